// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_lane_rows_h
#define scree_simd_lane_rows_h

#include <scree/simd/records.h>

#include <type_traits>

namespace scree
{
  /// The lanes of batches that are used later, one behind the other, so that they fill batches again. `Batches` is a
  /// struct of batches and masks, each of which gets a row; there is room for `capacity` lanes.
  template <typename Batches, unsigned int capacity>
  class LaneRows
  {
  public:
    /// Appends the lanes whose bits are set.
    void append(const Batches &batches, const unsigned int bits)
    {
      for (unsigned int row = 0; row < n_rows; ++row)
        append(simd::load(reinterpret_cast<const double *>(&batches) + row * batch_size), bits, &rows[row][size]);
      size += __builtin_popcount(bits);
    }

    /// `batch_size` lanes from `first` on; those beyond the end repeat the last one.
    Batches read(const unsigned int first)
    {
      if (first + batch_size > size)
        for (auto &row : rows)
          for (unsigned int lane = size; lane < first + batch_size; ++lane)
            row[lane] = row[size - 1];
      Batches batches;
      for (unsigned int row = 0; row < n_rows; ++row)
        simd::store(simd::load(&rows[row][first]), reinterpret_cast<double *>(&batches) + row * batch_size);
      return batches;
    }

  private:
    static constexpr unsigned int n_rows = sizeof(Batches) / sizeof(Batch);
    static_assert(std::is_trivially_copyable_v<Batches> && sizeof(Batches) % sizeof(Batch) == 0,
                  "made of batches alone");

    /// Writes a whole batch, of which the lanes in question come first.
    DEAL_II_ALWAYS_INLINE inline static void append(const Batch &batch, const unsigned int bits, double *end)
    {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
      const Batch first = __builtin_ia32_compressdf512_mask(batch, Batch{}, static_cast<unsigned char>(bits));
      simd::store(first, end);
#else
      unsigned int n = 0;
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        {
          end[n] = batch[lane];
          n += bits >> lane & 1;
        }
#endif
    }

    unsigned int size = 0;
    double rows[n_rows][capacity + batch_size];
  };
} // namespace scree

#endif
