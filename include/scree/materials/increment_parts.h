// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_increment_parts_h
#define scree_materials_increment_parts_h

#include <scree/simd/batch.h>
#include <scree/tensor/hencky.h>
#include <scree/tensor/matrix.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  /// The deformation increments of a batch of points, each cut into equal parts.
  template <int dim>
  class IncrementParts
  {
  public:
    /// @param input of BatchRecords
    /// @param wanted smallest number of parts, rounded up here
    template <typename Input>
    IncrementParts(const Input &input, const Batch &wanted)
        : n(wanted)
    {
      for (unsigned int l = 0; l < batch_size; ++l)
        n[l] = std::max(std::ceil(n[l]), 1.);
      part           = 1. / n;
      stretch_change = part * (input.out_of_plane_stretch - 1.);
      for (unsigned int i = 0; i < dim * dim; ++i)
        change[i] = i % (dim + 1) == 0 ? input.increment[i] - 1. : input.increment[i];
    }

    /// Trial b of part `k`, from the elastic b that the part before has left.
    void trial(const unsigned int k, const Batch *left_cauchy_green, Batch *result) const
    {
      Batch before[dim * dim], inverse[dim * dim], f[dim * dim];
      for (unsigned int i = 0; i < dim * dim; ++i)
        before[i] = (k * part) * change[i] + (i % (dim + 1) == 0 ? 1. : 0.);
      invert_rows<dim>(before, inverse);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            f[i * dim + j] = simd::broadcast<Batch>(i == j ? 1. : 0.);
            for (unsigned int m = 0; m < dim; ++m)
              f[i * dim + j] += part * change[i * dim + m] * inverse[m * dim + j];
          }
      trial_left_cauchy_green<dim, Batch>(
          f, 1. + stretch_change / (1. + k * stretch_change), left_cauchy_green, result);
    }

    Batch n;    ///< of parts; not a number where the increment is none
    Batch part; ///< 1/n

  private:
    Batch change[dim * dim], stretch_change; // dF - I, and a part of it out of the plane
  };
} // namespace scree

#endif
