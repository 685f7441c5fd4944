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
    OutputTimes(const OutputParameters &parameters, const double end_time);

    /// From here on, what is due comes after `time`.
    void begin(const double time);

    /// The time at which a step has to end next, for steps of `largest_step` s at most.
    double next(const double largest_step) const;

    bool is_end(const double time) const;
    bool picture_is_due(const double time) const;
    bool row_is_due(const double time) const;
    bool checkpoint_is_due(const double time) const;

  private:
    const double picture_interval, row_interval, checkpoint_interval, end_time;
    double picture = 0, row = 0, checkpoint = 0;
  };
} // namespace scree

#endif
