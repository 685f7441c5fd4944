// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_output_times_h
#define scree_postprocess_output_times_h

#include <scree/io/output_parameters.h>

namespace scree
{
  /// When a run writes what: all times are s of the run.
  class OutputTimes
  {
  public:
    /// Takes the intervals of the entries; begin() comes next.
    /// @param end_time of the run, s
    OutputTimes(const OutputParameters &parameters, const double end_time);

    /// From here on, what is due comes after `time`.
    void begin(const double time);

    /// The time at which a step has to end next, for steps of `largest_step` s at most.
    double next(const double largest_step) const;

    /// Whether the run ends at a time, s, within rounding.
    bool is_end(const double time) const;

    /// Whether a picture is due at a time, s.
    bool picture_is_due(const double time) const;

    /// Whether a row of the statistics is due at a time, s.
    bool row_is_due(const double time) const;

    /// Whether a checkpoint is due at a time, s; never if the interval is 0.
    bool checkpoint_is_due(const double time) const;

  private:
    const double picture_interval, row_interval, checkpoint_interval, end_time;
    double picture = 0, row = 0, checkpoint = 0;
  };
} // namespace scree

#endif
