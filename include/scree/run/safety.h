// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_safety_h
#define scree_run_safety_h

#include <scree/run/simulation.h>

namespace scree
{
  /// Two factors of strength between which a slope begins to fail.
  struct FactorBracket
  {
    double rests = 0.,                                      ///< largest factor tried with which it rests; 0: none
        fails    = std::numeric_limits<double>::infinity(); ///< smallest one with which it fails; infinite: none

    /// Takes a trial that has ended.
    void include(const double factor, const TrialEnd end)
    {
      if (end != TrialEnd::undecided)
        (end == TrialEnd::fails ? fails : rests) = factor;
    }

    /// Trials that a bisection still takes; before the slope has failed, one that begins at the upper factor.
    unsigned int n_left(const SafetyParameters &safety) const
    {
      return std::max(0., std::ceil(std::log2((std::min(fails, safety.upper) - rests) / safety.tolerance) - 1e-9));
    }

    /// "above 1.3", "1.3 to 1.69"; empty before a trial.
    std::string text() const
    {
      return std::isfinite(fails) ? number_text(rests) + " to " + number_text(fails)
             : rests > 0.         ? "above " + number_text(rests)
                                  : "";
    }
  };

  /// Searches the factor: the lower factor, then from 1 up in steps of 30 % until the slope fails, then by bisection to
  /// the tolerance. Throws EntryError if the slope fails with the lower factor, or rests with the upper one.
  /// @param try_factor makes a trial with a factor and adds it to the bracket
  /// @param bracket of the trials so far
  /// @return whether the search has come to its end: no trial is undecided, as it was asked to stop
  bool search_factor(const SafetyParameters &safety,
                     const std::function<TrialEnd(double)> &try_factor,
                     const FactorBracket &bracket);

  /// Searches the factor of safety of a case by strength reduction (@source{griffiths1999}), and writes it to the
  /// screen and to the folder `safety` of the run folder: `log.txt`, `safety.csv` with one row a trial, and the run
  /// folders `rests` and `fails` of the last trials of either end, with pictures. Collective. Throws EntryError if the
  /// case has water and no drained settling, or Nor-Sand, gravity is missing, no law has strength, or the factor is not
  /// in the range.
  /// @param parameters of the case, as it was read; each trial reads its file again
  template <int dim>
  End find_safety(const Parameters &parameters, const MPI_Comm communicator);
} // namespace scree

#endif
