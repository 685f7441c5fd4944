// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/step_report.h>

namespace scree
{
  using namespace dealii;

  std::string name_of(const TimerSection part)
  {
    static const char *const names[] = { "non-local strain",
                                         "points to grid",
                                         "nodes",
                                         "contact with the bed",
                                         "contact between bodies",
                                         "pressure: system",
                                         "pressure: solve",
                                         "grid to points, stress",
                                         "grid to water points",
                                         "sort into cells and ranks",
                                         "waiting for other ranks",
                                         "repartition",
                                         "output" };
    static_assert(std::size(names) == step_parts.size());
    return names[static_cast<unsigned int>(part)];
  }


  double seconds_of(const TimerOutput &timer, const TimerSection part)
  {
    const auto seconds = timer.get_summary_data(TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }
} // namespace scree
