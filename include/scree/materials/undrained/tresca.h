// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_undrained_tresca_h
#define scree_materials_undrained_tresca_h

#include <scree/materials/laws/mohr_coulomb_return.h>
#include <scree/materials/laws/point_strength_return.h>
#include <scree/materials/rate_of_strength.h>

namespace scree
{
  /// Entries of subsection "Tresca".
  struct TrescaParameters
  {
    double young_modulus       = 1e7;                  ///< E, Pa
    double poisson_ratio       = 0.45;                 ///< nu, -
    std::string strength       = "10e3";               ///< s_u of a place at the start, Pa
    double strength_gradient   = 0;                    ///< Pa/m below the surface
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

    /// sin(phi) of a law without friction: 0, so that K0 is 1 where the user gives none.
    double sine() const
    {
      return 0;
    }

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;

    /// See LawEntries.
    LawEntry modulus() const;

    /// See LawEntries. Divides the strength of the law, not that which points have from their place, and the cut-off.
    void divide_strength(const double factor);
  };


  /// Entries of subsection "Herschel-Bulkley".
  struct HerschelBulkleyParameters
  {
    double young_modulus   = 1e6;  ///< E, Pa
    double poisson_ratio   = 0.45; ///< nu, -
    double yield_stress    = 1e3;  ///< tau_y, Pa
    double consistency     = 100;  ///< K, Pa s^n
    double index           = 1;    ///< n, -
    double tension_cut_off = 0;    ///< largest principal stress, Pa
    double reduction       = 1;    ///< as of TrescaParameters

    /// The same as entries of Tresca.
    TrescaParameters tresca() const;

    /// See TrescaParameters.
    double sine() const
    {
      return 0;
    }

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;

    /// See LawEntries.
    LawEntry modulus() const;

    /// See TrescaParameters.
    void divide_strength(const double factor);
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

    /// Mud.
    explicit Tresca(const HerschelBulkleyParameters &parameters)
        : Tresca(parameters.tresca())
    {
    }

    /// From trial to returned `strain` and internal variables; sets `stress`, counts in `report`.
    Response return_map(const double time_step,
                        PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// The same of a point or of a Batch of them; see law.h.
    template <typename Number>
    PrincipalResponse<Number> respond(const double time_step,
                                      PrincipalNumbers<Number> &strain,
                                      Number *internal_variables,
                                      PrincipalNumbers<Number> &stress) const;

    /// See Material::initialise(). Throws if the stress is beyond the strength.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Plastic strains, -, and s_u.
    static std::vector<Quantity> internal_quantities();

    /// kappa and the one that sets the strength.
    NonlocalVariable nonlocal_variable() const;

    /// s_u, at most what does not fall faster than elastic stress.
    PlaceVariable place_variable() const;

    /// Shear strength of a point that shears slowly, Pa.
    template <typename Number>
    Number slow_strength(const Number *internal_variables) const;

    const RateOfStrength rate_of_strength; ///< what the rate of shear adds

  private:
    static constexpr unsigned int plastic_shear = 0, own_kappa = 1, acting_kappa = 2, of_place = 3; // variables

    template <typename Number>
    void plastic_return(const double time_step,
                        PrincipalNumbers<Number> &strain,
                        Number *internal_variables,
                        PrincipalNumbers<Number> &stress,
                        const Number &shear_stress,
                        const Number &slow,
                        PrincipalResponse<Number> &response) const;

    const PlaceVariable variable;
    const double scale;           // of the strength, 1 unless reduced
    const double nonlocal_length; // m
    const double residual;        // 1/S_t
    const double decay;           // 3/kappa_95; 0: strength does not fall
  };


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number Tresca::slow_strength(const Number *internal_variables) const
  {
    const Number peak = scale * internal_variables[of_place];
    if (decay == 0)
      return peak;
    const Number kappa = simd::max<Number>(internal_variables[acting_kappa], simd::broadcast<Number>(0.));
    return peak * (residual + (1. - residual) * simd::exp<Number>(-decay * kappa));
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalResponse<Number> Tresca::respond(const double time_step,
                                                                         PrincipalNumbers<Number> &strain,
                                                                         Number *internal_variables,
                                                                         PrincipalNumbers<Number> &stress) const
  {
    stress                    = stress_of<Number>(strain);
    const Number slow         = slow_strength<Number>(internal_variables);
    const Number largest      = simd::max<Number>(stress[0], simd::max<Number>(stress[1], stress[2]));
    const Number smallest     = simd::min<Number>(stress[0], simd::min<Number>(stress[1], stress[2]));
    const Number shear_stress = 0.5 * (largest - smallest);

    PrincipalResponse<Number> response{};
    response.is_plastic = (shear_stress > slow) | (largest > largest_principal_stress);
    if (simd::any(response.is_plastic))
      plastic_return(time_step, strain, internal_variables, stress, shear_stress, slow, response);
    return response;
  }


  template <typename Number>
  __attribute__((noinline)) void Tresca::plastic_return(const double time_step,
                                                        PrincipalNumbers<Number> &strain,
                                                        Number *internal_variables,
                                                        PrincipalNumbers<Number> &stress,
                                                        const Number &shear_stress,
                                                        const Number &slow,
                                                        PrincipalResponse<Number> &response) const
  {
    const Number zero = simd::broadcast<Number>(0.);
    Number strength   = slow;
    if (rate_of_strength.is_active(time_step))
      {
        const Number excess = shear_stress - slow;
        strength += simd::select<Number>(
            excess > 0., rate_of_strength.template overstress<Number>(excess, slow, shear, time_step), zero);
      }
    const PointStrengthReturn<Number> surfaces({ zero, zero, 2. * strength }, largest_principal_stress, bulk, shear);
    const PrincipalNumbers<Number> deviator = MohrCoulomb::plastic_return(
        strain,
        stress,
        response,
        simd::Mask<Number>{}, // none is without strength
        [&](auto &sorted, auto &plastic, auto &todo) { surfaces.return_sorted(sorted, plastic, todo); });
    const Number increment = plane_shear_of<Number>(deviator);
    internal_variables[plastic_shear] += shear_strain_of<Number>(deviator);
    internal_variables[own_kappa] += increment;
    internal_variables[acting_kappa] += increment;
  }
} // namespace scree

#endif
