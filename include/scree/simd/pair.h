// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_pair_h
#define scree_simd_pair_h

#include <scree/simd/batch.h>

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

  /// Subtracts lane by lane.
  DEAL_II_ALWAYS_INLINE inline BatchPair &operator-=(BatchPair &a, const BatchPair &b)
  {
    return a = a - b;
  }

  /// Multiplies lane by lane.
  DEAL_II_ALWAYS_INLINE inline BatchPair &operator*=(BatchPair &a, const BatchPair &b)
  {
    return a = a * b;
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

    /// See sqrt().
    template <>
    DEAL_II_ALWAYS_INLINE inline BatchPair sqrt<BatchPair>(const BatchPair &x)
    {
      return { sqrt<Batch>(x.first), sqrt<Batch>(x.second) };
    }

    /// The batch of a Number: itself, or one of a pair.
    DEAL_II_ALWAYS_INLINE inline Batch &half(Batch &x, const unsigned int)
    {
      return x;
    }

    /// One of the batches of a pair.
    DEAL_II_ALWAYS_INLINE inline Batch &half(BatchPair &x, const unsigned int h)
    {
      return h == 0 ? x.first : x.second;
    }

    /// The same, to be read.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline const Batch &half(const Number &x, const unsigned int h)
    {
      return half(const_cast<Number &>(x), h);
    }

    inline double lane(const BatchPair &value, const unsigned int lane)
    {
      return half(value, lane / batch_size)[lane % batch_size];
    }

    /// Sets the condition of a number.
    inline void set_bit(bool &mask, const unsigned int)
    {
      mask = true;
    }

    /// Sets the condition of a lane.
    inline void set_bit(BatchBits &mask, const unsigned int lane)
    {
      mask[lane] = -1;
    }

    /// Sets the condition of a lane of a pair.
    inline void set_bit(PairMask &mask, const unsigned int lane)
    {
      set_bit(lane < batch_size ? mask.first : mask.second, lane % batch_size);
    }

    /// Sets a lane of a pair.
    inline void set_lane(BatchPair &number, const unsigned int lane, const double value)
    {
      half(number, lane / batch_size)[lane % batch_size] = value;
    }
  } // namespace simd
} // namespace scree

#endif
