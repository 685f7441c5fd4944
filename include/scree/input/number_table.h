// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_number_table_h
#define scree_input_number_table_h

#include <algorithm>
#include <fstream>
#include <string>
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

  /// Opens a file that an entry names, behind a mark of byte order if it begins with one; throws EntryError if that
  /// fails.
  /// @param name entry_name() and the file's, for the message: `entry "Record" = a.csv: `
  std::ifstream open_file(const std::string &file, const std::string &name);

  /// What the first column of a table must be.
  enum class FirstColumn
  {
    ascending,
    any
  };

  /// Reads a file of numbers, a row a line, separated by commas or blanks; what follows a # is a comment, and the first
  /// line may name the columns.
  ///
  /// @param where entry_name() of the entry that names the file
  /// @param columns names with unit, for messages: { "x (m)", "y (m)" }
  /// Throws EntryError if there are not at least two such rows.
  std::vector<std::vector<double>> read_number_table(const std::string &file,
                                                     const std::string &where,
                                                     const std::vector<std::string> &columns,
                                                     const FirstColumn first_column = FirstColumn::ascending);
} // namespace scree

#endif
