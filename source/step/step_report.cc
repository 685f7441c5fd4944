// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/step_report.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const char *const names[] = { "non-local strain",
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
  } // namespace


  std::string name_of(const TimerSection part)
  {
    return names[static_cast<unsigned int>(part)];
  }


  std::vector<TimerSection> step_parts()
  {
    std::vector<TimerSection> parts;
    for (unsigned int part = 0; part < std::size(names); ++part)
      parts.push_back(static_cast<TimerSection>(part));
    return parts;
  }


  double seconds_of(const TimerOutput &timer, const TimerSection part)
  {
    const auto seconds = timer.get_summary_data(TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }
} // namespace scree
