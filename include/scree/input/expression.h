// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_expression_h
#define scree_input_expression_h

#include <deal.II/base/function_parser.h>

#include <memory>
#include <string>

namespace scree
{
  /// Reads an expression of x, y (and z), and of t if `with_time`, or throws EntryError that begins with `where`
  /// (see entry_name()) and shows the text. `n_components` expressions are separated by semicolons.
  template <int dim>
  std::unique_ptr<dealii::FunctionParser<dim>> parse_expression(const std::string &where,
                                                                const std::string &text,
                                                                const unsigned int n_components,
                                                                const bool with_time = false);
} // namespace scree

#endif
