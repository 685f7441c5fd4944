// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_jefferies_been_pressure_elasticity_h
#define scree_materials_jefferies_been_pressure_elasticity_h

#include <scree/simd/batch.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  /// Elasticity of sand from a stored energy, with moduli that grow with pressure (@source{houlsby2005}): at q = 0 both
  /// are G = g p_r (p/p_r)^n and K = k p_r (p/p_r)^n. Invariants of logarithmic strain, compression positive: volume
  /// strain e_v, which is 0 at p = p_r, and shear strain e_s = sqrt(2/3) |dev strain|. With a = k (1-n)/(3 g) and
  /// X = 1 + k (1-n) e_v,
  ///   eta = q/p = 3 g e_s/X,    p = p_r [X (1 + a eta^2)^{n/2}]^{1/(1-n)},
  ///   W = p_r/(k (2-n)) [X^2 + 3 g k (1-n) e_s^2]^{(2-n)/(2-2n)}.
  /// X <= 0 is a gap without stress.
  struct PressureElasticity
  {
    /// @param shear_modulus at the reference pressure, Pa
    /// @param poisson_ratio of the two moduli at q = 0
    /// @param exponent n, from 0 to less than 1
    /// @param reference_pressure p_r, Pa
    PressureElasticity(const double shear_modulus,
                       const double poisson_ratio,
                       const double exponent,
                       const double reference_pressure)
        : n(exponent)
        , p_r(reference_pressure)
        , log_p_r(std::log(reference_pressure))
        , g(shear_modulus / reference_pressure)
        , k(g * 2. * (1. + poisson_ratio) / (3. * (1. - 2. * poisson_ratio)))
        , k_n(k * (1. - exponent))
        , a(k_n / (3. * g))
        , inverse(1. / (1. - exponent))
    {
    }

    /// X of a volume strain.
    template <typename Number>
    Number opening(const Number &volume_strain) const
    {
      return 1. + k_n * volume_strain;
    }

    /// ln p of X > 0 and eta.
    template <typename Number>
    Number log_pressure(const Number &X, const Number &eta) const
    {
      return log_p_r + inverse * (simd::log<Number>(X) + (0.5 * n) * simd::log<Number>(1. + a * eta * eta));
    }

    /// X of ln p and eta.
    template <typename Number>
    Number opening_at(const Number &log_pressure, const Number &eta) const
    {
      return simd::exp<Number>((1. - n) * (log_pressure - log_p_r) - (0.5 * n) * simd::log<Number>(1. + a * eta * eta));
    }

    /// e_v of X.
    template <typename Number>
    Number volume_strain(const Number &X) const
    {
      return (X - 1.) * (1. / k_n);
    }

    /// e_s of X and eta.
    template <typename Number>
    Number shear_strain(const Number &X, const Number &eta) const
    {
      return eta * X * (1. / (3. * g));
    }

    /// Stored energy W, J/m^3 of reference volume.
    double energy(const double volume_strain, const double shear_strain) const
    {
      const double X = opening(volume_strain);
      return X <= 0. ? 0.
                     : p_r / (k * (2. - n)) *
                           std::pow(X * X + 3. * g * k_n * shear_strain * shear_strain, 0.5 * (2. - n) * inverse);
    }

    /// Modulus of waves, Pa: largest second derivative of W for a change of one principal strain.
    template <typename Number>
    Number wave_modulus(const Number &log_pressure, const Number &eta) const
    {
      const Number square = 1. + a * eta * eta;
      const Number along  = std::sqrt(k_n) + std::sqrt(4. / 3. * g * a) * simd::abs<Number>(eta);
      return p_r * simd::exp<Number>(n * (log_pressure - log_p_r) + (0.5 * n) * simd::log<Number>(square)) *
             (k_n + 4. / 3. * g + n * inverse * along * along / square);
    }

    /// G at q = 0, Pa.
    double shear_modulus(const double pressure) const
    {
      return g * p_r * std::pow(pressure / p_r, n);
    }

    double n,    ///< exponent of both moduli
        p_r,     ///< Pa
        log_p_r, ///< ln p_r
        g,       ///< G/p_r at p_r
        k,       ///< K/p_r at p_r
        k_n,     ///< k (1 - n)
        a,       ///< k_n/(3 g)
        inverse; ///< 1/(1 - n)
  };
} // namespace scree

#endif
