// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/cost.h>
#include <scree/io/progress.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Core-seconds of a checkpoint: by itself, and a point; measured over the cases of prm/.
    constexpr double checkpoint_seconds = 1.5e-3, checkpoint_seconds_per_point = 8e-7;

    /// Steps of a run, if nothing is to be written on the way, from its start to any time that is asked for; the times
    /// must not decrease.
    class StepsSoFar
    {
    public:
      StepsSoFar(const std::vector<SpeedInterval> &intervals, const TimeStepper &clock, const double cell_size)
          : intervals(intervals)
          , clock(clock)
          , cell_size(cell_size)
      {
        Assert(!intervals.empty(), dealii::ExcMessage("Nothing was seen of the run."));
      }

      double operator()(const double time)
      {
        while (time > begin + current().duration && index + 1 < intervals.size())
          {
            n += current().duration / step();
            begin += current().duration;
            ++index;
          }
        return n + (time - begin) / step(); // The last interval goes on.
      }

      /// Length of the steps at the time that was asked for last, s.
      double step() const
      {
        return clock.stable_step(cell_size, current().wave, current().speed);
      }

    private:
      const SpeedInterval &current() const
      {
        return intervals[index];
      }

      const std::vector<SpeedInterval> &intervals;
      const TimeStepper &clock;
      const double cell_size;
      std::size_t index = 0;
      double begin = 0, n = 0; // of the current interval
    };

    /// Steps to `end` s, if they are shortened to meet the output times.
    double count_steps(const OutputParameters &output, const double end, StepsSoFar &so_far)
    {
      double n = 0, time = 0;
      while (time < end * (1. - 1e-12))
        {
          double next = end;
          for (const double interval : { output.interval, output.interval_of_statistics(), output.checkpoint_interval })
            if (interval > 0)
              next = std::min(next, (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval);
          const double before = so_far(time);
          n += std::max(1., std::ceil(so_far(next) - before - 1e-6));
          time = next;
        }
      return n;
    }

    double seconds_of_output(const SceneNumbers &scene, const Observation &seen, const OutputParameters &output)
    {
      const auto count = [&](const double interval) {
        return interval > 0 ? std::floor(scene.end_time / interval) + 1. : 0.;
      };
      return count(output.interval) * seen.picture + count(output.interval_of_statistics()) * seen.row +
             count(output.checkpoint_interval) * (checkpoint_seconds + checkpoint_seconds_per_point * scene.n_points());
    }

    /// Calls `act` with the seconds of every cost of a step in `seen`.
    template <class Act>
    void for_each_part(Observation &seen, const Act &act)
    {
      for (StepCost *steps : { &seen.first, &seen.later })
        {
          const double rest = steps->rest();
          steps->seconds    = act(TimerSection::output, rest);
          for (auto &[part, seconds] : steps->parts)
            {
              seconds = act(part, seconds);
              steps->seconds += seconds;
            }
        }
    }
  } // namespace


  double StepCost::seconds_of(const TimerSection part) const
  {
    const auto found = parts.find(part);
    return found == parts.end() ? 0. : found->second;
  }


  double StepCost::rest() const
  {
    double sum = seconds;
    for (const auto &[part, of_part] : parts)
      sum -= of_part;
    return std::max(0., sum);
  }


  double Observation::duration() const
  {
    double sum = 0;
    for (const SpeedInterval &interval : intervals)
      sum += interval.duration;
    return sum;
  }


  RunCost cost_of_run(const SceneNumbers &scene, const Observation &seen, const Schedule &schedule)
  {
    const TimeStepper clock(schedule.time_step);
    StepsSoFar so_far(seen.intervals, clock, scene.cell_size);
    RunCost cost;
    cost.first_step     = so_far.step();
    cost.n_steps        = count_steps(schedule.output, scene.end_time, so_far);
    cost.mean_step      = scene.end_time / cost.n_steps;
    const double n_seen = std::min(seen.n_first, cost.n_steps);
    cost.step_seconds   = seen.setup + n_seen * seen.first.seconds + (cost.n_steps - n_seen) * seen.later.seconds;
    cost.output_seconds = seconds_of_output(scene, seen, schedule.output);
    cost.memory         = seen.memory;
    return cost;
  }


  Observation with_pilot(Observation first_steps, const Observation &pilot)
  {
    constexpr double hardly = 0.02; // of a step
    const double points     = first_steps.n_points / pilot.n_points;
    StepCost &later         = first_steps.later;
    later                   = {};
    later.seconds           = first_steps.first.rest();
    for (const auto &[part, in_pilot] : pilot.later.parts)
      {
        const double first = pilot.first.seconds_of(part);
        const bool is_event =
            part == TimerSection::sort || part == TimerSection::repartition; // which first steps need not meet
        const double seconds = is_event || first < hardly * pilot.first.seconds
                                   ? in_pilot * points
                                   : in_pilot / first * first_steps.first.seconds_of(part);
        later.parts[part]    = seconds;
        later.seconds += seconds;
      }
    const double time = first_steps.duration();
    double begin      = 0;
    for (const SpeedInterval &interval : pilot.intervals)
      {
        const double end = begin + interval.duration;
        if (end > time)
          first_steps.intervals.push_back({ end - std::max(begin, time), interval.wave, interval.speed });
        begin = end;
      }
    return first_steps;
  }


  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for (double *number : { &scene.n_cells, &scene.n_occupied, &scene.n_soil_points, &scene.n_water_points })
      *number *= factor;
    scene.cell_size = cell_size;
    return scene;
  }


  Observation with_cell_size(Observation seen, const SceneNumbers &scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for_each_part(seen, [&](const TimerSection, const double seconds) { return factor * seconds; });
    for (double *number : { &seen.n_points, &seen.setup, &seen.picture, &seen.row })
      *number *= factor;
    seen.memory = seen.program_memory + std::max(0., seen.memory - seen.program_memory) * factor;
    return seen;
  }


  Observation without_water(Observation seen, const SceneNumbers &scene)
  {
    const double soil = scene.n_soil_points / scene.n_points();
    for_each_part(seen, [&](const TimerSection part, const double seconds) {
      switch (part)
        {
        case TimerSection::nodes:
        case TimerSection::pressure_system:
        case TimerSection::pressure_solve:
        case TimerSection::water_points:
          return 0.;
        case TimerSection::stress:
          return seconds;
        default:
          return soil * seconds;
        }
    });
    for (double *seconds : { &seen.setup, &seen.picture, &seen.row })
      *seconds *= soil;
    return seen;
  }


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
        seen.intervals.push_back({ duration, speeds.wave, speeds.points });
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

  template decltype(measure_first_steps<2>) measure_first_steps<2>;
  template decltype(measure_first_steps<3>) measure_first_steps<3>;
  template decltype(measure_run<2>) measure_run<2>;
  template decltype(measure_run<3>) measure_run<3>;
} // namespace scree
