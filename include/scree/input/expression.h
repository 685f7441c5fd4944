// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_expression_h
#define scree_input_expression_h

#include <deal.II/base/function_parser.h>

#include <memory>
#include <string>

namespace scree
{
  /// An entry's expressions of x, y (and z), and perhaps of t; with dim = 1 of t alone, which is the place then.
  template <int dim>
  class Expression : public dealii::FunctionParser<dim>
  {
  public:
    /// @param name entry_name() and text, for messages
    Expression(const std::string &name, const unsigned int n_components, const bool with_time);

    /// Throws ValueError, with entry and place, if the value is not a finite number.
    double value(const dealii::Point<dim> &x, const unsigned int component = 0) const override;

  private:
    const std::string name;
    const bool with_time;
  };

  /// Reads an expression of x, y (and z), and of t if `with_time` (dim = 1: of t alone), or throws EntryError that
  /// begins with `where` (see entry_name()) and shows the text. `n_components` expressions are separated by semicolons.
  /// @param example of one expression, for the message; empty: a region, or of t a speed
  template <int dim>
  std::unique_ptr<Expression<dim>> parse_expression(const std::string &where,
                                                    const std::string &text,
                                                    const unsigned int n_components,
                                                    const bool with_time       = false,
                                                    const std::string &example = "");
} // namespace scree

#endif
