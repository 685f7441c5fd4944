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

  /// @param affine the point's slots: the velocity gradient (TPIC, AFLIP); nothing for FLIP
  /// @param mass kg
  template <TransferMethod method, int dim, int n, typename Shape>
  DEAL_II_ALWAYS_INLINE inline AffineMomentum<dim, n>
  affine_momentum(const Shape &shape, const double mass, const double *affine)
  {
    AffineMomentum<dim, n> result{};
    if constexpr (carries_affine(method))
      for (unsigned int a = 0; a < dim; ++a)
        {
          result.factor[a] = shape.moment[a];
          for (unsigned int c = 0; c < dim; ++c)
            result.slope[c][a] = mass * affine[c * dim + a];
        }
    return result;
  }
} // namespace scree

#endif
