// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_friction_angle_h
#define scree_materials_friction_angle_h

#include <string>

namespace scree
{
  /// Tests that a friction angle can come from.
  enum class FrictionAngleKind
  {
    triaxial,     ///< (s1 - s3)/(s1 + s3) in triaxial compression
    plane_strain, ///< the same in plane strain
    direct_shear  ///< tau/sigma on a plane: shear box, angle of repose, friction of a base
  };

  /// Values of entry "Friction angle kind".
  constexpr char friction_angle_kinds[] = "triaxial|plane strain|direct shear or repose";

  /// An angle in radians.
  double radians(const double degrees);

  /// The angle whose tangent is that of `degrees` over `factor`, degrees.
  double divided_angle(const double degrees, const double factor);

  /// The kind of that name. Throws dealii::ExcMessage if there is none.
  FrictionAngleKind friction_angle_kind(const std::string &name);

  /// sin(phi) of Mohr-Coulomb, which has one angle in triaxial compression and in plane strain. On a plane that shears
  /// without strain along it, tau/sigma = sin(phi) cos(psi)/(1 - sin(phi) sin(psi)) (@source{davis1968}), which
  /// is solved for sin(phi).
  /// @param angle degrees
  /// @param dilation_angle psi, degrees
  double sine_of_mohr_coulomb(const double angle, const double dilation_angle, const FrictionAngleKind kind);
} // namespace scree

#endif
