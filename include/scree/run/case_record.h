// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_case_record_h
#define scree_run_case_record_h

#include <scree/model/scene.h>

namespace scree
{
  /// Keeps the case with its results.
  void record_case(Parameters &parameters, RunFolder &folder);

  /// Begins the log with what has been made of the case: program, model, size, and what its ground, base and inflows
  /// are. Collective.
  template <int dim>
  void log_case(const Parameters &parameters, const Scene<dim> &scene, RunFolder &folder, const MPI_Comm communicator);

  /// Logs of each body that moves its volume, mass, density and stress before the first step, and of the water its
  /// mass. Collective.
  template <int dim>
  void
  log_released(const Parameters &parameters, const Scene<dim> &scene, RunFolder &folder, const MPI_Comm communicator);

  /// Logs volume and mass of what is in the box, of what left it through open walls and of what came in. Volumes of
  /// soil are those at its density before the first step, so that they add up. Collective.
  /// @param totals of this rank
  template <int dim>
  void
  log_balance(const Scene<dim> &scene, const RunBalance<dim> &totals, RunFolder &folder, const MPI_Comm communicator);

  /// Records the largest memory so far, MB of all ranks. Collective.
  void log_peak_memory(RunFolder &folder, const MPI_Comm communicator);
} // namespace scree

#endif
