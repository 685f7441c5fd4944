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
    double strength_factor = 1;    ///< divides the strength from the release on
    double lower           = 0.5;  ///< smallest factor that is tried
    double upper           = 5;    ///< largest factor that is tried
    double tolerance       = 0.01; ///< of the factor
    double displacement    = 0.02; ///< of a slope that fails, over its height

    /// Longest duration of a trial, in sqrt(height of the soil/gravity); what moves then fails.
    static constexpr double longest_trial = 40;

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check() const;
  };
} // namespace scree

#endif
