// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/log_header.h>
#include <scree/version.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <ctime>
#include <sstream>
#include <unistd.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    std::string date()
    {
      const std::time_t now = std::time(nullptr);
      char text[64];
      std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S %Z", std::localtime(&now));
      return text;
    }

    /// Of all ranks.
    std::string megabytes(const unsigned long kilobytes, const MPI_Comm communicator)
    {
      return std::to_string(std::lround(Utilities::MPI::sum(double(kilobytes), communicator) / 1024)) + " MB";
    }

    Utilities::System::MemoryStats memory()
    {
      Utilities::System::MemoryStats kilobytes;
      Utilities::System::get_memory_stats(kilobytes);
      return kilobytes;
    }

    /// On all ranks.
    template <int dim>
    std::string count(const PointSet<dim> &points, const MPI_Comm communicator)
    {
      const unsigned long long n = points.n_points();
      return std::to_string(Utilities::MPI::sum(n, communicator));
    }
  } // namespace


  void log_program(RunFolder &folder, const MPI_Comm communicator)
  {
    std::istringstream version(version_text() + "flags: " + single_blanks(compiler_flags()));
    for (std::string line; std::getline(version, line);)
      folder.log(line);
    folder.log(std::to_string(Utilities::MPI::n_mpi_processes(communicator)) + " rank(s), the first is process " +
               std::to_string(getpid()) + " on " + Utilities::System::get_hostname() + "; " + date());
    if (!folder.dead_run().empty())
      folder.log("The run before this one (" + folder.dead_run() + ") did not come to its end.");
  }


  template <int dim>
  void log_size(RunFolder &folder,
                const BackgroundGrid<dim> &grid,
                const std::list<SoilBody<dim>> &bodies,
                const std::list<WaterPhase<dim>> &water,
                const double expected_bytes)
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    std::string points;
    for (const auto &body : bodies)
      points += (points.empty() ? "" : ", ") + body.name + ' ' + count(body.points, communicator);
    for (const auto &part : water)
      if (part.carrier() == nullptr)
        points += (points.empty() ? "" : ", ") + ("water " + count(part.points(), communicator));
    const double n_cells = Utilities::MPI::sum(double(grid.fine_cells().n_owned()), communicator);
    const double n_all   = grid.n_cells_of_box();
    const unsigned long long n_ghosts =
        Utilities::MPI::sum(grid.numbering().partitioner()->n_ghost_indices(), communicator);
    folder.log(number_text(n_cells) + " cells of " + number_text(grid.cell_size()) + " m" +
               (n_cells < n_all ? " around the points, in a box of " + number_text(n_all) : "") +
               (n_ghosts > 0 ? "; ghost nodes " + std::to_string(n_ghosts) : "") + "; points: " + points +
               "; memory at the start " + megabytes(memory().VmRSS, communicator) + ", estimated for the run " +
               std::to_string(std::lround(expected_bytes / (1024. * 1024.))) + " MB (all ranks)");
  }


  void log_peak_memory(RunFolder &folder, const MPI_Comm communicator)
  {
    folder.log("largest memory: " + megabytes(memory().VmHWM, communicator) + " (all ranks)");
  }

  template void log_size(RunFolder &,
                         const BackgroundGrid<2> &,
                         const std::list<SoilBody<2>> &,
                         const std::list<WaterPhase<2>> &,
                         const double);
  template void log_size(RunFolder &,
                         const BackgroundGrid<3> &,
                         const std::list<SoilBody<3>> &,
                         const std::list<WaterPhase<3>> &,
                         const double);
} // namespace scree
