// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/log_header.h>
#include <scree/version.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <unistd.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t right_margin = 79;

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
    unsigned long long count(const PointSet<dim> &points, const MPI_Comm communicator)
    {
      const unsigned long long n = points.n_points();
      return Utilities::MPI::sum(n, communicator);
    }

    /// "1 rank", "2 ranks"
    std::string counted(const unsigned long long n, const std::string &what)
    {
      return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
    }

    /// "Scree 0.9.0 (c75edbf), 2 ranks" and, at the right margin, the date.
    std::string header_line(const MPI_Comm communicator)
    {
      std::string program      = version_text().substr(0, version_text().find('\n'));
      const std::string before = "(commit ";
      if (const std::size_t place = program.find(before); place != std::string::npos)
        program.replace(place, before.size(), "(");
      program += ", " + counted(Utilities::MPI::n_mpi_processes(communicator), "rank");
      const std::string now = date();
      program.resize(std::max(program.size() + 2, right_margin - std::min(right_margin, now.size())), ' ');
      return program + now;
    }

    /// ", 38480 soil points, 1200 water points"; of several bodies also each one's.
    template <int dim>
    std::string points_text(const std::list<SoilBody<dim>> &bodies,
                            const std::list<WaterPhase<dim>> &water,
                            const MPI_Comm communicator)
    {
      std::string of_each;
      unsigned long long n_soil = 0, n_water = 0;
      for (const auto &body : bodies)
        {
          const unsigned long long n = count(body.points, communicator);
          of_each += (of_each.empty() ? " (" : ", ") + body.name + ' ' + std::to_string(n);
          n_soil += n;
        }
      for (const auto &part : water)
        if (part.carrier() == nullptr)
          n_water += count(part.points(), communicator);
      return (bodies.empty() ? "" : ", " + counted(n_soil, "soil point")) + (bodies.size() > 1 ? of_each + ')' : "") +
             (n_water > 0 ? ", " + counted(n_water, "water point") : "");
    }


    /// For log.txt alone: libraries, compiler and its flags, process and host.
    void record_environment(RunFolder &folder)
    {
      std::istringstream version(version_text());
      std::string program, libraries, compiler;
      std::getline(version, program);
      std::getline(version, libraries);
      std::getline(version, compiler);
      folder.record("Libraries   " + libraries);
      folder.record("Compiler    " + compiler + ", flags " + single_blanks(compiler_flags()));
      folder.record("Process     " + std::to_string(getpid()) + " on " + Utilities::System::get_hostname() +
                    " (first rank)");
    }
  } // namespace


  template <int dim>
  void log_header(RunFolder &folder,
                  const HeaderTexts &texts,
                  const BackgroundGrid<dim> &grid,
                  const std::list<SoilBody<dim>> &bodies,
                  const std::list<WaterPhase<dim>> &water,
                  const double expected_bytes)
  {
    const MPI_Comm communicator = grid.communicator();
    folder.log(header_line(communicator));
    folder.log("Case        " + texts.case_file + " -> " + texts.output_directory);
    folder.log("Model       " + texts.model + points_text(bodies, water, communicator));
    const double n_cells = Utilities::MPI::sum(double(grid.fine_cells().n_owned()), communicator);
    const double n_all   = grid.n_cells_of_box();
    folder.log("Mesh        " + number_text(n_cells) + " cells of " + number_text(grid.cell_size()) + " m" +
               (n_cells < n_all ? " around the points, in a box of " + number_text(n_all) : ""));
    folder.log("Memory      " + std::to_string(std::lround(expected_bytes / (1024. * 1024.))) + " MB estimated");

    record_environment(folder);
    folder.record("In use      " + megabytes(memory().VmRSS, communicator) + " at the start (all ranks)");
    const unsigned long long n_ghosts =
        Utilities::MPI::sum(grid.numbering().partitioner()->n_ghost_indices(), communicator);
    if (n_ghosts > 0)
      folder.record("Ghost nodes " + std::to_string(n_ghosts));
    if (!folder.dead_run().empty())
      folder.log("The run before this one (" + folder.dead_run() + ") did not come to its end.");
  }


  void log_peak_memory(RunFolder &folder, const MPI_Comm communicator)
  {
    folder.record("Largest memory: " + megabytes(memory().VmHWM, communicator) + " (all ranks)");
  }

  template void log_header(RunFolder &,
                           const HeaderTexts &,
                           const BackgroundGrid<2> &,
                           const std::list<SoilBody<2>> &,
                           const std::list<WaterPhase<2>> &,
                           const double);
  template void log_header(RunFolder &,
                           const HeaderTexts &,
                           const BackgroundGrid<3> &,
                           const std::list<SoilBody<3>> &,
                           const std::list<WaterPhase<3>> &,
                           const double);
} // namespace scree
