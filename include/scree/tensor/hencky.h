// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_tensor_hencky_h
#define scree_tensor_hencky_h

#include <scree/tensor/principal.h>

namespace scree
{
  /// Principal logarithmic strains, 1/2 ln of the principal values of a left Cauchy-Green tensor.
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number> log_strain(const PrincipalNumbers<Number> &left_cauchy_green)
  {
    return { { 0.5 * simd::log<Number>(left_cauchy_green[0]),
               0.5 * simd::log<Number>(left_cauchy_green[1]),
               0.5 * simd::log<Number>(left_cauchy_green[2]) } };
  }

  /// Exponential map (@source{simo1992}): b = sum exp(2 strain_i) n_i n_i along the axes of `frame`.
  template <int dim, typename Number>
  DEAL_II_ALWAYS_INLINE inline void
  left_cauchy_green_of(const PrincipalFrame<dim, Number> &frame, const PrincipalNumbers<Number> &strain, Number *result)
  {
    frame.compose(
        { { simd::exp<Number>(2. * strain[0]), simd::exp<Number>(2. * strain[1]), simd::exp<Number>(2. * strain[2]) } },
        result);
  }

  /// Trial b = f b f^T by components. In plane strain `out_of_plane_stretch` is f_zz; in three dimensions it is not
  /// read.
  ///
  /// @param f dim x dim, row-major
  template <int dim, typename Number>
  DEAL_II_ALWAYS_INLINE inline void
  trial_left_cauchy_green(const Number *f, const Number &out_of_plane_stretch, const Number *b, Number *result)
  {
    if constexpr (dim == 2)
      {
        const Number x_x = f[0] * b[0] + f[1] * b[3]; // (f b)_xx and so on
        const Number x_y = f[0] * b[3] + f[1] * b[1];
        const Number y_x = f[2] * b[0] + f[3] * b[3];
        const Number y_y = f[2] * b[3] + f[3] * b[1];

        result[0] = x_x * f[0] + x_y * f[1];
        result[1] = y_x * f[2] + y_y * f[3];
        result[2] = out_of_plane_stretch * out_of_plane_stretch * b[2];
        result[3] = x_x * f[2] + x_y * f[3];
      }
    else
      {
        const Number full[3][3] = { { b[0], b[3], b[4] }, { b[3], b[1], b[5] }, { b[4], b[5], b[2] } };
        Number product[3][3];
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            product[i][j] = f[3 * i] * full[0][j] + f[3 * i + 1] * full[1][j] + f[3 * i + 2] * full[2][j];

        constexpr unsigned int rows[6]    = { 0, 1, 2, 0, 0, 1 };
        constexpr unsigned int columns[6] = { 0, 1, 2, 1, 2, 2 };
        for (unsigned int c = 0; c < 6; ++c)
          result[c] = product[rows[c]][0] * f[3 * columns[c]] + product[rows[c]][1] * f[3 * columns[c] + 1] +
                      product[rows[c]][2] * f[3 * columns[c] + 2];
      }
  }
} // namespace scree

#endif
