// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics/column.h>

#include <map>

namespace scree
{
  namespace
  {
    template <int dim>
    using ColumnGroups =
        std::map<std::pair<ColumnTopic, std::string>, std::function<void(const Snapshot<dim> &, StatisticsRow &)>>;

    /// Made at the first call, whichever source file registers first.
    template <int dim>
    ColumnGroups<dim> &column_groups()
    {
      static ColumnGroups<dim> all;
      return all;
    }
  } // namespace


  void add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const double value)
  {
    row.emplace_back(unit.empty() ? name : name + " (" + unit + ')', value);
  }


  void add_value(StatisticsRow &row, const std::string &, const std::string &, const StatisticsRow &values)
  {
    row.insert(row.end(), values.begin(), values.end());
  }


  template <int dim>
  void RegisterColumns::insert(const ColumnTopic topic,
                               const std::string &name,
                               const std::function<void(const Snapshot<dim> &, StatisticsRow &)> &add)
  {
    column_groups<dim>()[{ topic, name }] = add;
  }


  template <int dim>
  StatisticsRow row_of(const Snapshot<dim> &now)
  {
    StatisticsRow row;
    for (const auto &[place, add] : column_groups<dim>())
      add(now, row);
    return row;
  }

  template void RegisterColumns::insert<2>(const ColumnTopic,
                                           const std::string &,
                                           const std::function<void(const Snapshot<2> &, StatisticsRow &)> &);
  template void RegisterColumns::insert<3>(const ColumnTopic,
                                           const std::string &,
                                           const std::function<void(const Snapshot<3> &, StatisticsRow &)> &);
  template StatisticsRow row_of(const Snapshot<2> &);
  template StatisticsRow row_of(const Snapshot<3> &);
} // namespace scree
