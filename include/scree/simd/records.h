// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_records_h
#define scree_simd_records_h

#include <scree/simd/batch.h>

#include <algorithm>
#include <array>

namespace scree
{
  /// The numbers of the things that a batch is about.
  using BatchIndices = std::array<unsigned int, batch_size>;

  /// Where each lane finds its record of doubles.
  template <typename Pointee>
  using RecordPointers = std::array<Pointee *, batch_size>;

  /// The pointer itself. GCC would compute the pointers of a batch as a vector, only to take it apart again: a fifth of
  /// the time of a pass over points.
  template <typename Pointee>
  DEAL_II_ALWAYS_INLINE inline Pointee *apart(Pointee *pointer)
  {
    asm("" : "+r"(pointer));
    return pointer;
  }

  /// The same records, to be read.
  inline RecordPointers<const double> as_constant(const RecordPointers<double> &records)
  {
    RecordPointers<const double> result;
    for (unsigned int l = 0; l < batch_size; ++l)
      result[l] = records[l];
    return result;
  }

  namespace simd
  {
    using TwoDoubles = double __attribute__((vector_size(2 * sizeof(double)))); ///< a register of two doubles

    /// Four rows of four or eight doubles, of which lanes 4 i + j of row k become lanes 4 i + k of row j: lanes of
    /// records are those of quantities then, and the other way round.
    template <typename Row>
    DEAL_II_ALWAYS_INLINE inline void transpose_fours(Row *rows)
    {
      const Row a = rows[0], b = rows[1], c = rows[2], d = rows[3];
      if constexpr (sizeof(Row) == 8 * sizeof(double))
        {
          const Row e = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
          const Row f = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
          const Row g = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
          const Row h = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
          rows[0]     = __builtin_shufflevector(e, g, 0, 1, 8, 9, 4, 5, 12, 13);
          rows[1]     = __builtin_shufflevector(f, h, 0, 1, 8, 9, 4, 5, 12, 13);
          rows[2]     = __builtin_shufflevector(e, g, 2, 3, 10, 11, 6, 7, 14, 15);
          rows[3]     = __builtin_shufflevector(f, h, 2, 3, 10, 11, 6, 7, 14, 15);
        }
      else
        {
          const Row e = __builtin_shufflevector(a, b, 0, 4, 2, 6);
          const Row f = __builtin_shufflevector(a, b, 1, 5, 3, 7);
          const Row g = __builtin_shufflevector(c, d, 0, 4, 2, 6);
          const Row h = __builtin_shufflevector(c, d, 1, 5, 3, 7);
          rows[0]     = __builtin_shufflevector(e, g, 0, 1, 4, 5);
          rows[1]     = __builtin_shufflevector(f, h, 0, 1, 4, 5);
          rows[2]     = __builtin_shufflevector(e, g, 2, 3, 6, 7);
          rows[3]     = __builtin_shufflevector(f, h, 2, 3, 6, 7);
        }
    }

#if defined(__AVX2__)
    using FourDoubles = double __attribute__((vector_size(4 * sizeof(double)))); ///< a register of four doubles

    /// Four doubles from `first` on of the records of lanes `l`, l + 4, ...
    DEAL_II_ALWAYS_INLINE inline Batch
    load_fours(const RecordPointers<const double> &records, const unsigned int first, const unsigned int l)
    {
      FourDoubles four;
      std::memcpy(&four, records[l] + first, sizeof(four));
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
      FourDoubles other;
      std::memcpy(&other, records[l + 4] + first, sizeof(other));
      return __builtin_shufflevector(four, other, 0, 1, 2, 3, 4, 5, 6, 7);
#  else
      return four;
#  endif
    }

    /// Two doubles from `first` on of the records of lanes `l`, l + 2, ...
    DEAL_II_ALWAYS_INLINE inline Batch
    load_twos(const RecordPointers<const double> &records, const unsigned int first, const unsigned int l)
    {
      constexpr unsigned int n = batch_size / 2;
      TwoDoubles twos[n];
      for (unsigned int k = 0; k < n; ++k)
        std::memcpy(&twos[k], records[l + 2 * k] + first, sizeof(TwoDoubles));
      const FourDoubles low = __builtin_shufflevector(twos[0], twos[1], 0, 1, 2, 3);
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
      return __builtin_shufflevector(
          low, __builtin_shufflevector(twos[2], twos[3], 0, 1, 2, 3), 0, 1, 2, 3, 4, 5, 6, 7);
#  else
      return low;
#  endif
    }

    /// Two batches of which lanes 2 i + j of batch k become lanes 2 i + k of batch j.
    DEAL_II_ALWAYS_INLINE inline void transpose_twos(Batch *rows)
    {
      const Batch a = rows[0], b = rows[1];
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
      rows[0] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
      rows[1] = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
#  else
      rows[0] = __builtin_shufflevector(a, b, 0, 4, 2, 6);
      rows[1] = __builtin_shufflevector(a, b, 1, 5, 3, 7);
#  endif
    }

    /// Stores two doubles of lanes `l`, l + 2, ... each, as load_twos() reads them.
    DEAL_II_ALWAYS_INLINE inline void
    store_twos(const Batch &row, const RecordPointers<double> &records, const unsigned int first, const unsigned int l)
    {
      const auto put = [&](const TwoDoubles two, const unsigned int k) {
        std::memcpy(records[l + 2 * k] + first, &two, sizeof(two));
      };
      put(__builtin_shufflevector(row, row, 0, 1), 0);
      put(__builtin_shufflevector(row, row, 2, 3), 1);
#  if defined(__AVX512F__) && defined(__AVX512DQ__)
      put(__builtin_shufflevector(row, row, 4, 5), 2);
      put(__builtin_shufflevector(row, row, 6, 7), 3);
#  endif
    }
#endif

    /// Reads the first `n` doubles of each lane's record into `n` batches.
    template <unsigned int n>
    DEAL_II_ALWAYS_INLINE inline void load_records(const RecordPointers<const double> &records, Batch *batches)
    {
#if defined(__AVX2__)
      if constexpr (n >= 4)
        {
          // The last four may overlap those before them.
          for (unsigned int c = 0; c < n; c += 4)
            {
              const unsigned int first = std::min(c, n - 4);
              for (unsigned int l = 0; l < 4; ++l)
                batches[first + l] = load_fours(records, first, l);
              transpose_fours(batches + first);
            }
          return;
        }
      if constexpr (n >= 2)
        {
          for (unsigned int l = 0; l < 2; ++l)
            batches[l] = load_twos(records, 0, l);
          transpose_twos(batches);
        }
      constexpr unsigned int n_done = n >= 2 ? 2 : 0;
#else
      constexpr unsigned int n_done   = 0;
#endif
      for (unsigned int c = n_done; c < n; ++c)
        for (unsigned int l = 0; l < batch_size; ++l)
          batches[c][l] = records[l][c];
    }

    /// Scatter: stores the lanes to the records. Lanes that share a record must hold equal values.
    template <unsigned int n>
    DEAL_II_ALWAYS_INLINE inline void store_records(const Batch *batches, const RecordPointers<double> &records)
    {
#if defined(__AVX2__)
      if constexpr (n >= 4)
        {
          for (unsigned int c = 0; c < n; c += 4)
            {
              const unsigned int first = std::min(c, n - 4);
              Batch rows[4]            = { batches[first], batches[first + 1], batches[first + 2], batches[first + 3] };
              transpose_fours(rows);
              for (unsigned int l = 0; l < batch_size; ++l)
                std::memcpy(
                    records[l] + first, reinterpret_cast<const double *>(&rows[l % 4]) + l / 4 * 4, 4 * sizeof(double));
            }
          return;
        }
      if constexpr (n >= 2)
        {
          Batch rows[2] = { batches[0], batches[1] };
          transpose_twos(rows);
          for (unsigned int l = 0; l < 2; ++l)
            store_twos(rows[l], records, 0, l);
        }
      constexpr unsigned int n_done = n >= 2 ? 2 : 0;
#else
      constexpr unsigned int n_done   = 0;
#endif
      for (unsigned int c = n_done; c < n; ++c)
        for (unsigned int l = 0; l < batch_size; ++l)
          records[l][c] = batches[c][l];
    }

    /// Adds `n` doubles to others, four, two and one at a time. (A masked store of all at once delays the next load
    /// from its neighbourhood.)
    template <unsigned int n>
    DEAL_II_ALWAYS_INLINE inline void add_doubles(const double *numbers, double *sums)
    {
      const auto add = [&](auto both, const unsigned int first) {
        decltype(both) sum;
        std::memcpy(&both, numbers + first, sizeof(both));
        std::memcpy(&sum, sums + first, sizeof(sum));
        sum += both;
        std::memcpy(sums + first, &sum, sizeof(sum));
      };
#if defined(__AVX2__)
      constexpr unsigned int in_fours = n / 4 * 4;
      for (unsigned int first = 0; first < in_fours; first += 4)
        add(FourDoubles(), first);
#else
      constexpr unsigned int in_fours = 0;
#endif
      for (unsigned int first = in_fours; first + 2 <= n; first += 2)
        add(TwoDoubles(), first);
      if constexpr (n % 2 == 1)
        sums[n - 1] += numbers[n - 1];
    }

    /// A batch anywhere among doubles. GCC would copy halves of it.
    using BatchInMemory =
        double __attribute__((vector_size(batch_size * sizeof(double)), aligned(alignof(double)), may_alias));

    /// Reads `batch_size` doubles one behind the other.
    DEAL_II_ALWAYS_INLINE inline Batch load(const double *values)
    {
      return *reinterpret_cast<const BatchInMemory *>(values);
    }

    /// Writes `batch_size` doubles one behind the other.
    DEAL_II_ALWAYS_INLINE inline void store(const Batch &batch, double *values)
    {
      *reinterpret_cast<BatchInMemory *>(values) = batch;
    }

    /// The lanes below `n`.
    DEAL_II_ALWAYS_INLINE inline Mask<Batch> first_lanes(const unsigned int n)
    {
      BatchBits numbers;
      for (unsigned int l = 0; l < batch_size; ++l)
        numbers[l] = l;
      return numbers < static_cast<std::int64_t>(n);
    }
  } // namespace simd


  /// Calls `act(indices, n)` for groups of the numbers below `size`, in order: as many as batches, or pairs, have
  /// lanes. The last group repeats its last number, so that all lanes can be computed and stored; the first `n` of them
  /// count.
  template <unsigned int n_lanes, typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_group(const unsigned int size, const Act &act)
  {
    for (unsigned int start = 0; start < size; start += n_lanes)
      {
        const unsigned int n = std::min(size - start, n_lanes);
        std::array<unsigned int, n_lanes> indices;
        for (unsigned int l = 0; l < n_lanes; ++l)
          indices[l] = start + std::min(l, n - 1);
        act(indices, n);
      }
  }


  /// The same by batches.
  template <typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_batch(const unsigned int size, const Act &act)
  {
    for_each_group<batch_size>(size, act);
  }
} // namespace scree

#endif
