// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_nor_sand_h
#define scree_materials_laws_nor_sand_h

#include <scree/materials/law_entries.h>

namespace scree
{
  /// Entries of both forms of Nor-Sand.
  struct SandParameters : LawEntries
  {
    double shear_modulus;         ///< G, Pa; at the reference pressure, if it grows with pressure
    double compression_index;     ///< lambda, slope of the critical state line in ln p
    double critical_stress_ratio; ///< M, q/p at critical state; in triaxial compression
    double substep_strain;        ///< largest component of dF - I in one return map

    static constexpr double minimum_pressure = 1; ///< Pa; no stress below it

    LawEntry modulus() const override
    {
      return { "Shear modulus", shear_modulus };
    }

    /// Divides M, from whichever entry; dilatancy and hardening are as before, so that the peak falls with M.
    bool divide_strength(const double factor) override
    {
      critical_stress_ratio /= factor;
      return true;
    }

    /// At critical state in triaxial compression.
    std::optional<double> sine_of_friction() const override
    {
      return 3 * critical_stress_ratio / (6 + critical_stress_ratio);
    }

  protected:
    /// The last of the entries: sub-steps, with more `text`.
    void add_substeps(dealii::ParameterHandler &prm, const std::string &text);

    /// Throws EntryError if one of these entries is not positive.
    void check_positive(const std::string &subsection, const std::vector<LawEntry> &entries) const;
  };


  /// Entries of subsection "Nor-Sand". Defaults: @source{xie2024}, Table 1, dense.
  struct NorSandParameters : SandParameters
  {
    double swelling_index                 = 0.002; ///< kappa, elastic compressibility in ln P
    double critical_state_specific_volume = 1.88;  ///< v_c0, on that line at 1 Pa
    double yield_constant                 = 0.3;   ///< N, curvature of the yield surface; 0: Cam-Clay
    double potential_constant             = 0.3;   ///< Nbar, curvature of the plastic potential, at most N
    double hardening_coefficient          = 300;   ///< h, hardening coefficient
    double dilatancy_multiplier           = -4.5;  ///< alpha, largest dilatancy over state parameter; negative
    double initial_specific_volume        = 1.629; ///< v_0, 1 + void ratio at the start

    /// The values of this form.
    NorSandParameters()
    {
      shear_modulus         = 4e6;
      compression_index     = 0.012;
      critical_stress_ratio = 0.7097;
      substep_strain        = 1e-3;
    }

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;
    LawEntry stiffest() const override;
  };


  /// Entries of subsection "Nor-Sand (Jefferies-Been)". Defaults: Erksak sand, fitted to drained tests G667 and G682
  /// (@source{been1991}).
  struct JefferiesBeenParameters : SandParameters
  {
    double reference_pressure  = 100e3; ///< p_ref, Pa, of the shear modulus
    double poisson_ratio       = 0.2;   ///< of the moduli at q = 0
    double modulus_exponent    = 0.5;   ///< n: moduli grow with (p/p_ref)^n
    double critical_void_ratio = 0.816; ///< Gamma, at 1 kPa
    double volumetric_coupling = 0.05;  ///< N
    double state_dilatancy     = 4.3;   ///< chi_tc
    double hardening_modulus   = 77.7;  ///< H_0
    double hardening_slope     = 633;   ///< H_psi
    double initial_void_ratio  = 0.65;  ///< e_0

    /// The values of this form.
    JefferiesBeenParameters()
    {
      shear_modulus         = 80e6;
      compression_index     = 0.015;
      critical_stress_ratio = 1.188;
      substep_strain        = 5e-4;
    }

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;
  };


  /// Specific volume at critical state: v_c = Gamma - lambda ln(p/p_ref).
  struct CriticalLine
  {
    /// The state parameter psi = v - v_c.
    template <typename Number>
    Number state(const Number &volume, const Number &log_pressure) const
    {
      return volume - intercept + slope * (log_pressure - log_reference);
    }

    double intercept,  ///< Gamma
        slope,         ///< lambda
        log_reference; ///< ln p_ref
  };


  /// Elasticity of constant G with a bulk modulus in proportion to pressure (@source{borja2006}): P = P_0
  /// exp(e_v/kappa), q = 3 G e_s, energy kappa P + 3/2 G e_s^2; P_0 = 1 kPa only fixes the zero of e_v. Strains as in
  /// PressureElasticity.
  struct ConstantShear
  {
    /// e_v and e_s of p (and its logarithm) and eta = q/p.
    template <typename Number>
    void strain_of(const Number &log_pressure, const Number &p, const Number &eta, Number &volume, Number &shear) const
    {
      volume = (log_pressure - log_zero_strain_pressure) * kappa;
      shear  = p * eta * (1. / (3. * G));
    }

    /// ln p.
    template <typename Number>
    Number log_pressure(const Number &volume_strain) const
    {
      return log_zero_strain_pressure + volume_strain * (1. / kappa);
    }

    /// Tangent, Pa.
    template <typename Number>
    Number bulk_modulus(const Number &, const Number &p, const Number &) const
    {
      return p * (1. / kappa);
    }

    /// J/m^3 of reference volume.
    /// @param shear_square e_s^2
    template <typename Number>
    Number energy(const Number &volume_strain, const Number &shear_square) const
    {
      return kappa * simd::exp<Number>(log_pressure(volume_strain)) + 1.5 * G * shear_square;
    }

    static constexpr double log_zero_strain_pressure = 6.907755278982137; ///< ln(1 kPa/1 Pa)
    double kappa,                                                         ///< compressibility in ln p
        G;                                                                ///< Pa
  };


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
        , constant_shear(g * p_r * std::pow(1e3 / p_r, n))
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

    /// See ConstantShear.
    template <typename Number>
    void strain_of(const Number &log_pressure, const Number &, const Number &eta, Number &volume, Number &shear) const
    {
      const Number X = opening_at(log_pressure, eta);
      volume         = (X - 1.) * (1. / k_n);
      shear          = eta * X * (1. / (3. * g));
    }

    /// Such that it and 4/3 of `constant_shear` are the modulus of waves: largest second derivative of W for a change
    /// of one principal strain.
    template <typename Number>
    Number bulk_modulus(const Number &log_pressure, const Number &, const Number &eta) const
    {
      const Number square = 1. + a * eta * eta;
      const Number along  = std::sqrt(k_n) + std::sqrt(4. / 3. * g * a) * simd::abs<Number>(eta);
      return p_r * simd::exp<Number>(n * (log_pressure - log_p_r) + (0.5 * n) * simd::log<Number>(square)) *
                 (k_n + 4. / 3. * g + n * inverse * along * along / square) -
             4. / 3. * constant_shear;
    }

    /// Stored energy W, J/m^3 of reference volume.
    /// @param shear_square e_s^2
    template <typename Number>
    Number energy(const Number &volume_strain, const Number &shear_square) const
    {
      const Number X = opening(volume_strain), zero = simd::broadcast<Number>(0.);
      const Number square = simd::select<Number>(X > 0., X * X + 3. * g * k_n * shear_square, zero + 1.);
      const Number power  = simd::exp<Number>(0.5 * (2. - n) * inverse * simd::log<Number>(square));
      return simd::select<Number>(X > 0., p_r / (k * (2. - n)) * power, zero);
    }

    double n,           ///< exponent of both moduli
        p_r,            ///< Pa
        log_p_r,        ///< ln p_r
        g,              ///< G/p_r at p_r
        k,              ///< K/p_r at p_r
        k_n,            ///< k (1 - n)
        a,              ///< k_n/(3 g)
        inverse,        ///< 1/(1 - n)
        constant_shear; ///< G at 1 kPa and q = 0, Pa
  };


  /// What both forms of Nor-Sand share: critical state plasticity of sand in finite strain, with p the mean compressive
  /// Kirchhoff stress, q = sqrt(3/2)|dev tau|, eta = q/p, p_i the image pressure, r = ln(p/p_i), v the specific volume,
  /// psi = v - v_c(p_i). Backward Euler. Flow is along the deviator of the trial state, so that the Lode angle is its
  /// own: a return is two equations in r and one more unknown of the form.
  ///
  /// At the vertex q = 0 the plastic multiplier exceeds the plastic shear strain; dilatancy and hardening go with it,
  /// so isotropic compression hardens.
  ///
  /// No tension: a point whose trial or returned p is below the minimum pressure has no stress. Its b_e becomes
  /// isotropic and keeps the volume strain: the gap, to be closed before stress returns; grains apart do not dilate.
  /// Its image pressure becomes the limit at the minimum pressure.
  ///
  /// A `Form` has its own Trial, trial(), solve(), search(), limit_at(), image_through() and `elastic`.
  template <typename Form, typename Elasticity>
  class SandLaw : public ConstitutiveLaw
  {
  public:
    static constexpr unsigned int n_internal_variables = 2;    ///< image pressure, Pa, and plastic shear strain
    static constexpr bool in_invariants                = true; ///< see ConstitutiveLaw
    static constexpr bool leaves_returns               = true; ///< see ConstitutiveLaw

    /// What a return starts from, as far as forms share it.
    template <typename Number>
    struct Trial
    {
      Number volume_strain;          ///< e_v, compression positive
      Number shear_strain;           ///< e_s
      Number log_pressure;           ///< ln p
      Number pressure;               ///< p, Pa
      Number eta;                    ///< q/p
      Number stress_factor;          ///< deviatoric stress over strain, Pa
      Number log_image;              ///< ln p_i, after the cap of an elastic step
      Number volume;                 ///< v
      simd::Mask<Number> is_apart;   ///< no stress
      simd::Mask<Number> is_capped;  ///< the cap lowered p_i
      simd::Mask<Number> is_plastic; ///< has to return
    };

    /// A state on the yield surface.
    template <typename Number>
    struct Returned
    {
      Number log_pressure; ///< ln p
      Number log_ratio;    ///< r
      Number eta;          ///< q/p
    };

    /// Two residuals of the unknowns x and r, and their derivatives.
    template <typename Number>
    struct Residual
    {
      Number first;      ///< residual
      Number first_x;    ///< derivative in x
      Number first_r;    ///< derivative in r
      Number second;     ///< residual
      Number second_x;   ///< derivative in x
      Number second_r;   ///< derivative in r
      Number scale;      ///< size of what `first` is made of
      Number multiplier; ///< plastic multiplier
    };

    /// Tangent, Pa, which with 4/3 of the shear modulus is the modulus of waves at the pressure.
    double bulk_modulus(const double pressure) const
    {
      const double p = std::max(pressure, std::exp(log_minimum_pressure));
      return std::max(elastic.bulk_modulus(std::log(p), p, 0.), 0.);
    }

    /// J per m^3 of reference volume.
    template <typename Number>
    Number energy(const StrainInvariants<Number> &strain) const
    {
      return elastic.template energy<Number>(-1. * strain.volume, 2. / 3. * strain.square);
    }

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline InvariantResponse<Number>
    respond(const LawStep<Number> &step, const StrainInvariants<Number> &strain, Number *internal_variables) const
    {
      const auto state  = form().trial(strain, step.volume_ratio, internal_variables);
      const Number zero = simd::broadcast<Number>(0.), one = simd::broadcast<Number>(1.);
      const simd::Mask<Number> is_plastic = state.is_plastic, changes = state.is_apart | is_plastic | state.is_capped;
      const Number &p = state.pressure;

      InvariantResponse<Number> response{};
      response.volume_strain   = strain.volume;
      response.deviator_factor = one;
      response.mean_stress     = -1. * p;
      response.stress_factor   = state.stress_factor;
      response.bulk_modulus    = elastic.bulk_modulus(state.log_pressure, p, state.eta);
      response.is_plastic      = changes;
      if (step.leaves_returns || !simd::any(changes))
        {
          response.is_left = changes;
          return response;
        }

      simd::Mask<Number> is_apart = state.is_apart;
      Number image_pressure = simd::exp<Number>(state.log_image), plastic_shear = zero;
      if (simd::any(is_plastic))
        {
          Returned<Number> found{ state.log_pressure, state.log_pressure - state.log_image, state.eta };
          const simd::Mask<Number> solved = form().solve(state, is_plastic, found);
          for (unsigned int left = simd::bits_of(is_plastic & !solved); left != 0; left &= left - 1)
            {
              // Point by point.
              const unsigned int l = __builtin_ctz(left);
              const StrainInvariants<double> alone{ simd::lane(strain.volume, l),
                                                    simd::lane(strain.square, l),
                                                    simd::lane(strain.third, l) };
              const double variables[2] = { simd::lane(internal_variables[0], l), 0 };
              LawResponse<double> of_search{};
              const Returned<double> root =
                  form().search(form().trial(alone, simd::lane(step.volume_ratio, l), variables), of_search);
              simd::set_lane(found.log_pressure, l, root.log_pressure);
              simd::set_lane(found.log_ratio, l, root.log_ratio);
              simd::set_lane(found.eta, l, root.eta);
              simd::set_lane(response.is_searched, l, true);
              simd::set_lane(response.is_vertex, l, of_search.is_vertex);
              simd::set_lane(response.is_unresolved, l, of_search.is_unresolved);
            }
          Number volume, shear;
          const Number p_found = simd::exp<Number>(found.log_pressure);
          elastic.strain_of(found.log_pressure, p_found, found.eta, volume, shear);
          const Number inverse = 1. / simd::max<Number>(state.shear_strain, simd::broadcast<Number>(1e-300));
          const auto set       = [&](Number &value, const Number &returned) {
            value = simd::select<Number>(is_plastic, returned, value);
          };
          set(response.volume_strain, -1. * volume);
          set(response.deviator_factor, shear * inverse);
          set(response.mean_stress, -1. * p_found);
          set(response.stress_factor, (2. / 3.) * p_found * found.eta * inverse);
          set(response.bulk_modulus, elastic.bulk_modulus(found.log_pressure, p_found, found.eta));
          set(image_pressure, simd::exp<Number>(found.log_pressure - found.log_ratio));
          set(plastic_shear, simd::max<Number>(state.shear_strain - shear, zero));
          is_apart = is_apart | (is_plastic & (found.log_pressure < log_minimum_pressure));
        }
      if (simd::any(is_apart))
        {
          const Number log_least = simd::broadcast<Number>(log_minimum_pressure);
          for (Number *value : { &response.deviator_factor,
                                 &response.mean_stress,
                                 &response.stress_factor,
                                 &response.bulk_modulus,
                                 &plastic_shear })
            *value = simd::select<Number>(is_apart, zero, *value);
          image_pressure = simd::select<Number>(
              is_apart, simd::exp<Number>(log_least + form().limit_at(state.volume, log_least)), image_pressure);
        }
      response.is_separated = is_apart;
      internal_variables[0] = simd::select<Number>(changes, image_pressure, internal_variables[0]);
      internal_variables[1] += plastic_shear;
      return response;
    }

    /// See Material::initialise(). The yield surface passes through the stress. Throws for tension and for stresses
    /// that no yield surface has. A stress below the minimum pressure becomes no stress and no gap.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Writes v or e and psi at J = `volume_ratio`; psi at the minimum pressure where p is less.
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

    /// The trial state of principal strains.
    auto trial_of(PrincipalValues strain, const double volume_ratio, const double *internal_variables) const
    {
      return form().trial(take_invariants<double>(strain), volume_ratio, internal_variables);
    }

    const Elasticity elastic; ///< stored energy
    const CriticalLine line;  ///< of critical states

  protected:
    /// From the entries and the parts of the form; v_0 is the `initial_volume`, and `volume_name` that of its measure.
    SandLaw(const SandParameters &parameters,
            const Elasticity &elastic,
            const CriticalLine &line,
            const double initial_volume,
            const std::string &volume_name);

    /// Sets what forms share of a trial state but pressure, eta and masks.
    template <typename Number>
    void set_trial(const StrainInvariants<Number> &strain,
                   const Number &volume_ratio,
                   const Number *internal_variables,
                   Trial<Number> &trial) const
    {
      trial.volume_strain = -1. * strain.volume;
      trial.shear_strain  = simd::sqrt<Number>(2. / 3. * strain.square);
      trial.log_image     = simd::log<Number>(internal_variables[0]);
      trial.volume        = initial_volume * volume_ratio;
    }

    /// Newton's method for the points `todo` from x and r, whose residuals are `now`; says which converged. Steps are
    /// halved until the sum of squares falls.
    /// @param residual of x and r
    /// @param room how far x may change in a step, from the step and x
    /// @param largest_ratio of r; a step goes at most nine tenths of the way
    template <typename Number, typename Residuals, typename Room>
    DEAL_II_ALWAYS_INLINE static inline simd::Mask<Number> newton(const Residuals &residual,
                                                                  const Room &room,
                                                                  const double largest_ratio,
                                                                  const double tolerance,
                                                                  Residual<Number> now,
                                                                  simd::Mask<Number> todo,
                                                                  Number &x,
                                                                  Number &r)
    {
      constexpr unsigned int largest_number_of_iterations = 14, largest_number_of_halvings = 6;
      constexpr double largest_change_of_ratio = 1, largest_part_of_the_way = 0.9; // to a bound
      const Number one = simd::broadcast<Number>(1.);

      simd::Mask<Number> converged = todo & !todo;
      for (unsigned int i = 0; i < largest_number_of_iterations; ++i)
        {
          const Number inverse_determinant = 1. / (now.first_x * now.second_r - now.first_r * now.second_x);
          const Number step_x = (now.first_r * now.second - now.second_r * now.first) * inverse_determinant;
          const Number step_r = (now.second_x * now.first - now.first_x * now.second) * inverse_determinant;
          Number part         = one;

          // A branch, as it is nearly always taken: minima would hold up the next residual.
          const Number room_x = room(step_x, x), ahead = largest_part_of_the_way * (largest_ratio - r);
          const auto is_full = (simd::abs<Number>(step_r) <= largest_change_of_ratio) & (step_r <= ahead) &
                               (simd::abs<Number>(step_x) <= room_x);
          if (simd::any(todo & !is_full))
            {
              const Number to_bound = simd::select<Number>(step_r > 0., ahead / step_r, one);
              const Number shorter =
                  simd::min<Number>(simd::min<Number>(one, largest_change_of_ratio / simd::abs<Number>(step_r)),
                                    simd::min<Number>(room_x / simd::abs<Number>(step_x), to_bound));
              part = simd::select<Number>(is_full, one, shorter);
            }

          const auto is_last = todo & (part == 1.) & (now.multiplier >= -1e-12) &
                               (simd::abs<Number>(now.first) <= tolerance * now.scale) &
                               (simd::abs<Number>(now.second) <= tolerance);
          converged = converged | is_last;
          x         = simd::select<Number>(is_last, x + step_x, x);
          r         = simd::select<Number>(is_last, r + step_r, r);
          todo      = todo & !is_last;
          if (!simd::any(todo))
            break;

          const Number merit = now.first * now.first + now.second * now.second;
          for (unsigned int halving = 0;; ++halving)
            {
              const Residual<Number> next = residual(x + part * step_x, r + part * step_r);
              const auto falls            = next.first * next.first + next.second * next.second < merit;
              if (halving == largest_number_of_halvings)
                todo = todo & falls;
              if (!simd::any(todo & !falls))
                {
                  now = next;
                  break;
                }
              part = simd::select<Number>(falls, part, 0.5 * part);
            }
          x = simd::select<Number>(todo, x + part * step_x, x);
          r = simd::select<Number>(todo, r + part * step_r, r);
        }
      return converged;
    }

    const double log_minimum_pressure; ///< of Pa

  private:
    const Form &form() const
    {
      return static_cast<const Form &>(*this);
    }

    const double initial_volume;
  };


  /// Nor-Sand of @source{borja2006} and @source{andrade2006} on ConstantShear.
  ///
  /// Yield eta = (M/N)(1 - (1-N) exp(r N/(1-N))), for N = 0 eta = M (1 - r). Flow d eps_s^p = gamma, d eps_v^p = gamma
  /// D (tension positive), D = (eta - M)/(1 - Nbar). Hardening d Pi = h (Pi* - Pi) gamma towards Pi* = P x^{-(1-N)/N},
  /// x = max(1 - Abar psi N/M, 0.15), Abar = alpha (1-Nbar)/(1-N); psi is taken at the returned Pi, v at the end of the
  /// step. The unknown beside r is gamma. The data show no dependence on the Lode angle.
  class NorSand : public SandLaw<NorSand, ConstantShear>
  {
  public:
    static constexpr double volume_zero = 0; ///< what the measure of volume is less than v

    /// Computes the constants of the equations from the entries.
    explicit NorSand(const NorSandParameters &parameters);

    /// Where a return starts.
    template <typename Number>
    struct Trial : SandLaw::Trial<Number>
    {
      Number stress_ratio; ///< eta of the yield surface
    };

    /// See Trial.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Trial<Number>
    trial(const StrainInvariants<Number> &strain, const Number &volume_ratio, const Number *internal_variables) const
    {
      Trial<Number> trial;
      set_trial(strain, volume_ratio, internal_variables, trial);
      trial.log_pressure  = elastic.log_pressure(trial.volume_strain);
      trial.pressure      = simd::exp<Number>(trial.log_pressure);
      trial.stress_ratio  = stress_ratio<Number>(trial.log_pressure - trial.log_image);
      const Number q      = 3. * parameters.shear_modulus * trial.shear_strain;
      trial.eta           = q / trial.pressure;
      trial.is_apart      = !(trial.log_pressure >= log_minimum_pressure);
      trial.stress_factor = simd::broadcast<Number>(2. * parameters.shear_modulus);
      trial.is_capped     = simd::Mask<Number>{};
      trial.is_plastic    = !(trial.is_apart | (q <= trial.pressure * trial.stress_ratio));
      return trial;
    }

  private:
    friend SandLaw<NorSand, ConstantShear>;

    /// eta of the yield surface, its derivative in r there, and D.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number stress_ratio(const Number &log_ratio) const
    {
      const double N = parameters.yield_constant, M = parameters.critical_stress_ratio;
      if (N > 0)
        return M / N * (1. - (1. - N) * simd::exp<Number>(exponent * log_ratio));
      return M * (1. - log_ratio);
    }
    template <typename Number>
    Number slope(const Number &stress_ratio) const
    {
      const double N = parameters.yield_constant;
      return (N * stress_ratio - parameters.critical_stress_ratio) * (1. / (1. - N));
    }
    template <typename Number>
    Number dilatancy(const Number &stress_ratio) const
    {
      return (stress_ratio - parameters.critical_stress_ratio) * dilatancy_factor;
    }

    /// ln(Pi*/P) and its derivative in ln Pi.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number
    log_limit(const Number &log_image, const Number &volume, Number &derivative) const
    {
      constexpr double smallest_argument = 0.15; // Below, the limit pressure runs away for very dense sand.

      const Number state = line.state(volume, log_image);
      if (exponent == 0) // the limit N -> 0
        {
          const double factor =
              parameters.dilatancy_multiplier * (1 - parameters.potential_constant) / parameters.critical_stress_ratio;
          derivative = simd::broadcast<Number>(factor * line.slope);
          return factor * state;
        }
      const Number argument = 1. - limit_factor * state;
      const Number used     = simd::max<Number>(argument, simd::broadcast<Number>(smallest_argument));
      derivative            = simd::select<Number>(argument > smallest_argument,
                                        limit_factor * line.slope * inverse_exponent / used,
                                        simd::broadcast<Number>(0.));
      return -1. * simd::log<Number>(used) * inverse_exponent;
    }
    template <typename Number>
    Number limit_at(const Number &volume, const Number &log_image) const
    {
      Number derivative;
      return log_limit(log_image, volume, derivative);
    }

    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Residual<Number>
    residual(const Trial<Number> &trial, const Number &multiplier, const Number &log_ratio) const
    {
      const double h = parameters.hardening_coefficient, stiffness = 1. / elastic.kappa;
      const Number eta = stress_ratio<Number>(log_ratio), eta_ratio = slope<Number>(eta);
      const Number D                  = dilatancy(eta);
      const Number log_pressure_gamma = D * stiffness;
      const Number log_pressure       = trial.log_pressure + multiplier * log_pressure_gamma;
      const Number log_pressure_ratio = multiplier * eta_ratio * (dilatancy_factor * stiffness);

      const Number compliance     = simd::exp<Number>(-1. * log_pressure);
      const Number deviator_slope = 3 * parameters.shear_modulus * compliance;
      const Number deviator_ratio = deviator_slope * (trial.shear_strain - multiplier); // q/P

      // Pi (1 + h gamma) = Pi_n + h gamma Pi*, over P.
      Number limit_slope;
      const Number limit =
          h * simd::exp<Number>(log_limit<Number>(log_pressure - log_ratio, trial.volume, limit_slope));
      const Number old         = simd::exp<Number>(trial.log_image - log_pressure);
      const Number hardening   = 1. + h * multiplier;
      const Number sum         = old + multiplier * limit;
      const Number inverse_sum = 1. / sum;

      Residual<Number> r;
      r.scale      = 1. + deviator_slope * trial.shear_strain;
      r.multiplier = multiplier;
      r.first      = deviator_ratio - eta;
      r.first_x    = -1. * (deviator_slope + deviator_ratio * log_pressure_gamma);
      r.first_r    = -1. * deviator_ratio * log_pressure_ratio - eta_ratio;
      r.second     = simd::log<Number>(hardening * inverse_sum) - log_ratio;
      r.second_x =
          h / hardening - (limit + (multiplier * limit * limit_slope - old) * log_pressure_gamma) * inverse_sum;
      r.second_r =
          -1. - (multiplier * limit * limit_slope * (log_pressure_ratio - 1.) - old * log_pressure_ratio) * inverse_sum;
      return r;
    }

    /// The same at gamma = 0, cheap. At the vertex r is less than ln(p/p_i) of the trial state.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Residual<Number> first_residual(const Trial<Number> &trial,
                                                                 const Number &log_ratio) const
    {
      const Number zero = simd::broadcast<Number>(0.), eta = simd::max<Number>(trial.stress_ratio, zero);
      const Number rise = trial.log_pressure - trial.log_image, flow = dilatancy(eta) * (1. / elastic.kappa);
      const Number limit = limit_at<Number>(trial.volume, trial.log_pressure - log_ratio);

      Residual<Number> r;
      r.multiplier = zero;
      r.scale      = 1. + trial.eta;
      r.first      = trial.eta - eta;
      r.first_x    = -1. * (3. * parameters.shear_modulus / trial.pressure + trial.eta * flow);
      r.first_r    = -1. * slope<Number>(eta);
      r.second     = rise - log_ratio;
      r.second_x   = parameters.hardening_coefficient * (1. - simd::exp<Number>(rise + limit)) + flow;
      r.second_r   = simd::broadcast<Number>(-1.);
      return r;
    }

    /// The return of the points `todo`; says which of them converged.
    template <typename Number>
    __attribute__((noinline)) simd::Mask<Number>
    solve(const Trial<Number> &trial, const simd::Mask<Number> &todo, Returned<Number> &returned) const
    {
      constexpr double tolerance = 1e-7, part_of_the_way = 0.9; // before the last step, which squares the residual
      Number multiplier = simd::broadcast<Number>(0.);
      Number log_ratio =
          simd::min<Number>(trial.log_pressure - trial.log_image, simd::broadcast<Number>(largest_log_ratio));
      const auto converged =
          newton<Number>([&](const Number &x, const Number &r) { return residual(trial, x, r); },
                         [&](const Number &step, const Number &x) {
                           return part_of_the_way * simd::select<Number>(step > 0., trial.shear_strain - x, x);
                         },
                         largest_log_ratio,
                         tolerance,
                         first_residual(trial, log_ratio),
                         todo,
                         multiplier,
                         log_ratio);
      // P from the flow rule, q from the yield surface: q_tr - 3 G gamma loses digits where gamma is large.
      const Number eta      = stress_ratio<Number>(log_ratio);
      returned.log_ratio    = log_ratio;
      returned.log_pressure = trial.log_pressure + multiplier * dilatancy(eta) * (1. / elastic.kappa);
      returned.eta          = eta;
      return converged;
    }

    /// What solve() has left.
    Returned<double> search(const Trial<double> &trial, LawResponse<double> &response) const;
    double ratio_on_yield(const Trial<double> &trial, const double log_deviator, const double multiplier) const;
    double image_residual(const Trial<double> &trial, const double multiplier, const double log_ratio) const;

    /// ln Pi of the yield surface through a stress.
    double image_through(const StrainInvariants<double> &, const double log_pressure, const double eta) const;

    const NorSandParameters parameters;
    const double exponent, inverse_exponent; // N/(1-N) and (1-N)/N
    const double dilatancy_factor;           // 1/(1-Nbar)
    const double largest_log_ratio;          // r at q = 0
    const double limit_factor;               // Abar N/M
  };


  /// Nor-Sand as practice has it (@source{jefferiesbeen2015}) on PressureElasticity.
  ///
  /// With e = v - 1 the void ratio, chi = chi_tc/(1 - lambda chi_tc/M_tc), theta the Lode angle:
  ///   M(theta) = M_tc - M_tc^2/(3 + M_tc) cos(3 theta/2 + pi/4),    M_i = M(theta) (1 - N chi |psi|/M_tc),
  ///   yield eta = q/p = M_i (1 - r),    flow d e_v^p = M_i r d e_s^p,    L = -chi psi/M_i,tc,
  ///   d ln p_i = H M(theta)/M_tc e^{2r} (e^L - e^{-r}) d e_s^p,    H = H_0 - H_psi psi of the start of a step.
  /// The cap p_i <= p e^L holds after elastic and after plastic steps: where the hardening law lags behind,
  /// p_i = p e^L replaces it. The unknown beside r is ln p.
  class JefferiesBeen : public SandLaw<JefferiesBeen, PressureElasticity>
  {
  public:
    static constexpr double volume_zero = 1; ///< what the measure of volume is less than v

    /// Computes the constants of the equations from the entries.
    explicit JefferiesBeen(const JefferiesBeenParameters &parameters);

    /// What the image pressure makes of the specific volume, and derivatives in ln p_i.
    template <typename Number>
    struct Image
    {
      Number state;  ///< psi
      Number ratio;  ///< M_i
      Number ratio_; ///< derivative of M_i
      Number limit;  ///< L
      Number limit_; ///< derivative of L
    };

    /// See Image.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Image<Number>
    image(const Number &volume, const Number &log_image, const Number &lode_ratio) const
    {
      constexpr double rounding   = 1e-3; // of |psi|
      constexpr double least_part = 0.2;  // of M that is left to M_i
      // Without the first bound no stress ratio would be left to very loose sand at the cap, where r = -L.
      constexpr double least_limit = -0.9, largest_limit = 3;
      const double M = parameters.critical_stress_ratio, coupling = parameters.volumetric_coupling * chi / M;

      Image<Number> image;
      image.state       = line.state(volume, log_image);
      const Number size = simd::sqrt<Number>(image.state * image.state + rounding * rounding);
      const Number part = 1. - coupling * (size - rounding), zero = simd::broadcast<Number>(0.);
      const Number used  = simd::max<Number>(part, simd::broadcast<Number>(least_part));
      const Number part_ = simd::select<Number>(part > least_part, (-coupling * line.slope) * image.state / size, zero);
      image.ratio        = lode_ratio * used;
      image.ratio_       = lode_ratio * part_;

      const Number inverse = 1. / used, limit = (-chi / M) * image.state * inverse;
      image.limit = simd::min<Number>(simd::max<Number>(limit, simd::broadcast<Number>(least_limit)),
                                      simd::broadcast<Number>(largest_limit));
      image.limit_ =
          simd::select<Number>(limit == image.limit, ((-chi / M * line.slope) - limit * part_) * inverse, zero);
      return image;
    }

    /// M(theta) of a deviator of strain; that of compression without one.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Number lode_ratio(const StrainInvariants<Number> &strain) const
    {
      // With x = sin(3 theta), 1 in triaxial compression, cos(3 theta/2 + pi/4) = sqrt((1 - x)/2). There the root would
      // make 1e-8 of rounding.
      constexpr double rounding = 1e-12;
      const double M            = parameters.critical_stress_ratio;
      const Number inverse = 1. / simd::sqrt<Number>(strain.square + 1e-60), zero = simd::broadcast<Number>(0.);
      const Number x    = -7.3484692283495345 * (strain.third * inverse) * inverse * inverse;
      const Number half = simd::max<Number>(0.5 - rounding - 0.5 * x, zero);
      return M - M * M / (3. + M) * simd::sqrt<Number>(simd::select<Number>(strain.square > 1e-30, half, zero));
    }

    /// Where a return starts.
    template <typename Number>
    struct Trial : SandLaw::Trial<Number>
    {
      Number X;          ///< see PressureElasticity
      Number lode_ratio; ///< M(theta)
      Number hardening;  ///< H M(theta)/M_tc
    };

    /// See Trial.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline Trial<Number>
    trial(const StrainInvariants<Number> &strain, const Number &volume_ratio, const Number *internal_variables) const
    {
      constexpr double least_hardening = 10; // H of very loose sand

      Trial<Number> trial;
      set_trial(strain, volume_ratio, internal_variables, trial);
      trial.lode_ratio   = lode_ratio(strain);
      const Number least = simd::broadcast<Number>(1e-12), X = elastic.opening(trial.volume_strain);
      trial.X             = simd::max<Number>(X, least);
      trial.eta           = 3. * elastic.g * trial.shear_strain / trial.X;
      trial.log_pressure  = elastic.log_pressure(trial.X, trial.eta);
      trial.pressure      = simd::exp<Number>(trial.log_pressure);
      trial.stress_factor = 2. * elastic.g * trial.pressure / trial.X;
      trial.is_apart      = !((X > least) & (trial.log_pressure >= log_minimum_pressure));

      // The cap first where the state is elastic: on a plastic trial state it would depend on the size of the step.
      Image<Number> now         = image(trial.volume, trial.log_image, trial.lode_ratio);
      const auto is_outside     = [&]() { return trial.eta > now.ratio * (1. - trial.log_pressure + trial.log_image); };
      simd::Mask<Number> yields = is_outside();
      trial.is_capped           = (!(trial.is_apart | yields)) & (trial.log_image > trial.log_pressure + now.limit);
      if (simd::any(trial.is_capped))
        {
          for (unsigned int pass = 0; pass < 2; ++pass) // L is at p_i
            {
              const Number cap = simd::min<Number>(trial.log_image, trial.log_pressure + now.limit);
              trial.log_image  = simd::select<Number>(trial.is_capped, cap, trial.log_image);
              now              = image(trial.volume, trial.log_image, trial.lode_ratio);
            }
          yields = is_outside();
        }
      trial.is_plastic = yields & !trial.is_apart;
      trial.hardening  = simd::max<Number>(parameters.hardening_modulus - parameters.hardening_slope * now.state,
                                          simd::broadcast<Number>(least_hardening)) *
                        trial.lode_ratio * (1. / parameters.critical_stress_ratio);
      return trial;
    }

    /// The equations that a return solves.
    enum class Hardening
    {
      law, ///< hardening law
      cap  ///< p_i = p e^L in its place
    };

    /// Residuals of flow rule and hardening in (ln p, r) with the trial state's X and e_s.
    template <Hardening hardening, typename Number>
    DEAL_II_ALWAYS_INLINE inline Residual<Number> residual(const Trial<Number> &trial,
                                                           const Number &X,
                                                           const Number &shear_strain,
                                                           const Number &log_pressure,
                                                           const Number &r) const
    {
      const Number log_image = log_pressure - r;
      const Image<Number> i  = image(trial.volume, log_image, trial.lode_ratio);
      const double n = elastic.n, to_shear = 1. / (3. * elastic.g);

      // Of the yield surface: eta, elastic X and e_s, with derivatives in ln p and r.
      const Number rest = 1. - r, eta = i.ratio * rest, eta_p = i.ratio_ * rest, eta_r = -1. * eta_p - i.ratio;
      const Number square = 1. + elastic.a * eta * eta;
      const Number Y      = elastic.opening_at(log_pressure, eta);
      const Number Y_eta  = (-n * elastic.a) * eta / square; // d ln Y/d eta
      const Number Y_p = Y * ((1. - n) + Y_eta * eta_p), Y_r = Y * (Y_eta * eta_r);
      const Number e_s = to_shear * (eta * Y), e_s_p = to_shear * (eta_p * Y + eta * Y_p),
                   e_s_r = to_shear * (eta_r * Y + eta * Y_r);
      const Number gamma = shear_strain - e_s, D = i.ratio * r, D_p = i.ratio_ * r, D_r = i.ratio - D_p;

      // X - k_n gamma D = Y, over Y
      Residual<Number> result;
      const Number inverse = 1. / Y, part = (X - elastic.k_n * (gamma * D)) * inverse;
      result.scale      = simd::broadcast<Number>(1.);
      result.multiplier = gamma;
      result.first      = part - 1.;
      result.first_x    = inverse * (elastic.k_n * (e_s_p * D - gamma * D_p) - part * Y_p);
      result.first_r    = inverse * (elastic.k_n * (e_s_r * D - gamma * D_r) - part * Y_r);
      if constexpr (hardening == Hardening::cap)
        {
          result.second   = r + i.limit;
          result.second_x = i.limit_;
          result.second_r = 1. - i.limit_;
        }
      else
        {
          const Number B = simd::exp<Number>(r), A = B * B * simd::exp<Number>(i.limit), f = A - B;
          const Number f_p = A * i.limit_, f_r = A * (2. - i.limit_) - B, h = trial.hardening;
          result.second   = log_image - trial.log_image - h * f * gamma;
          result.second_x = 1. - h * (f_p * gamma - f * e_s_p);
          result.second_r = -1. - h * (f_r * gamma - f * e_s_r);
        }
      return result;
    }

  private:
    friend SandLaw<JefferiesBeen, PressureElasticity>;

    /// L in triaxial compression.
    template <typename Number>
    Number limit_at(const Number &volume, const Number &log_image) const
    {
      return image(volume, log_image, simd::broadcast<Number>(parameters.critical_stress_ratio)).limit;
    }

    /// Newton's method in ln p and r from `root`, with another X and e_s than those of the trial state.
    template <Hardening hardening, typename Number>
    __attribute__((noinline)) simd::Mask<Number> newton_to(const Trial<Number> &trial,
                                                           const Number &X,
                                                           const Number &shear_strain,
                                                           const simd::Mask<Number> &todo,
                                                           Returned<Number> &root) const
    {
      constexpr double tolerance = 1e-8, largest_change = 1, largest_log_pressure = 60;
      const auto at = [&](const Number &log_pressure, const Number &log_ratio) {
        return residual<hardening, Number>(trial, X, shear_strain, log_pressure, log_ratio);
      };
      const auto room      = [](const Number &, const Number &) { return simd::broadcast<Number>(largest_change); };
      const auto converged = newton<Number>(
          at, room, 1., tolerance, at(root.log_pressure, root.log_ratio), todo, root.log_pressure, root.log_ratio);
      return converged & (simd::abs<Number>(root.log_pressure) < largest_log_pressure) & (root.log_ratio <= 1.);
    }

    /// Whether a root is beyond the cap.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline simd::Mask<Number> is_beyond_cap(const Trial<Number> &trial,
                                                                  const Returned<Number> &root) const
    {
      const Image<Number> i = image<Number>(trial.volume, root.log_pressure - root.log_ratio, trial.lode_ratio);
      return root.log_ratio + i.limit < -1e-12;
    }

    /// A root with its eta.
    template <typename Number>
    Returned<Number> with_ratio(const Trial<Number> &trial, Returned<Number> root) const
    {
      const Image<Number> i = image<Number>(trial.volume, root.log_pressure - root.log_ratio, trial.lode_ratio);
      root.eta              = i.ratio * simd::max<Number>(1. - root.log_ratio, simd::broadcast<Number>(0.));
      return root;
    }

    /// The return of the points `todo`; says which of them converged.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline simd::Mask<Number>
    solve(const Trial<Number> &trial, const simd::Mask<Number> &todo, Returned<Number> &returned) const
    {
      constexpr double largest_first_ratio = 0.9; // towards the vertex
      Returned<Number> root{ trial.log_pressure,
                             simd::min<Number>(trial.log_pressure - trial.log_image,
                                               simd::broadcast<Number>(largest_first_ratio)),
                             {} };
      simd::Mask<Number> converged    = newton_to<Hardening::law>(trial, trial.X, trial.shear_strain, todo, root);
      const simd::Mask<Number> to_cap = converged & is_beyond_cap(trial, root);
      if (simd::any(to_cap))
        converged = converged & (newton_to<Hardening::cap>(trial, trial.X, trial.shear_strain, to_cap, root) | !to_cap);
      returned = with_ratio(trial, root);
      return converged;
    }

    /// What solve() has left.
    Returned<double> search(const Trial<double> &trial, LawResponse<double> &response) const;

    /// The root where q = 0, if there is one.
    bool find_vertex(const Trial<double> &trial, Returned<double> &root) const;

    /// Of trial states on the way from the yield surface.
    bool continue_to(const Trial<double> &trial, Returned<double> &root) const;

    /// The root on the cap, in ln p_i along it.
    Returned<double> on_cap(const Trial<double> &trial) const;

    /// ln p_i of the yield surface through a stress.
    double image_through(const StrainInvariants<double> &strain, const double log_pressure, const double eta) const;

    const JefferiesBeenParameters parameters;
    const double chi;
  };
} // namespace scree

#endif
