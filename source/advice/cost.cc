// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/cost.h>
#include <scree/points/point_set.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  namespace
  {
    // Measured over the cases of prm/, doc/studies/pages/advice.md.

    /// What falls from rest moves at first with this part of gravity.
    constexpr double part_of_gravity = 0.5;

    /// How long dry soil moves, over sqrt(H/g); water keeps it moving.
    constexpr double motion_lasts = 5.;

    /// Largest speed of the points in motion over that of a free fall by SceneNumbers::fall.
    constexpr double part_of_fall_speed = 0.8;

    /// Mean speed over the largest one.
    constexpr double mean_speed = 0.5;

    /// Bulk modulus of soil in motion over that at the start, where it grows with the pressure: bodies that fall by d
    /// press on what is below with about rho g d more.
    double stiffening(const SceneNumbers &scene, const double fall)
    {
      if (!scene.stiffens || scene.fastest.pressure <= 0)
        return 1.;
      return 1. + scene.fastest.density * scene.gravity * fall / scene.fastest.pressure;
    }

    /// Cost of the stress update over that of the first steps: in motion 1 + this times the strain of a step at the
    /// rate sqrt(g/H), over the strain at which the law divides it; at rest.
    constexpr double substeps_of_strain = 0.33, resting_update = 0.65;

    /// Cost of the pressure's solves, where soil or water falls, over that of the first steps; with volume correction,
    /// which begins as the water crowds, and of the water's points then.
    constexpr double solve_in_motion = 2., solve_with_correction = 2.5, water_with_correction = 1.7;

    /// Core-seconds of a checkpoint: by itself, and a point.
    constexpr double checkpoint_seconds = 1.5e-3, checkpoint_seconds_per_point = 8e-7;

    /// Steps of at most `step` s from `begin` to `end`, s, if they are shortened to meet the output times.
    double count_steps(const OutputParameters &output, const double begin, const double end, const double step)
    {
      double n = 0, time = begin;
      while (time < end * (1. - 1e-12))
        {
          double next = end;
          for (const double interval : { output.interval, output.interval_of_statistics(), output.checkpoint_interval })
            if (interval > 0)
              next = std::min(next, (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval);
          n += std::max(1., std::ceil((next - time) / step * (1. - 1e-12)));
          time = next;
        }
      return n;
    }

    double seconds_of_output(const SceneNumbers &scene, const StepCost &steps, const OutputParameters &output)
    {
      const auto count = [&](const double interval) {
        return interval > 0 ? std::floor(scene.end_time / interval) + 1. : 0.;
      };
      return count(output.interval) * steps.picture + count(output.interval_of_statistics()) * steps.row +
             count(output.checkpoint_interval) * (checkpoint_seconds + checkpoint_seconds_per_point * scene.n_points());
    }

    /// Core-seconds of a part of a step; 0 if it was not met.
    double seconds_of(const StepCost &steps, const StepPart part)
    {
      const auto found = steps.parts.find(part);
      return found == steps.parts.end() ? 0. : found->second;
    }
  } // namespace


  RunCost cost_of_run(const SceneNumbers &scene, const StepCost &first_steps, const Schedule &schedule)
  {
    const Clock clock(schedule.time_step);
    const auto step_at = [&](const double stiffness, const double speed) {
      return clock.stable_step(scene.cell_size, scene.fastest.speed(stiffness), speed);
    };
    const double update = seconds_of(first_steps, StepPart::stress);

    RunCost cost;
    // Core-seconds that a step takes more than the first ones, which are known.
    const auto add = [&](const double begin, const double end, const double step, const double more) {
      const double n     = count_steps(schedule.output, begin, end, step);
      const double known = std::clamp(first_steps.n_steps - cost.n_steps, 0., n);
      cost.n_steps += n;
      cost.step_seconds += n * first_steps.seconds + (n - known) * more;
    };
    const bool flows    = scene.has_soil && !scene.is_elastic && scene.gravity > 0;
    const double rate   = std::sqrt(scene.gravity / scene.height); // 1/s
    const double motion = flows && !scene.has_water ? std::min(scene.end_time, motion_lasts / rate) : scene.end_time;
    const bool falls    = scene.falls() && (flows || !scene.has_soil);
    // How far motion comes until the end of the run.
    const double fall = std::min(scene.fall, 0.5 * part_of_gravity * scene.gravity * scene.end_time * scene.end_time);
    const double strain_rate = rate * std::min(1., part_of_gravity * scene.end_time * rate);
    const double speed       = std::max(scene.initial_speed, part_of_fall_speed * std::sqrt(2. * scene.gravity * fall));
    const double in_motion   = step_at(stiffening(scene, fall), speed);
    const double leave_cell  = mean_speed * speed * in_motion / scene.cell_size; // part of the points, in a step
    double more              = first_steps.sorting * std::min(1., leave_cell / PointSet<2>::most_moved);
    if (flows)
      more += substeps_of_strain * in_motion * strain_rate / scene.substep_strain * update;
    if (falls)
      more += ((scene.corrects_volume ? solve_with_correction : solve_in_motion) - 1.) *
              seconds_of(first_steps, StepPart::pressure_solve);
    if (falls && scene.corrects_volume)
      more += (water_with_correction - 1.) * seconds_of(first_steps, StepPart::water_points);
    add(0, motion, in_motion, more);
    add(motion, scene.end_time, step_at(1., 0.), (resting_update - 1.) * update);
    cost.first_step = step_at(1., scene.initial_speed);
    cost.mean_step  = scene.end_time / cost.n_steps;
    cost.step_seconds += first_steps.first_seconds;
    cost.output_seconds = seconds_of_output(scene, first_steps, schedule.output);
    cost.memory         = first_steps.memory;
    return cost;
  }


  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for (double *number : { &scene.n_cells, &scene.n_occupied, &scene.n_soil_points, &scene.n_water_points })
      *number *= factor;
    scene.cell_size = cell_size;
    return scene;
  }


  StepCost with_cell_size(StepCost steps, const SceneNumbers &scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for (double *seconds : { &steps.seconds, &steps.first_seconds, &steps.sorting, &steps.picture, &steps.row })
      *seconds *= factor;
    for (auto &part : steps.parts)
      part.second *= factor;
    steps.memory = steps.program_memory + std::max(0., steps.memory - steps.program_memory) * factor;
    return steps;
  }


  StepCost without_water(StepCost steps, const SceneNumbers &scene)
  {
    const double soil = scene.n_soil_points / scene.n_points();
    double seconds    = 0;
    for (auto &[part, of_part] : steps.parts)
      {
        switch (part)
          {
          case StepPart::nodes:
          case StepPart::pressure_system:
          case StepPart::pressure_solve:
          case StepPart::water_points:
            of_part = 0;
            break;
          case StepPart::stress:
            break;
          default:
            of_part *= soil;
          }
        seconds += of_part;
      }
    steps.seconds = seconds;
    for (double *seconds : { &steps.first_seconds, &steps.sorting, &steps.picture, &steps.row })
      *seconds *= soil;
    return steps;
  }
} // namespace scree
