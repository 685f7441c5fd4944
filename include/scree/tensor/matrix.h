// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_matrix_h
#define scree_tensor_matrix_h

#include <scree/tensor/components.h>

#include <array>

namespace scree
{
  /// The dim x dim matrix of a symmetric tensor given by components (plane strain: the in-plane part).
  template <int dim, typename Number>
  std::array<std::array<Number, dim>, dim> matrix_of_components(const Number *t)
  {
    if constexpr (dim == 2)
      return { { { { t[0], t[3] } }, { { t[3], t[1] } } } };
    else
      return { { { { t[0], t[3], t[4] } }, { { t[3], t[1], t[5] } }, { { t[4], t[5], t[2] } } } };
  }

  /// Determinant of a symmetric tensor given by components, in three dimensions.
  template <int dim, typename Number>
  Number determinant_of_components(const Number *t)
  {
    if constexpr (dim == 2)
      return t[2] * (t[0] * t[1] - t[3] * t[3]);
    else
      return t[0] * (t[1] * t[2] - t[5] * t[5]) - t[3] * (t[3] * t[2] - t[5] * t[4]) +
             t[4] * (t[3] * t[5] - t[1] * t[4]);
  }

  /// The square of a symmetric tensor given by components, in three dimensions.
  template <typename Number>
  void square_of_components(const Number *t, Number *square)
  {
    square[0] = t[0] * t[0] + t[3] * t[3] + t[4] * t[4];
    square[1] = t[1] * t[1] + t[3] * t[3] + t[5] * t[5];
    square[2] = t[2] * t[2] + t[4] * t[4] + t[5] * t[5];
    square[3] = t[3] * (t[0] + t[1]) + t[4] * t[5];
    square[4] = t[4] * (t[0] + t[2]) + t[3] * t[5];
    square[5] = t[5] * (t[1] + t[2]) + t[3] * t[4];
  }

  /// Determinant of a dim x dim matrix, row-major.
  template <int dim, typename Number>
  Number determinant_of_rows(const Number *m)
  {
    if constexpr (dim == 2)
      return m[0] * m[3] - m[1] * m[2];
    else
      return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
             m[2] * (m[3] * m[7] - m[4] * m[6]);
  }

  /// Inverse of a dim x dim matrix, row-major.
  template <int dim, typename Number>
  void invert_rows(const Number *m, Number *inverse)
  {
    const Number scale = 1. / determinant_of_rows<dim>(m);
    if constexpr (dim == 2)
      {
        inverse[0] = scale * m[3];
        inverse[1] = -scale * m[1];
        inverse[2] = -scale * m[2];
        inverse[3] = scale * m[0];
      }
    else
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const unsigned int k = (j + 1) % 3, l = (j + 2) % 3, o = (i + 1) % 3, q = (i + 2) % 3;
            inverse[3 * i + j] = scale * (m[3 * k + o] * m[3 * l + q] - m[3 * k + q] * m[3 * l + o]);
          }
  }
} // namespace scree

#endif
