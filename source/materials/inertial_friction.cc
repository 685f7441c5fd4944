// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/materials/inertial_friction.h>

namespace scree
{
  using namespace dealii;

  void InertialFrictionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Grain diameter",
                      grain_diameter,
                      "m; grain diameter d in the inertial number I of dry grains. 0: friction does not depend on the "
                      "rate of shear. Element tests are slow and do not depend on it.",
                      Patterns::Double(0));
    prm.add_parameter("Reference inertial number",
                      reference_number,
                      "Inertial number I_0 at which half of \"Friction increase\" is reached.",
                      Patterns::Double(1e-6));
    prm.add_parameter("Friction increase",
                      friction_increase,
                      "Largest increase of tau/p with the rate of shear: tau/p grows by this value/(1 + I_0/I).",
                      Patterns::Double(0, 2));
  }
} // namespace scree
