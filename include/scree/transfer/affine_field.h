// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_affine_field_h
#define scree_transfer_affine_field_h

#include <scree/transfer/batch_shape.h>
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
  template <TransferMethod method, int dim, int n, typename Shape>
  DEAL_II_ALWAYS_INLINE inline AffineMomentum<dim, n>
  affine_momentum(const Shape &shape, const double width, const double mass, const double *affine)
  {
    AffineMomentum<dim, n> result{};
    if constexpr (carries_affine(method))
      for (unsigned int a = 0; a < dim; ++a)
        {
          result.factor[a] = shape.moment[a];
          double scale     = mass;
          if constexpr (method == TransferMethod::apic)
            {
              // APIC stores sum phi v (x_i - x)^T; the linear basis makes this vanish at a node together with its
              // inertia.
              const auto positions = CellBasis<dim, n>::node_positions(shape.open, a);
              double inertia       = 0.;
              for (unsigned int i = 0; i < n; ++i)
                inertia += shape.moment[a][i] * (width * (positions[i] - shape.x[a]));
              scale = inertia > 1e-12 * width * width ? mass / inertia : 0.;
            }
          for (unsigned int c = 0; c < dim; ++c)
            result.slope[c][a] = scale * affine[c * dim + a];
        }
    return result;
  }
} // namespace scree

#endif
