// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/points/region.h>

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


  template <int dim>
  Region<dim>::Region(const std::string &where, const std::string &expression)
      : function(parse_expression<dim>(where, expression, 1))
  {
  }


  template <int dim>
  std::pair<double, Point<dim>> Region<dim>::part_of_cube(const Point<dim> &lower, const double width) const
  {
    const auto at = [&](const unsigned int index, const unsigned int n, const double inset) {
      Point<dim> x;
      for (unsigned int a = 0, rest = index; a < dim; ++a, rest /= n)
        x[a] = lower[a] + width * (inset + (1. - 2. * inset) * (rest % n) / (n - 1.));
      return x;
    };

    // Most cubes lie inside or outside with all corners (a little inside the cube: a region may end at its face).
    constexpr unsigned int n_corners = 1 << dim;
    unsigned int corners_inside      = 0;
    for (unsigned int v = 0; v < n_corners; ++v)
      corners_inside += contains(at(v, 2, 1e-6));
    Point<dim> middle = lower;
    for (unsigned int a = 0; a < dim; ++a)
      middle[a] += width / 2.;
    const double volume = Utilities::fixed_power<dim>(width);
    if (corners_inside == n_corners && contains(middle))
      return { volume, middle };
    if (corners_inside == 0 && !contains(middle))
      return { 0., middle };

    constexpr unsigned int n         = dim == 2 ? 32 : 12;
    constexpr unsigned int n_samples = Utilities::pow(n, dim);
    unsigned int n_inside            = 0;
    Tensor<1, dim> sum;
    for (unsigned int i = 0; i < n_samples; ++i)
      if (const auto x = at(i, n, 0.5 / n); contains(x))
        {
          ++n_inside;
          sum += x - lower;
        }
    if (n_inside == 0)
      return { 0., middle };
    return { volume * n_inside / n_samples, lower + sum / n_inside };
  }

  template std::unique_ptr<FunctionParser<2>>
  parse_expression(const std::string &, const std::string &, const unsigned int, const bool);
  template std::unique_ptr<FunctionParser<3>>
  parse_expression(const std::string &, const std::string &, const unsigned int, const bool);
  template class Region<2>;
  template class Region<3>;
} // namespace scree
