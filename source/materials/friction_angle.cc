// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/materials/friction_angle.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>

namespace scree
{
  double radians(const double degrees)
  {
    return degrees * dealii::numbers::PI / 180;
  }


  double divided_angle(const double degrees, const double factor)
  {
    return std::atan(std::tan(radians(degrees)) / factor) * 180 / dealii::numbers::PI;
  }


  FrictionAngleKind friction_angle_kind(const std::string &name)
  {
    if (name == "triaxial")
      return FrictionAngleKind::triaxial;
    if (name == "plane strain")
      return FrictionAngleKind::plane_strain;
    AssertThrow(name == "direct shear or repose", dealii::ExcMessage("There is no kind of angle \"" + name + "\"."));
    return FrictionAngleKind::direct_shear;
  }


  double sine_of_mohr_coulomb(const double angle, const double dilation_angle, const FrictionAngleKind kind)
  {
    if (kind != FrictionAngleKind::direct_shear)
      return std::sin(radians(angle));
    const double on_plane = std::tan(radians(angle)), psi = radians(dilation_angle);
    return on_plane / (std::cos(psi) + std::sin(psi) * on_plane);
  }
} // namespace scree
