// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_jefferies_been_law_h
#define scree_materials_jefferies_been_law_h

#include <scree/materials/jefferies_been/critical_line.h>
#include <scree/materials/law.h>
#include <scree/materials/law_entries.h>
#include <scree/materials/jefferies_been/pressure_elasticity.h>

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// Entries of subsection "Nor-Sand (Jefferies-Been)". Defaults: Erksak sand, fitted to drained tests G667 and G682
  /// (@source{been1991}).
  struct JefferiesBeenParameters
  {
    double shear_modulus             = 80e6;  ///< G at the reference pressure, Pa
    double poisson_ratio             = 0.2;   ///< of the moduli at q = 0
    double modulus_exponent          = 0.5;   ///< n: moduli grow with (p/p_ref)^n
    double reference_pressure        = 100e3; ///< p_ref, Pa
    double critical_void_ratio       = 0.816; ///< Gamma, at 1 kPa
    double compression_index         = 0.015; ///< lambda, in ln p
    double critical_stress_ratio     = 1.188; ///< M_tc, q/p at critical state in triaxial compression
    double volumetric_coupling       = 0.05;  ///< N
    double state_dilatancy           = 4.3;   ///< chi_tc
    double hardening_modulus         = 77.7;  ///< H_0
    double hardening_slope           = 633;   ///< H_psi
    double initial_void_ratio        = 0.65;  ///< e_0
    double initial_overconsolidation = 1;     ///< image pressure over that of the yield surface through the stress
    double minimum_pressure          = 1;     ///< Pa; no stress below it
    double substep_strain            = 5e-4;  ///< largest component of dF - I in one return map

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;

    /// The critical line of the entries.
    CriticalLine line() const;

    /// See LawEntries: of triaxial compression at M.
    double sine() const;

    /// See LawEntries.
    LawEntry modulus() const;

    /// See LawEntries. Divides M; dilatancy and hardening are as before.
    void divide_strength(const double factor);

  private:
    void add_line(dealii::ParameterHandler &prm);
    void check_line(const std::string &subsection) const;
  };


  /// Nor-Sand as practice has it (@source{jefferiesbeen2015}) on PressureElasticity, in finite strain.
  ///
  /// With p the mean compressive Kirchhoff stress, q = sqrt(3/2)|dev tau|, p_i the image pressure, r = ln(p/p_i),
  /// e the void ratio, psi = e - e_c(p_i), chi = chi_tc/(1 - lambda chi_tc/M_tc), theta the Lode angle:
  ///   M(theta) = M_tc - M_tc^2/(3 + M_tc) cos(3 theta/2 + pi/4),    M_i = M(theta) (1 - N chi |psi|/M_tc),
  ///   yield eta = q/p = M_i (1 - r),    flow d e_v^p = M_i r d e_s^p,    L = -chi psi/M_i,tc,
  ///   d ln p_i = H M(theta)/M_tc e^{2r} (e^L - e^{-r}) d e_s^p,    H = H_0 - H_psi psi of the start of a step.
  /// The cap p_i <= p e^L holds after elastic and after plastic steps: where the hardening law lags behind,
  /// p_i = p e^L replaces it. Backward Euler in (ln p, r). Flow is along the deviator of the trial state, so that the
  /// Lode angle is its own.
  ///
  /// No tension: as NorSand, a point whose p is below the minimum pressure has no stress and keeps its gap.
  class JefferiesBeen
  {
  public:
    static constexpr unsigned int n_internal_variables = 2;     ///< image pressure, Pa, and plastic shear strain
    static constexpr bool is_elastic                   = false; ///< the law has plastic strain

    /// Computes the constants of the equations from the entries.
    explicit JefferiesBeen(const JefferiesBeenParameters &parameters);

    /// Largest strain of one return map.
    double substep_strain() const;

    /// At 1 kPa and q = 0, Pa. It is the constant part of the modulus of waves, see bulk_modulus().
    double shear_modulus() const;

    /// Such that it and 4/3 of shear_modulus() are the modulus of waves at the pressure, Pa.
    double bulk_modulus(const double pressure) const;

    /// J per m^3 of reference volume.
    double energy(const PrincipalValues &strain) const;

    /// e_0/(1 + e_0).
    double initial_porosity() const;

    /// tau/sigma on a plane of shear at critical state, with M of theta = 0.
    double plane_friction() const;

    /// Of a point or of a Batch of them, see law.h.
    template <typename Number>
    VolumeResponse<Number> respond(PrincipalNumbers<Number> &strain,
                                   const Number &volume_ratio,
                                   Number *internal_variables,
                                   PrincipalNumbers<Number> &stress) const;

    /// From trial to returned `strain` and internal variables, at J = `volume_ratio`; sets `stress`, counts in
    /// `report`. What respond() leaves is found by continuation or searched.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// See Material::initialise(). The yield surface passes through the stress, times the overconsolidation ratio, as
    /// far as the cap allows. Throws for tension and for stresses beyond the cap. A stress below the minimum pressure
    /// becomes no stress and no gap.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Image pressure, Pa, and plastic shear strain, -.
    static std::vector<Quantity> internal_quantities();

    /// Void ratio and state parameter psi, -.
    static std::vector<Quantity> output_quantities();

    /// Writes e and psi at J = `volume_ratio`; psi at the minimum pressure where p is less.
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

    /// (q/p - M_i (1 - r)) of a state, for tests; negative inside.
    double yield(const PrincipalValues &strain, const double *internal_variables, const double volume_ratio) const;

    /// ln(p_i/(p e^L)) of a state, for tests; positive beyond the cap.
    double beyond_cap(const PrincipalValues &strain, const double *internal_variables, const double volume_ratio) const;

    /// What the image pressure makes of the void ratio, and derivatives in ln p_i.
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
    Image<Number> image(const Number &void_ratio, const Number &log_image, const Number &lode_ratio) const;

    /// M(theta) of a deviator of strain and its square |s|^2; that of compression without one.
    template <typename Number>
    Number lode_ratio(const PrincipalNumbers<Number> &deviator, const Number &square) const;

    /// Where a return starts.
    template <typename Number>
    struct Trial
    {
      PrincipalNumbers<Number> deviator; ///< of strain
      Number volume_strain;              ///< e_v
      Number shear_strain;               ///< e_s
      Number X;                          ///< see PressureElasticity
      Number log_pressure;               ///< ln p
      Number eta;                        ///< q/p
      Number log_image;                  ///< ln p_i, after the cap of an elastic step
      Number void_ratio;                 ///< e
      Number lode_ratio;                 ///< M(theta)
      Number hardening;                  ///< H M(theta)/M_tc
      simd::Mask<Number> is_apart;       ///< no stress
      simd::Mask<Number> is_capped;      ///< the cap lowered p_i
      simd::Mask<Number> is_plastic;     ///< has to return
    };

    /// Unknowns of a return.
    template <typename Number>
    struct Root
    {
      Number log_pressure; ///< ln p
      Number log_ratio;    ///< r
    };

    /// The equations that a return solves.
    enum class Hardening
    {
      law, ///< hardening law
      cap  ///< p_i = p e^L in its place
    };

    /// Residuals of (ln p, r), and their derivatives.
    template <typename Number>
    struct Residual
    {
      Number volume;     ///< of the flow rule
      Number volume_p;   ///< its derivative in ln p
      Number volume_r;   ///< its derivative in r
      Number image;      ///< of the hardening
      Number image_p;    ///< its derivative in ln p
      Number image_r;    ///< its derivative in r
      Number multiplier; ///< d e_s^p
    };

    /// Of a root with the trial state's X and e_s; for tests of the derivatives.
    template <Hardening hardening, typename Number>
    Residual<Number>
    residual(const Trial<Number> &trial, const Number &X, const Number &shear_strain, const Root<Number> &root) const;

    /// See Trial.
    template <typename Number>
    Trial<Number>
    trial(const PrincipalNumbers<Number> &strain, const Number &volume_ratio, const Number *internal_variables) const;

    const PressureElasticity elastic; ///< stored energy

  private:
    /// Newton's method in full steps from `root`: the points of `todo` that converged.
    template <Hardening hardening, typename Number>
    simd::Mask<Number> newton(const Trial<Number> &trial, simd::Mask<Number> todo, Root<Number> &root) const;

    /// The same with halved steps, of a trial state with another X and e_s.
    template <Hardening hardening>
    bool
    careful_newton(const Trial<double> &trial, const double X, const double shear_strain, Root<double> &root) const;

    /// The root where q = 0, if there is one.
    bool find_vertex(const Trial<double> &trial, Root<double> &root) const;

    /// Of trial states on the way from the yield surface.
    bool continue_to(const Trial<double> &trial, Root<double> &root) const;

    /// Bisection in r along the flow rule.
    bool search(const Trial<double> &trial, Root<double> &root) const;

    /// Bisection in ln p_i along the cap.
    bool search_cap(const Trial<double> &trial, Root<double> &root) const;

    /// What newton() left.
    Root<double> find(const Trial<double> &trial, UpdateReport &report) const;

    /// Whether a root is beyond the cap.
    template <typename Number>
    simd::Mask<Number> is_beyond_cap(const Trial<Number> &trial, const Root<Number> &root) const;

    /// Sets strain, stress and internal variables of all points, returned ones or not.
    template <typename Number>
    VolumeResponse<Number> finish(const Trial<Number> &trial,
                                  const Root<Number> &root,
                                  PrincipalNumbers<Number> &strain,
                                  Number *internal_variables,
                                  PrincipalNumbers<Number> &stress) const;

    const JefferiesBeenParameters parameters;
    const CriticalLine line;
    const double chi, log_minimum_pressure, constant_shear_modulus;
  };
} // namespace scree

#endif
