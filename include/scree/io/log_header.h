// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_log_header_h
#define scree_io_log_header_h

#include <scree/mesh/background_grid.h>
#include <scree/io/run_folder.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <list>

namespace scree
{
  /// Logs what runs where: program and commit, libraries, compiler and its flags, ranks, host, process, date.
  /// Collective.
  void log_program(RunFolder &folder, const MPI_Comm communicator);

  /// Logs the size of the run: cells, points, and memory, MB of all ranks. Collective.
  /// @param expected_bytes that the run is estimated to take, of all ranks
  template <int dim>
  void log_size(RunFolder &folder,
                const BackgroundGrid<dim> &grid,
                const std::list<SoilBody<dim>> &bodies,
                const std::list<WaterPhase<dim>> &water,
                const double expected_bytes);

  /// Logs the largest memory so far, MB of all ranks. Collective.
  void log_peak_memory(RunFolder &folder, const MPI_Comm communicator);
} // namespace scree

#endif
