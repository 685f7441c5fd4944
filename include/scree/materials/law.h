// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_law_h
#define scree_materials_law_h

#include <scree/materials/material.h>
#include <scree/tensor/principal.h>

namespace scree
{
  /// A step of points, beside their strain.
  template <typename Number>
  struct LawStep
  {
    Number volume_ratio; ///< J at the end of the step

    /// s; infinite: slow. A law that reads it has no sub-steps.
    double time_step     = std::numeric_limits<double>::infinity();
    double grain_density = 0; ///< kg/m^3

    /// Whether a law whose return costs much returns none and sets LawResponse::is_left instead.
    bool leaves_returns = false;
  };


  /// What a law makes of points.
  template <typename Number>
  struct LawResponse
  {
    simd::Mask<Number> is_plastic;    ///< Strain or internal variables were changed
    simd::Mask<Number> is_left;       ///< see LawStep::leaves_returns
    simd::Mask<Number> is_separated;  ///< As counted in UpdateReport, like the next three
    simd::Mask<Number> is_vertex;     ///< see UpdateReport::n_vertices
    simd::Mask<Number> is_searched;   ///< see UpdateReport::n_fallbacks
    simd::Mask<Number> is_unresolved; ///< see UpdateReport::n_unresolved
    Number bulk_modulus;              ///< With 4/3 of the law's shear modulus the modulus of waves, Pa
  };


  /// Invariants of logarithmic elastic strain, tension positive.
  template <typename Number>
  struct StrainInvariants
  {
    Number volume; ///< tr(eps)
    Number square; ///< |dev(eps)|^2
    Number third;  ///< det dev(eps)
  };


  /// Invariants of a principal strain, which becomes its deviator.
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline StrainInvariants<Number> take_invariants(PrincipalNumbers<Number> &strain)
  {
    const Number volume = strain[0] + strain[1] + strain[2];
    Number square       = simd::broadcast<Number>(0.);
    for (Number &value : strain)
      {
        value -= volume * (1. / 3.);
        square += value * value;
      }
    return { volume, square, strain[0] * strain[1] * strain[2] };
  }


  /// What a law in invariants makes of points: strain and stress along the deviator of the trial strain.
  template <typename Number>
  struct InvariantResponse : LawResponse<Number>
  {
    Number volume_strain;   ///< elastic; read where the point is plastic, as the next one
    Number deviator_factor; ///< elastic deviatoric strain over the trial one
    Number mean_stress;     ///< Kirchhoff, Pa, tension positive
    Number stress_factor;   ///< deviatoric Kirchhoff stress over the deviator of the trial strain, Pa
  };


  /// Base class of laws, with what a law may leave out. A law is a class with this base in a file of its own, together
  /// with its entries (LawEntries); HenckyMaterial makes a Material of it and inlines it. It also has
  ///   n_internal_variables                                              their number; a law without any is elastic
  ///   bulk_modulus(pressure)                                            Pa; tangent at a mean compressive stress
  ///   energy(strain)                                                    J per m^3 of reference volume
  ///   initialise(wanted stress, strain, stress, internal variables)     see Material::initialise()
  ///   respond(step, strain, internal variables, stress)                 from trial strain to strain and stress
  /// all in principal values of logarithmic elastic strain and of Kirchhoff stress (Pa), tension positive. energy() and
  /// respond() are templates of `Number`: a double, a Batch or a BatchPair of points.
  ///
  /// A law whose response depends on invariants alone, and whose stress has the axes and the ratios of the trial
  /// strain's deviator, has instead, with `in_invariants`,
  ///   energy(StrainInvariants)                                          J per m^3 of reference volume
  ///   respond(step, StrainInvariants, internal variables)               an InvariantResponse
  /// which saves the principal axes in three dimensions.
  class ConstitutiveLaw : public LawProperties
  {
  public:
    static constexpr bool in_invariants  = false; ///< see above
    static constexpr bool leaves_returns = false; ///< whether points that return are gathered, see LawStep

    /// Largest component of dF - I in one return map: backward Euler has several roots if it is larger.
    double substep_strain = std::numeric_limits<double>::infinity();

    /// See Material::output().
    void output(const PrincipalValues &, const double *, const double, double *) const
    {
    }
  };


  /// Stored energy of any law in principal values, J per m^3 of reference volume.
  template <typename Number, typename Law>
  DEAL_II_ALWAYS_INLINE inline Number energy_of(const Law &law, PrincipalNumbers<Number> strain)
  {
    if constexpr (Law::in_invariants)
      return law.energy(take_invariants<Number>(strain));
    else
      return law.energy(strain);
  }


  /// The response of any law in principal values: from trial to returned `strain` and internal variables, and `stress`.
  template <typename Number, typename Law>
  DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond(const Law &law,
                                                           const LawStep<Number> &step,
                                                           PrincipalNumbers<Number> &strain,
                                                           Number *internal_variables,
                                                           PrincipalNumbers<Number> &stress)
  {
    if constexpr (Law::in_invariants)
      {
        PrincipalNumbers<Number> deviator = strain;
        const InvariantResponse<Number> found =
            law.respond(step, take_invariants<Number>(deviator), internal_variables);
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Number returned = found.volume_strain * (1. / 3.) + found.deviator_factor * deviator[i];
            strain[i]             = simd::select<Number>(found.is_plastic, returned, strain[i]);
            stress[i]             = found.mean_stress + found.stress_factor * deviator[i];
          }
        return found;
      }
    else
      return law.respond(step, strain, internal_variables, stress);
  }
} // namespace scree

#endif
