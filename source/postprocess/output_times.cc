// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/output_times.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  namespace
  {
    /// The first multiple of `interval` after `time`; never, if there is no interval.
    double first_after(const double time, const double interval)
    {
      return interval > 0 ? (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval
                          : std::numeric_limits<double>::infinity();
    }

    /// Times that differ by rounding only are one.
    bool reached(const double time, const double due)
    {
      return time >= due * (1. - 1e-12);
    }
  } // namespace


  OutputTimes::OutputTimes(const OutputParameters &parameters, const double end_time)
      : picture_interval(parameters.interval)
      , row_interval(parameters.interval_of_statistics())
      , checkpoint_interval(parameters.checkpoint_interval)
      , end_time(end_time)
  {
  }


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


  bool OutputTimes::is_end(const double time) const
  {
    return reached(time, end_time);
  }


  bool OutputTimes::picture_is_due(const double time) const
  {
    return reached(time, picture);
  }


  bool OutputTimes::row_is_due(const double time) const
  {
    return reached(time, row);
  }


  bool OutputTimes::checkpoint_is_due(const double time) const
  {
    return checkpoint_interval > 0 && reached(time, checkpoint);
  }
} // namespace scree
