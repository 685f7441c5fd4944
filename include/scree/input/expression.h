// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_expression_h
#define scree_input_expression_h

#include <scree/input/input_error.h>

#include <deal.II/base/function_parser.h>

#include <cmath>
#include <memory>

namespace scree
{
  /// An entry's expressions of x, y (and z), and perhaps of one more variable, set by set_time(); with dim = 1 of t
  /// alone, which is the place then.
  template <int dim>
  class Expression : public dealii::FunctionParser<dim>
  {
  public:
    /// @param name entry_name() and text, for messages
    /// @param further variable, `t` (s) or `depth` (m); empty: none
    Expression(const std::string &name, const unsigned int n_components, const std::string &further)
        : dealii::FunctionParser<dim>(n_components)
        , name(name)
        , further(further)
    {
    }

    /// Throws ValueError, with entry and place, if the value is not a finite number.
    double value(const dealii::Point<dim> &x, const unsigned int component = 0) const override
    {
      const double result = dealii::FunctionParser<dim>::value(x, component);
      if (!std::isfinite(result))
        throw ValueError(name + ": it is " + (std::isnan(result) ? "not a number" : "infinite") + " at " +
                         (dim == 1 ? "t = " : "") + number_text(x) + (dim == 1 ? " s" : " m") +
                         (further.empty() ? ""
                                          : ", " + further + " = " + number_text(this->get_time()) +
                                                (further == "t" ? " s" : " m")) +
                         ". Write an expression that is a number wherever it is asked for, for instance with if(" +
                         (dim == 1 ? 't' : 'x') + " > 0, ..., ...).");
      return result;
    }

  private:
    const std::string name;
    const std::string further;
  };

  /// Reads an expression of x, y (and z), and of the `further` variable, see Expression (dim = 1: of t alone), or
  /// throws EntryError that begins with `where` (see entry_name()) and shows the text. `n_components` expressions are
  /// separated by semicolons.
  /// @param example of one expression, for the message; empty: a region, or of t a speed
  template <int dim>
  std::unique_ptr<Expression<dim>> parse_expression(const std::string &where,
                                                    const std::string &text,
                                                    const unsigned int n_components,
                                                    const std::string &further = "",
                                                    const std::string &example = "");

  /// Throws EntryError unless the text of a scene of dimension `dim`, 2 or 3, reads, see parse_expression().
  void check_expression(const unsigned int dim,
                        const std::string &where,
                        const std::string &text,
                        const unsigned int n_components,
                        const std::string &further = "",
                        const std::string &example = "");
} // namespace scree

#endif
