// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_initial_state_h
#define scree_initial_initial_state_h

#include <scree/particles/region.h>

namespace scree
{
  /// Subsection Initial state of a body: stress before the first step.
  struct InitialStateParameters
  {
    std::string type = "none"; ///< none | K0 | isotropic
    std::string k0   = "auto"; ///< horizontal over vertical stress; auto: 1 - sin(phi), see k0_ratio()
    double pressure  = 0;      ///< Pa, isotropic

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Initial state");
      prm.add_parameter("Type",
                        type,
                        "Stress at the start. none: no stress. K0: vertical stress from the weight above the point, "
                        "horizontal stress K0 times that. isotropic: \"Pressure\".",
                        dealii::Patterns::Selection("none|K0|isotropic"));
      prm.add_parameter(
          "K0",
          k0,
          "Ratio of horizontal to vertical effective stress, from 0 to 10. auto: 1 - sin(phi) with the "
          "friction angle of the law (Nor-Sand: the critical one; Tresca, Herschel-Bulkley: 0), 0.5 if it has none.");
      prm.add_parameter(
          "Pressure", pressure, "Pa; isotropic stress, compression positive.", dealii::Patterns::Double(0));
      prm.leave_subsection();
    }

    /// Throws EntryError at impossible combinations; `body` is the enclosing subsection.
    void check(const std::string &body, const std::vector<double> &gravity) const
    {
      const std::string subsection = body + "/Initial state";
      const InitialStateParameters defaults;
      require_entry(is_isotropic() ? pressure > 0 : pressure == 0,
                    { subsection, "Pressure", pressure },
                    is_isotropic() ? "an isotropic start needs a pressure above 0, in Pa."
                                   : "this entry has no effect. Remove it, or write \"Type = isotropic\".");
      const double ratio = k0_ratio({});
      require_entry(ratio >= 0 && ratio <= 10, { subsection, "K0", k0 }, "write auto, or a number from 0 to 10.");
      require_entry(is_k0() || k0 == defaults.k0,
                    { subsection, "K0", k0 },
                    "this entry has no effect. Remove it, or write \"Type = K0\".");
      require_entry(!is_k0() || std::count(gravity.begin(), gravity.end(), 0.) + 1 == long(gravity.size()),
                    { subsection, "Type", type },
                    "the weight above a point needs gravity along one axis, but entry \"Gravity\" = " +
                        number_text(gravity) + ". Change it, or write \"Type = none\" or \"Type = isotropic\".");
    }

    /// Whether the stress is the weight above a point, and K0 times that sideways.
    bool is_k0() const
    {
      return type == "K0";
    }

    /// Whether it is one pressure everywhere.
    bool is_isotropic() const
    {
      return type == "isotropic";
    }

    /// Entry `K0` as a number; auto: 1 - sin(phi) of normally consolidated soil (@source{jaky1944}), 0.5 without an
    /// angle.
    double k0_ratio(const std::optional<double> &sine_of_friction) const
    {
      if (k0 != "auto")
        return number_of(k0);
      return sine_of_friction ? 1. - *sine_of_friction : 0.5;
    }
  };

  /// Subsection Settling: motion under gravity with damping, before the release at t = 0. Water keeps its place and its
  /// initial pressure.
  struct SettlingParameters
  {
    double maximum_time     = 0;    ///< s; 0: no settling
    double unbalanced_force = 1e-3; ///< ends below this part of the weight
    std::string gate;               ///< nodes where this is true are held until the release

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Settling");
      prm.add_parameter(
          "Maximum time",
          maximum_time,
          "s; longest duration of the damped motion under gravity before the release at t = 0; 0: no settling.",
          dealii::Patterns::Double(0));
      prm.add_parameter(
          "Unbalanced force",
          unbalanced_force,
          "Ratio of unbalanced force to weight, root mean square over the nodes, below which settling ends.",
          dealii::Patterns::Double(0, 1));
      prm.add_parameter(
          "Gate",
          gate,
          "Nodes where this expression of x, y (z), in m, is true are held until the release, such as x > "
          "1. Empty: none.");
      prm.leave_subsection();
    }

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2
    void check(const std::vector<double> &gravity) const
    {
      const std::size_t dim = gravity.size();
      require_entry(maximum_time == 0 || std::count(gravity.begin(), gravity.end(), 0.) < long(dim),
                    { "Settling", "Maximum time", maximum_time },
                    "without gravity nothing settles. Change entry \"Gravity\", or write 0.");
      require_entry(gate.empty() || maximum_time > 0,
                    { "Settling", "Gate", gate },
                    "it holds only while the soil settles. Write a \"Maximum time\" above 0, or remove it.");
      if (!gate.empty())
        check_expression(dim, entry_name("Settling", "Gate"), gate, 1);
    }
  };
} // namespace scree

#endif
