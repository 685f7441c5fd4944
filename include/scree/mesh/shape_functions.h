// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_shape_functions_h
#define scree_mesh_shape_functions_h

#include <scree/mesh/background_grid.h>

namespace scree
{
  /// Calls `visit(node, shape value)` for the nodes that act at the place `x` (in cell widths from the lower corner) of
  /// a cell of this rank. For output and the like: the kernels of the transfer work on rows of nodes.
  template <int dim, typename Visit>
  void
  visit_nodes(const BackgroundGrid<dim> &grid, const unsigned int cell, const dealii::Point<dim> &x, const Visit &visit)
  {
    const auto visit_basis = [&](const auto &basis, const unsigned int n) {
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        {
          double value = 1.;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            value *= basis.value[a][rest % n];
          visit(grid.nodes(cell)[i], value);
        }
    };
    if (grid.n_nodes_1d() == 2)
      visit_basis(CellBasis<dim, 2>(x, grid.open_knots(cell)), 2);
    else
      visit_basis(CellBasis<dim, 3>(x, grid.open_knots(cell)), 3);
  }
} // namespace scree

#endif
