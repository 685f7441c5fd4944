// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_jefferies_been_critical_line_h
#define scree_materials_jefferies_been_critical_line_h

#include <scree/simd/batch.h>

#include <cmath>

namespace scree
{
  /// Void ratio at critical state: e_c = Gamma - lambda ln(p/1 kPa).
  struct CriticalLine
  {
    /// e - e_c, and its derivative in ln p.
    template <typename Number>
    Number state(const Number &void_ratio, const Number &log_pressure, Number &slope) const
    {
      slope = simd::broadcast<Number>(coefficient);
      return void_ratio - intercept + coefficient * (log_pressure - log_reference);
    }

    /// The slope -d e_c/d ln p.
    double slope() const
    {
      return coefficient;
    }

    double intercept,  ///< Gamma
        coefficient,   ///< lambda
        log_reference; ///< ln of 1 kPa
  };
} // namespace scree

#endif
