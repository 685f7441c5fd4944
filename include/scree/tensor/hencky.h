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
    constexpr unsigned int rows[6] = { 0, 1, 2, 0, 0, 1 }, columns[6] = { 0, 1, 2, 1, 2, 2 };
    const auto full = matrix_of_components<dim>(b);
    Number product[dim][dim]; // f b
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          product[i][j] = f[dim * i] * full[0][j] + f[dim * i + 1] * full[1][j];
          if constexpr (dim == 3)
            product[i][j] += f[dim * i + 2] * full[2][j];
        }
    for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
      if (dim == 2 && c == 2)
        result[c] = out_of_plane_stretch * out_of_plane_stretch * b[c];
      else
        {
          const Number *of_row = product[rows[c]], *of_column = f + dim * columns[c];
          result[c] = of_row[0] * of_column[0] + of_row[1] * of_column[1];
          if constexpr (dim == 3)
            result[c] += of_row[2] * of_column[2];
        }
  }
} // namespace scree

#endif
