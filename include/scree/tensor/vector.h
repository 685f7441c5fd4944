// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_vector_h
#define scree_tensor_vector_h

#include <deal.II/base/tensor.h>

namespace scree
{
  /// The vector whose components lie behind each other.
  template <int dim>
  dealii::Tensor<1, dim> vector_of(const double *components)
  {
    return dealii::Tensor<1, dim>(dealii::make_array_view(components, components + dim));
  }
} // namespace scree

#endif
