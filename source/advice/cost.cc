// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/cost.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  namespace
  {
    /// Core-seconds of a checkpoint: by itself, and a point; measured over the cases of prm/.
    constexpr double checkpoint_seconds = 1.5e-3, checkpoint_seconds_per_point = 8e-7;

    /// Steps of a run, if nothing is to be written on the way, from its start to any time that is asked for; the times
    /// must not decrease.
    class StepsSoFar
    {
    public:
      StepsSoFar(const std::vector<Passage> &passages, const TimeStepper &clock, const double cell_size)
          : passages(passages)
          , clock(clock)
          , cell_size(cell_size)
      {
        Assert(!passages.empty(), dealii::ExcMessage("Nothing was seen of the run."));
      }

      double operator()(const double time)
      {
        while (time > begin + current().duration && index + 1 < passages.size())
          {
            n += current().duration / step();
            begin += current().duration;
            ++index;
          }
        return n + (time - begin) / step(); // The last passage goes on.
      }

      /// Length of the steps at the time that was asked for last, s.
      double step() const
      {
        return clock.stable_step(cell_size, current().wave, current().speed);
      }

    private:
      const Passage &current() const
      {
        return passages[index];
      }

      const std::vector<Passage> &passages;
      const TimeStepper &clock;
      const double cell_size;
      std::size_t index = 0;
      double begin = 0, n = 0; // of the current passage
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
    for (const Passage &passage : passages)
      sum += passage.duration;
    return sum;
  }


  RunCost cost_of_run(const SceneNumbers &scene, const Observation &seen, const Schedule &schedule)
  {
    const TimeStepper clock(schedule.time_step);
    StepsSoFar so_far(seen.passages, clock, scene.cell_size);
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
    for (const Passage &passage : pilot.passages)
      {
        const double end = begin + passage.duration;
        if (end > time)
          first_steps.passages.push_back({ end - std::max(begin, time), passage.wave, passage.speed });
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
} // namespace scree
