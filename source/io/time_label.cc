// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/time_label.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace scree
{
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
    std::ostringstream longest;
    longest << std::fixed << std::setprecision(decimals) << end_time;
    width = static_cast<int>(longest.str().size());
  }


  std::string TimeLabel::operator()(const double time) const
  {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << std::setfill('0') << std::setw(width) << time << 's';
    return text.str();
  }
} // namespace scree
