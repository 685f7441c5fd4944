// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/seepage_field.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  std::string SeepageReport::text(const unsigned int dim) const
  {
    const std::string unit = dim == 2 ? " m^2/s" : " m^3/s";
    return "Steady seepage: " + number_text(inflow) + unit + " in, " + number_text(outflow_in_air) +
           " out through faces in air" + (std::isnan(exit_height) ? "" : " up to " + number_text(exit_height) + " m") +
           ", " + number_text(outflow_below) + " out below given heads; " + std::to_string(n_iterations) +
           " iterations" + (has_converged ? "" : ", not converged. Use the pressure with care");
  }


  template <int dim>
  SeepageField<dim>::SeepageField(const CellsOfBox<dim> &box,
                                  const CellPlace<dim> &first,
                                  const CellPlace<dim> &n,
                                  std::vector<double> values,
                                  const SeepageReport &report)
      : report(report)
      , box(box)
      , first(first)
      , n(n)
      , values(std::move(values))
  {
  }


  template <int dim>
  std::pair<double, Tensor<1, dim>> SeepageField<dim>::pressure_head(const Point<dim> &x) const
  {
    const CellPlace<dim> cell = box.place_near(x);
    const Point<dim> corner   = box.corner(cell);
    std::pair<double, Tensor<1, dim>> result;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      {
        std::size_t number = 0, step = 1;
        double shape = 1.;
        Tensor<1, dim> gradient;
        for (unsigned int a = 0; a < dim; ++a)
          gradient[a] = 1. / box.width;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const bool is_upper = v >> a & 1;
            const int place     = cell[a] + is_upper - first[a];
            if (place < 0 || place >= n[a])
              return { std::numeric_limits<double>::quiet_NaN(), {} };
            number += place * step;
            step *= n[a];
            const double part = std::clamp((x[a] - corner[a]) / box.width, 0., 1.);
            const double hat  = is_upper ? part : 1. - part;
            shape *= hat;
            for (unsigned int b = 0; b < dim; ++b)
              gradient[b] *= b != a ? hat : is_upper ? 1. : -1.;
          }
        result.first += shape * values[number];
        result.second += values[number] * gradient;
      }
    return result;
  }


  template <int dim>
  bool SeepageField<dim>::is_open(const Point<dim> &x) const
  {
    return !(pressure_head(x).first >= 0.);
  }


  template <int dim>
  SurfaceView<dim> SeepageField<dim>::view(const Point<dim> &x, const double reach) const
  {
    const auto [head, gradient] = pressure_head(x);
    const double slope          = gradient.norm();
    if (std::isnan(head) || !(slope > 0.))
      return { std::isnan(head) || head < 0. ? reach : -reach, Point<dim>::unit_vector(dim - 1) };
    return { std::clamp(-head / slope, -reach, reach), -gradient / slope };
  }

  template class SeepageField<2>;
  template class SeepageField<3>;
} // namespace scree
