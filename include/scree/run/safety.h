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

    /// The factor to try: from 1 on 30 % more until the slope fails, then the middle.
    double next() const
    {
      return std::isfinite(fails) ? 0.5 * (rests + fails) : rests < 1. ? 1. : 1.3 * rests;
    }

    /// Trials that a bisection to the `tolerance` still takes, if the slope fails with the next factor.
    unsigned int n_left(const double tolerance) const
    {
      const bool has_failed = std::isfinite(fails);
      const double width    = (has_failed ? fails : next()) - rests;
      return (has_failed ? 0 : 1) + std::max(0., std::ceil(std::log2(width / tolerance) - 1e-9));
    }

    /// "above 1.3", "1.3 to 1.69"; empty before a trial.
    std::string text() const
    {
      return std::isfinite(fails) ? number_text(rests) + " to " + number_text(fails)
             : rests > 0.         ? "above " + number_text(rests)
                                  : "";
    }
  };

  /// Searches the factor: from 1 up in steps of 30 % until the slope fails, then by bisection to the tolerance. Throws
  /// EntryError if the slope still rests with a factor of 100.
  /// @param try_factor makes a trial with a factor and adds it to the bracket
  /// @param bracket of the trials so far
  /// @return whether the search has come to its end: no trial is undecided, as it was asked to stop
  bool search_factor(const double tolerance,
                     const std::function<TrialEnd(double)> &try_factor,
                     const FactorBracket &bracket);

  /// Searches the factor of safety of a case by strength reduction (@source{griffiths1999}), and writes it to the
  /// screen and to the folder `safety` of the run folder: `log.txt`, `safety.csv` with one row a trial, and the run
  /// folders `rests` and `fails` of the last trials of either end, with pictures. Collective. Throws EntryError if the
  /// case has water and no drained settling, or Nor-Sand, gravity is missing, no law has strength, or there is no
  /// factor.
  /// @param parameters of the case, as it was read; each trial reads its file again
  template <int dim>
  End find_safety(const Parameters &parameters, const MPI_Comm communicator);
} // namespace scree

#endif
