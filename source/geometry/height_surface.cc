// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/height_surface.h>
#include <scree/geometry/rigid_shape.h>
#include <scree/geometry/triangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace scree
{
  using namespace dealii;

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
