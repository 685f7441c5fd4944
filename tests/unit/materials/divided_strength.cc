// SPDX-License-Identifier: LGPL-2.1-or-later

// Mohr-Coulomb with its strength divided by a factor: angles of all kinds, residual values, tension cut-off.

#include <scree/materials/laws/mohr_coulomb.h>

#include <cmath>
#include <iostream>

#include "../unit_test.h"

namespace test_divided_strength
{
using namespace scree;

/// Prints c, tan(phi) and the cut-off over those before, at the peak and residual.
void print(const std::string &name, const MohrCoulombParameters &before, const double factor)
{
  MohrCoulombParameters after = before;
  after.divide_strength(factor);
  after.check("Mohr-Coulomb");
  const auto tangent = [](const MohrCoulombParameters &law) { return std::tan(std::asin(law.sine())); };
  std::cout << name << ", factor " << factor << ": tan(phi) " << tangent(after) / tangent(before) << ", c "
            << after.cohesion / before.cohesion << ", residual tan(phi) "
            << tangent(after.residual()) / tangent(before.residual()) << ", residual c "
            << after.residual().cohesion / before.residual().cohesion << ", psi " << after.dilation_angle << '\n';
}

void run()
{
  MohrCoulombParameters soil;
  soil.young_modulus   = 1e7;
  soil.cohesion        = 1e4;
  soil.friction_angle  = 34;
  soil.dilation_angle  = 5;
  soil.tension_cut_off = 0;
  for (const double factor : { 0.25, 1., 2. })
    {
      print("triaxial", soil, factor);
      MohrCoulombParameters repose = soil;
      repose.angle_kind            = "direct shear or repose";
      print("direct shear or repose", repose, factor);
      MohrCoulombParameters softening    = soil;
      softening.softening.strain         = 0.1;
      softening.softening.cohesion       = 2e3;
      softening.softening.friction_angle = 25;
      softening.softening.dilation_angle = 0;
      print("softening", softening, factor);
      MohrCoulombParameters inertial            = soil;
      inertial.inertial_friction.grain_diameter = 1e-3;
      print("inertial friction", inertial, factor);
    }
}

const UnitTest registered("divided_strength", run);
} // namespace test_divided_strength


// Output:
// triaxial, factor 0.25: tan(phi) 4, c 4, residual tan(phi) 4, residual c 4, psi 5
// direct shear or repose, factor 0.25: tan(phi) 4, c 4, residual tan(phi) 4, residual c 4, psi 5
// softening, factor 0.25: tan(phi) 4, c 4, residual tan(phi) 4, residual c 4, psi 5
// inertial friction, factor 0.25: tan(phi) 4, c 4, residual tan(phi) 4, residual c 4, psi 5
// triaxial, factor 1: tan(phi) 1, c 1, residual tan(phi) 1, residual c 1, psi 5
// direct shear or repose, factor 1: tan(phi) 1, c 1, residual tan(phi) 1, residual c 1, psi 5
// softening, factor 1: tan(phi) 1, c 1, residual tan(phi) 1, residual c 1, psi 5
// inertial friction, factor 1: tan(phi) 1, c 1, residual tan(phi) 1, residual c 1, psi 5
// triaxial, factor 2: tan(phi) 0.5, c 0.5, residual tan(phi) 0.5, residual c 0.5, psi 5
// direct shear or repose, factor 2: tan(phi) 0.5, c 0.5, residual tan(phi) 0.5, residual c 0.5, psi 5
// softening, factor 2: tan(phi) 0.5, c 0.5, residual tan(phi) 0.5, residual c 0.5, psi 5
// inertial friction, factor 2: tan(phi) 0.5, c 0.5, residual tan(phi) 0.5, residual c 0.5, psi 5
