// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_case_record_h
#define scree_run_case_record_h

#include <scree/io/run_folder.h>
#include <scree/model/scene.h>

namespace scree
{
  /// Keeps the case with its results.
  void record_case(Parameters &parameters, RunFolder &folder);

  /// Begins the log with what has been made of the case: program, model, size, and what its ground, base and inflows
  /// are. Collective.
  template <int dim>
  void log_case(const Parameters &parameters, const Scene<dim> &scene, RunFolder &folder, const MPI_Comm communicator);
} // namespace scree

#endif
