// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_phases_h
#define scree_run_phases_h

#include <scree/run/simulation.h>

namespace scree
{
  /// Runs a case to its end time or to a request to stop. If it settles, its "Strength factor" acts from the release
  /// on: the run then goes on from a checkpoint of the settled soil. Collective.
  /// @param parameters of the case; afterwards with the strength that the run had
  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator);
} // namespace scree

#endif
