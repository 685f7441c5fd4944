// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/tensor/matrix.h>
#include <scree/transfer/affine_field.h>
#include <scree/transfer/transfer.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Sums of a cell's points at its nodes.
    template <int dim, int n>
    class CellSums
    {
    public:
      static constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;

      /// Adds `momentum[c]` and `mass` (already weighted with the shape functions of the first axis) and the traction
      /// -V sigma grad phi.
      void add(const RowFactors<dim, n> &rows,
               const NodeRow mass,
               const NodeRow (&momentum)[dim],
               const NodeRow (&force_x)[dim],
               const NodeRow (&force_other)[dim][dim - 1])
      {
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            sums[r][0] += mass * rows.value[r];
            for (unsigned int c = 0; c < dim; ++c)
              {
                sums[r][1 + c] += momentum[c] * rows.value[r];
                sums[r][1 + dim + c] += force_x[c] * rows.value[r];
                for (unsigned int a = 0; a < dim - 1; ++a)
                  sums[r][1 + dim + c] += force_other[c][a] * rows.derivative[a][r];
              }
          }
      }

      /// The part of the momentum that depends on the row: the affine field's slope along the other axes.
      void add_momentum(const unsigned int row, const unsigned int c, const NodeRow momentum)
      {
        sums[row][1 + c] += momentum;
      }

      void scatter(const unsigned int *nodes, NodalField<dim> &field) const
      {
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n; ++i)
            {
              double *node = field[nodes[r * n + i]];
              for (unsigned int c = 0; c < NodalField<dim>::n_components; ++c)
                node[c] += sums[r][c][i];
            }
      }

    private:
      NodeRow sums[n_rows][NodalField<dim>::n_components] = {};
    };
  } // namespace


  template <int dim>
  template <int n, TransferMethod method>
  void Transfer<dim>::add_points(const SoilBody<dim> &body, NodalField<dim> &field) const
  {
    constexpr bool is_affine = method == TransferMethod::apic || method == TransferMethod::tpic;
    const double width = grid.cell_size(), inverse_width = 1. / width;
    const auto &layout = body.layout;

    for (const auto &cell : body.points.cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        CellSums<dim, n> sums;

        const double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += body.points.stride())
          {
            const CellBasis<dim, n> basis(cell.reference_location[p], open);
            const RowFactors<dim, n> rows(basis);
            const NodeRow value_x = make_row(basis.value[0]), derivative_x = make_row(basis.derivative[0]);

            const double mass  = properties[layout.mass];
            const double scale = -properties[layout.volume] * inverse_width;
            const auto sigma   = matrix_of_components<dim>(properties + layout.stress);

            NodeRow momentum[dim], force_x[dim], force_other[dim][dim - 1];
            for (unsigned int c = 0; c < dim; ++c)
              {
                momentum[c] = value_x * (mass * properties[layout.velocity + c]);
                force_x[c]  = derivative_x * (scale * sigma[c][0]);
                for (unsigned int a = 1; a < dim; ++a)
                  force_other[c][a - 1] = value_x * (scale * sigma[c][a]);
              }

            if constexpr (is_affine)
              add_affine_momentum<method>(basis,
                                          rows,
                                          open,
                                          cell.reference_location[p],
                                          width,
                                          mass,
                                          properties + layout.affine,
                                          momentum,
                                          [&](const unsigned int r, const unsigned int c, const NodeRow &part) {
                                            sums.add_momentum(r, c, part);
                                          });

            sums.add(rows, value_x * mass, momentum, force_x, force_other);
          }
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
        case TransferMethod::apic:
          return add_points<n, TransferMethod::apic>(body, field);
        case TransferMethod::tpic:
          return add_points<n, TransferMethod::tpic>(body, field);
        default: // FLIP and PIC differ on the way back only.
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
