// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_measure_h
#define scree_advice_measure_h

#include <scree/advice/cost.h>
#include <scree/simulation.h>

namespace scree
{
  /// Takes the time of the first steps of a run, until rank 0 has spent `seconds` core-seconds, and of what is written
  /// then. Collective.
  template <int dim>
  StepCost measure_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator);
} // namespace scree

#endif
