// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_cell_velocity_h
#define scree_transfer_cell_velocity_h

#include <scree/grid/nodal_field.h>
#include <scree/transfer/node_rows.h>

namespace scree
{
  /// End-of-step velocity and its change at a cell's nodes.
  template <int dim, int n>
  struct CellVelocity
  {
    static constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;

    NodeRow velocity[dim][n_rows];
    NodeRow change[dim][n_rows];

    CellVelocity(const unsigned int *nodes, const NodalField<dim> &field)
    {
      for (unsigned int r = 0; r < n_rows; ++r)
        {
          std::array<const double *, n> node;
          for (unsigned int i = 0; i < n; ++i)
            node[i] = field[nodes[r * n + i]];
          for (unsigned int c = 0; c < dim; ++c)
            {
              std::array<double, n> v, dv;
              for (unsigned int i = 0; i < n; ++i)
                {
                  v[i]  = node[i][NodalField<dim>::velocity + c];
                  dv[i] = node[i][NodalField<dim>::velocity_change + c];
                }
              velocity[c][r] = make_row(v);
              change[c][r]   = make_row(dv);
            }
        }
    }
  };
} // namespace scree

#endif
