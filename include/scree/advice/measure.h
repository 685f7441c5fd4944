// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_measure_h
#define scree_advice_measure_h

#include <scree/advice/cost.h>
#include <scree/run/simulation.h>

namespace scree
{
  /// Takes the time of the first steps of a run, until rank 0 has spent `seconds` core-seconds or the run is at its
  /// end, and of what is written then; later steps count as the first. Collective.
  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator);

  /// Takes the time of a whole run, of its first steps until `begin` s and of those that come later; or of less, once
  /// rank 0 has spent `seconds` core-seconds. Nothing is written. Collective.
  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator);
} // namespace scree

#endif
