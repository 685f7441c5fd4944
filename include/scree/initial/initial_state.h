// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_initial_state_h
#define scree_initial_initial_state_h

#include <scree/particles/region.h>

namespace scree
{
  /// Stress of a body before the first step.
  enum class InitialStress
  {
    none,
    k0,       ///< the weight above a point, K0 times that sideways
    isotropic ///< one pressure everywhere
  };

  /// Subsection Initial state of a body: stress before the first step.
  struct InitialStateParameters
  {
    std::string type = "none"; ///< none | K0 | isotropic
    std::string k0   = "auto"; ///< horizontal over vertical stress; auto: 1 - sin(phi), see k0_ratio()
    double pressure  = 0;      ///< Pa, isotropic

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations; `body` is the enclosing subsection.
    void check(const std::string &body, const std::vector<double> &gravity) const;

    /// Entry `Type` as an enum.
    InitialStress stress_kind() const
    {
      return type == "K0" ? InitialStress::k0 : type == "isotropic" ? InitialStress::isotropic : InitialStress::none;
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
    void add_parameters(dealii::ParameterHandler &prm);

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
