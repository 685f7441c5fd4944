// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_safety_parameters_h
#define scree_case_safety_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// Subsection Safety: the search of scree --safety, and a strength that is reduced in a run.
  struct SafetyParameters
  {
    double strength_factor = 1;      ///< divides the strength from the release on
    double lower           = 0.5;    ///< smallest factor that is tried
    double upper           = 5;      ///< largest factor that is tried
    double tolerance       = 0.01;   ///< of the factor
    double displacement    = 0.02;   ///< of a slope that fails, over its height
    double maximum_time    = 40;     ///< of a trial, in sqrt(height/gravity)
    std::string damping    = "auto"; ///< 1/s, or auto

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check() const;

    /// Damping rate of the trials, 1/s.
    /// @param time_scale sqrt(height/gravity), s
    double damping_rate(const double time_scale) const;
  };
} // namespace scree

#endif
