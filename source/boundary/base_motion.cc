// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/input/named_file.h>
#include <scree/input/number_table.h>
#include <scree/boundary/base_motion.h>

#include <deal.II/base/array_view.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  void BaseMotionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Base motion");
    add_file_entry(prm,
                   "Acceleration record",
                   record,
                   "File of the acceleration of the box with all its walls; empty: at rest. Each line has the time (s) "
                   "and one component per axis, separated by commas. Values are linear between lines and 0 outside the "
                   "record. Results are relative to the box.");
    prm.add_parameter(
        "Scale", scale, "Factor that converts the record to m/s^2; 9.81 if it is in g.", Patterns::Double());
    prm.leave_subsection();
  }


  void BaseMotionParameters::check(const unsigned int dim) const
  {
    require_entry(!record.empty() || scale == BaseMotionParameters().scale,
                  "Base motion",
                  "Scale",
                  scale,
                  "there is nothing to scale. Write an \"Acceleration record\", or remove the entry.");
    if (record.empty())
      return;
    if (dim == 2)
      BaseMotion<2>{ *this };
    else
      BaseMotion<3>{ *this };
  }


  template <int dim>
  BaseMotion<dim>::BaseMotion(const BaseMotionParameters &parameters)
  {
    std::vector<std::string> columns{ "time (s)", "acceleration along x", "along y", "along z" };
    columns.resize(1 + dim);
    for (const auto &numbers :
         read_number_table(parameters.record, entry_name("Base motion", "Acceleration record"), columns))
      acceleration.add(numbers[0],
                       parameters.scale * Tensor<1, dim>(make_array_view(numbers.begin() + 1, numbers.end())));
  }


  template <int dim>
  std::string BaseMotion<dim>::text() const
  {
    const auto &rows = acceleration.rows();
    double largest   = 0;
    for (const auto &row : rows)
      largest = std::max(largest, row.value.norm());
    return "Base motion: " + std::to_string(rows.size()) + " rows from " + number_text(rows.front().time) + " to " +
           number_text(rows.back().time) + " s, at most " + number_text(largest) +
           " m/s^2; the base's velocity after it is " + number_text(rows.back().integral.norm()) + " m/s";
  }

  template class BaseMotion<2>;
  template class BaseMotion<3>;
} // namespace scree
