// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_pair_h
#define scree_simd_pair_h

#include <scree/simd/batch.h>

#include <cstring>

namespace scree
{
  /// Two batches as one Number: where each operation waits for the one before, as in Newton's method, the processor
  /// works on one while the other waits.
  struct BatchPair
  {
    Batch first, ///< lanes 0 to batch_size - 1
        second;  ///< lanes from batch_size on
  };

  namespace simd
  {
    /// Result of comparisons of pairs.
    struct PairMask
    {
      BatchBits first, ///< of the first batches
          second;      ///< of the second batches
    };

    /// Result of comparisons of pairs.
    template <>
    struct MaskOf<BatchPair>
    {
      using type = PairMask; ///< a mask for each batch
    };
  } // namespace simd

#define SCREE_PAIR_OPERATOR(Result, op)                                                   \
  DEAL_II_ALWAYS_INLINE inline Result operator op(const BatchPair &a, const BatchPair &b) \
  {                                                                                       \
    return { a.first op b.first, a.second op b.second };                                  \
  }                                                                                       \
  DEAL_II_ALWAYS_INLINE inline Result operator op(const BatchPair &a, const double b)     \
  {                                                                                       \
    return { a.first op b, a.second op b };                                               \
  }                                                                                       \
  DEAL_II_ALWAYS_INLINE inline Result operator op(const double a, const BatchPair &b)     \
  {                                                                                       \
    return { a op b.first, a op b.second };                                               \
  }
  SCREE_PAIR_OPERATOR(BatchPair, +)
  SCREE_PAIR_OPERATOR(BatchPair, -)
  SCREE_PAIR_OPERATOR(BatchPair, *)
  SCREE_PAIR_OPERATOR(BatchPair, /)
  SCREE_PAIR_OPERATOR(simd::PairMask, <)
  SCREE_PAIR_OPERATOR(simd::PairMask, <=)
  SCREE_PAIR_OPERATOR(simd::PairMask, >)
  SCREE_PAIR_OPERATOR(simd::PairMask, >=)
  SCREE_PAIR_OPERATOR(simd::PairMask, ==)
#undef SCREE_PAIR_OPERATOR

  /// Changes the sign of all lanes.
  DEAL_II_ALWAYS_INLINE inline BatchPair operator-(const BatchPair &a)
  {
    return { -a.first, -a.second };
  }

  /// Adds lane by lane.
  DEAL_II_ALWAYS_INLINE inline BatchPair &operator+=(BatchPair &a, const BatchPair &b)
  {
    return a = a + b;
  }

  /// Multiplies all lanes.
  DEAL_II_ALWAYS_INLINE inline BatchPair &operator*=(BatchPair &a, const double b)
  {
    return a = a * b;
  }

  namespace simd
  {
    /// Whether both hold, lane by lane.
    DEAL_II_ALWAYS_INLINE inline PairMask operator&(const PairMask &a, const PairMask &b)
    {
      return { a.first & b.first, a.second & b.second };
    }

    /// Whether one of them holds, lane by lane.
    DEAL_II_ALWAYS_INLINE inline PairMask operator|(const PairMask &a, const PairMask &b)
    {
      return { a.first | b.first, a.second | b.second };
    }

    /// Whether it does not hold, lane by lane.
    DEAL_II_ALWAYS_INLINE inline PairMask operator!(const PairMask &a)
    {
      return { !a.first, !a.second };
    }

    /// Lane l becomes bit l.
    DEAL_II_ALWAYS_INLINE inline unsigned int bits_of(const PairMask &mask)
    {
      return bits_of(mask.first) | bits_of(mask.second) << batch_size;
    }

    /// Whether the condition holds in any lane.
    DEAL_II_ALWAYS_INLINE inline bool any(const PairMask &mask)
    {
      return bits_of(mask.first | mask.second) != 0;
    }

    /// See broadcast().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair broadcast<BatchPair>(const double value)
    {
      return { broadcast<Batch>(value), broadcast<Batch>(value) };
    }

    /// See select().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair
    select<BatchPair>(const PairMask &condition, const BatchPair &yes, const BatchPair &no)
    {
      return { select<Batch>(condition.first, yes.first, no.first),
               select<Batch>(condition.second, yes.second, no.second) };
    }

    /// See abs().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair abs<BatchPair>(const BatchPair &x)
    {
      return { abs<Batch>(x.first), abs<Batch>(x.second) };
    }

    /// See exp().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair exp<BatchPair>(const BatchPair &x)
    {
      return { exp<Batch>(x.first), exp<Batch>(x.second) };
    }

    /// See log().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair log<BatchPair>(const BatchPair &x)
    {
      return { log<Batch>(x.first), log<Batch>(x.second) };
    }

    /// A struct of pairs made of two such structs of batches.
    template <typename OfPairs, typename OfBatches>
    DEAL_II_ALWAYS_INLINE inline OfPairs join(const OfBatches &first, const OfBatches &second)
    {
      constexpr unsigned int n = sizeof(OfBatches) / sizeof(Batch);
      static_assert(sizeof(OfPairs) == 2 * sizeof(OfBatches));
      Batch a[n], b[n], both[2 * n];
      std::memcpy(a, &first, sizeof(a));
      std::memcpy(b, &second, sizeof(b));
      for (unsigned int i = 0; i < n; ++i)
        {
          both[2 * i]     = a[i];
          both[2 * i + 1] = b[i];
        }
      OfPairs pairs;
      std::memcpy(&pairs, both, sizeof(both));
      return pairs;
    }

    /// Scatter: stores the lanes to the records.
    template <typename OfBatches, typename OfPairs>
    DEAL_II_ALWAYS_INLINE inline void split(const OfPairs &pairs, OfBatches &first, OfBatches &second)
    {
      constexpr unsigned int n = sizeof(OfBatches) / sizeof(Batch);
      static_assert(sizeof(OfPairs) == 2 * sizeof(OfBatches));
      Batch a[n], b[n], both[2 * n];
      std::memcpy(both, &pairs, sizeof(both));
      for (unsigned int i = 0; i < n; ++i)
        {
          a[i] = both[2 * i];
          b[i] = both[2 * i + 1];
        }
      std::memcpy(&first, a, sizeof(a));
      std::memcpy(&second, b, sizeof(b));
    }
  } // namespace simd
} // namespace scree

#endif
