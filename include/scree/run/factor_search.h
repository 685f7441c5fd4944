// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_factor_search_h
#define scree_run_factor_search_h

#include <scree/case/safety_parameters.h>
#include <scree/run/relaxation.h>

#include <functional>
#include <optional>

namespace scree
{
  /// Two factors of strength between which a slope begins to fail.
  struct FactorBracket
  {
    double rests, ///< largest factor tried with which it rests
        fails;    ///< smallest one with which it fails
  };

  /// Searches the factor: the lower factor, then from 1 up in steps of 30 % until the slope fails, then by bisection to
  /// the tolerance. Nothing if a trial is undecided, as it was asked to stop. Throws EntryError if the slope fails with
  /// the lower factor, or rests with the upper one.
  /// @param try_factor makes a trial with a factor
  std::optional<FactorBracket> search_factor(const SafetyParameters &safety,
                                             const std::function<TrialEnd(double)> &try_factor);
} // namespace scree

#endif
