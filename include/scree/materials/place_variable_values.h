// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_place_variable_values_h
#define scree_materials_place_variable_values_h

#include <scree/input/expression.h>
#include <scree/materials/material.h>

#include <memory>
#include <string>

namespace scree
{
  /// Gives points the variable of their law that depends on the place, see PlaceVariable.
  template <int dim>
  class PlaceVariableValues
  {
  public:
    /// Reads the expression. Throws EntryError, which names the entry in this subsection, if it is none.
    PlaceVariableValues(const PlaceVariable &variable, const std::string &subsection);

    /// Sets the variable at a place. Throws ValueError if the value is not positive, or beyond what the law can follow.
    /// @param depth below the surface, m
    void set(const dealii::Point<dim> &place, const double depth, double *internal_variables) const;

  private:
    const PlaceVariable variable;
    const std::string name; // of the entry, and its text
    const std::unique_ptr<Expression<dim>> expression;
  };
} // namespace scree

#endif
