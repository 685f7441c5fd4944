// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_jefferies_been_critical_line_h
#define scree_materials_jefferies_been_critical_line_h

#include <scree/simd/batch.h>

#include <cmath>

namespace scree
{
  /// Void ratio at critical state: e_c = Gamma - lambda ln(p/1 kPa), or curved, e_c = a - b (p/p_ref)^c
  /// (@source{liwang1998}).
  struct CriticalLine
  {
    /// e - e_c, and its derivative in ln p.
    template <typename Number>
    Number state(const Number &void_ratio, const Number &log_pressure, Number &slope) const
    {
      if (is_curved)
        {
          const Number fall = coefficient * simd::exp<Number>(exponent * (log_pressure - log_reference));
          slope             = exponent * fall;
          return void_ratio - intercept + fall;
        }
      slope = simd::broadcast<Number>(coefficient);
      return void_ratio - intercept + coefficient * (log_pressure - log_reference);
    }

    /// The slope -d e_c/d ln p at the reference pressure.
    double slope() const
    {
      return is_curved ? coefficient * exponent : coefficient;
    }

    bool is_curved;    ///< a - b (p/p_ref)^c
    double intercept,  ///< Gamma or a
        coefficient,   ///< lambda or b
        exponent,      ///< c
        log_reference; ///< ln of 1 kPa or of p_ref
  };
} // namespace scree

#endif
