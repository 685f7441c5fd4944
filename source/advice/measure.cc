// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/measure.h>
#include <scree/io/progress.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include <sys/resource.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Largest memory of this process so far, bytes.
    double peak_memory()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * usage.ru_maxrss;
    }


    /// Watches a run step by step.
    template <int dim>
    class Watch
    {
    public:
      Watch(Simulation<dim> &simulation, const MPI_Comm communicator)
          : simulation(simulation)
          , communicator(communicator)
      {
        for (const PointSet<dim> *points : simulation.point_sets())
          seen.n_points += points->handler().n_global_particles();
      }

      /// Of all ranks.
      template <class Act>
      double core_seconds_of(const Act &act) const
      {
        const double start = processor_time();
        act();
        return Utilities::MPI::sum(processor_time() - start, communicator);
      }

      /// Core-seconds of `act`, a mean, as once may be too short to be timed, of as many as fit into `seconds`. The
      /// first one makes files and starts libraries: it only counts if it alone takes as long.
      template <class Act>
      double mean_of_several(const double seconds, const Act &act) const
      {
        constexpr unsigned int most = 20;
        const double first          = core_seconds_of(act);
        if (first > seconds)
          return first;
        double sum     = 0;
        unsigned int n = 0;
        for (; n == 0 || (n < most && sum < 0.2 * seconds); ++n)
          sum += core_seconds_of(act);
        return sum / n;
      }

      void step()
      {
        const Speeds speeds   = simulation.limiting_speeds();
        const double duration = simulation.step(simulation.stable_step(), simulation.end_time());
        seen.passages.push_back({ duration, speeds.wave, speeds.points });
      }

      /// Steps while `more`, which gets how many were taken, the core-seconds that rank 0 spent on them and the time
      /// of the run, s, and until the run's end. Adds them to n_steps.
      template <class More>
      StepCost steps_while(const More &more, double &n_steps)
      {
        const auto before       = times_of_parts();
        const double wall_start = MPI_Wtime(), start = processor_time();
        double n         = 0;
        double of_rank_0 = 0; // which decides for all
        while (!simulation.is_at_end() && more(n, of_rank_0, simulation.time()))
          {
            step();
            ++n;
            of_rank_0 = Utilities::MPI::broadcast(communicator, processor_time() - start, 0);
          }
        StepCost cost;
        if (n == 0)
          return cost;
        const double wall = MPI_Wtime() - wall_start;
        cost.seconds      = Utilities::MPI::sum(processor_time() - start, communicator) / n;
        for (const auto &[part, seconds] : times_of_parts())
          {
            const auto found = before.find(part);
            cost.parts[part] = cost.seconds * (seconds - (found == before.end() ? 0. : found->second)) / wall;
          }
        n_steps += n;
        return cost;
      }

      Observation seen;

    private:
      std::map<TimerSection, double> times_of_parts() const
      {
        std::map<TimerSection, double> seconds;
        for (const TimerSection part : step_parts)
          if (const double of_part = scree::seconds_of(simulation.times_of_parts(), part); of_part > 0.)
            seconds[part] = of_part;
        return seconds;
      }

      Simulation<dim> &simulation;
      const MPI_Comm communicator;
    };
  } // namespace


  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int most_steps = 2000;
    Watch<dim> watch(simulation, communicator);
    Observation &seen  = watch.seen;
    const double first = watch.core_seconds_of([&] { watch.step(); });
    seen.first         = watch.steps_while(
        [&](const double n, const double spent, const double) { return spent < seconds && n < most_steps; },
        seen.n_first);
    if (seen.n_first == 0) // The run is one step long.
      seen.first.seconds = first;
    seen.later   = seen.first;
    seen.setup   = std::max(0., first - seen.first.seconds);
    seen.row     = watch.mean_of_several(seconds, [&] { simulation.write_row(); });
    seen.picture = watch.mean_of_several(seconds, [&] { simulation.write_picture(); });
    seen.memory  = Utilities::MPI::sum(peak_memory(), communicator);
    seen.program_memory *= Utilities::MPI::n_mpi_processes(communicator);
    return seen;
  }


  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int least_steps = 10; // to take their time
    Watch<dim> watch(simulation, communicator);
    Observation &seen = watch.seen;
    watch.step();
    seen.first = watch.steps_while(
        [&](const double n, const double, const double time) { return time < begin || n < least_steps; }, seen.n_first);
    double n_later = 0;
    seen.later =
        watch.steps_while([&](const double, const double spent, const double) { return spent < seconds; }, n_later);
    if (n_later == 0)
      seen.later = seen.first;
    return seen;
  }

  template Observation measure_first_steps(Simulation<2> &, const double, const MPI_Comm);
  template Observation measure_first_steps(Simulation<3> &, const double, const MPI_Comm);
  template Observation measure_run(Simulation<2> &, const double, const double, const MPI_Comm);
  template Observation measure_run(Simulation<3> &, const double, const double, const MPI_Comm);
} // namespace scree
