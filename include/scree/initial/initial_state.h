// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_initial_state_h
#define scree_initial_initial_state_h

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

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
    InitialStress stress_kind() const;

    /// Entry `K0` as a number; auto: 1 - sin(phi) of normally consolidated soil (@source{jaky1944}), 0.5 without an
    /// angle.
    double k0_ratio(const std::optional<double> &sine_of_friction) const;
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
    void check(const std::vector<double> &gravity) const;
  };
} // namespace scree

#endif
