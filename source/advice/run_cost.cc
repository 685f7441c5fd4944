// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>

#include <set>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Core-seconds of a checkpoint: by itself, and a point; measured over the cases of prm/.
    constexpr double checkpoint_seconds = 1.5e-3, checkpoint_seconds_per_point = 8e-7;

    /// Steps to `end` s, if they are shortened to meet the output times. The last interval goes on.
    /// @param step_of length of the steps of an interval, s
    template <class StepOf>
    double count_steps(const OutputParameters &output,
                       const double end,
                       const std::vector<SpeedInterval> &intervals,
                       const StepOf &step_of)
    {
      OutputTimes times(output, end);
      auto interval          = intervals.begin();
      double end_of_interval = interval->duration, time = 0, n = 0;
      while (!times.is_end(time))
        {
          times.begin(time);
          const double next = times.next(0.);
          double steps      = 0; // to the next output
          for (; next > end_of_interval && interval + 1 != intervals.end(); end_of_interval += (++interval)->duration)
            {
              steps += (end_of_interval - time) / step_of(*interval);
              time = end_of_interval;
            }
          steps += (next - time) / step_of(*interval);
          n += std::max(1., std::ceil(steps - 1e-6));
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

    /// Multiplies all costs; those of a part of a step by `factor_of(name)`.
    template <class FactorOf>
    Observation scaled(Observation seen, const double factor, const FactorOf &factor_of)
    {
      for (StepCost *steps : { &seen.first, &seen.later })
        for (auto &[part, seconds] : *steps)
          seconds *= factor_of(part);
      for (double *seconds : { &seen.setup, &seen.picture, &seen.row })
        *seconds *= factor;
      return seen;
    }
  } // namespace


  double seconds_of(const StepCost &cost)
  {
    return std::accumulate(
        cost.begin(), cost.end(), 0., [](const double sum, const auto &part) { return sum + part.second; });
  }


  RunCost cost_of_run(const SceneNumbers &scene,
                      const Observation &seen,
                      const TimeStepParameters &time_step,
                      const OutputParameters &output)
  {
    const TimeStepper clock(time_step);
    Assert(!seen.intervals.empty(), ExcMessage("Nothing was seen of the run."));
    const auto step_of = [&](const SpeedInterval &interval) {
      return clock.stable_step(scene.cell_size, interval.wave, interval.speed);
    };
    RunCost cost;
    cost.first_step     = step_of(seen.intervals.front());
    cost.n_steps        = count_steps(output, scene.end_time, seen.intervals, step_of);
    cost.mean_step      = scene.end_time / cost.n_steps;
    const double n_seen = std::min(seen.n_first, cost.n_steps);
    cost.step_seconds = seen.setup + n_seen * seconds_of(seen.first) + (cost.n_steps - n_seen) * seconds_of(seen.later);
    cost.output_seconds = seconds_of_output(scene, seen, output);
    return cost;
  }


  Observation with_pilot(Observation first_steps, const Observation &pilot)
  {
    constexpr double hardly           = 0.02; // of a step
    const std::set<std::string> event = { name_of(TimerSection::sort), name_of(TimerSection::repartition) };
    const double points = first_steps.n_points / pilot.n_points, pilot_step = seconds_of(pilot.first);
    const StepCost first = first_steps.first;
    const auto cost_of   = [](const StepCost &cost, const std::string &part) {
      const auto found = cost.find(part);
      return found == cost.end() ? 0. : found->second;
    };
    first_steps.later = { { other_parts, cost_of(first, other_parts) } };
    for (const auto &[part, later] : pilot.later)
      if (const double before = cost_of(pilot.first, part); part != other_parts)
        first_steps.later[part] = event.count(part) > 0 || before < hardly * pilot_step
                                      ? later * points
                                      : later / before * cost_of(first, part);
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
    seen.n_points *= factor;
    return scaled(seen, factor, [&](const std::string &) { return factor; });
  }


  Observation without_water(const Observation &seen, const SceneNumbers &scene)
  {
    const double soil                   = scene.n_soil_points / scene.n_points();
    std::map<std::string, double> parts = { { name_of(TimerSection::stress), 1. } }; // that are soil's alone, or none's
    for (const TimerSection of_water : { TimerSection::nodes,
                                         TimerSection::pressure_system,
                                         TimerSection::pressure_solve,
                                         TimerSection::water_points })
      parts[name_of(of_water)] = 0.;
    return scaled(seen, soil, [&](const std::string &part) {
      const auto found = parts.find(part);
      return found == parts.end() ? soil : found->second;
    });
  }


  namespace
  {
    /// Core-seconds of all ranks.
    template <class Act>
    double core_seconds_of(const MPI_Comm communicator, const Act &act)
    {
      const double start = processor_time();
      act();
      return Utilities::MPI::sum(processor_time() - start, communicator);
    }

    /// Core-seconds of `act`, a mean, as once may be too short to be timed, of as many as fit into `seconds`. The first
    /// one makes files and starts libraries: it only counts if it alone takes as long.
    template <class Act>
    double mean_of_several(const MPI_Comm communicator, const double seconds, const Act &act)
    {
      constexpr unsigned int most = 20;
      const double first          = core_seconds_of(communicator, act);
      if (first > seconds)
        return first;
      double sum     = 0;
      unsigned int n = 0;
      for (; n == 0 || (n < most && sum < 0.2 * seconds); ++n)
        sum += core_seconds_of(communicator, act);
      return sum / n;
    }

    template <int dim>
    Observation look_at(Simulation<dim> &simulation)
    {
      Observation seen;
      for (const PointSet<dim> *points : simulation.point_sets())
        seen.n_points += points->handler().n_global_particles();
      return seen;
    }

    template <int dim>
    void step(Simulation<dim> &simulation, Observation &seen)
    {
      const Speeds speeds   = simulation.limiting_speeds();
      const double duration = simulation.step(simulation.stable_step(), simulation.end_time());
      seen.intervals.push_back({ duration, speeds.wave, speeds.points });
    }

    /// Steps until the run's end, and while `more`, which gets how many were taken, the core-seconds that rank 0 spent
    /// on them and the time of the run, s. Returns the cost of a step and how many were taken.
    template <int dim, class More>
    std::pair<StepCost, double>
    steps_while(Simulation<dim> &simulation, const MPI_Comm communicator, Observation &seen, const More &more)
    {
      const auto seconds_of_parts = [&simulation] {
        StepCost seconds;
        for (const TimerSection part : step_parts())
          if (const double of_part = seconds_of(simulation.times_of_parts(), part); of_part > 0.)
            seconds[name_of(part)] = of_part;
        return seconds;
      };
      StepCost before         = seconds_of_parts();
      const double wall_start = MPI_Wtime(), start = processor_time();
      double n = 0, of_rank_0 = 0; // which decides for all
      while (!simulation.is_at_end() && more(n, of_rank_0, simulation.time()))
        {
          step(simulation, seen);
          ++n;
          of_rank_0 = Utilities::MPI::broadcast(communicator, processor_time() - start, 0);
        }
      StepCost cost;
      if (n == 0)
        return { cost, n };
      const double wall  = MPI_Wtime() - wall_start;
      const double total = Utilities::MPI::sum(processor_time() - start, communicator) / n;
      for (const auto &[part, seconds] : seconds_of_parts())
        cost[part] = total * (seconds - before[part]) / wall; // 0 s of new ones
      cost[other_parts] = std::max(0., total - seconds_of(cost));
      return { cost, n };
    }
  } // namespace


  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int most_steps = 2000;
    Observation seen                  = look_at(simulation);
    const double first                = core_seconds_of(communicator, [&] { step(simulation, seen); });
    std::tie(seen.first, seen.n_first) =
        steps_while(simulation, communicator, seen, [&](const double n, const double spent, const double) {
          return spent < seconds && n < most_steps;
        });
    if (seen.n_first == 0) // The run is one step long.
      seen.first[other_parts] = first;
    seen.later   = seen.first;
    seen.setup   = std::max(0., first - seconds_of(seen.first));
    seen.row     = mean_of_several(communicator, seconds, [&] { simulation.write_row(); });
    seen.picture = mean_of_several(communicator, seconds, [&] { simulation.write_picture(); });
    return seen;
  }


  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int least_steps = 10; // to take their time
    Observation seen                   = look_at(simulation);
    step(simulation, seen);
    std::tie(seen.first, seen.n_first) =
        steps_while(simulation, communicator, seen, [&](const double n, const double, const double time) {
          return time < begin || n < least_steps;
        });
    const auto [later, n_later] =
        steps_while(simulation, communicator, seen, [&](const double, const double spent, const double) {
          return spent < seconds;
        });
    seen.later = n_later > 0 ? later : seen.first;
    return seen;
  }

  template decltype(measure_first_steps<2>) measure_first_steps<2>;
  template decltype(measure_first_steps<3>) measure_first_steps<3>;
  template decltype(measure_run<2>) measure_run<2>;
  template decltype(measure_run<3>) measure_run<3>;
} // namespace scree
