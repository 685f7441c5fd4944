// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_column_h
#define scree_postprocess_statistics_column_h

#include <scree/postprocess/statistics/snapshot.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// Values by the whole names of their columns, such as `Mass (kg)`.
  using StatisticsRow = std::vector<std::pair<std::string, double>>;

  /// Where columns stand in a row, from left to right.
  enum class ColumnTopic
  {
    run,
    soil,
    lost,
    water,
    rigid,
    inflows,
    work,
    further
  };

  /// Columns of any scene.
  struct Always
  {
    /// True.
    template <typename Snapshot>
    bool operator()(const Snapshot &) const
    {
      return true;
    }
  };

  /// A column of the file `statistics`. Its functions take a Snapshot<2> or a Snapshot<3>; `value` may be collective.
  template <typename Value, typename Exists = Always>
  struct Column
  {
    std::string name;   ///< without unit
    std::string unit;   ///< empty: none
    Value value;        ///< a number; a vector has a column an axis; a StatisticsRow has names of its own
    Exists exists = {}; ///< whether the scene has it: the same in all rows
  };

  /// A column of any scene.
  template <typename Value>
  Column(const char *, const char *, Value) -> Column<Value>;

  /// A column of some scenes.
  template <typename Value, typename Exists>
  Column(const char *, const char *, Value, Exists) -> Column<Value, Exists>;

  /// Adds a value under its column's whole name.
  void add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const double value);

  /// Adds values that have whole names.
  void add_value(StatisticsRow &row, const std::string &, const std::string &, const StatisticsRow &values);

  /// Adds a vector: a column an axis.
  template <int dim>
  void
  add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const dealii::Tensor<1, dim> &value)
  {
    for (unsigned int a = 0; a < dim; ++a)
      add_value(row, name + ' ' + "xyz"[a], unit, value[a]);
  }

  /// All registered columns of a scene, in their order. Collective.
  template <int dim>
  StatisticsRow row_of(const Snapshot<dim> &now);

  /// Adds columns to the statistics; their source file has one as a static constant.
  class RegisterColumns
  {
  public:
    /// Columns at the end of the row, in the order of the first one's name.
    template <typename... Value, typename... Exists>
    explicit RegisterColumns(const Column<Value, Exists> &...columns)
        : RegisterColumns(ColumnTopic::further, Always(), columns...)
    {
    }

    /// Columns of scenes for which `exists` is true.
    template <typename Exists, typename First, typename... Others>
    RegisterColumns(const ColumnTopic topic, const Exists &exists, const First &first, const Others &...others)
    {
      const auto add = [=](const auto &now, StatisticsRow &row) {
        if (exists(now))
          (add_column(first, now, row), ..., add_column(others, now, row));
      };
      insert<2>(topic, first.name, add);
      insert<3>(topic, first.name, add);
    }

  private:
    template <typename AnyColumn, typename AnySnapshot>
    static void add_column(const AnyColumn &column, const AnySnapshot &now, StatisticsRow &row)
    {
      if (column.exists(now))
        add_value(row, column.name, column.unit, column.value(now));
    }

    template <int dim>
    void insert(const ColumnTopic topic,
                const std::string &name,
                const std::function<void(const Snapshot<dim> &, StatisticsRow &)> &add);
  };
} // namespace scree

#endif
