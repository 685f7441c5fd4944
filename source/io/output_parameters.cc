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
                      "true: maps of the soil on the columns of cells are written with each graphics output, for "
                      "instance thickness, largest speed and arrival time. 3D: rasters. 2D: tables along x.",
                      Patterns::Bool());
    prm.add_parameter("Least thickness",
                      least_thickness,
                      "m; thickness from which the arrival time and the speed of the soil are recorded.",
                      Patterns::Double(0));
    prm.add_parameter("Format",
                      format,
                      "3D. File format of the maps. ASCII grid: ESRI ASCII grids (.asc), each with a .prj file if the "
                      "coordinate system is known. GeoTIFF: compressed, with coordinate system (.tif). "
                      "ASCII grid and GeoTIFF: both.",
                      Patterns::Selection("ASCII grid|GeoTIFF|ASCII grid and GeoTIFF"));
    prm.leave_subsection();
  }


  void MapParameters::check(const bool has_soil, const unsigned int dim) const
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
                  "this entry has no effect. Remove it, or write \"Write = true\".");
    require_entry(write || format == MapParameters().format,
                  subsection,
                  "Format",
                  format,
                  "this entry has no effect. Remove it, or write \"Write = true\".");
    require_entry(dim == 3 || format == MapParameters().format,
                  subsection,
                  "Format",
                  format,
                  "maps of a scene in the plane are tables (.csv). Remove it.");
  }


  void OutputParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter("Interval", interval, "s; simulated time between graphics outputs.", Patterns::Double(1e-12));
    prm.add_parameter("Statistics interval",
                      statistics_interval,
                      "s; simulated time between rows of statistics; 0: as \"Interval\".",
                      Patterns::Double(0));
    prm.add_parameter("Checkpoint interval",
                      checkpoint_interval,
                      "s; simulated time between checkpoints, from which --resume continues; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter("Wall time limit",
                      wall_time_limit,
                      "s; wall-clock time within which the run writes a checkpoint and stops, so that --resume can "
                      "continue; 0: none. Choose a little less than the limit of the batch system.",
                      Patterns::Double(0));
    prm.add_parameter("Graphics",
                      graphics,
                      "Files for ParaView: points and grid, points, or none.",
                      Patterns::Selection("points and grid|points|none"));
    prm.add_parameter("Screen",
                      screen,
                      "Console output: progress; statistics (the last row only, for tests); nothing.",
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
