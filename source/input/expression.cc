// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/expression.h>
#include <scree/input/input_error.h>

#include <deal.II/base/utilities.h>

#include <iostream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// While it lives, nothing appears on the screen: deal.II's parser prints there before it throws.
    class Silence
    {
    public:
      Silence()
          : screen(std::cerr.rdbuf(nullptr))
      {
      }
      ~Silence()
      {
        std::cerr.rdbuf(screen);
      }

    private:
      std::streambuf *screen;
    };
  } // namespace


  template <int dim>
  std::unique_ptr<FunctionParser<dim>> parse_expression(const std::string &where,
                                                        const std::string &text,
                                                        const unsigned int n_components,
                                                        const bool with_time)
  {
    const std::string variables = FunctionParser<dim>::default_variable_names() + (with_time ? ",t" : "");
    auto function               = std::make_unique<FunctionParser<dim>>(n_components);
    std::string fault;
    if (const auto n = Utilities::split_string_list(text, ';').size(); n != n_components)
      fault = std::to_string(n) + " expression(s) where " + std::to_string(n_components) + " are needed";
    else
      try
        {
          const Silence silence;
          // muParser reads an expression when it is first evaluated.
          function->initialize(variables, text, { { "pi", numbers::PI } }, with_time);
          for (unsigned int c = 0; c < n_components; ++c)
            function->value(Point<dim>(), c);
        }
      catch (const ExceptionBase &error)
        {
          const std::string message = plain_text(error), mark = "said: ";
          const std::size_t said = message.find(mark);
          fault                  = said == std::string::npos ? message : message.substr(said + mark.size());
          fault.erase(fault.find_last_not_of('.') + 1);
        }
    const std::string example = n_components == 1   ? "if(x < 2, y < 2, y < 4 - x)"
                                : n_components == 2 ? "0; -2*x"
                                                    : "0; 0; -2*x";
    const std::string names   = dim == 2 ? "x, y" : "x, y, z";
    // muParser reads "&&y" as "&" and a word "&y".
    const bool blank_missing =
        fault.rfind("Unexpected token \"&", 0) == 0 || fault.rfind("Unexpected token \"|", 0) == 0;
    if (!fault.empty())
      throw EntryError(where + " = " + text + ": " + fault + ". Write " +
                       (n_components == 1 ? "an expression" : "expressions, separated by semicolons,") + " of " +
                       names + (with_time ? ", t" : "") + (blank_missing ? ", with blanks around && and ||" : "") +
                       ", for instance " + example);
    return function;
  }

  template std::unique_ptr<FunctionParser<2>>
  parse_expression(const std::string &, const std::string &, const unsigned int, const bool);
  template std::unique_ptr<FunctionParser<3>>
  parse_expression(const std::string &, const std::string &, const unsigned int, const bool);
} // namespace scree
