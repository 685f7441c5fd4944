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

    /// How long dry soil moves, over sqrt(H/g); water keeps it moving.
    constexpr double motion_lasts = 5.;

    /// Largest speed of the points in motion over that of a free fall by SceneNumbers::fall.
    constexpr double part_of_fall_speed = 0.8;

    /// Bulk modulus of soil in motion over that at the start, where it grows with the pressure: bodies that fall by d
    /// press on what is below with about rho g d more.
    double stiffening(const SceneNumbers &scene)
    {
      if (!scene.stiffens || scene.fastest.pressure <= 0)
        return 1.;
      return 1. + scene.fastest.density * scene.gravity * scene.fall / scene.fastest.pressure;
    }

    /// Cost of the stress update over that of the first steps: in motion 1 + this times the strain of a step at the
    /// rate sqrt(g/H), over the strain at which the law divides it; at rest.
    constexpr double substeps_of_strain = 0.33, resting_update = 0.65;

    /// Core-seconds of a picture and of a row of `statistics`: by themselves, and a point.
    constexpr double picture_seconds = 1.5e-3, picture_seconds_per_point = 8e-7;
    constexpr double row_seconds = 5e-5, row_seconds_per_point = 1.5e-7;

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

    double seconds_of_output(const SceneNumbers &scene, const OutputParameters &output)
    {
      const auto count = [&](const double interval) {
        return interval > 0 ? std::floor(scene.end_time / interval) + 1. : 0.;
      };
      const double pictures =
          (output.graphics_kind() == Pictures::none ? 0. : count(output.interval)) + count(output.checkpoint_interval);
      const double rows = count(output.interval_of_statistics());
      return pictures * (picture_seconds + picture_seconds_per_point * scene.n_points()) +
             rows * (row_seconds + row_seconds_per_point * scene.n_points());
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
    const auto add =
        [&](const double begin, const double end, const double step, const double update_factor, const double more) {
          const double n = count_steps(schedule.output, begin, end, step);
          cost.n_steps += n;
          cost.step_seconds += n * (first_steps.seconds + (update_factor - 1.) * update + more);
        };
    const bool flows    = scene.has_soil && !scene.is_elastic && scene.gravity > 0;
    const double rate   = std::sqrt(scene.gravity / scene.height); // 1/s
    const double motion = flows && !scene.has_water ? std::min(scene.end_time, motion_lasts / rate) : scene.end_time;
    const double speed = std::max(scene.initial_speed, part_of_fall_speed * std::sqrt(2. * scene.gravity * scene.fall));
    const double in_motion  = step_at(stiffening(scene), speed);
    const double leave_cell = speed * in_motion / scene.cell_size; // part of the points, in a step
    const double more       = first_steps.sorting * std::min(1., leave_cell / PointSet<2>::most_moved);
    add(0, motion, in_motion, flows ? 1. + substeps_of_strain * in_motion * rate / scene.substep_strain : 1., more);
    add(motion, scene.end_time, step_at(1., 0.), resting_update, 0.);
    cost.first_step     = step_at(1., scene.initial_speed);
    cost.mean_step      = scene.end_time / cost.n_steps;
    cost.output_seconds = seconds_of_output(scene, schedule.output);
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
    steps.seconds *= factor;
    steps.sorting *= factor;
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
    steps.sorting *= soil;
    return steps;
  }
} // namespace scree
