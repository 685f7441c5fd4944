// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_batch_records_h
#define scree_materials_batch_records_h

#include <scree/materials/material.h>
#include <scree/simd/records.h>
#include <scree/tensor/matrix.h>

#include <algorithm>

namespace scree
{
  /// A batch of points' states and motion: from their records, and back.
  template <int dim, unsigned int n_internal>
  struct BatchRecords
  {
    static constexpr unsigned int n_components = n_symmetric_components<dim>; ///< components of a symmetric tensor

    /// What one batch reads.
    struct Input
    {
      Batch left_cauchy_green[n_components];    ///< elastic b_e at the start of the step
      Batch increment[dim * dim],               ///< dF, in-plane part, row-major
          out_of_plane_stretch;                 ///< dF_zz
      Batch volume_ratio,                       ///< J at the end of the step
          reference_volume;                     ///< V_0, m^3
      Batch internal_variables[n_internal + 1]; ///< at the start of the step; an array of 0 is not allowed
    };

    /// Reads points, of which `n` in a row count, or any points if n = 0.
    static Input read(const BatchIndices &indices,
                      const unsigned int n,
                      const MaterialPoints<dim> &points,
                      const MaterialMotion<dim> &motion)
    {
      Input input;
      RecordPointers<const double> b, internal;
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          const std::size_t offset = points.offset(indices[l]);
          b[l]                     = apart(points.left_cauchy_green + offset);
          internal[l]              = apart(points.internal_variables + offset);
        }
      simd::load_records<n_components>(b, input.left_cauchy_green);
      simd::load_records<n_internal>(internal, input.internal_variables);

      const auto list = [&](const double *numbers) {
        if (n == batch_size)
          return simd::load(numbers + indices[0]);
        Batch batch;
        for (unsigned int l = 0; l < batch_size; ++l)
          batch[l] = numbers[indices[l]];
        return batch;
      };
      for (unsigned int c = 0; c < dim * dim; ++c)
        input.increment[c] = list(motion.deformation_increment + c * motion.pitch);
      input.volume_ratio         = list(motion.volume_ratio);
      input.reference_volume     = list(motion.reference_volume);
      input.out_of_plane_stretch = dim == 2 ? list(motion.out_of_plane_stretch) : simd::broadcast<Batch>(1.);
      return input;
    }

    /// Writes `n` batches into the points' records, those of lanes whose bits are not set into nothing.
    template <unsigned int n>
    static void write(const Batch *batches,
                      const BatchIndices &indices,
                      const unsigned int bits,
                      const MaterialPoints<dim> &points,
                      double *of_record_0)
    {
      if constexpr (n > 0)
        {
          double nothing[n];
          RecordPointers<double> records;
          for (unsigned int l = 0; l < batch_size; ++l)
            records[l] = apart(bits >> l & 1 ? of_record_0 + points.offset(indices[l]) : nothing);
          simd::store_records<n>(batches, records);
        }
    }

    /// Largest |dF - I|.
    static Batch largest_change_of(const Input &input)
    {
      Batch largest = dim == 2 ? simd::abs<Batch>(input.out_of_plane_stretch - 1.) : simd::broadcast<Batch>(0.);
      for (unsigned int i = 0; i < dim * dim; ++i)
        largest = simd::max<Batch>(largest,
                                   simd::abs<Batch>(i % (dim + 1) == 0 ? input.increment[i] - 1. : input.increment[i]));
      return largest;
    }

    /// Whether a point can follow its increment. Written such that not-a-number cannot.
    static simd::Mask<Batch> is_possible(const Input &input)
    {
      return (determinant_of_rows<dim>(input.increment) > 0.) & (input.volume_ratio > 0.) &
             (input.out_of_plane_stretch > 0.);
    }
  };
} // namespace scree

#endif
