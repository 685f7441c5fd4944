// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/expression.h>

#include <deal.II/base/utilities.h>

#include <cctype>
#include <iostream>
#include <regex>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// What muParser accepts and nobody means, a comma between no arguments and a single "=": it would go on with what
    /// follows the comma, and set the variable. Empty if there is neither.
    std::string misleading_sign(const std::string &text)
    {
      const auto at = [&](const std::size_t i) { return i < text.size() ? text[i] : ' '; };
      std::vector<bool> is_call; // of the parentheses that are open
      char before = ' ';         // the last character that is no blank
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const char c            = text[i];
          const std::string place = " after " + quoted(text.substr(0, i));
          if (c == '(')
            is_call.push_back(std::isalnum(static_cast<unsigned char>(before)) || before == '_');
          else if (c == ')' && !is_call.empty())
            is_call.pop_back();
          else if (c == ',' && (is_call.empty() || !is_call.back()))
            return "the comma" + place +
                   " stands between no arguments of a function. Decimals have a point: 0.5, not 0,5";
          else if (c == '=' && at(i + 1) == '=')
            ++i;
          else if (c == '=' && std::string("<>!").find(before) == std::string::npos)
            return "the \"=\"" + place + " compares nothing. Write ==, or better < and >";
          if (c != ' ')
            before = c;
        }
      return "";
    }


    /// What keeps the expressions from being read; empty: nothing.
    template <int dim>
    std::string read_expressions(Expression<dim> &function, const std::string &text, const std::string &further)
    {
      const unsigned int n_components = function.n_components;
      const std::string variables =
          dim == 1 ? "t" : FunctionParser<dim>::default_variable_names() + (further.empty() ? "" : "," + further);
      if (const auto n = Utilities::split_string_list(text, ';').size(); n != n_components)
        return std::to_string(n) + " expression(s) where " + std::to_string(n_components) + " are needed";
      if (const std::string fault = misleading_sign(text); !fault.empty())
        return fault;
      try
        {
          // Nothing appears on the screen, where deal.II's parser prints before it throws.
          const std::unique_ptr<std::streambuf, void (*)(std::streambuf *)> screen(
              std::cerr.rdbuf(nullptr), [](std::streambuf *buffer) { std::cerr.rdbuf(buffer); });
          // muParser reads an expression when it is first evaluated.
          function.initialize(variables, text, { { "pi", numbers::PI } }, !further.empty());
          for (unsigned int c = 0; c < n_components; ++c)
            function.FunctionParser<dim>::value(Point<dim>(), c);
        }
      catch (const ExceptionBase &error)
        {
          const std::string message = plain_text(error), mark = "said: ";
          const std::size_t said = message.find(mark);
          std::string fault      = said == std::string::npos ? message : message.substr(said + mark.size());
          fault.erase(fault.find_last_not_of('.') + 1);
          return fault +
                 (std::regex_search(text, std::regex("[0-9],[0-9]")) ? ". Decimals have a point: 0.5, not 0,5" : "");
        }
      return "";
    }
  } // namespace


  template <int dim>
  std::unique_ptr<Expression<dim>> parse_expression(const std::string &where,
                                                    const std::string &text,
                                                    const unsigned int n_components,
                                                    const std::string &further,
                                                    const std::string &example_of_one)
  {
    const std::string of_one  = !example_of_one.empty() ? example_of_one
                                : dim == 1              ? "2*min(t/5, 1)"
                                                        : "if(x < 2, y < 2, y < 4 - x)";
    auto function             = std::make_unique<Expression<dim>>(where + " = " + text, n_components, further);
    const std::string fault   = read_expressions(*function, text, further);
    const std::string last    = dim == 1 ? "0.1*t" : "-2*x";
    const std::string example = n_components == 1 ? of_one : n_components == 2 ? "0; " + last : "0; 0; " + last;
    const std::string names   = dim == 1 ? "t" : dim == 2 ? "x, y" : "x, y, z";
    // muParser reads "&&y" as "&" and a word "&y".
    const bool blank_missing =
        fault.rfind("Unexpected token \"&", 0) == 0 || fault.rfind("Unexpected token \"|", 0) == 0;
    const bool has_not = std::regex_search(text, std::regex("!\\s*[^=\\s]")); // muParser has "!=" only
    if (!fault.empty())
      throw EntryError(where + " = " + text + ": " + fault + (has_not ? ". In place of !(...) write (...) == 0" : "") +
                       ". Write " + (n_components == 1 ? "an expression" : "expressions, separated by semicolons,") +
                       " of " + names + (further.empty() ? "" : ", " + further) +
                       (blank_missing ? ", with blanks around && and ||" : "") + ", for instance " + example);
    return function;
  }

  template decltype(parse_expression<1>) parse_expression<1>;
  template decltype(parse_expression<2>) parse_expression<2>;
  template decltype(parse_expression<3>) parse_expression<3>;


  void check_expression(const unsigned int dim,
                        const std::string &where,
                        const std::string &text,
                        const unsigned int n_components,
                        const std::string &further,
                        const std::string &example)
  {
    if (dim == 2)
      parse_expression<2>(where, text, n_components, further, example);
    else
      parse_expression<3>(where, text, n_components, further, example);
  }
} // namespace scree
