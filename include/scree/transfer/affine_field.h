// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_affine_field_h
#define scree_transfer_affine_field_h

#include <scree/transfer/node_rows.h>
#include <scree/transfer/transfer_parameters.h>

#include <deal.II/base/config.h>

namespace scree
{
  /// Adds the momentum of a point's affine velocity field to a cell's nodes: phi_i m C (x_i - x). Inlined by force: out
  /// of line, points to nodes take up to a third more (2D, TPIC).
  ///
  /// @param width of the cell, m
  /// @param affine the point's slots: the velocity gradient (TPIC, AFLIP), or sum phi v (x_i - x)^T (APIC)
  /// @param momentum of the row of nodes, still to be multiplied with the factors of the other axes; is added to
  /// @param add_to_row called with (row, component, momentum) for what depends on the row
  template <TransferMethod method, int dim, int n, typename Function>
  DEAL_II_ALWAYS_INLINE inline void add_affine_momentum(const PointShape<dim, n> &shape,
                                                        const double width,
                                                        const double mass,
                                                        const double *affine,
                                                        NodeRow (&momentum)[dim],
                                                        const Function &add_to_row)
  {
    const NodeRow value_x = shape.value_x;
    std::array<std::array<double, n>, dim> offset; // of the nodes from the point, m
    std::array<double, dim> inertia{};
    for (unsigned int a = 0; a < dim; ++a)
      {
        offset[a] = CellBasis<dim, n>::node_positions(shape.open, a);
        for (unsigned int i = 0; i < n; ++i)
          {
            offset[a][i] = width * (offset[a][i] - shape.x[a]);
            inertia[a] += shape.basis.value[a][i] * offset[a][i] * offset[a][i];
          }
      }
    const NodeRow offset_x = make_row(offset[0]);
    for (unsigned int c = 0; c < dim; ++c)
      {
        double slope[dim]; // of the momentum, kg/s
        for (unsigned int a = 0; a < dim; ++a)
          {
            slope[a] = mass * affine[c * dim + a];
            // APIC stores sum phi v (x_i - x)^T; the linear basis makes this vanish at a node together with its
            // inertia.
            if (method == TransferMethod::apic)
              slope[a] = inertia[a] > 1e-12 * width * width ? slope[a] / inertia[a] : 0.;
          }
        momentum[c] += value_x * offset_x * slope[0];
        for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
          {
            double along = slope[1] * offset[1][r % n];
            if constexpr (dim == 3)
              along += slope[2] * offset[2][r / n];
            add_to_row(r, c, value_x * (along * shape.rows.value[r]));
          }
      }
  }


  /// phi_i (x_i - x) along each axis, m: what takes the place of an axis' shape functions in sum phi_i v_i (x_i - x)^T,
  /// which APIC stores.
  ///
  /// @param x places in the cell
  template <int dim, int n>
  std::array<std::array<Batch, n>, dim> moment_factors(const CellBasis<dim, n, Batch> &basis,
                                                       const std::array<Batch, dim> &x,
                                                       const OpenKnots open,
                                                       const double width)
  {
    std::array<std::array<Batch, n>, dim> factors;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const auto positions = CellBasis<dim, n>::node_positions(open, a);
        for (unsigned int i = 0; i < n; ++i)
          factors[a][i] = basis.value[a][i] * (width * (positions[i] - x[a]));
      }
    return factors;
  }
} // namespace scree

#endif
