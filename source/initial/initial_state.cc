// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/initial_state.h>
#include <scree/points/region.h>

namespace scree
{
  using namespace dealii;

  void InitialStateParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Initial state");
    prm.add_parameter("Type",
                      type,
                      "Stress before the first step: none; K0 (weight above the point, K0 times that sideways); isotropic.",
                      Patterns::Selection("none|K0|isotropic"));
    prm.add_parameter("K0", k0, "Horizontal over vertical stress.", Patterns::Double(0, 10));
    prm.add_parameter("Pressure", pressure, "Isotropic stress, Pa, compression positive.", Patterns::Double(0));
    prm.leave_subsection();
  }



  void InitialStateParameters::check(const std::string &body) const
  {
    AssertThrow(type != "isotropic" || pressure > 0,
                ExcMessage("Subsection " + body + "/Initial state: 'Type' is isotropic, but 'Pressure' is " +
                           Utilities::to_string(pressure) + ". Write a pressure above 0, in Pa."));
  }



  void SettlingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Settling");
    prm.add_parameter("Maximum time",
                      maximum_time,
                      "Longest time, s, of damped motion under gravity before the release at t = 0; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter("Damping rate", damping_rate, "Decay of velocity while settling, 1/s.", Patterns::Double(0));
    prm.add_parameter("Kinetic energy",
                      kinetic_energy,
                      "Settling ends when the kinetic energy is below this part of the elastic energy.",
                      Patterns::Double(0, 1));
    prm.add_parameter("Gate",
                      gate,
                      "Nodes where this expression of x, y (and z) is true are held until the release, e.g. x > 1; "
                      "empty: none.",
                      Patterns::Anything());
    prm.leave_subsection();
  }



  void SettlingParameters::check(const unsigned int dim) const
  {
    if (!gate.empty() && dim == 2)
      Region<2>("Subsection Settling: 'Gate'", gate);
    if (!gate.empty() && dim == 3)
      Region<3>("Subsection Settling: 'Gate'", gate);
  }
} // namespace scree
