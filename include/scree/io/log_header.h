// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_log_header_h
#define scree_io_log_header_h

#include <scree/mesh/background_grid.h>
#include <scree/io/run_folder.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <list>
#include <string>

namespace scree
{
  /// What the head of a log says of the case.
  struct HeaderTexts
  {
    std::string case_file;        ///< as it was given
    std::string output_directory; ///< the run folder
    std::string model;            ///< dimension, phases and transfer
  };

  /// Logs the five lines of the head: program, commit, ranks and date; case and run folder; model and points; mesh;
  /// memory, MB of all ranks. Records libraries, compiler and its flags, process and host. Collective.
  /// @param expected_bytes that the run is estimated to take, of all ranks
  template <int dim>
  void log_header(RunFolder &folder,
                  const HeaderTexts &texts,
                  const BackgroundGrid<dim> &grid,
                  const std::list<SoilBody<dim>> &bodies,
                  const std::list<WaterPhase<dim>> &water,
                  const double expected_bytes);

  /// Records the largest memory so far, MB of all ranks. Collective.
  void log_peak_memory(RunFolder &folder, const MPI_Comm communicator);
} // namespace scree

#endif
