// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/tensor/invariants.h>
#include <scree/transfer/viscous_force.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// 2 dev(sym grad v), 1/s: incompressible beside the pressure.
    template <int dim>
    Tensor<2, dim> twice_deviatoric_rate(const Tensor<2, dim> &gradient)
    {
      return gradient + transpose(gradient) - 2. / 3. * trace(gradient) * Tensor<2, dim>(unit_symmetric_tensor<dim>());
    }

    /// sum |grad phi_i|^2/phi_i, per square of the cell's width: a sum over the axes, as the others' functions add up
    /// to one.
    template <int dim, int n>
    double stiffness(const CellBasis<dim, n> &basis)
    {
      double sum = 0;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int i = 0; i < n; ++i)
          if (const double slope = basis.derivative[a][i]; slope != 0.)
            sum += slope * slope / basis.value[a][i];
      return sum;
    }
  } // namespace


  template <int dim>
  ViscousForce<dim>::ViscousForce(const BackgroundGrid<dim> &grid, const WaterParameters &water)
      : grid(grid)
      , viscosity(water.viscosity)
      , suspension(water.suspension, water.viscosity)
  {
  }


  template <int dim>
  auto ViscousForce<dim>::coefficient_of(const WaterPhase<dim> &water) const
  {
    return [this, volume = water.layout.volume](const double *properties) { return viscosity * properties[volume]; };
  }


  template <int dim>
  auto ViscousForce<dim>::coefficient_of(const SoilBody<dim> &soil) const
  {
    return [this, &soil](const double *properties) {
      const double part = suspension.suspended_part(mean_effective_stress(properties + soil.layout.stress));
      if (part == 0.)
        return 0.;
      const double porosity = std::max(soil.porosity(properties), 0.);
      return part * (suspension.viscosity(1. - porosity) - porosity * viscosity) * properties[soil.layout.volume];
    };
  }


  template <int dim>
  template <int n, typename Coefficient>
  void ViscousForce<dim>::add_points(const PointSet<dim> &points,
                                     const Coefficient &coefficient,
                                     const NodalField<dim> &motion,
                                     NodalField<dim> &field) const
  {
    for (const auto &cell : points.cells())
      {
        const OpenKnots open      = grid.open_knots(cell.cell);
        const unsigned int *nodes = grid.nodes(cell.cell);
        const CellVelocity<dim, n> velocity(nodes, motion, grid.cell_size());
        CellSums<dim, n> sums(grid.cell_size());
        for_each_point(cell, [&](const auto &point) {
          const double factor = coefficient(point.properties);
          if (factor == 0.)
            return;
          const PointShape<dim, n> shape(point.reference_location, open);
          sums.add(shape, sums.force_part(shape, factor, twice_deviatoric_rate(velocity.gradient(shape))));
        });
        field.activate_cell(cell.cell);
        sums.scatter(nodes, field);
      }
  }


  template <int dim>
  template <int n, typename Coefficient>
  double ViscousForce<dim>::largest_rate(const PointSet<dim> &points,
                                         const unsigned int mass_slot,
                                         const Coefficient &coefficient) const
  {
    double largest = 0;
    for (const auto &cell : points.cells())
      for_each_point(cell, [&, open = grid.open_knots(cell.cell)](const auto &point) {
        if (const double factor = coefficient(point.properties); factor > 0.)
          largest = std::max(largest,
                             factor / point.properties[mass_slot] *
                                 stiffness(CellBasis<dim, n>(point.reference_location, open)));
      });
    return 2. * largest / (grid.cell_size() * grid.cell_size());
  }


  template <int dim>
  void ViscousForce<dim>::add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const
  {
    if (grid.n_nodes_1d() == 2)
      add_points<2>(water.points(), coefficient_of(water), motion, field);
    else
      add_points<3>(water.points(), coefficient_of(water), motion, field);
  }


  template <int dim>
  void ViscousForce<dim>::add(const SoilBody<dim> &soil, const NodalField<dim> &motion, NodalField<dim> &field) const
  {
    if (!suspension.any() || soil.is_rigid)
      return;
    if (grid.n_nodes_1d() == 2)
      add_points<2>(soil.points, coefficient_of(soil), motion, field);
    else
      add_points<3>(soil.points, coefficient_of(soil), motion, field);
  }


  template <int dim>
  double ViscousForce<dim>::largest_rate(const WaterPhase<dim> &water) const
  {
    if (grid.n_nodes_1d() == 2)
      return largest_rate<2>(water.points(), water.layout.mass, coefficient_of(water));
    return largest_rate<3>(water.points(), water.layout.mass, coefficient_of(water));
  }


  template <int dim>
  double ViscousForce<dim>::largest_rate(const SoilBody<dim> &soil) const
  {
    if (!suspension.any() || soil.is_rigid)
      return 0.;
    if (grid.n_nodes_1d() == 2)
      return largest_rate<2>(soil.points, soil.layout.mass, coefficient_of(soil));
    return largest_rate<3>(soil.points, soil.layout.mass, coefficient_of(soil));
  }

  template class ViscousForce<2>;
  template class ViscousForce<3>;
} // namespace scree
