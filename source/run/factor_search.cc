// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/run/factor_search.h>

#include <algorithm>

namespace scree
{
  std::optional<FactorBracket> search_factor(const SafetyParameters &safety,
                                             const std::function<TrialEnd(double)> &try_factor)
  {
    constexpr double growth = 1.3;
    const TrialEnd first    = try_factor(safety.lower);
    if (first == TrialEnd::undecided)
      return {};
    require_entry(first == TrialEnd::rests,
                  "Safety",
                  "Lower factor",
                  safety.lower,
                  "the slope does not come to rest with its strength divided by this. Write a smaller one.");
    FactorBracket bracket{ safety.lower, 0. };
    bool has_failed = false;
    double factor   = std::min(safety.lower < 1. ? 1. : growth * safety.lower, safety.upper);
    while (!has_failed || bracket.fails - bracket.rests > safety.tolerance)
      {
        const TrialEnd end = try_factor(factor);
        if (end == TrialEnd::undecided)
          return {};
        has_failed                                               = has_failed || end == TrialEnd::fails;
        (end == TrialEnd::fails ? bracket.fails : bracket.rests) = factor;
        require_entry(bracket.rests < safety.upper,
                      "Safety",
                      "Upper factor",
                      safety.upper,
                      "the slope still comes to rest with its strength divided by this. Write a larger one.");
        factor = has_failed ? 0.5 * (bracket.rests + bracket.fails) : std::min(growth * factor, safety.upper);
      }
    return bracket;
  }
} // namespace scree
