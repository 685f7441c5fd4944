// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_initial_state_h
#define scree_initial_initial_state_h

#include <deal.II/base/parameter_handler.h>

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
    double k0        = 0.5;    ///< horizontal over vertical stress
    double pressure  = 0;      ///< Pa, isotropic

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations; `body` is the enclosing subsection.
    void check(const std::string &body, const std::vector<double> &gravity) const;

    /// Entry `Type` as an enum.
    InitialStress stress_kind() const;
  };

  /// Subsection Settling: motion under gravity with damping, before the release at t = 0.
  struct SettlingParameters
  {
    double maximum_time   = 0;    ///< s; 0: no settling
    double damping_rate   = 20;   ///< 1/s
    double kinetic_energy = 1e-8; ///< ends when kinetic energy falls below this part of the elastic energy
    std::string gate;             ///< nodes where this is true are held until the release

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2
    void check(const std::vector<double> &gravity) const;
  };
} // namespace scree

#endif
