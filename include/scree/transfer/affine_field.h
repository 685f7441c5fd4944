// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_affine_field_h
#define scree_transfer_affine_field_h

#include <scree/mesh/node_rows.h>
#include <scree/transfer/transfer_parameters.h>

#include <deal.II/base/config.h>

namespace scree
{
  /// The momentum of a point's affine velocity field, phi_i m C (x_i - x), as the axes contribute to it.
  template <int dim, int n>
  struct AffineMomentum
  {
    std::array<std::array<double, dim>, dim> slope; ///< m C by component and axis, kg/s
    std::array<std::array<double, n>, dim> factor;  ///< shape functions of an axis times x_i - x, m
  };

  /// @param width of the cell, m
  /// @param affine the point's slots: the velocity gradient (TPIC, AFLIP), or sum phi v (x_i - x)^T (APIC); nothing for
  /// other methods
  template <TransferMethod method, int dim, int n>
  DEAL_II_ALWAYS_INLINE inline AffineMomentum<dim, n>
  affine_momentum(const PointShape<dim, n> &shape, const double width, const double mass, const double *affine)
  {
    AffineMomentum<dim, n> result{};
    if constexpr (carries_affine(method))
      for (unsigned int a = 0; a < dim; ++a)
        {
          const auto positions = CellBasis<dim, n>::node_positions(shape.open, a);
          double inertia       = 0.;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double offset = width * (positions[i] - shape.x[a]);
              result.factor[a][i] = shape.basis.value[a][i] * offset;
              inertia += result.factor[a][i] * offset;
            }
          // APIC stores sum phi v (x_i - x)^T; the linear basis makes this vanish at a node together with its inertia.
          double scale = mass;
          if (method == TransferMethod::apic)
            scale = inertia > 1e-12 * width * width ? mass / inertia : 0.;
          for (unsigned int c = 0; c < dim; ++c)
            result.slope[c][a] = scale * affine[c * dim + a];
        }
    return result;
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
