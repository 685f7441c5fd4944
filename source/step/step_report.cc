// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/step_report.h>

namespace scree
{
  using namespace dealii;

  std::string name_of(const TimerSection part)
  {
    switch (part)
      {
      case TimerSection::nonlocal:
        return "non-local strain";
      case TimerSection::points_to_grid:
        return "points to grid";
      case TimerSection::nodes:
        return "nodes";
      case TimerSection::bed:
        return "contact with the bed";
      case TimerSection::contacts:
        return "contact between bodies";
      case TimerSection::pressure_system:
        return "pressure: system";
      case TimerSection::pressure_solve:
        return "pressure: solve";
      case TimerSection::stress:
        return "grid to points, stress";
      case TimerSection::water_points:
        return "grid to water points";
      case TimerSection::sort:
        return "sort into cells and ranks";
      case TimerSection::waiting:
        return "waiting for other ranks";
      case TimerSection::repartition:
        return "repartition";
      default:
        return "output";
      }
  }


  double seconds_of(const TimerOutput &timer, const TimerSection part)
  {
    const auto seconds = timer.get_summary_data(TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }
} // namespace scree
