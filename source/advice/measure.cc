// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/measure.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <ctime>

#include <sys/resource.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of this process so far, s.
    double processor_time()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    /// Largest memory of this process so far, bytes.
    double peak_memory()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * usage.ru_maxrss;
    }
  } // namespace


  template <int dim>
  StepCost measure_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator)
  {
    const auto core_seconds_of = [&](const auto &act) {
      const double start = processor_time();
      act();
      return Utilities::MPI::sum(processor_time() - start, communicator);
    };
    const double first  = core_seconds_of([&] { simulation.advance(simulation.stable_step()); });
    const auto parts_of = [&] {
      std::map<StepPart, double> seconds;
      for (const StepPart part : step_parts)
        if (const double of_part = seconds_of(simulation.times_of_parts(), part); of_part > 0.)
          seconds[part] = of_part;
      return seconds;
    };
    auto before = parts_of();

    constexpr unsigned int most_steps = 2000;
    StepCost cost;
    const double wall_start = MPI_Wtime(), processor_start = processor_time();
    double rank_0 = 0; // core-seconds of rank 0, which decides for all
    while (rank_0 < seconds && cost.n_steps < most_steps)
      {
        simulation.advance(simulation.stable_step());
        ++cost.n_steps;
        rank_0 = Utilities::MPI::broadcast(communicator, processor_time() - processor_start, 0);
      }
    const double wall = MPI_Wtime() - wall_start;

    cost.seconds       = Utilities::MPI::sum(processor_time() - processor_start, communicator) / cost.n_steps;
    cost.first_seconds = std::max(0., first - cost.seconds);
    for (const auto &[part, of_part] : parts_of())
      cost.parts[part] = cost.seconds * (of_part - before[part]) / wall;
    // A body that has hardly moved yet is not sorted.
    for (PointSet<dim> *points : simulation.point_sets())
      cost.sorting += core_seconds_of([&] { points->sort(); });
    // The first of them make files and start libraries.
    simulation.write_row();
    cost.row           = core_seconds_of([&] { simulation.write_row(); });
    const auto picture = [&] { simulation.write_picture(); };
    cost.picture       = core_seconds_of(picture);
    if (cost.picture < seconds)
      cost.picture = core_seconds_of(picture);
    cost.memory = Utilities::MPI::sum(peak_memory(), communicator);
    cost.program_memory *= Utilities::MPI::n_mpi_processes(communicator);
    return cost;
  }

  template StepCost measure_steps(Simulation<2> &, const double, const MPI_Comm);
  template StepCost measure_steps(Simulation<3> &, const double, const MPI_Comm);
} // namespace scree
