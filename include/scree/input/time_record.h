// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_time_record_h
#define scree_input_time_record_h

#include <algorithm>
#include <vector>

namespace scree
{
  /// A quantity over time: linear between rows, 0 before the first and after the last.
  /// @tparam Value a number or a tensor of them
  template <typename Value>
  class TimeRecord
  {
  public:
    /// The value at a time.
    struct Row
    {
      double time;    ///< s
      Value value;    ///< at this time
      Value integral; ///< of the value up to here
    };

    /// Adds a row, later than those before.
    void add(const double time, const Value &value)
    {
      Value integral = Value();
      if (!all.empty())
        integral = all.back().integral + 0.5 * (time - all.back().time) * (value + all.back().value);
      all.push_back({ time, value, integral });
    }

    /// All rows in the order of time.
    const std::vector<Row> &rows() const
    {
      return all;
    }

    /// Value at a time, s.
    Value value(const double time) const
    {
      const auto next = first_after(time);
      if (next == all.begin() || next == all.end())
        return Value();
      const Row &row = *(next - 1);
      return row.value + (time - row.time) * slope(row, *next);
    }

    /// The integral up to a time.
    Value integral(const double time) const
    {
      const auto next = first_after(time);
      if (next == all.begin())
        return Value();
      const Row &row = *(next - 1);
      if (next == all.end())
        return row.integral;
      const double since = time - row.time;
      return row.integral + since * row.value + 0.5 * since * since * slope(row, *next);
    }

  private:
    typename std::vector<Row>::const_iterator first_after(const double time) const
    {
      return std::upper_bound(
          all.begin(), all.end(), time, [](const double t, const Row &row) { return t < row.time; });
    }

    static Value slope(const Row &row, const Row &next)
    {
      return (next.value - row.value) / (next.time - row.time);
    }

    std::vector<Row> all;
  };
} // namespace scree

#endif
