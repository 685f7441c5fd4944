// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/expression_surface.h>
#include <scree/geometry/rigid_shape.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  ExpressionSurface<dim>::ExpressionSurface(const std::string &where,
                                            const std::string &expression,
                                            const double length)
      : function(parse_expression<dim>(where, expression, 1, false, dim == 2 ? "y - 0.2*x" : "z - 0.2*x"))
      , length(length)
  {
  }


  template <int dim>
  bool ExpressionSurface<dim>::is_open(const Point<dim> &x) const
  {
    return function->value(x) > 0.;
  }


  template <int dim>
  Tensor<1, dim> ExpressionSurface<dim>::gradient(const Point<dim> &x) const
  {
    const double step = 1e-4 * length;
    Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const Tensor<1, dim> along = step * Point<dim>::unit_vector(a);
        result[a]                  = (function->value(x + along) - function->value(x - along)) / (2. * step);
      }
    return result;
  }


  template <int dim>
  SurfaceView<dim> ExpressionSurface<dim>::view(const Point<dim> &x, const double reach) const
  {
    double value           = function->value(x);
    Tensor<1, dim> slope   = gradient(x);
    double size            = slope.norm();
    const double far       = std::copysign(reach, value);
    const double estimate  = size > 0. ? value / size : far;
    SurfaceView<dim> first = { estimate, size > 0. ? slope / size : Point<dim>::unit_vector(dim - 1) };
    if (size == 0. || std::abs(estimate) > 2. * reach)
      return { far, first.normal };

    constexpr unsigned int most_steps = 30;
    Point<dim> foot                   = x;
    for (unsigned int k = 0; k < most_steps && size > 0.; ++k)
      {
        const Tensor<1, dim> normal = slope / size, way = x - foot;
        const Tensor<1, dim> step = way - (way * normal + value / size) * normal;
        foot += step;
        value = function->value(foot);
        slope = gradient(foot);
        size  = slope.norm();
        if (step.norm() < 1e-10 * length && size > 0.)
          return { (x - foot) * (slope / size), slope / size };
      }
    return first;
  }

  template class ExpressionSurface<2>;
  template class ExpressionSurface<3>;


  namespace
  {
    template <int dim>
    std::unique_ptr<LevelSet<dim>> make_expression(const ShapeRequest &request)
    {
      return std::make_unique<ExpressionSurface<dim>>(request.where(), request.value, request.cell_size);
    }


    const RegisterShape registered_expression_surface(
        "Level set expression",
        { "m; expression of x, y (z): positive in the open, 0 on the surface. A signed distance is best, "
          "such as (y - 0.2*x)/sqrt(1.04).",
          ShapeValue::text,
          "",
          make_expression<2>,
          make_expression<3> });
  } // namespace
} // namespace scree
