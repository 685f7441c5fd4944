// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/tensor/matrix.h>
#include <scree/transfer/cell_sums.h>
#include <scree/transfer/transfer.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  template <int n, TransferMethod method>
  void Transfer<dim>::add_points(const SoilBody<dim> &body, NodalField<dim> &field) const
  {
    const auto &layout = body.layout;
    // Without a name for the cells GCC writes the sums of each cell to memory before they are added to the nodes: 8 %
    // of the time from points to nodes in 2D.
    const auto &cells = body.points.cells();
    for (const auto &cell : cells)
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        CellSums<dim, n> sums(grid.cell_size());
        for_each_record_with_shape<n>(
            cell, cell.stride, open, grid.cell_size(), [&](const auto &point, const auto &shape) {
              const double *properties = point.properties;
              sums.template add<method>(shape,
                                        properties[layout.mass],
                                        properties + layout.velocity,
                                        properties + layout.affine,
                                        properties[layout.volume],
                                        matrix_of_components<dim>(properties + layout.stress));
            });
        field.activate_cell(cell.cell);
        sums.scatter(grid.nodes(cell.cell), field);
      }
  }


  template <int dim>
  void Transfer<dim>::to_grid(const SoilBody<dim> &body, NodalField<dim> &field) const
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::tpic:
        case TransferMethod::aflip: // They differ on the way back only.
          return add_points<n, TransferMethod::tpic>(body, field);
        default:
          return add_points<n, TransferMethod::flip>(body, field);
        }
    };
    if (grid.n_nodes_1d() == 2)
      dispatch(std::integral_constant<int, 2>());
    else
      dispatch(std::integral_constant<int, 3>());
  }

  template void Transfer<2>::to_grid(const SoilBody<2> &, NodalField<2> &) const;
  template void Transfer<3>::to_grid(const SoilBody<3> &, NodalField<3> &) const;
} // namespace scree
