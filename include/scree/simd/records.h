// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_records_h
#define scree_simd_records_h

#include <scree/simd/batch.h>

#include <array>

namespace scree
{
  /// Where each lane finds its record of doubles.
  template <typename Pointee>
  using RecordPointers = std::array<Pointee *, batch_size>;

  namespace simd
  {
#if defined(__AVX2__)
    using FourDoubles = double __attribute__((vector_size(4 * sizeof(double))));

    DEAL_II_ALWAYS_INLINE inline FourDoubles load_four(const double *values)
    {
      FourDoubles four;
      std::memcpy(&four, values, sizeof(four));
      return four;
    }

    /// Four batches of which lanes 4 i + j of batch k become lanes 4 i + k of batch j: lanes of records are those of
    /// quantities then, and the other way round.
    DEAL_II_ALWAYS_INLINE inline void transpose_fours(Batch *rows)
    {
      const Batch a = rows[0], b = rows[1], c = rows[2], d = rows[3];
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
      const Batch e = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
      const Batch f = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
      const Batch g = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
      const Batch h = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
      rows[0]       = __builtin_shufflevector(e, g, 0, 1, 8, 9, 4, 5, 12, 13);
      rows[1]       = __builtin_shufflevector(f, h, 0, 1, 8, 9, 4, 5, 12, 13);
      rows[2]       = __builtin_shufflevector(e, g, 2, 3, 10, 11, 6, 7, 14, 15);
      rows[3]       = __builtin_shufflevector(f, h, 2, 3, 10, 11, 6, 7, 14, 15);
#  else
      const Batch e = __builtin_shufflevector(a, b, 0, 4, 2, 6);
      const Batch f = __builtin_shufflevector(a, b, 1, 5, 3, 7);
      const Batch g = __builtin_shufflevector(c, d, 0, 4, 2, 6);
      const Batch h = __builtin_shufflevector(c, d, 1, 5, 3, 7);
      rows[0]       = __builtin_shufflevector(e, g, 0, 1, 4, 5);
      rows[1]       = __builtin_shufflevector(f, h, 0, 1, 4, 5);
      rows[2]       = __builtin_shufflevector(e, g, 2, 3, 6, 7);
      rows[3]       = __builtin_shufflevector(f, h, 2, 3, 6, 7);
#  endif
    }
#endif

    /// Reads the first `n` doubles of each lane's record into `n` batches.
    template <unsigned int n>
    DEAL_II_ALWAYS_INLINE inline void load_records(const RecordPointers<const double> &records, Batch *batches)
    {
      unsigned int c = 0;
#if defined(__AVX2__)
      for (; c + 4 <= n; c += 4)
        {
          for (unsigned int l = 0; l < 4; ++l)
            {
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
              batches[c + l] = __builtin_shufflevector(
                  load_four(records[l] + c), load_four(records[l + 4] + c), 0, 1, 2, 3, 4, 5, 6, 7);
#  else
              batches[c + l] = load_four(records[l] + c);
#  endif
            }
          transpose_fours(batches + c);
        }
#endif
      for (; c < n; ++c)
        for (unsigned int l = 0; l < batch_size; ++l)
          batches[c][l] = records[l][c];
    }

    /// The other way round. Lanes that share a record have to hold the same numbers.
    template <unsigned int n>
    DEAL_II_ALWAYS_INLINE inline void store_records(const Batch *batches, const RecordPointers<double> &records)
    {
      unsigned int c = 0;
#if defined(__AVX2__)
      for (; c + 4 <= n; c += 4)
        {
          Batch rows[4] = { batches[c], batches[c + 1], batches[c + 2], batches[c + 3] };
          transpose_fours(rows);
          for (unsigned int l = 0; l < batch_size; ++l)
            std::memcpy(records[l] + c, reinterpret_cast<const double *>(&rows[l % 4]) + l / 4 * 4, 4 * sizeof(double));
        }
#endif
      for (; c < n; ++c)
        for (unsigned int l = 0; l < batch_size; ++l)
          records[l][c] = batches[c][l];
    }

    /// Reads `batch_size` doubles one behind the other.
    DEAL_II_ALWAYS_INLINE inline Batch load(const double *values)
    {
      Batch batch;
      std::memcpy(&batch, values, sizeof(batch));
      return batch;
    }

    DEAL_II_ALWAYS_INLINE inline void store(const Batch &batch, double *values)
    {
      std::memcpy(values, &batch, sizeof(batch));
    }
  } // namespace simd
} // namespace scree

#endif
