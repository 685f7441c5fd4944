// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_tresca_h
#define scree_materials_laws_tresca_h

#include <scree/materials/laws/mohr_coulomb.h>

namespace scree
{
  /// Entries of subsection "Tresca".
  struct TrescaParameters : LinearElasticParameters
  {
    double strength = 10e3;                            ///< s_u, Pa, unless there is
    std::string strength_of_place;                     ///< s_u of a place at the start, see PlaceVariable
    double tension_cut_off     = 0;                    ///< largest principal stress, Pa
    double sensitivity         = 1;                    ///< S_t, -
    double remoulding_strain   = 0;                    ///< kappa_95, -
    double nonlocal_length     = 0;                    ///< l, m; 0: the strain of the point itself
    double rate_increase       = 0;                    ///< mu of RateOfStrength
    double reference_rate      = 3e-6;                 ///< 1/s
    double consistency         = 0;                    ///< K, Pa s^n; not an entry of clay
    double index               = 1;                    ///< n; not an entry of clay
    std::string strength_entry = "Undrained strength"; ///< name of the entry, for messages
    double reduction           = 1;                    ///< factor by which a safety of slopes divides the strength

    /// With the moduli of soft clay.
    TrescaParameters()
        : LinearElasticParameters(1e7, 0.45)
    {
    }

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;

    /// Divides the strength of the law, not that which points have from their place, and the cut-off.
    bool divide_strength(const double factor) override
    {
      reduction *= factor;
      tension_cut_off /= factor;
      return true;
    }

    /// Of a law without friction: 0, so that K0 is 1 where the user gives none.
    std::optional<double> sine_of_friction() const override
    {
      return 0.;
    }
  };


  /// Entries of subsection "Herschel-Bulkley": mud is a TrescaParameters with other entries.
  struct HerschelBulkleyParameters : TrescaParameters
  {
    /// The values of mud.
    HerschelBulkleyParameters();

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;
  };


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
    DEAL_II_ALWAYS_INLINE inline Number overstress(const Number &excess,
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

  private:
    const double increase;        // mu/ln(10)
    const double log_reference;   // of 1/s
    const double log_consistency; // of Pa s^n
    const double index;           // n
  };


  /// Undrained clay with a strength of each place that falls with plastic shear and grows with its rate
  /// (@source{einav2005}), and mud that flows (@source{herschel1926}): MohrCoulomb without friction whose cohesion is
  ///   s = s_u(place) [1/S_t + (1 - 1/S_t) exp(-3 kappa/kappa_95)] (1 + mu log10(rate/rate_0)) + K rate^n,
  /// with kappa as in SofteningMohrCoulomb and RateOfStrength.
  ///
  /// A return to tau_1 - tau_3 = 2 s has the plastic shear (tau_1 - tau_3 - 2 s)/(2 G) on a face and on an edge, so
  /// that one equation for s makes both implicit in the rate. kappa is that before the step.
  class Tresca : public MohrCoulomb
  {
  public:
    /// Plastic shear strain sqrt(2/3 e:e), kappa, the kappa that sets the strength, and s_u of the place, Pa.
    static constexpr unsigned int n_internal_variables = 4;

    /// Clay.
    explicit Tresca(const TrescaParameters &parameters);

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond(const LawStep<Number> &step,
                                                             PrincipalNumbers<Number> &strain,
                                                             Number *internal_variables,
                                                             PrincipalNumbers<Number> &stress) const
    {
      stress            = stress_of(strain);
      const Number slow = slow_strength<Number>(internal_variables), zero = simd::broadcast<Number>(0.);
      const Number largest = largest_of(stress), shear_stress = 0.5 * (largest - smallest_of(stress));

      LawResponse<Number> response{};
      response.bulk_modulus     = simd::broadcast<Number>(bulk);
      response.is_plastic       = (shear_stress > slow) | (largest > largest_principal_stress);
      const auto plastic_return = [&]() __attribute__((noinline))
      {
        Number strength = slow;
        if (rate_of_strength.is_active(step.time_step))
          {
            const Number excess = shear_stress - slow;
            strength += simd::select<Number>(
                excess > 0., rate_of_strength.overstress<Number>(excess, slow, shear_modulus, step.time_step), zero);
          }
        const MohrCoulombSurfaces<Number> surfaces(
            { zero, zero, 2. * strength }, largest_principal_stress, bulk, shear_modulus, true);
        const simd::Mask<Number> none{}; // is without strength
        return_to<3, Number>(surfaces, none, step, strain, internal_variables, stress, response);
      };
      if (simd::any(response.is_plastic))
        plastic_return();
      return response;
    }

    /// See Material::initialise(). Throws if the stress is beyond the strength.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Shear strength of a point that shears slowly, Pa.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number slow_strength(const Number *internal_variables) const
    {
      const Number peak = scale * internal_variables[of_place];
      if (decay == 0)
        return peak;
      const Number kappa = simd::max<Number>(internal_variables[acting_kappa], simd::broadcast<Number>(0.));
      return peak * (residual + (1. - residual) * simd::exp<Number>(-decay * kappa));
    }

  private:
    static constexpr unsigned int plastic_shear = 0, own_kappa = 1, acting_kappa = 2, of_place = 3; // variables

    const RateOfStrength rate_of_strength;
    const double scale;    // of the strength, 1 unless reduced
    const double residual; // 1/S_t
    const double decay;    // 3/kappa_95; 0: strength does not fall
  };
} // namespace scree

#endif
