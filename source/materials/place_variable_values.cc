// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/place_variable_values.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PlaceVariableValues<dim>::PlaceVariableValues(const PlaceVariable &variable, const std::string &subsection)
      : variable(variable)
      , name(entry_name(subsection, variable.entry) + " = " + variable.expression)
      , expression(
            parse_expression<dim>(entry_name(subsection, variable.entry), variable.expression, 1, false, "5e3 - 2e3*y"))
  {
  }


  template <int dim>
  void PlaceVariableValues<dim>::set(const Point<dim> &place, const double depth, double *internal_variables) const
  {
    const double value = expression->value(place) + variable.gradient * depth;
    const auto fault   = [&](const std::string &remedy) {
      return ValueError(name + ": the value at " + number_text(place) + " m is " + number_text(value) + ". " + remedy);
    };
    if (!(value > 0))
      throw fault("Write an expression that is positive in the whole body.");
    if (value > variable.largest)
      throw fault("Beyond " + number_text(variable.largest) + ", " + variable.remedy);
    internal_variables[variable.number] = value;
  }

  template class PlaceVariableValues<2>;
  template class PlaceVariableValues<3>;
} // namespace scree
