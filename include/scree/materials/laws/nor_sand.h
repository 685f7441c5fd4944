// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_nor_sand_h
#define scree_materials_laws_nor_sand_h

#include <scree/materials/law.h>
#include <scree/materials/law_entries.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace scree
{
  /// Entries of subsection "Nor-Sand". Defaults: @source{xie2024}, Table 1, dense.
  struct NorSandParameters
  {
    double shear_modulus                  = 4e6;    ///< G, Pa
    double swelling_index                 = 0.002;  ///< kappa, elastic compressibility in ln P
    double compression_index              = 0.012;  ///< lambda, slope of the critical state line in ln P
    double critical_state_specific_volume = 1.88;   ///< v_c0, on that line at the reference pressure
    double reference_pressure             = 1;      ///< p_ref, Pa
    double critical_stress_ratio          = 0.7097; ///< M, q/P at critical state
    double yield_constant                 = 0.3;    ///< N, curvature of the yield surface; 0: Cam-Clay
    double potential_constant             = 0.3;    ///< Nbar, curvature of the plastic potential, at most N
    double hardening_coefficient          = 300;    ///< h, hardening coefficient
    double dilatancy_multiplier           = -4.5;   ///< alpha, largest dilatancy over state parameter; negative
    double initial_specific_volume        = 1.629;  ///< v_0, 1 + void ratio at the start
    double initial_overconsolidation      = 1;      ///< the yield surface passes through the initial stress times this
    double minimum_pressure               = 1;      ///< Pa; no stress below it
    double substep_strain                 = 1e-3;   ///< largest component of dF - I in one return map

    /// Sine of the friction angle at critical state in triaxial compression.
    double sine() const;

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;

    /// See LawEntries.
    LawEntry modulus() const;

    /// See LawEntries.
    LawEntry stiffest() const;

    /// See LawEntries. Divides M, from whichever entry; dilatancy is as before, so that the peak falls with M.
    void divide_strength(const double factor);
  };


  /// Nor-Sand, critical state plasticity of sand in finite strain (@source{borja2006}; @source{andrade2006}).
  ///
  /// With P the mean compressive Kirchhoff stress, q = sqrt(3/2)|dev tau|, Pi the image pressure, r = ln(P/Pi):
  /// elastic P = P_0 exp(-eps_v/kappa), q = 3 G eps_s, energy kappa P + 3/2 G eps_s^2; P_0 = 1 kPa only fixes the zero
  /// of eps_v. Yield zeta q = P eta(r), eta = (M/N)(1 - (1-N) exp(r N/(1-N))), for N = 0 eta = M (1 - r); zeta = 1.
  /// Flow d eps_s^p = gamma, d eps_v^p = gamma D, D = (eta - M)/((1 - Nbar) zeta). Hardening d Pi = h (Pi* - Pi) gamma
  /// towards Pi* = P x^{-(1-N)/N}, x = max(1 - Abar psi N/M, 0.15), Abar = alpha (1-Nbar)/(1-N),
  /// psi = v - v_c0 + lambda ln(Pi/p_ref), v = v_0 J. Backward Euler; psi is taken at the returned Pi, v at the end of
  /// the step.
  ///
  /// At the vertex q = 0 the multiplier gamma exceeds the plastic shear strain; D and the hardening go with gamma, so
  /// isotropic compression hardens.
  ///
  /// No tension: a point whose trial or returned P is below the minimum pressure has no stress. Its b_e becomes
  /// isotropic and keeps eps_v: the gap, to be closed before stress returns; grains apart do not dilate. Pi becomes
  /// Pi* of the minimum pressure.
  class NorSand
  {
  public:
    static constexpr unsigned int n_internal_variables = 2;     ///< image pressure Pi, Pa, and plastic shear strain
    static constexpr bool is_elastic                   = false; ///< the law has plastic strain

    /// Computes the constants of the equations from the entries.
    explicit NorSand(const NorSandParameters &parameters);

    /// Largest strain of one return map.
    double substep_strain() const;

    /// Pa.
    double shear_modulus() const;

    /// Tangent at a mean compressive Kirchhoff stress, Pa.
    double bulk_modulus(const double pressure) const;

    /// Invariants of the trial state.
    template <typename Number>
    struct Trial
    {
      Number pressure,     ///< P, Pa
          log_pressure;    ///< ln P
      Number deviator;     ///< q, Pa
      Number stress_ratio; ///< eta
      Number image,        ///< Pi at the start, Pa
          log_image;       ///< ln Pi
      Number volume;       ///< v
    };

    /// See law.h.
    template <typename Number>
    Trial<Number> trial(const Number &volume_strain,
                        const Number &deviator_square,
                        const Number &volume_ratio,
                        const Number *internal_variables) const;

    /// Whether the trial state is within the yield surface and P is at least the minimum pressure.
    template <typename Number>
    simd::Mask<Number> is_admissible(const Trial<Number> &trial) const;

    /// Mean Kirchhoff stress -P, Pa, tension positive.
    template <typename Number>
    Number mean_stress(const Trial<Number> &trial) const;

    /// Tangent P/kappa at a mean Kirchhoff stress, Pa.
    template <typename Number>
    Number bulk_modulus_at(const Number &mean_stress) const;

    /// Returns the points `todo`: sets `result` and internal variables. The mask has the points for which it converged.
    template <typename Number>
    simd::Mask<Number> return_to_surface(const Trial<Number> &trial,
                                         const simd::Mask<Number> &todo,
                                         Number *internal_variables,
                                         InvariantReturn<Number> &result) const;

    /// J per m^3 of reference volume.
    double energy(const PrincipalValues &strain) const;

    /// 1 - 1/v_0.
    double initial_porosity() const;

    /// tau/sigma on a plane of shear at critical state, M/sqrt(3).
    double plane_friction() const;

    /// Mean compression, Pa.
    double friction_pressure(const PrincipalValues &stress) const;

    /// Elastic principal stress, Pa.
    PrincipalValues stress_of(const PrincipalValues &strain) const;

    /// Mean Kirchhoff stress of an elastic volume strain, Pa, tension positive.
    template <typename Number>
    Number mean_stress_of(const Number &volume_strain) const;

    /// From trial to returned `strain` and internal variables, at J = `volume_ratio`; sets `stress`, counts in
    /// `report`.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// See Material::initialise(). The yield surface passes through the stress, times the overconsolidation ratio.
    /// Throws for tension and for q/P >= M/N. A stress below the minimum pressure becomes no stress and no gap.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Image pressure, Pa, and plastic shear strain, -.
    static std::vector<Quantity> internal_quantities();

    /// Specific volume v and state parameter psi, -.
    static std::vector<Quantity> output_quantities();

    /// Writes v and psi at J = `volume_ratio`; psi at the minimum pressure where P is less.
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

    /// (zeta q - P eta)/P of a state, for tests; negative inside.
    double yield(const PrincipalValues &strain, const double image_pressure) const;

  private:
    /// zeta. The data show no dependence on the Lode angle; Gudehus-Argyris or Willam-Warnke would enter here.
    static constexpr double lode_factor = 1;

    /// Invariants after the return.
    template <typename Number>
    struct Returned
    {
      Number log_pressure; // ln P
      Number pressure;     // P, Pa
      Number log_ratio;    // r
      Number deviator;     // q, Pa
    };

    /// Residuals of (gamma, r) and their derivatives.
    template <typename Number>
    struct Residual
    {
      Number deviator_ratio; // q_tr/P
      Number yield, yield_gamma, yield_ratio;
      Number image, image_gamma, image_ratio;
    };

    /// A step of Newton's method, and the part of it that keeps gamma and r within their bounds.
    template <typename Number>
    struct NewtonStep
    {
      Number multiplier, log_ratio, part;
    };

    template <typename Number>
    Number log_pressure_of(const Number &volume_strain) const;
    template <typename Number>
    Number stress_ratio(const Number &log_ratio) const;
    template <typename Number>
    Number dilatancy(const Number &stress_ratio) const;

    /// ln(Pi*/P) and its derivative in ln Pi.
    template <typename Number>
    Number log_limit(const Number &log_image, const Number &volume, Number &derivative) const;

    template <typename Number>
    Residual<Number> residual(const Trial<Number> &trial, const Number &multiplier, const Number &log_ratio) const;

    /// The same at gamma = 0, cheap.
    template <typename Number>
    Residual<Number> first_residual(const Trial<Number> &trial, const Number &log_ratio) const;

    template <typename Number>
    NewtonStep<Number> newton_step(const Residual<Number> &residual,
                                   const Number &multiplier,
                                   const Number &log_ratio,
                                   const Number &largest_multiplier) const;

    /// Where the residual falls along a step, which is halved where it does not: the first such place in `part`. Lanes
    /// that find none leave `todo`.
    template <typename Number>
    Residual<Number> residual_after(NewtonStep<Number> &step,
                                    const Trial<Number> &trial,
                                    const Number &multiplier,
                                    const Number &log_ratio,
                                    const Residual<Number> &now,
                                    simd::Mask<Number> &todo) const;

    /// The return of the lanes `todo`; says which of them converged.
    template <typename Number>
    simd::Mask<Number> newton(const Trial<Number> &trial, simd::Mask<Number> todo, Returned<Number> &returned) const;

    /// Where both residuals vanish, or the state of grains that are apart.
    template <typename Number>
    InvariantReturn<Number>
    finish(const Trial<Number> &trial, const Returned<Number> &returned, Number *internal_variables) const;

    Response plastic_return(const Trial<double> &trial,
                            PrincipalValues &strain,
                            double *internal_variables,
                            PrincipalValues &stress,
                            UpdateReport &report) const;
    Returned<double> search(const Trial<double> &trial, UpdateReport &report) const;
    Returned<double> search_vertex(const Trial<double> &trial, UpdateReport &report) const;
    double ratio_on_yield(const Trial<double> &trial, const double log_deviator, const double multiplier) const;
    double image_residual(const Trial<double> &trial, const double multiplier, const double log_ratio) const;

    /// Pi of grains that are apart, Pa.
    template <typename Number>
    Number image_of_separated(const Number &volume) const;

    const NorSandParameters parameters;
    const double inverse_swelling_index;
    const double log_minimum_pressure;
    const double log_reference_pressure;
    const double exponent, inverse_exponent; // N/(1-N) and (1-N)/N
    const double dilatancy_factor;           // 1/((1-Nbar) zeta)
    const double largest_log_ratio;          // r at q = 0
    const double limit_factor;               // Abar N/M
  };


  inline double NorSand::substep_strain() const
  {
    return parameters.substep_strain;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::log_pressure_of(const Number &volume_strain) const
  {
    constexpr double log_zero_strain_pressure = 6.907755278982137; // ln(1 kPa/1 Pa)
    return log_zero_strain_pressure - volume_strain * inverse_swelling_index;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::stress_ratio(const Number &log_ratio) const
  {
    const double N = parameters.yield_constant, M = parameters.critical_stress_ratio;
    if (N > 0)
      return M / N * (1. - (1. - N) * simd::exp<Number>(exponent * log_ratio));
    return M * (1. - log_ratio);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::dilatancy(const Number &stress_ratio) const
  {
    return (stress_ratio - parameters.critical_stress_ratio) * dilatancy_factor;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline NorSand::Trial<Number> NorSand::trial(const Number &volume_strain,
                                                                     const Number &deviator_square,
                                                                     const Number &volume_ratio,
                                                                     const Number *internal_variables) const
  {
    Trial<Number> trial;
    trial.deviator     = 3 * parameters.shear_modulus * simd::sqrt<Number>(2. / 3. * deviator_square);
    trial.log_pressure = log_pressure_of(volume_strain);
    trial.pressure     = simd::exp<Number>(trial.log_pressure);
    trial.image        = internal_variables[0];
    trial.log_image    = simd::log<Number>(trial.image);
    trial.stress_ratio = stress_ratio<Number>(trial.log_pressure - trial.log_image);
    trial.volume       = parameters.initial_specific_volume * volume_ratio;
    return trial;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline simd::Mask<Number> NorSand::is_admissible(const Trial<Number> &trial) const
  {
    return (trial.log_pressure >= log_minimum_pressure) &
           (lode_factor * trial.deviator <= trial.pressure * trial.stress_ratio);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::mean_stress(const Trial<Number> &trial) const
  {
    return -trial.pressure;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::mean_stress_of(const Number &volume_strain) const
  {
    return -1. * simd::exp<Number>(log_pressure_of(volume_strain));
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number NorSand::bulk_modulus_at(const Number &mean_stress) const
  {
    return -mean_stress * inverse_swelling_index;
  }


  inline Response NorSand::return_map(PrincipalValues &strain,
                                      double *internal_variables,
                                      const double volume_ratio,
                                      PrincipalValues &stress,
                                      UpdateReport &report) const
  {
    const double volume_strain = strain[0] + strain[1] + strain[2];
    const double mean          = volume_strain / 3;
    double deviator_square     = 0;
    for (unsigned int i = 0; i < 3; ++i)
      deviator_square += (strain[i] - mean) * (strain[i] - mean);

    const Trial<double> state = trial(volume_strain, deviator_square, volume_ratio, internal_variables);
    if (!is_admissible(state))
      return plastic_return(state, strain, internal_variables, stress, report);

    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = -state.pressure + 2 * parameters.shear_modulus * (strain[i] - mean);
    report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, bulk_modulus_at(-state.pressure));
    return Response::elastic;
  }
} // namespace scree

#endif
