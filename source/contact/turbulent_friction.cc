// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/turbulent_friction.h>
#include <scree/mesh/cell_basis.h>
#include <scree/tensor/vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  TurbulentFriction<dim>::TurbulentFriction(const BackgroundGrid<dim> &grid,
                                            const DiscreteLevelSet<dim> &bed,
                                            const double coefficient,
                                            const double gravity)
      : grid(grid)
      , bed(bed)
      , factor(gravity / coefficient)
      , reach(grid.cell_size())
  {
  }


  template <int dim>
  template <int n>
  void TurbulentFriction<dim>::add_to(NodalField<dim> &field,
                                      std::list<SoilBody<dim>> &bodies,
                                      const unsigned int group,
                                      const double time_step,
                                      Budget<dim> &balance) const
  {
    using Basis = CellBasis<dim, n>;
    for (auto &body : bodies)
      {
        if (body.group != group || body.is_rigid)
          continue;
        const auto add_point = [&](const auto &point) {
          const SurfaceView<dim> view = bed.view(point.cell, point.reference_location);
          if (view.distance >= reach)
            return;
          const Tensor<1, dim> velocity = vector_of<dim>(point.properties + PropertyLayout<dim>::velocity);
          const Tensor<1, dim> along    = velocity - (velocity * view.normal) * view.normal;
          const double weight           = 2. / reach * (1. - std::max(view.distance, 0.) / reach);
          const double rate             = std::min(factor * weight * along.norm(), 1. / time_step); // 1/s
          const Tensor<1, dim> force    = -point.properties[body.layout.mass] * rate * along;
          balance.bed_impulse += time_step * force;
          balance.bed_dissipation -= time_step * force * along;

          const Basis basis(point.reference_location, grid.open_knots(point.cell));
          const unsigned int *nodes = grid.nodes(point.cell);
          for (unsigned int i = 0; i < Basis::n_nodes; ++i)
            {
              double shape = 1.;
              for (unsigned int a = 0, j = i; a < dim; ++a, j /= n)
                shape *= basis.value[a][j % n];
              for (unsigned int c = 0; c < dim; ++c)
                field[nodes[i]][NodalField<dim>::force + c] += shape * force[c];
            }
        };
        for (const auto &cell : body.points.cells())
          if (bed.least_distance(cell.cell) < reach)
            for_each_point(cell, add_point);
      }
  }


  template <int dim>
  void TurbulentFriction<dim>::add_to(NodalField<dim> &field,
                                      std::list<SoilBody<dim>> &bodies,
                                      const unsigned int group,
                                      const double time_step,
                                      Budget<dim> &balance) const
  {
    with_nodes_1d(grid, [&](auto n) { add_to<n>(field, bodies, group, time_step, balance); });
  }

  template class TurbulentFriction<2>;
  template class TurbulentFriction<3>;
} // namespace scree
