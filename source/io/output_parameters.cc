// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/output_parameters.h>

#include <map>

namespace scree
{
  using namespace dealii;

  void MapParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Maps");
    prm.add_parameter("Write",
                      write,
                      "Whether maps of the soil (thickness, largest speed, arrival time, ...) on the columns of cells "
                      "are written with each picture: ESRI ASCII grids, in 2D tables along x.",
                      Patterns::Bool());
    prm.add_parameter("Least thickness",
                      least_thickness,
                      "Thickness, m, from which on soil counts as arrived, and its speed as that of the column.",
                      Patterns::Double(0));
    prm.leave_subsection();
  }


  void MapParameters::check(const bool has_soil) const
  {
    const std::string subsection = "Output/Maps";
    require_entry(!write || has_soil,
                  subsection,
                  "Write",
                  "true",
                  "maps are of soil, and there is none: entry \"Bodies\" is none. Remove it.");
    require_entry(write || least_thickness == MapParameters().least_thickness,
                  subsection,
                  "Least thickness",
                  least_thickness,
                  "nothing reads it. Remove it, or write \"Write = true\".");
  }


  void OutputParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter("Interval", interval, "Simulated time between pictures, s.", Patterns::Double(1e-12));
    prm.add_parameter("Statistics interval",
                      statistics_interval,
                      "Simulated time between rows of the file statistics, s; 0: as 'Interval'.",
                      Patterns::Double(0));
    prm.add_parameter("Checkpoint interval",
                      checkpoint_interval,
                      "Simulated time between checkpoints, from which --resume goes on, s; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Checkpoint failure",
        checkpoint_failure,
        "What follows if a checkpoint cannot be written: stop; go on (the next one is tried when it is due).",
        Patterns::Selection("stop|go on"));
    prm.add_parameter("Wall time limit",
                      wall_time_limit,
                      "Time of the clock on the wall, s, within which the run writes a checkpoint and ends, so that "
                      "--resume can go on: a little less than what a batch system grants; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter("Graphics",
                      graphics,
                      "What is written for ParaView: points and grid, points, or none.",
                      Patterns::Selection("points and grid|points|none"));
    prm.add_parameter("Screen",
                      screen,
                      "What appears on the screen: progress; statistics (the last row only, for tests); nothing.",
                      Patterns::Selection("progress|statistics|nothing"));
    maps.add_parameters(prm);
    prm.leave_subsection();
  }


  void OutputParameters::check(const double end_time) const
  {
    constexpr double most = 1e8; // times at which a run meets an output, each with a step of its own
    for (const auto &[name, interval] : { std::make_pair("Interval", interval),
                                          { "Statistics interval", statistics_interval },
                                          { "Checkpoint interval", checkpoint_interval } })
      require_entry(interval == 0 || end_time / interval <= most,
                    "Output",
                    name,
                    interval,
                    "until \"End time\" = " + number_text(end_time) + " s it would be due " +
                        number_text(end_time / interval) + " times, and at most 1e8 are possible. Write a longer one.");
  }


  Screen OutputParameters::screen_kind() const
  {
    static const std::map<std::string, Screen> table{ { "progress", Screen::progress },
                                                      { "statistics", Screen::statistics },
                                                      { "nothing", Screen::nothing } };
    return table.at(screen);
  }


  Pictures OutputParameters::graphics_kind() const
  {
    return graphics == "none" ? Pictures::none : graphics == "points" ? Pictures::points : Pictures::points_and_grid;
  }


  double OutputParameters::interval_of_statistics() const
  {
    return statistics_interval > 0 ? statistics_interval : interval;
  }
} // namespace scree
