// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_rate_of_strength_h
#define scree_materials_rate_of_strength_h

#include <scree/simd/batch.h>

#include <cmath>
#include <limits>

namespace scree
{
  /// Shear strength that grows with the rate gamma_dot of plastic shear:
  ///   s = s_0 (1 + mu log10(max(1, gamma_dot/rate_0))) + K gamma_dot^n,
  /// of clay (@source{einav2005}, K = 0) and of mud (@source{herschel1926}, mu = 0).
  ///
  /// The rate is that of the end of the step (viscoplasticity of @source{perzyna1966}, implicit): stable for any K, and
  /// the stress never changes faster with the strain than in an elastic step.
  class RateOfStrength
  {
  public:
    /// @param increase mu, per factor of 10 of the rate
    /// @param reference_rate rate_0, 1/s
    /// @param consistency K, Pa s^n
    /// @param index n
    RateOfStrength(const double increase, const double reference_rate, const double consistency, const double index)
        : increase(increase / std::log(10.))
        , log_reference(std::log(reference_rate))
        , log_consistency(consistency > 0 ? std::log(consistency) : -std::numeric_limits<double>::infinity())
        , index(index)
    {
    }

    /// Whether strength depends on the rate in steps of this length, s; infinite: slow.
    bool is_active(const double time_step) const
    {
      return (increase > 0 || log_consistency > -std::numeric_limits<double>::infinity()) && std::isfinite(time_step);
    }

    /// s - s_0, Pa, where s = s_0 + excess - G gamma with the plastic shear gamma of the step.
    ///
    /// With y = ln(gamma) the equation is a sum of convex functions that grow. From the y where the first of them
    /// reaches the excess, Newton's method goes down to the root.
    /// @param excess of the shear stress of an elastic step over s_0, Pa; not above 0: the result has no meaning
    /// @param static_strength s_0, Pa
    /// @param shear_modulus G, Pa
    /// @param time_step s, finite
    template <typename Number>
    Number overstress(const Number &excess,
                      const Number &static_strength,
                      const double shear_modulus,
                      const double time_step) const;

  private:
    const double increase;        // mu/ln(10)
    const double log_reference;   // of 1/s
    const double log_consistency; // of Pa s^n
    const double index;           // n
  };


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number RateOfStrength::overstress(const Number &excess,
                                                                 const Number &static_strength,
                                                                 const double shear_modulus,
                                                                 const double time_step) const
  {
    constexpr double tolerance = 1e-13, least = 1e-200; // Pa
    constexpr unsigned int most_iterations = 60;

    const Number zero = simd::broadcast<Number>(0.), some = simd::max<Number>(excess, simd::broadcast<Number>(least));
    const Number log_excess = simd::log<Number>(some), clay = increase * static_strength;
    const double log_step = std::log(time_step), start = log_reference + log_step; // ln(gamma) at the reference rate
    const double viscous = log_consistency - index * log_step;                     // ln(K/dt^n)
    const bool is_clay = increase > 0, is_mud = std::isfinite(log_consistency);

    Number y = log_excess - std::log(shear_modulus), elastic = zero;
    if (is_clay)
      y = simd::min<Number>(y, start + some / simd::max<Number>(clay, simd::broadcast<Number>(least)));
    if (is_mud)
      y = simd::min<Number>(y, (log_excess - viscous) * (1. / index));
    for (unsigned int i = 0; i < most_iterations; ++i)
      {
        elastic       = shear_modulus * simd::exp<Number>(y);
        Number beyond = elastic - some, slope = elastic;
        if (is_mud)
          {
            const Number power = simd::exp<Number>(index * y + viscous);
            beyond += power;
            slope += index * power;
          }
        if (is_clay)
          {
            const auto is_fast = y > start;
            beyond += simd::select<Number>(is_fast, clay * (y - start), zero);
            slope += simd::select<Number>(is_fast, clay, zero);
          }
        if (!simd::any(beyond > tolerance * some))
          break;
        y -= beyond / slope;
      }
    return simd::max<Number>(some - elastic, zero);
  }
} // namespace scree

#endif
