// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_output_parameters_h
#define scree_io_output_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace scree
{
  /// Times in the names of files, such as `05.0s`: of the same length for all times of a run, so that the names sort.
  class TimeLabel
  {
  public:
    /// @param end_time of the run, s: its digits before the point
    /// @param interval of the files, s: its digits behind the point
    TimeLabel(const double end_time, const double interval);

    /// The label of a time from 0 to the end, s.
    std::string operator()(const double time) const;

  private:
    int width, decimals;
  };

  /// What a run prints on the screen.
  enum class Screen
  {
    progress,   ///< start, progress with time left, timings
    statistics, ///< the last row of the statistics only: numbers that do not depend on the machine
    nothing
  };

  /// The pictures a run writes.
  enum class Pictures
  {
    none,
    points,
    points_and_grid
  };

  /// Subsection Maps of subsection Output.
  struct MapParameters
  {
    bool write             = false;        ///< whether maps are written with each picture
    double least_thickness = 0;            ///< m, of soil that counts as having arrived
    std::string format     = "ASCII grid"; ///< ASCII grid | GeoTIFF | ASCII grid and GeoTIFF, in 3D

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at maps of a scene that has none, and at formats that it or the program does not have.
    void check(const bool has_soil, const unsigned int dim) const;
  };

  /// Subsection Output.
  struct OutputParameters
  {
    double interval            = 0.1;               ///< s, of pictures
    double statistics_interval = 0;                 ///< s; 0: as pictures
    double checkpoint_interval = 0;                 ///< s; 0: none
    double wall_time_limit     = 0;                 ///< s of the clock on the wall; 0: none
    std::string graphics       = "points and grid"; ///< points and grid | points | none
    std::string screen         = "progress";        ///< progress | statistics | nothing
    MapParameters maps;                             ///< subsection Maps

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at an interval that no run to `end_time`, s, can meet.
    void check(const double end_time) const;

    /// Entry `Screen` as an enum.
    Screen screen_kind() const
    {
      static const std::map<std::string, Screen> table{ { "progress", Screen::progress },
                                                        { "statistics", Screen::statistics },
                                                        { "nothing", Screen::nothing } };
      return table.at(screen);
    }

    /// Entry `Graphics` as an enum.
    Pictures graphics_kind() const
    {
      return graphics == "none" ? Pictures::none : graphics == "points" ? Pictures::points : Pictures::points_and_grid;
    }

    /// Time between rows of statistics, s; that of pictures by default.
    double interval_of_statistics() const
    {
      return statistics_interval > 0 ? statistics_interval : interval;
    }
  };

  /// When a run writes what: all times are s of the run.
  class OutputTimes
  {
  public:
    /// Takes the intervals of the entries; begin() comes next.
    /// @param end_time of the run, s
    OutputTimes(const OutputParameters &parameters, const double end_time)
        : picture_interval(parameters.interval)
        , row_interval(parameters.interval_of_statistics())
        , checkpoint_interval(parameters.checkpoint_interval)
        , end_time(end_time)
    {
    }

    /// From here on, what is due comes after `time`.
    void begin(const double time);

    /// The time at which a step has to end next, for steps of `largest_step` s at most.
    double next(const double largest_step) const;

    /// Whether the run ends at a time, s, within rounding.
    bool is_end(const double time) const
    {
      return reached(time, end_time);
    }

    /// Whether a picture is due at a time, s.
    bool picture_is_due(const double time) const
    {
      return reached(time, picture);
    }

    /// Whether a row of the statistics is due at a time, s.
    bool row_is_due(const double time) const
    {
      return reached(time, row);
    }

    /// Whether a checkpoint is due at a time, s; never if the interval is 0.
    bool checkpoint_is_due(const double time) const
    {
      return checkpoint_interval > 0 && reached(time, checkpoint);
    }

  private:
    /// Times that differ by rounding only are one.
    static bool reached(const double time, const double due)
    {
      return time >= due * (1. - 1e-12);
    }

    const double picture_interval, row_interval, checkpoint_interval, end_time;
    double picture = 0, row = 0, checkpoint = 0;
  };
} // namespace scree

#endif
