// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/geometry/level_set.h>
#include <scree/geometry/surfaces.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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


  Profile::Profile(std::vector<Point<2>> points)
      : points(std::move(points))
  {
    Assert(this->points.size() >= 2, ExcInternalError());
  }


  unsigned int Profile::segment_at(const double x) const
  {
    const auto behind =
        std::upper_bound(points.begin(), points.end(), x, [](const double a, const Point<2> &b) { return a < b[0]; });
    const auto n = behind - points.begin();
    return std::clamp<int>(n - 1, 0, int(points.size()) - 2);
  }


  double Profile::height(const double x) const
  {
    const unsigned int s = segment_at(x);
    const Point<2> &a = points[s], &b = points[s + 1];
    const double part = std::clamp((x - a[0]) / (b[0] - a[0]), 0., 1.);
    return a[1] + part * (b[1] - a[1]);
  }


  bool Profile::is_open(const Point<2> &x) const
  {
    return x[1] > height(x[0]);
  }


  SurfaceView<2> Profile::view(const Point<2> &x, const double reach) const
  {
    const double above = x[1] - height(x[0]), side = above > 0. ? 1. : -1.;
    double shortest = std::min(reach, std::abs(above));
    SurfaceView<2> best{ side * shortest, Tensor<1, 2>({ 0., 1. }) };
    const auto look_at = [&](const unsigned int s) {
      const Tensor<1, 2> along = points[s + 1] - points[s];
      const double part        = std::clamp((x - points[s]) * along / along.norm_square(), 0., 1.);
      const Tensor<1, 2> way   = x - (points[s] + part * along);
      const double distance    = way.norm();
      if (distance > shortest)
        return;
      shortest      = distance;
      best.distance = side * distance;
      // On the ground itself the open side is that of the segment.
      best.normal = distance > 1e-10 * along.norm() ? side / distance * way
                                                    : Tensor<1, 2>({ -along[1], along[0] }) / along.norm();
    };
    const int middle = segment_at(x[0]), n = points.size() - 1;
    look_at(middle);
    for (int s = middle - 1; s >= 0 && x[0] - points[s + 1][0] < shortest; --s)
      look_at(s);
    for (int s = middle + 1; s < n && points[s][0] - x[0] < shortest; ++s)
      look_at(s);
    return best;
  }


  namespace
  {
    /// Reads the points "x, y", m, by read_number_table().
    Profile read_profile(const std::string &file, const std::string &where)
    {
      std::vector<Point<2>> points;
      for (const auto &row : read_number_table(file, where, { "x (m)", "y (m)" }))
        points.emplace_back(row[0], row[1]);
      return Profile(points);
    }


    std::unique_ptr<LevelSet<2>> make_profile(const ShapeRequest &request)
    {
      auto profile = std::make_unique<Profile>(read_profile(request.value, request.where()));
      request.require_cover(0, profile->first_x(), profile->last_x(), 0.);
      return profile;
    }


    const RegisterShape registered_profile(
        "Profile",
        { "m; 2D. File of ground points x, y, one per line, with ascending x; alternative to \"Level set expression\".",
          ShapeValue::file,
          "a profile is ground of plane scenes. Write a \"Raster\" or a \"Level set expression\".",
          make_profile,
          nullptr });
  } // namespace


  HeightSurface::HeightSurface(Raster raster)
      : raster(std::move(raster))
  {
  }


  Point<3> HeightSurface::node(const unsigned int column, const unsigned int row) const
  {
    return { raster.x + column * raster.spacing, raster.y + row * raster.spacing, raster(column, row) };
  }


  bool HeightSurface::has_ground(const unsigned int column, const unsigned int row) const
  {
    return !std::isnan(raster(column, row) + raster(column + 1, row) + raster(column, row + 1) +
                       raster(column + 1, row + 1));
  }


  double HeightSurface::height(const double x, const double y) const
  {
    const double u = (x - raster.x) / raster.spacing, v = (y - raster.y) / raster.spacing;
    const int i    = std::clamp(static_cast<int>(std::floor(u)), 0, int(raster.n_columns) - 2);
    const int j    = std::clamp(static_cast<int>(std::floor(v)), 0, int(raster.n_rows) - 2);
    const double s = std::clamp(u - i, 0., 1.), t = std::clamp(v - j, 0., 1.);
    const double a = raster(i, j), b = raster(i + 1, j), c = raster(i, j + 1), d = raster(i + 1, j + 1);
    if (!has_ground(i, j))
      return std::numeric_limits<double>::quiet_NaN();
    // The diagonal goes from b to c.
    return s + t <= 1. ? a + s * (b - a) + t * (c - a) : d + (1. - s) * (c - d) + (1. - t) * (b - d);
  }


  bool HeightSurface::is_open(const Point<3> &x) const
  {
    return !(x[2] <= height(x[0], x[1]));
  }


  std::string HeightSurface::remark() const
  {
    return raster.remark_on_heights("Bed",
                                    "There is no ground around them: it ends in vertical walls, and soil falls past "
                                    "them. Fill holes of the data first, for instance with gdal_fillnodata.");
  }


  SurfaceView<3> HeightSurface::view(const Point<3> &x, const double reach) const
  {
    const double above = x[2] - height(x[0], x[1]), side = above <= 0. ? -1. : 1.;
    double shortest = std::isnan(above) ? reach : std::min(reach, std::abs(above));
    SurfaceView<3> best{ side * shortest, Tensor<1, 3>({ 0., 0., 1. }) };
    const auto look_at = [&](const Triangle &corners) {
      const Tensor<1, 3> way = x - nearest_place(x, corners).place;
      const double distance  = way.norm();
      if (distance > shortest)
        return;
      shortest                  = distance;
      const Tensor<1, 3> normal = across(corners);
      // On the ground itself the open side is that of the triangle.
      best = { side * distance, distance > 1e-10 * raster.spacing ? side / distance * way : normal / normal.norm() };
    };
    const auto range = [&](const double place, const double first, const unsigned int n) {
      const auto number = [&](const double at) {
        return static_cast<int>(std::clamp(std::floor((at - first) / raster.spacing), 0., n - 2.));
      };
      return std::make_pair(number(place - shortest), number(place + shortest));
    };
    const auto [first_column, last_column] = range(x[0], raster.x, raster.n_columns);
    const auto [first_row, last_row]       = range(x[1], raster.y, raster.n_rows);
    for (int j = first_row; j <= last_row; ++j)
      for (int i = first_column; i <= last_column; ++i)
        {
          if (!has_ground(i, j))
            continue;
          const Point<3> a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
          look_at({ { a, b, c } });
          look_at({ { d, c, b } });
          // The ground ends beside missing heights in a vertical wall; its normal points to them.
          const auto look_at_wall = [&](const int column, const int row, const Point<3> &left, const Point<3> &right) {
            if (column < 0 || row < 0 || column + 1 == int(raster.n_columns) || row + 1 == int(raster.n_rows) ||
                has_ground(column, row))
              return;
            Point<3> below_left = left, below_right = right;
            below_left[2] = below_right[2] = std::min({ left[2], right[2], x[2] }) - reach;
            look_at({ { left, below_left, right } });
            look_at({ { below_right, right, below_left } });
          };
          look_at_wall(i, j - 1, a, b);
          look_at_wall(i + 1, j, b, d);
          look_at_wall(i, j + 1, d, c);
          look_at_wall(i - 1, j, c, a);
        }
    return best;
  }


  namespace
  {
    std::unique_ptr<LevelSet<3>> make_height_surface(const ShapeRequest &request)
    {
      Raster raster         = read_raster(request.value, request.where(), request.map_origin);
      const double rounding = 1e-6 * raster.spacing;
      request.require_cover(0, raster.x, raster.last_x(), rounding);
      request.require_cover(1, raster.y, raster.last_y(), rounding);
      return std::make_unique<HeightSurface>(std::move(raster));
    }


    const RegisterShape registered_height_surface(
        "Raster",
        { "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the ground heights; alternative to \"Level set expression\".",
          ShapeValue::file,
          "a raster is ground of scenes in space. Write a \"Profile\" or a \"Level set expression\".",
          nullptr,
          make_height_surface });
  } // namespace
} // namespace scree
