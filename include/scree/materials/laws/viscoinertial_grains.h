// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_viscoinertial_grains_h
#define scree_materials_laws_viscoinertial_grains_h

#include <scree/materials/laws/linear_elastic.h>

namespace scree
{
  /// Entries of subsection "Viscoinertial grains". Defaults: for glass beads, after @source{baumgarten2019}.
  struct ViscoinertialGrainsParameters : LinearElasticParameters
  {
    double grain_diameter    = 1e-3;   ///< d, m
    double liquid_viscosity  = 1e-3;   ///< eta, Pa s; 0: dry
    double static_friction   = 0.35;   ///< mu_1, tau/p of slow flow
    double rapid_friction    = 1.387;  ///< mu_2, limit of tau/p without the viscous term
    double reference_number  = 0.3085; ///< b, I_m at which half of mu_2 - mu_1 is reached
    double critical_fraction = 0.585;  ///< phi_m, solid fraction of slow flow
    double fraction_slope    = 1.23;   ///< a of phi_eq = phi_m/(1 + a I_m)
    double dilatancy         = 4.715;  ///< K of beta = K (phi - phi_eq)
    double initial_fraction  = 0.6;    ///< phi_0, solid fraction at the start

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;

    /// Divides mu_1 and mu_2; dilatancy stays.
    bool divide_strength(const double factor) override
    {
      static_friction /= factor;
      rapid_friction /= factor;
      return true;
    }

    /// Of slow flow in plane strain, where the mean stress is that in the plane.
    std::optional<double> sine_of_friction() const override
    {
      return static_friction;
    }
  };


  /// Grains in a liquid, or dry, from rest to suspension (@source{baumgarten2019}): Hencky elasticity, and with the
  /// mean compressive stress p, tau = |dev|/sqrt(2), the rate gamma_dot of plastic shear and the solid fraction phi
  ///   I_v = eta gamma_dot/p,   I = gamma_dot d sqrt(rho_s/p),   I_m = sqrt(I^2 + 2 I_v),
  ///   tau <= (mu + beta) p,    mu = mu_1 + (mu_2 - mu_1)/(1 + b/I_m) + 5/2 phi I_v/(a I_m),
  ///   volume strain rate of flow beta gamma_dot,   beta = K (phi - phi_eq),   phi_eq = phi_m/(1 + a I_m).
  /// beta is the dilatancy of @source{pailha2009}; the paper has a constant each below and above phi_m. Grains looser
  /// than phi_m are a suspension that cannot be denser than phi_eq:
  ///   p <= (a phi/(phi_m - phi))^2 (rho_s d^2 gamma_dot^2 + 2 eta gamma_dot),
  /// and compaction keeps p there, also at 0 (K_5 = 0 in the paper). Without pressure grains are apart.
  ///
  /// Backward Euler, with phi of the end of the step. With A = eta J/dt, B = rho_s d^2 J/dt^2 and the plastic shear
  /// gamma, p I_m^2 = h = B gamma^2 + 2 A gamma. In a suspension I_m is that of phi, and gamma the root of a quadratic
  /// equation. Else p = y^2 of a gamma is the positive root of
  ///   y^3 + s y^2 + (m - q) y - q s = 0,   s = a sqrt(h),   q = p_tr + c phi gamma,   m = c phi_m gamma,
  /// with the trial pressure p_tr and c = K times the bulk modulus: Newton's method from sqrt(q) goes down to it. tau
  /// is the root of tau - (mu + beta) p, which grows with it, by Newton's method within a bracket.
  class ViscoinertialGrains : public LinearElastic
  {
  public:
    static constexpr unsigned int n_internal_variables = 1; ///< plastic shear strain sqrt(2/3) |dev e_p|

    /// Copies the constants.
    explicit ViscoinertialGrains(const ViscoinertialGrainsParameters &parameters);

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline InvariantResponse<Number>
    respond(const LawStep<Number> &step, const StrainInvariants<Number> &strain, Number *internal_variables) const
    {
      InvariantResponse<Number> response = LinearElastic::respond<Number>(step, strain, internal_variables);
      Trial<Number> trial;
      trial.pressure = -1. * response.mean_stress;
      trial.shear    = (sqrt_2 * shear_modulus) * simd::sqrt<Number>(strain.square);
      trial.phi      = of.initial_fraction / step.volume_ratio;

      const Number excess = trial.phi - of.critical_fraction;
      response.is_plastic =
          (excess < 0.) | (trial.shear > (of.static_friction + of.dilatancy * excess) * trial.pressure);
      const auto plastic_return = [&]() __attribute__((noinline))
      {
        const double per_time = 1. / step.time_step;
        trial.viscous         = (of.liquid_viscosity * per_time) * step.volume_ratio;
        trial.inertial =
            (step.grain_density * of.grain_diameter * of.grain_diameter * per_time * per_time) * step.volume_ratio;
        return_to_flow<Number>(trial, internal_variables, response);
      };
      if (simd::any(response.is_plastic))
        plastic_return();
      return response;
    }

    /// See Material::initialise(). Throws for stresses that grains at rest cannot carry.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Writes phi.
    void output(const PrincipalValues &, const double *, const double volume_ratio, double *values) const
    {
      values[0] = of.initial_fraction / volume_ratio;
    }

  private:
    static constexpr double sqrt_2 = 1.4142135623730951, sqrt_3 = 1.7320508075688772;
    static constexpr double einstein = 2.5, smallest = 1e-200;

    /// An elastic step, and A and B of the class.
    template <typename Number>
    struct Trial
    {
      Number pressure; // Pa; negative in tension
      Number shear;    // |dev|/sqrt(2), Pa
      Number phi;
      Number viscous;  // A, Pa
      Number inertial; // B, Pa
    };

    /// Pressure, Pa, and shear stress, Pa, with its derivative by gamma.
    template <typename Number>
    struct Flow
    {
      Number pressure, shear, slope;
    };

    /// A suspension that flows and compacts.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Flow<Number> suspension(const Trial<Number> &trial, Number &gamma) const
    {
      constexpr double least_number = 1e-8;
      const Number I_m       = simd::max<Number>((of.critical_fraction - trial.phi) / (of.fraction_slope * trial.phi),
                                           simd::broadcast<Number>(least_number));
      const Number mu        = of.static_friction + friction_range * I_m / (I_m + of.reference_number),
                   square    = 1. / (I_m * I_m);
      const Number quadratic = mu * square * trial.inertial;
      const Number linear    = (2. * mu * square + (einstein / of.fraction_slope) * trial.phi / I_m) * trial.viscous;
      const Number with_elastic = linear + shear_modulus;
      gamma                     = 2. * trial.shear /
              (with_elastic + simd::sqrt<Number>(with_elastic * with_elastic + 4. * quadratic * trial.shear));
      return { (trial.inertial * gamma + 2. * trial.viscous) * gamma * square,
               (quadratic * gamma + linear) * gamma,
               gamma };
    }

    /// Flow by `gamma` that changes the volume by beta gamma.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Flow<Number> dilating(const Trial<Number> &trial, const Number &gamma) const
    {
      constexpr unsigned int most_iterations = 60;
      constexpr double tolerance             = 1e-14;
      const Number zero = simd::broadcast<Number>(0.), least = simd::broadcast<Number>(smallest);
      const Number r =
          simd::sqrt<Number>(simd::max<Number>((trial.inertial * gamma + 2. * trial.viscous) * gamma, least));
      const Number r_ = (trial.inertial * gamma + trial.viscous) / r; // derivatives by gamma end with _
      const Number s = of.fraction_slope * r, s_ = of.fraction_slope * r_;
      const Number q_ = stiff_dilatancy * trial.phi, q = simd::max<Number>(trial.pressure + q_ * gamma, least);
      const double m_     = stiff_dilatancy * of.critical_fraction;
      const Number linear = m_ * gamma - q;

      Number y = simd::sqrt<Number>(q), slope = zero;
      simd::Mask<Number> is_moving = y > 0.;
      for (unsigned int i = 0; i < most_iterations && simd::any(is_moving); ++i)
        {
          slope               = (3. * y + 2. * s) * y + linear;
          const Number change = simd::max<Number>((((y + s) * y + linear) * y - q * s) / slope, zero);
          y                   = simd::select<Number>(is_moving, y - change, y);
          is_moving           = is_moving & (change > tolerance * y);
        }
      y               = simd::max<Number>(y, least);
      slope           = (3. * y + 2. * s) * y + linear;
      const Number y_ = -1. * (s_ * y * y + (m_ - q_) * y - q_ * s - q * s_) / slope;

      const Number of_number = r + of.reference_number * y, of_fraction = y + s;
      const Number friction = of.static_friction + friction_range * r / of_number +
                              of.dilatancy * (trial.phi - of.critical_fraction * y / of_fraction);
      const Number friction_ = (friction_range * of.reference_number) * (r_ * y - r * y_) / (of_number * of_number) -
                               (of.dilatancy * of.critical_fraction) * (y_ * s - y * s_) / (of_fraction * of_fraction);
      const Number viscous = (einstein / of.fraction_slope) * trial.phi * trial.viscous / r;
      return { y * y,
               friction * y * y + viscous * gamma * y,
               friction_ * y * y + 2. * friction * y * y_ + viscous * (y + gamma * y_ - gamma * y * r_ / r) };
    }

    /// The return of the points that are plastic.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline void
    return_to_flow(const Trial<Number> &trial, Number *internal_variables, InvariantResponse<Number> &response) const
    {
      constexpr unsigned int most_iterations = 200;
      constexpr double tolerance             = 1e-12;
      const Number zero = simd::broadcast<Number>(0.), largest = trial.shear * (1. / shear_modulus);

      Number gamma;
      Flow<Number> flow                   = suspension<Number>(trial, gamma);
      const simd::Mask<Number> is_limited = (trial.phi < of.critical_fraction) & (flow.pressure <= trial.pressure);
      const simd::Mask<Number> is_apart = (trial.pressure + stiff_dilatancy * trial.phi * largest <= 0.) & !is_limited;
      gamma                             = simd::select<Number>(is_limited, gamma, largest);
      Number pressure                   = simd::select<Number>(is_limited, flow.pressure, zero);
      Number shear                      = simd::select<Number>(is_limited, flow.shear, zero);
      simd::Mask<Number> todo           = response.is_plastic & !is_limited & !is_apart;
      if (simd::any(todo))
        {
          Number low = zero, high = trial.shear;
          Number root = simd::min<Number>(
              (of.static_friction + of.dilatancy * simd::max<Number>(trial.phi - of.critical_fraction, zero)) *
                  simd::max<Number>(trial.pressure, zero),
              trial.shear);
          const simd::Mask<Number> is_dilating = todo;
          for (unsigned int i = 0; i < most_iterations && simd::any(todo); ++i)
            {
              const Number now                  = simd::max<Number>(trial.shear - root, zero) * (1. / shear_modulus);
              flow                              = dilating<Number>(trial, now);
              gamma                             = simd::select<Number>(todo, now, gamma);
              pressure                          = simd::select<Number>(todo, flow.pressure, pressure);
              shear                             = simd::select<Number>(todo, root, shear);
              const Number beyond               = root - flow.shear;
              const simd::Mask<Number> is_above = beyond > 0.;
              high                              = simd::select<Number>(is_above, root, high);
              low                               = simd::select<Number>(is_above, low, root);
              todo =
                  todo & (simd::abs<Number>(beyond) > tolerance * trial.shear) & (high - low > tolerance * trial.shear);
              const Number newton                = root - beyond / (1. + (1. / shear_modulus) * flow.slope);
              const simd::Mask<Number> is_within = (newton > low) & (newton < high);
              root                               = simd::select<Number>(is_within, newton, 0.5 * (low + high));
            }
          response.is_unresolved = todo & is_dilating;
        }

      const auto set = [&](Number &value, const Number &returned) {
        value = simd::select<Number>(response.is_plastic, returned, value);
      };
      const Number factor = shear / simd::max<Number>(trial.shear, simd::broadcast<Number>(smallest));
      set(response.volume_strain, pressure * (-1. / bulk_modulus(0)));
      set(response.deviator_factor, factor);
      set(response.mean_stress, -1. * pressure);
      set(response.stress_factor, (2. * shear_modulus) * factor);
      response.is_separated = response.is_plastic & is_apart;
      internal_variables[0] += (1. / sqrt_3) * simd::select<Number>(response.is_plastic, gamma, zero);
    }

    const ViscoinertialGrainsParameters of;
    const double friction_range;  // mu_2 - mu_1
    const double stiff_dilatancy; // K times the bulk modulus, Pa
  };
} // namespace scree

#endif
