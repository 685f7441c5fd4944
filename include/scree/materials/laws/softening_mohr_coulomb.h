// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_softening_mohr_coulomb_h
#define scree_materials_laws_softening_mohr_coulomb_h

#include <scree/materials/laws/mohr_coulomb_return.h>
#include <scree/materials/laws/point_strength_return.h>

namespace scree
{
  /// MohrCoulomb whose cohesion, tan(phi) and tan(psi) fall from peak to residual with the plastic shear strain of the
  /// plane of shear, kappa = sum of (d eps_1^p - d eps_3^p), which is gamma^p in simple shear:
  ///   value = residual + (peak - residual) exp(-kappa/softening strain).
  ///
  /// Strength is that of kappa before the step, so that a return is perfectly plastic: the error is of first order in
  /// the strain of a step. kappa does not grow while grains are apart. Where the law has a length, the strain that sets
  /// the strength is averaged over space between two steps, see NonlocalAverage.
  class SofteningMohrCoulomb : public MohrCoulomb
  {
  public:
    /// Plastic shear strain sqrt(2/3 e:e), kappa, and the kappa that sets the strength.
    static constexpr unsigned int n_internal_variables = 3;

    /// Strength between that of the parameters and of their residual().
    explicit SofteningMohrCoulomb(const MohrCoulombParameters &parameters);

    /// tau/sigma on a plane of shear after much strain; infinite with residual cohesion.
    double plane_friction() const;

    /// From trial to returned `strain` and internal variables; sets `stress`, counts in `report`.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// The same of a point or of a Batch of them; see law.h.
    template <typename Number>
    PrincipalResponse<Number>
    respond(PrincipalNumbers<Number> &strain, Number *internal_variables, PrincipalNumbers<Number> &stress) const;

    /// See Material::initialise(). Throws if the stress is outside the yield surface of the peak.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Plastic strains, -.
    static std::vector<Quantity> internal_quantities();

    /// kappa and the one that sets the strength.
    NonlocalVariable nonlocal_variable() const;

    /// The strength at this kappa.
    template <typename Number>
    PointStrength<Number> strength(const Number &kappa) const;

    /// Largest of all yield functions, Pa, at this strength; negative inside.
    template <typename Number>
    Number yield(const PrincipalNumbers<Number> &stress, const PointStrength<Number> &strength) const;

  private:
    /// A strength that falls with kappa.
    struct Falling
    {
      double residual, fall;

      template <typename Number>
      Number at(const Number &remaining) const
      {
        return residual + fall * remaining;
      }
    };

    static constexpr unsigned int plastic_shear = 0, own_kappa = 1, acting_kappa = 2; // internal variables

    template <typename Number>
    void plastic_return(PrincipalNumbers<Number> &strain,
                        Number *internal_variables,
                        PrincipalNumbers<Number> &stress,
                        const PointStrength<Number> &strength,
                        PrincipalResponse<Number> &response) const;

    const double softening_strain;
    const double nonlocal_length; // m
    const double residual_plane_friction;
    Falling tangent, dilation_tangent, cohesion; // tan(phi), tan(psi), c, Pa
    const double least_limit;                    // 2 c cos(phi) of grains without cohesion, Pa
  };


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PointStrength<Number> SofteningMohrCoulomb::strength(const Number &kappa) const
  {
    const Number positive  = simd::max<Number>(kappa, simd::broadcast<Number>(0.));
    const Number remaining = simd::exp<Number>(positive * (-1. / softening_strain));
    const Number tan_phi = tangent.at(remaining), tan_psi = dilation_tangent.at(remaining);
    const Number cos_phi = 1. / simd::sqrt<Number>(1. + tan_phi * tan_phi);
    const Number cos_psi = 1. / simd::sqrt<Number>(1. + tan_psi * tan_psi);
    return { tan_phi * cos_phi, tan_psi * cos_psi, 2. * cohesion.at(remaining) * cos_phi };
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number SofteningMohrCoulomb::yield(const PrincipalNumbers<Number> &stress,
                                                                  const PointStrength<Number> &strength) const
  {
    const Number largest  = simd::max<Number>(stress[0], simd::max<Number>(stress[1], stress[2]));
    const Number smallest = simd::min<Number>(stress[0], simd::min<Number>(stress[1], stress[2]));
    return simd::max<Number>((1. + strength.sine) * largest - (1. - strength.sine) * smallest - strength.limit,
                             largest - largest_principal_stress);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalResponse<Number>
  SofteningMohrCoulomb::respond(PrincipalNumbers<Number> &strain,
                                Number *internal_variables,
                                PrincipalNumbers<Number> &stress) const
  {
    stress                                   = stress_of<Number>(strain);
    const PointStrength<Number> of_last_step = strength<Number>(internal_variables[acting_kappa]);

    PrincipalResponse<Number> response{};
    response.is_plastic = yield<Number>(stress, of_last_step) > 0.;
    if (simd::any(response.is_plastic))
      plastic_return(strain, internal_variables, stress, of_last_step, response);
    return response;
  }


  template <typename Number>
  __attribute__((noinline)) void SofteningMohrCoulomb::plastic_return(PrincipalNumbers<Number> &strain,
                                                                      Number *internal_variables,
                                                                      PrincipalNumbers<Number> &stress,
                                                                      const PointStrength<Number> &strength,
                                                                      PrincipalResponse<Number> &response) const
  {
    const PointStrengthReturn<Number> surfaces(strength, largest_principal_stress, bulk, shear);
    const PrincipalNumbers<Number> deviator = MohrCoulomb::plastic_return(
        strain, stress, response, strength.limit <= least_limit, [&](auto &sorted, auto &plastic, auto &todo) {
          surfaces.return_sorted(sorted, plastic, todo);
        });
    const Number increment = plane_shear_of<Number>(deviator);
    internal_variables[plastic_shear] += shear_strain_of<Number>(deviator);
    internal_variables[own_kappa] += increment;
    internal_variables[acting_kappa] += increment;
  }
} // namespace scree

#endif
