// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_matrix_h
#define scree_tensor_matrix_h

#include <scree/tensor/components.h>

#include <array>

namespace scree
{
  /// The dim x dim matrix of a symmetric tensor given by components (plane strain: the in-plane part).
  template <int dim>
  std::array<std::array<double, dim>, dim> matrix_of_components(const double *t)
  {
    if constexpr (dim == 2)
      return { { { { t[0], t[3] } }, { { t[3], t[1] } } } };
    else
      return { { { { t[0], t[3], t[4] } }, { { t[3], t[1], t[5] } }, { { t[4], t[5], t[2] } } } };
  }

  /// Determinant of a symmetric tensor given by components, in three dimensions.
  template <int dim>
  double determinant_of_components(const double *t)
  {
    if constexpr (dim == 2)
      return t[2] * (t[0] * t[1] - t[3] * t[3]);
    else
      return t[0] * (t[1] * t[2] - t[5] * t[5]) - t[3] * (t[3] * t[2] - t[5] * t[4]) +
             t[4] * (t[3] * t[5] - t[1] * t[4]);
  }
} // namespace scree

#endif
