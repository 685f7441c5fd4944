// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/particle_shifting.h>
#include <scree/mixture/mixture.h>
#include <scree/mesh/node_rows.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  ParticleShifting<dim>::ParticleShifting(const BackgroundGrid<dim> &grid,
                                          const Constraints<dim> &constraints,
                                          const FreeSurface<dim> &surface,
                                          PorePressure<dim> &pressure,
                                          const Tensor<1, dim> &gravity,
                                          const double rate)
      : grid(grid)
      , constraints(constraints)
      , surface(surface)
      , pressure(pressure)
      , gravity(gravity)
      , rate(rate)
  {
    if (rate > 0.)
      shifts.emplace(grid.numbering());
    reinit();
  }


  template <int dim>
  void ParticleShifting<dim>::reinit()
  {
    if (rate == 0.)
      return;
    volume_inside.reinit(grid.vertices().partitioner());
    shifts->reinit();
  }


  template <int dim>
  void ParticleShifting<dim>::find_inside(const Mixture<dim> &mixture)
  {
    volume_inside.zero_out_ghost_values();
    volume_inside = 0.;
    for (const MixtureCell<dim> &cell : mixture.cells())
      {
        const unsigned int *vertices = grid.vertices().nodes(cell.cell);
        if (std::all_of(vertices, vertices + cell.n_vertices, [&](const unsigned int vertex) {
              return surface.kind(vertex) == PressureDofType::unknown;
            }))
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            volume_inside.local_element(vertices[v]) += surface.volume_in_cell(cell.cell, v);
      }
    volume_inside.compress(VectorOperation::add);
  }


  template <int dim>
  bool ParticleShifting<dim>::find_potential(const Mixture<dim> &mixture, const double time_step, Budget<dim> &balance)
  {
    const double part = -std::expm1(-rate * time_step);
    find_inside(mixture);
    source.clear();
    bool is_any = false;
    for (const unsigned int vertex : surface.unknowns())
      {
        const double surplus = surface.fill(vertex) - 1., volume = surface.volume_under(vertex);
        const bool inside = volume_inside.local_element(vertex) > (1. - 1e-9) * volume;
        // At the free surface a deficit is expected: only an excess is corrected.
        const bool counts = surplus > closures::least_surplus || (inside && surplus < -closures::least_surplus);
        const bool moves  = counts && surface.is_free_water(vertex);
        source.push_back(moves ? part * surplus * volume / time_step : 0.);
        is_any = is_any || moves;
      }
    if (!Utilities::MPI::logical_or(is_any, grid.communicator()))
      return false;
    pressure.solve_potential(source, balance);
    return true;
  }


  template <int dim>
  void
  ParticleShifting<dim>::find_shifts(const Mixture<dim> &mixture, const WetNodes<dim> &nodes, const double time_step)
  {
    shifts->clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      shifts->activate_cell(cell.cell);
    const FlowField<dim> &of_flow = pressure.impulses_of_potential(time_step);
    const double most             = 0.1 * grid.cell_size();
    for (const unsigned int node : shifts->active_nodes())
      {
        const double mass = nodes.water[node][NodalField<dim>::mass];
        const bool moves  = mass > 0. && !(nodes.pores[node][Pores::grain_fraction] > 0.);
        double *values    = (*shifts)[node];
        Tensor<1, dim> shift;
        for (unsigned int c = 0; c < dim && moves; ++c)
          shift[c] = std::clamp(time_step * (of_flow[node][c] + of_flow[node][dim + c]) / mass, -most, most);
        if (const NodeConstraints<dim> *walls = constraints.at(node))
          shift = walls->water_constraint.free_part(shift);
        for (unsigned int c = 0; c < dim; ++c)
          values[c] = shift[c];
      }
    shifts->update_ghosts();
  }


  template <int dim>
  void ParticleShifting<dim>::apply(WaterPhase<dim> &water,
                                    const Mixture<dim> &mixture,
                                    const WetNodes<dim> &nodes,
                                    const double time_step,
                                    Budget<dim> &balance)
  {
    if (rate == 0.)
      return;
    if (water.own_points() == nullptr)
      return; // Water that rides on the soil's points moves with them.
    if (!find_potential(mixture, time_step, balance))
      return;
    find_shifts(mixture, nodes, time_step);
    move(water, balance);
  }


  template <int dim>
  void ParticleShifting<dim>::move(WaterPhase<dim> &water, Budget<dim> &balance) const
  {
    with_nodes_1d(grid, [&](auto n) {
      constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
      const auto &layout            = water.layout;
      for (const auto &cell : water.points().cells())
        {
          NodeRow of_nodes[dim][n_rows]{};
          for (unsigned int r = 0; r < n_rows; ++r)
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int c = 0; c < dim; ++c)
                of_nodes[c][r][i] = (*shifts)[grid.nodes(cell.cell)[r * n + i]][c];
          for_each_record(cell, [&](const auto &point) {
            const PointShape<dim, n> shape(point.reference_location, grid.open_knots(cell.cell));
            Tensor<1, dim> shift;
            for (unsigned int c = 0; c < dim; ++c)
              shift[c] = sum(contract(shape.rows.value, of_nodes[c]) * shape.value_x);
            point.location += shift;
            balance.correction_work -= point.properties[layout.mass] * (gravity * shift);
            // The pressure stays where it is; the point reads it at its new place.
            for (unsigned int c = 0; c < dim; ++c)
              point.properties[layout.pressure] += point.properties[layout.pressure_gradient + c] * shift[c];
          });
        }
    });
  }

  template class ParticleShifting<2>;
  template class ParticleShifting<3>;
} // namespace scree
