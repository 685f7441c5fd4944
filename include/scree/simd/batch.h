// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_batch_h
#define scree_simd_batch_h

#include <deal.II/base/config.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#if defined(__AVX2__)
#  include <immintrin.h>
#endif

namespace scree
{
  /// Doubles that the processor which is compiled for computes with at a time.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  constexpr unsigned int batch_size = 8;
#elif defined(__AVX2__)
  constexpr unsigned int batch_size = 4;
#else
  constexpr unsigned int batch_size = 2;
#endif

  /// As many numbers, each in its lane: a compiler vector, which has the operators of double. A lane's result does not
  /// depend on what is in the others. (Debian builds deal.II's VectorizedArray with a single lane.)
  using Batch = double __attribute__((vector_size(batch_size * sizeof(double))));

  /// The functions of a `Number`, which is double, Batch or BatchPair: kernels are written once for all.
  namespace simd
  {
    /// Two vectors side by side.
    template <typename Half>
    struct Pair
    {
      Half first, ///< lanes 0 to batch_size - 1
          second; ///< lanes from batch_size on
    };

    /// Whether a type is a Pair.
    template <typename>
    constexpr bool is_pair = false;
    template <typename Half>
    constexpr bool is_pair<Pair<Half>> = true; ///< it is

    /// The vector of a number: itself, or one of a pair.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline auto &half(Number &x, [[maybe_unused]] const unsigned int h)
    {
      if constexpr (is_pair<std::remove_const_t<Number>>)
        return h == 0 ? x.first : x.second;
      else
        return x;
    }

    /// A pair of these.
    template <typename Half>
    DEAL_II_ALWAYS_INLINE inline Pair<Half> pair_of(const Half &first, const Half &second)
    {
      return { first, second };
    }

    // Operators of two pairs, or of a pair and a number.
#define SCREE_PAIR_OPERATOR(op)                                                            \
  template <typename A, typename B, typename = std::enable_if_t<is_pair<A> || is_pair<B>>> \
  DEAL_II_ALWAYS_INLINE inline auto operator op(const A &a, const B &b)                    \
  {                                                                                        \
    return pair_of(half(a, 0) op half(b, 0), half(a, 1) op half(b, 1));                    \
  }
    SCREE_PAIR_OPERATOR(+)
    SCREE_PAIR_OPERATOR(-)
    SCREE_PAIR_OPERATOR(*)
    SCREE_PAIR_OPERATOR(/)
    SCREE_PAIR_OPERATOR(<)
    SCREE_PAIR_OPERATOR(<=)
    SCREE_PAIR_OPERATOR(>)
    SCREE_PAIR_OPERATOR(>=)
    SCREE_PAIR_OPERATOR(==)
    SCREE_PAIR_OPERATOR(&)
    SCREE_PAIR_OPERATOR(|)
#undef SCREE_PAIR_OPERATOR

#define SCREE_PAIR_ASSIGNMENT(op)                                                    \
  template <typename Half, typename B>                                               \
  DEAL_II_ALWAYS_INLINE inline Pair<Half> &operator op##=(Pair<Half> &a, const B &b) \
  {                                                                                  \
    return a = a op b;                                                               \
  }
    SCREE_PAIR_ASSIGNMENT(+)
    SCREE_PAIR_ASSIGNMENT(-)
    SCREE_PAIR_ASSIGNMENT(*)
#undef SCREE_PAIR_ASSIGNMENT

    /// Changes all signs.
    template <typename Half>
    DEAL_II_ALWAYS_INLINE inline auto operator-(const Pair<Half> &a)
    {
      return pair_of(-a.first, -a.second);
    }

    /// Whether it does not hold, lane by lane.
    template <typename Half>
    DEAL_II_ALWAYS_INLINE inline auto operator!(const Pair<Half> &a)
    {
      return pair_of(!a.first, !a.second);
    }
  } // namespace simd

  /// Two batches as one Number: where each operation waits for the one before, as in Newton's method, the processor
  /// works on one while the other waits.
  using BatchPair = simd::Pair<Batch>;

  namespace simd
  {
    /// Comparisons of batches: all bits of a lane are set where they hold, else none.
    using BatchBits = decltype(std::declval<Batch>() > std::declval<Batch>());

    /// The type of comparisons; combine them by &, | and !.
    template <typename Number>
    using Mask = std::conditional_t<std::is_same_v<Number, double>,
                                    bool,
                                    std::conditional_t<is_pair<Number>, Pair<BatchBits>, BatchBits>>;

    /// The bits of a Number as integers.
    template <typename Number>
    using Bits = std::conditional_t<std::is_same_v<Number, double>, std::int64_t, Mask<Number>>;

    /// The same without a sign: bits may be shifted out of it.
    template <typename Number>
    using UnsignedBits = std::conditional_t<std::is_same_v<Number, double>,
                                            std::uint64_t,
                                            std::uint64_t __attribute__((vector_size(batch_size * sizeof(double))))>;

    template <typename Number>
    constexpr unsigned int n_lanes = sizeof(Number) / sizeof(double); ///< lanes of a Number

    /// A Number with this value in all lanes.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number broadcast(const double value)
    {
      if constexpr (std::is_same_v<Number, double>)
        return value;
      else
        {
          // No addition, which would change -0, and no loop over lanes, of which GCC makes two halves in memory:
          // reading them as one vector waits for both stores.
          return value - Number{};
        }
    }

    /// Lane by lane `yes` where the condition holds, else `no`.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number select(const Mask<Number> &condition, const Number &yes, const Number &no)
    {
      if constexpr (is_pair<Number>)
        return { condition.first ? yes.first : no.first, condition.second ? yes.second : no.second };
      else
        return condition ? yes : no;
    }

    /// Lane by lane a bit.
    inline unsigned int bits_of(const bool mask)
    {
      return mask;
    }

    /// Lane l becomes bit l.
    DEAL_II_ALWAYS_INLINE inline unsigned int bits_of(const BatchBits &mask)
    {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
      // One instruction; the compiler makes eight of the loop.
      using Compare = long long __attribute__((vector_size(64)));
      return __builtin_ia32_cvtq2mask512(reinterpret_cast<Compare>(mask));
#elif defined(__AVX2__)
      return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask));
#else
      unsigned int bits = 0;
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        bits |= (static_cast<unsigned int>(mask[lane]) & 1u) << lane;
      return bits;
#endif
    }

    /// The same of a pair.
    DEAL_II_ALWAYS_INLINE inline unsigned int bits_of(const Pair<BatchBits> &mask)
    {
      return bits_of(mask.first) | bits_of(mask.second) << batch_size;
    }

    /// Whether the condition holds in any lane.
    template <typename MaskType>
    DEAL_II_ALWAYS_INLINE inline bool any(const MaskType &mask)
    {
      if constexpr (is_pair<MaskType>)
        return any(mask.first | mask.second);
      else
        return bits_of(mask) != 0;
    }

    /// A lane of a number; set_lane() sets it.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline double lane(const Number &number, [[maybe_unused]] const unsigned int lane)
    {
      if constexpr (std::is_same_v<Number, double>)
        return number;
      else
        return half(number, lane / batch_size)[lane % batch_size];
    }

    /// Sets a lane of a number, or of a condition: to all bits for `true`.
    template <typename Number, typename Value>
    DEAL_II_ALWAYS_INLINE inline void
    set_lane(Number &number, [[maybe_unused]] const unsigned int lane, const Value value)
    {
      if constexpr (std::is_arithmetic_v<Number>)
        number = value;
      else if constexpr (std::is_same_v<Value, bool>)
        half(number, lane / batch_size)[lane % batch_size] = value ? -1 : 0;
      else
        half(number, lane / batch_size)[lane % batch_size] = value;
    }

    /// The bits of a Number, read as integers.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Bits<Number> to_bits(const Number &value)
    {
      Bits<Number> bits;
      std::memcpy(&bits, &value, sizeof(bits));
      return bits;
    }

    /// The Number that has these bits.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number from_bits(const Bits<Number> &bits)
    {
      Number value;
      std::memcpy(&value, &bits, sizeof(value));
      return value;
    }

    /// The absolute value; clears the sign bit.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number abs(const Number &x)
    {
      if constexpr (is_pair<Number>)
        return { abs(x.first), abs(x.second) };
      else
        return from_bits<Number>(to_bits(x) & 0x7fffffffffffffff);
    }

    /// The larger one; b if either is not a number.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number max(const Number &a, const Number &b)
    {
      return select<Number>(a > b, a, b);
    }

    /// The smaller one; b if either is not a number.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number min(const Number &a, const Number &b)
    {
      return select<Number>(a < b, a, b);
    }

    /// The square root, correctly rounded.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number sqrt(const Number &x)
    {
      if constexpr (std::is_same_v<Number, double>)
        return std::sqrt(x);
      else if constexpr (is_pair<Number>)
        return { sqrt(x.first), sqrt(x.second) };
      else
        {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
          return _mm512_mask_sqrt_pd(x, 0xff, x); // GCC 12 warns of the one without a mask
#elif defined(__AVX2__)
          return _mm256_sqrt_pd(x);
#else
          Number root;
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            root[lane] = std::sqrt(x[lane]);
          return root;
#endif
        }
    }

    /// The largest of the lanes; not a number only if all are.
    template <typename Number>
    inline double largest_lane(const Number &x)
    {
      double largest = lane(x, 0);
      for (unsigned int l = 1; l < n_lanes<Number>; ++l)
        if (lane(x, l) > largest || largest != largest)
          largest = lane(x, l);
      return largest;
    }

    /// The sum of the lanes.
    template <typename Number>
    inline double sum_of_lanes(const Number &x)
    {
      double sum = lane(x, 0);
      for (unsigned int l = 1; l < n_lanes<Number>; ++l)
        sum += lane(x, l);
      return sum;
    }

    /// `result` with the lanes of `condition` from a function of double.
    template <typename Number, typename Function>
    __attribute__((noinline, cold)) void
    set_lanes_by(const Function &function, const Number &x, const Mask<Number> &condition, Number &result)
    {
      const unsigned int bits = bits_of(condition);
      for (unsigned int l = 0; l < n_lanes<Number>; ++l)
        if (bits >> l & 1)
          set_lane(result, l, function(lane(x, l)));
    }

    /// exp(x) to one unit in the last place: 2^n exp(r) with |r| <= ln(2)/2, exp(r) by its Taylor polynomial, whose
    /// last coefficients are fitted. Lanes whose result is not a normal number have it from the C library.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number exp(const Number &x)
    {
      if constexpr (is_pair<Number>)
        return { exp(x.first), exp(x.second) };
      else
        {
          constexpr double to_integer = 0x1.8p52; // the sum's last bit stands for 1
          const Number shifted        = x * 1.4426950408889634 + to_integer;
          const Number n              = shifted - to_integer;
          const Number r = (x - n * 0x1.62e42fefa0000p-1) - n * 0x1.cf79abc9e3b3ap-40; // ln(2) in two parts

          const Number r2 = r * r, r4 = r2 * r2;
          const Number low = (0x1.0000000000000p-1 + r * 0x1.5555555555557p-3) +
                             r2 * (0x1.5555555555556p-5 + r * 0x1.11111111100dcp-7);
          const Number middle = (0x1.6c16c16c162d4p-10 + r * 0x1.a01a01abe7fe1p-13) +
                                r2 * (0x1.a01a01a6d889cp-16 + r * 0x1.71de0231960ebp-19);
          const Number high  = (0x1.27e4db646b17ep-22 + r * 0x1.af4de97ca4194p-26) + r2 * 0x1.1f730349868cep-29;
          const Number power = 1. + (r + r2 * (low + r4 * (middle + r4 * high)));

          const auto exponent         = UnsignedBits<Number>(to_bits(shifted)) << 52;
          Number result               = from_bits<Number>(to_bits(power) + Bits<Number>(exponent));
          const Mask<Number> is_usual = (x > -708.) & (x < 709.);
          if (any(!is_usual))
            set_lanes_by([](const double value) { return std::exp(value); }, x, !is_usual, result);
          return result;
        }
    }

    /// ln(x) to one unit in the last place: that of 2^n m with m about 1 by fdlibm's polynomial in s = f/(2 + f),
    /// f = m - 1. Lanes that are not positive normal numbers have it from the C library.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number log(const Number &x)
    {
      if constexpr (is_pair<Number>)
        return { log(x.first), log(x.second) };
      else
        {
          constexpr std::int64_t one = 0x3ff0000000000000, lowest = 0x3fe6a09e667f3bcd; // bits of 1 and 1/sqrt(2)

          // The exponent is put into the last bits of 2^52, where it can be read as a number.
          const Bits<Number> bits = to_bits(x) + (one - lowest);
          const Number n          = from_bits<Number>((bits >> 52) | 0x4330000000000000) - (0x1p52 + 1023.);
          const Number f          = from_bits<Number>((bits & 0x000fffffffffffff) + lowest) - 1.;
          const Number s = f / (2. + f), z = s * s, w = z * z, half_square = 0.5 * f * f;
          const Number even =
              w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
          const Number odd =
              z * (6.666666666666735130e-01 +
                   w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860510658591e-01)));
          Number result = n * 6.93147180369123816490e-01 -
                          ((half_square - (s * (half_square + (even + odd)) + n * 1.90821492927058770002e-10)) - f);

          const Mask<Number> is_usual =
              (x >= std::numeric_limits<double>::min()) & (x <= std::numeric_limits<double>::max());
          if (any(!is_usual))
            set_lanes_by([](const double value) { return std::log(value); }, x, !is_usual, result);
          return result;
        }
    }

    /// The cube root to a few units in the last place: near 1, where ratios of volumes lie, by the binomial series,
    /// else from the C library.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number cube_root(const Number &x)
    {
      const Number e = x - 1., e2 = e * e;
      Number root =
          1. + e * ((1. / 3. - e * (1. / 9.)) + e2 * ((5. / 81. - e * (10. / 243.)) +
                                                      e2 * ((22. / 729. - e * (154. / 6561.)) + e2 * (374. / 19683.))));
      const Mask<Number> is_near = simd::abs<Number>(e) < 0.01;
      if (any(!is_near))
        set_lanes_by([](const double value) { return std::cbrt(value); }, x, !is_near, root);
      return root;
    }
  } // namespace simd
} // namespace scree

#endif
