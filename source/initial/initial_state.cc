// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/initial_state.h>

namespace scree
{
  using namespace dealii;

  void InitialStateParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Initial state");
    prm.add_parameter("Type",
                      type,
                      "Stress at the start. none: no stress. K0: vertical stress from the weight above the point, "
                      "horizontal stress K0 times that. isotropic: \"Pressure\".",
                      Patterns::Selection("none|K0|isotropic"));
    prm.add_parameter(
        "K0",
        k0,
        "Ratio of horizontal to vertical effective stress, from 0 to 10. auto: 1 - sin(phi) with the "
        "friction angle of the law (Nor-Sand: the critical one; Tresca, Herschel-Bulkley: 0), 0.5 if it has none.");
    prm.add_parameter("Pressure", pressure, "Pa; isotropic stress, compression positive.", Patterns::Double(0));
    prm.leave_subsection();
  }


  void InitialStateParameters::check(const std::string &body, const std::vector<double> &gravity) const
  {
    const std::string subsection = body + "/Initial state";
    const InitialStateParameters defaults;
    const bool is_k0 = stress_kind() == InitialStress::k0, is_isotropic = stress_kind() == InitialStress::isotropic;
    require_entry(is_isotropic ? pressure > 0 : pressure == 0,
                  { subsection, "Pressure", pressure },
                  is_isotropic ? "an isotropic start needs a pressure above 0, in Pa."
                               : "this entry has no effect. Remove it, or write \"Type = isotropic\".");
    const double ratio = k0_ratio({});
    require_entry(ratio >= 0 && ratio <= 10, { subsection, "K0", k0 }, "write auto, or a number from 0 to 10.");
    require_entry(is_k0 || k0 == defaults.k0,
                  { subsection, "K0", k0 },
                  "this entry has no effect. Remove it, or write \"Type = K0\".");
    require_entry(!is_k0 || std::count(gravity.begin(), gravity.end(), 0.) + 1 == long(gravity.size()),
                  { subsection, "Type", type },
                  "the weight above a point needs gravity along one axis, but entry \"Gravity\" = " +
                      number_text(gravity) + ". Change it, or write \"Type = none\" or \"Type = isotropic\".");
  }


  void SettlingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Settling");
    prm.add_parameter(
        "Maximum time",
        maximum_time,
        "s; longest duration of the damped motion under gravity before the release at t = 0; 0: no settling.",
        Patterns::Double(0));
    prm.add_parameter(
        "Unbalanced force",
        unbalanced_force,
        "Ratio of unbalanced force to weight, root mean square over the nodes, below which settling ends.",
        Patterns::Double(0, 1));
    prm.add_parameter("Gate",
                      gate,
                      "Nodes where this expression of x, y (z), in m, is true are held until the release, such as x > "
                      "1. Empty: none.");
    prm.leave_subsection();
  }


} // namespace scree
