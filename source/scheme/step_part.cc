// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/step_part.h>

namespace scree
{
  using namespace dealii;

  std::string name_of(const StepPart part)
  {
    switch (part)
      {
      case StepPart::points_to_grid:
        return "points to grid";
      case StepPart::nodes:
        return "nodes";
      case StepPart::bed:
        return "contact with the bed";
      case StepPart::contacts:
        return "contact between bodies";
      case StepPart::pressure_system:
        return "pressure: system";
      case StepPart::pressure_solve:
        return "pressure: solve";
      case StepPart::stress:
        return "grid to points, stress";
      case StepPart::water_points:
        return "grid to water points";
      case StepPart::sort:
        return "sort into cells and ranks";
      case StepPart::waiting:
        return "waiting for other ranks";
      case StepPart::repartition:
        return "repartition";
      default:
        return "output";
      }
  }


  double seconds_of(const TimerOutput &timer, const StepPart part)
  {
    const auto seconds = timer.get_summary_data(TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }
} // namespace scree
