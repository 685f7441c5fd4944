// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_law_h
#define scree_materials_law_h

#include <scree/materials/material.h>
#include <scree/simd/batch.h>
#include <scree/tensor/principal.h>

#include <type_traits>

namespace scree
{
  /// What a return map did to the trial strain.
  ///
  /// A law is a class with the members of MohrCoulomb, all in principal values: logarithmic elastic strain and
  /// Kirchhoff stress (Pa), tension positive. HenckyMaterial makes a Material of it, point by point.
  ///
  /// If it also has MohrCoulomb's template of `Number`, double or a Batch of points,
  ///   respond(strain, internal variables, stress)                   the return map of all points
  /// PrincipalBatchMaterial makes a Material of it that updates several points at a time.
  ///
  /// A law whose strength depends on the volume, or whose moduli on the stress, has
  ///   respond(strain, J, internal variables, stress)                the same with a VolumeResponse
  ///
  /// A law whose yield surface has no corners needs the invariants of strain only. It has the members of NorSand that
  /// are templates of `Number`, and BatchMaterial makes a Material of it that updates several points at a time:
  ///   trial(volume strain, |dev strain|^2, J, internal variables)   state before the return
  ///   is_admissible(trial), mean_stress(trial)                      and that state itself, if it stands
  ///   bulk_modulus_at(mean stress)                                  tangent, Pa
  ///   return_to_surface(trial, todo, internal variables, result)    of the points `todo`; says which it could return,
  ///                                                                 others are left to return_map()
  ///
  /// A law with a member `inertial_friction` has friction that grows with the rate of shear, see InertialFriction. It
  /// also has
  ///   friction_pressure(stress)                                     p of that friction, Pa, of a principal stress
  ///   stress_of(strain)                                             elastic principal stress, Pa
  ///
  /// A law with a member nonlocal_variable() may have an internal variable that is averaged over space, one with
  /// place_variable() an internal variable that each point has from its place. The return map of a law with a member
  /// `rate_of_strength`, see RateOfStrength, also asks for the time step:
  ///   respond(time step, strain, internal variables, stress)        of all points
  ///   return_map(time step, strain, internal variables, J, stress, report)
  enum class Response
  {
    elastic, ///< The trial strain stands
    plastic  ///< The strain was changed
  };

  /// Whether the friction of a law can grow with the rate of shear.
  template <typename Law, typename = void>
  struct HasInertialFriction : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct HasInertialFriction<Law, std::void_t<decltype(std::declval<const Law &>().inertial_friction)>> : std::true_type
  {
  };

  /// Whether a law may have a variable that is averaged over space.
  template <typename Law, typename = void>
  struct HasNonlocalVariable : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct HasNonlocalVariable<Law, std::void_t<decltype(std::declval<const Law &>().nonlocal_variable())>>
      : std::true_type
  {
  };

  /// Whether a law has a variable from the place of a point.
  template <typename Law, typename = void>
  struct HasPlaceVariable : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct HasPlaceVariable<Law, std::void_t<decltype(std::declval<const Law &>().place_variable())>> : std::true_type
  {
  };

  /// Whether the return of a law asks for the time step.
  template <typename Law, typename = void>
  struct HasRateOfStrength : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct HasRateOfStrength<Law, std::void_t<decltype(std::declval<const Law &>().rate_of_strength)>> : std::true_type
  {
  };

  /// What a law has from the place of a point; nothing if it has no such member.
  template <typename Law>
  PlaceVariable place_variable_of(const Law &law)
  {
    if constexpr (HasPlaceVariable<Law>())
      return law.place_variable();
    else
      return {};
  }

  /// The return map of a law that does, or does not, ask for the time step, s.
  template <typename Law>
  Response return_map_of(const Law &law,
                         const double time_step,
                         PrincipalValues &strain,
                         double *internal_variables,
                         const double volume_ratio,
                         PrincipalValues &stress,
                         UpdateReport &report)
  {
    if constexpr (HasRateOfStrength<Law>())
      return law.return_map(time_step, strain, internal_variables, volume_ratio, stress, report);
    else
      return law.return_map(strain, internal_variables, volume_ratio, stress, report);
  }

  /// What became of points in a return in principal values.
  template <typename Number>
  struct PrincipalResponse
  {
    simd::Mask<Number> is_plastic;    ///< The strain was changed
    simd::Mask<Number> is_vertex;     ///< As counted in UpdateReport, like the next two
    simd::Mask<Number> is_separated;  ///< see UpdateReport::n_separated
    simd::Mask<Number> is_unresolved; ///< see UpdateReport::n_unresolved
  };

  /// The same of a law that depends on the volume.
  template <typename Number>
  struct VolumeResponse : PrincipalResponse<Number>
  {
    simd::Mask<Number> is_left; ///< Left to return_map()
    Number bulk_modulus;        ///< With 4/3 of the law's shear modulus the modulus of waves, Pa
  };

  /// Whether a law in principal values depends on the volume.
  template <typename Law, typename = void>
  struct DependsOnVolume : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct DependsOnVolume<
      Law,
      std::void_t<decltype(std::declval<const Law &>().template respond<double>(std::declval<PrincipalValues &>(),
                                                                                std::declval<const double &>(),
                                                                                std::declval<double *>(),
                                                                                std::declval<PrincipalValues &>()))>>
      : std::true_type
  {
  };

  /// Whether a law has friction on a plane of shear.
  template <typename Law, typename = void>
  struct HasPlaneFriction : std::false_type
  {
  };

  /// It has the member.
  template <typename Law>
  struct HasPlaneFriction<Law, std::void_t<decltype(std::declval<const Law &>().plane_friction())>> : std::true_type
  {
  };

  /// Invariants of a state on the yield surface.
  template <typename Number>
  struct InvariantReturn
  {
    Number volume_strain;            ///< elastic
    Number deviator_factor;          ///< elastic deviatoric strain over the trial one
    Number mean_stress;              ///< Kirchhoff, Pa
    simd::Mask<Number> is_separated; ///< whether grains are apart
  };
} // namespace scree

#endif
