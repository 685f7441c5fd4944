// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/region.h>

#include <deal.II/base/utilities.h>

namespace scree
{
  using namespace dealii;

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

  template class Region<2>;
  template class Region<3>;
} // namespace scree
