// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_time_label_h
#define scree_io_time_label_h

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
} // namespace scree

#endif
