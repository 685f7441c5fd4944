// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_safety_h
#define scree_run_safety_h

#include <scree/run/simulation.h>

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
