// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simd_sums_h
#define scree_simd_sums_h

#include <scree/simd/records.h>

namespace scree
{
  namespace simd
  {
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
  } // namespace simd
} // namespace scree

#endif
