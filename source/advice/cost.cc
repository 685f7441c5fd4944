// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/cost.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  namespace
  {
    // Measured over the cases of prm/, doc/studies/pages/advice.md.

    /// Bulk modulus of soil in motion over that at the start, where it grows with the pressure: of the stiffest point.
    constexpr double stiffening = 1.5;

    /// Cost of plastic soil's stress update, mean of a run over the first steps.
    constexpr double plastic_flow = 1.2;

    /// Largest speed of the points, mean over a run, over that of a free fall by Scene::fall.
    constexpr double part_of_fall_speed = 0.8;

    /// Core-seconds of a picture and of a row of `statistics`: by themselves, a point, and a row written before (each
    /// row writes all).
    constexpr double picture_seconds = 8e-3, picture_seconds_per_point = 1.5e-6;
    constexpr double row_seconds = 5e-4, row_seconds_per_point = 3e-7, row_seconds_per_row = 1e-5;

    /// Steps of at most `step` s until the end, if they are shortened to meet the appointments.
    double count_steps(const Schedule &schedule, const double end_time, const double step)
    {
      const OutputParameters &output = schedule.output;
      double n = 0, time = 0;
      while (time < end_time * (1. - 1e-12))
        {
          double next = end_time;
          for (const double interval : { output.interval, output.interval_of_statistics(), output.checkpoint_interval })
            if (interval > 0)
              next = std::min(next, (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval);
          n += std::max(1., std::ceil((next - time) / step * (1. - 1e-12)));
          time = next;
        }
      return n;
    }

    double seconds_of_output(const Scene &scene, const OutputParameters &output)
    {
      const auto count = [&](const double interval) {
        return interval > 0 ? std::floor(scene.end_time / interval) + 1. : 0.;
      };
      const double pictures =
          (output.graphics == "none" ? 0. : count(output.interval)) + count(output.checkpoint_interval);
      const double rows = count(output.interval_of_statistics());
      return pictures * (picture_seconds + picture_seconds_per_point * scene.n_points()) +
             rows * (row_seconds + row_seconds_per_point * scene.n_points() + 0.5 * rows * row_seconds_per_row);
    }

    bool is_of_law(const std::string &part)
    {
      return part == "grid to points, stress";
    }
  } // namespace


  RunCost cost_of_run(const Scene &scene, const StepCost &first_steps, const Schedule &schedule)
  {
    const Clock clock(schedule.time_step);
    const auto step = [&](const double stiffness, const double speed) {
      return std::min(schedule.longest_step, clock.stable_step(scene.cell_size, scene.fastest.speed(stiffness), speed));
    };
    RunCost cost;
    cost.speed      = std::max(scene.initial_speed, part_of_fall_speed * std::sqrt(2. * scene.gravity * scene.fall));
    cost.first_step = step(1., scene.initial_speed);
    cost.mean_step  = step(scene.stiffens ? stiffening : 1., cost.speed);
    cost.n_steps    = count_steps(schedule, scene.end_time, cost.mean_step);

    double seconds = first_steps.seconds;
    for (const auto &[part, of_part] : first_steps.parts)
      if (is_of_law(part) && scene.has_soil && !scene.is_elastic)
        seconds += (plastic_flow - 1.) * of_part;
    cost.step_seconds   = cost.n_steps * seconds;
    cost.output_seconds = seconds_of_output(scene, schedule.output);
    cost.memory         = first_steps.memory;
    return cost;
  }


  Scene with_cell_size(Scene scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for (double *number : { &scene.n_cells, &scene.n_occupied, &scene.n_soil_points, &scene.n_water_points })
      *number *= factor;
    scene.cell_size = cell_size;
    return scene;
  }


  StepCost with_cell_size(StepCost steps, const Scene &scene, const double cell_size)
  {
    constexpr double program = 1.2e8; // bytes, without points and cells
    const double factor      = std::pow(scene.cell_size / cell_size, scene.dim);
    steps.seconds *= factor;
    for (auto &part : steps.parts)
      part.second *= factor;
    steps.memory = program + std::max(0., steps.memory - program) * factor;
    return steps;
  }


  StepCost without_water(StepCost steps, const Scene &scene)
  {
    const double soil = scene.n_soil_points / scene.n_points();
    double seconds    = 0;
    for (auto &[part, of_part] : steps.parts)
      {
        if (part.rfind("pressure", 0) == 0 || part == "grid to water points" || part == "nodes")
          of_part = 0;
        else if (!is_of_law(part))
          of_part *= soil;
        seconds += of_part;
      }
    steps.seconds = seconds;
    return steps;
  }
} // namespace scree
