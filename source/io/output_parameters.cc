// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/output_parameters.h>
#include <scree/io/progress.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Digits behind the point that a number needs, at most 12.
    int decimals_of(const double number)
    {
      constexpr double rounding = 1e-9; // of the number
      int decimals              = 0;
      for (double scaled = number; decimals < 12 && std::abs(scaled - std::round(scaled)) > rounding * scaled;
           scaled *= 10.)
        ++decimals;
      return decimals;
    }
  } // namespace


  TimeLabel::TimeLabel(const double end_time, const double interval)
      : decimals(std::max(decimals_of(end_time), decimals_of(interval)))
  {
    width = formatted("%.*f", decimals, end_time).size();
  }


  std::string TimeLabel::operator()(const double time) const
  {
    return formatted("%0*.*fs", width, decimals, time);
  }


  void MapParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Maps");
    prm.add_parameter("Write",
                      write,
                      "true: maps of the soil on the columns of cells are written with each graphics output, for "
                      "instance thickness, largest speed and arrival time. 3D: rasters. 2D: tables along x.");
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
                  { subsection, "Write", "true" },
                  "maps are of soil, and there is none: entry \"Bodies\" is none. Remove it.");
    require_entry(write || least_thickness == MapParameters().least_thickness,
                  { subsection, "Least thickness", least_thickness },
                  "this entry has no effect. Remove it, or write \"Write = true\".");
    require_entry(write || format == MapParameters().format,
                  { subsection, "Format", format },
                  "this entry has no effect. Remove it, or write \"Write = true\".");
    require_entry(dim == 3 || format == MapParameters().format,
                  { subsection, "Format", format },
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
                    { "Output", name, interval },
                    "until \"End time\" = " + number_text(end_time) + " s it would be due " +
                        number_text(end_time / interval) + " times, and at most 1e8 are possible. Write a longer one.");
  }


  namespace
  {
    /// The first multiple of `interval` after `time`; never, if there is no interval.
    double first_after(const double time, const double interval)
    {
      return interval > 0 ? (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval
                          : std::numeric_limits<double>::infinity();
    }
  } // namespace


  void OutputTimes::begin(const double time)
  {
    picture    = first_after(time, picture_interval);
    row        = first_after(time, row_interval);
    checkpoint = first_after(time, checkpoint_interval);
  }


  double OutputTimes::next(const double largest_step) const
  {
    const auto due     = { end_time, picture, row, checkpoint };
    const double first = std::min(due);
    // Those that follow at once are met together: in a step that is far shorter than the others the pressure would
    // answer to what divergence the last one left with a shock.
    double last = first;
    for (const double time : due)
      if (time <= first + 0.1 * largest_step)
        last = std::max(last, time);
    return std::min(last, end_time);
  }
} // namespace scree
