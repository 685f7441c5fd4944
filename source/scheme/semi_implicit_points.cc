// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/shape_functions.h>
#include <scree/scheme/semi_implicit_scheme.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  double SemiImplicitScheme<dim>::to_points(WaterPhase<dim> &water, const double time_step)
  {
    return transfer.to_points(
        water, water_nodes, [this](const unsigned int cell) { return corner_pressure(cell); }, time_step);
  }


  template <int dim>
  void
  SemiImplicitScheme<dim>::correct_volume(WaterPhase<dim> &water, const double time_step, StepBalance<dim> &balance)
  {
    if (volume_correction == 0. || water.own_points() == nullptr)
      return;
    // A flow that takes a part of the surplus out of each corner: L chi = beta (F - 1) integral psi / dt.
    source = 0.;
    for (const unsigned int corner : surface.wet_corners())
      if (surface.kind(corner) == CornerKind::unknown && surface.is_free_water(corner))
        source.local_element(corner) =
            volume_correction * (surface.fill(corner) - 1.) * surface.volume_under(corner) / time_step;
    count(solver.solve(source, pressure, crowding), balance);
    crowding.update_ghost_values();
    surface.extrapolate(mixture, crowding);

    correction.clear();
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      if (const MixtureCell<dim> &cell = mixture.cells()[record]; cell.water_volume > 0)
        {
          correction.activate_cell(cell.cell);
          mixture.add_pressure_gradient(record,
                                        multilinear_of<dim>(at_corners(crowding, cell.cell)),
                                        -time_step * time_step,
                                        correction,
                                        0,
                                        correction,
                                        dim);
        }
    correction.add_contributions();
    const double most = 0.1 * grid.cell_size();
    for (const unsigned int node : correction.active_nodes())
      {
        const double mass  = water_nodes[node][NodalField<dim>::mass];
        const bool in_soil = pores[node][PoreField<dim>::grain_fraction] > 0.;
        for (unsigned int c = 0; c < dim; ++c)
          {
            double &shift    = correction[node][dim + c];
            const bool fixed = forcing.is_held(node) || (water_walls.fixed_components(grid.node_faces(node)) >> c) & 1;
            shift            = mass > 0. && !in_soil && !fixed ? std::clamp(shift / mass, -most, most) : 0.;
          }
      }
    correction.update_ghosts();

    for (const CellPoints<dim> &cell : water.points().cells())
      for (unsigned int p = 0; p < cell.n_points; ++p)
        {
          Tensor<1, dim> shift;
          visit_nodes(grid, cell.cell, cell.reference_location[p], [&](const unsigned int node, const double shape) {
            for (unsigned int c = 0; c < dim; ++c)
              shift[c] += shape * correction[node][dim + c];
          });
          cell.location[p] += shift;
        }
  }


  template <int dim>
  double SemiImplicitScheme<dim>::largest_step() const
  {
    if (viscosity == 0.)
      return std::numeric_limits<double>::infinity();
    return 0.25 / dim * grid.cell_size() * grid.cell_size() * water_density / viscosity;
  }


  template <int dim>
  void SemiImplicitScheme<dim>::fluidise(SoilBody<dim> &soil) const
  {
    if (fluidisation_porosity >= 1.)
      return;
    const auto &layout = soil.layout;
    std::vector<double> scratch(layout.n_properties); // a state without stress must not reset the internal variables
    const double no_stress[n_symmetric_components<dim>] = {};
    for (const CellPoints<dim> &cell : soil.points.cells())
      for (unsigned int p = 0; p < cell.n_points; ++p)
        {
          double *properties = cell.properties + p * soil.points.stride();
          if (soil.porosity(properties) > fluidisation_porosity)
            soil.material->initialise(
                no_stress, properties + layout.left_cauchy_green, properties + layout.stress, scratch.data());
        }
  }

  template double SemiImplicitScheme<2>::to_points(WaterPhase<2> &, const double);
  template double SemiImplicitScheme<3>::to_points(WaterPhase<3> &, const double);
  template void SemiImplicitScheme<2>::correct_volume(WaterPhase<2> &, const double, StepBalance<2> &);
  template void SemiImplicitScheme<3>::correct_volume(WaterPhase<3> &, const double, StepBalance<3> &);
  template double SemiImplicitScheme<2>::largest_step() const;
  template double SemiImplicitScheme<3>::largest_step() const;
  template void SemiImplicitScheme<2>::fluidise(SoilBody<2> &) const;
  template void SemiImplicitScheme<3>::fluidise(SoilBody<3> &) const;
} // namespace scree
