// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/shape_functions.h>
#include <scree/postprocess/visualization/interpolation.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim> velocity_at(const Point<dim> &x,
                             const BackgroundGrid<dim> &grid,
                             const unsigned int cell,
                             const NodalField<dim> &field)
  {
    Tensor<1, dim> velocity;
    visit_nodes(grid, cell, x, [&](const unsigned int node, const double shape) {
      for (unsigned int c = 0; c < dim; ++c)
        velocity[c] += shape * field[node][NodalField<dim>::velocity + c];
    });
    return velocity;
  }


  template <int dim>
  Tensor<1, dim> relative_velocity_at(const Point<dim> &x,
                                      const BackgroundGrid<dim> &grid,
                                      const unsigned int cell,
                                      const NodalField<dim> &soil,
                                      const NodalField<dim> &water)
  {
    using Field = NodalField<dim>;
    Tensor<1, dim> velocity;
    visit_nodes(grid, cell, x, [&](const unsigned int node, const double shape) {
      // A node without mass has no velocity of its own.
      if (soil[node][Field::mass] > 0 && water[node][Field::mass] > 0)
        for (unsigned int c = 0; c < dim; ++c)
          velocity[c] += shape * (water[node][Field::velocity + c] - soil[node][Field::velocity + c]);
    });
    return velocity;
  }

  template Tensor<1, 2>
  velocity_at(const Point<2> &, const BackgroundGrid<2> &, const unsigned int, const NodalField<2> &);
  template Tensor<1, 3>
  velocity_at(const Point<3> &, const BackgroundGrid<3> &, const unsigned int, const NodalField<3> &);
  template Tensor<1, 2> relative_velocity_at(const Point<2> &,
                                             const BackgroundGrid<2> &,
                                             const unsigned int,
                                             const NodalField<2> &,
                                             const NodalField<2> &);
  template Tensor<1, 3> relative_velocity_at(const Point<3> &,
                                             const BackgroundGrid<3> &,
                                             const unsigned int,
                                             const NodalField<3> &,
                                             const NodalField<3> &);
} // namespace scree
