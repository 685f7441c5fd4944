// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/profile.h>
#include <scree/geometry/rigid_shape.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree
{
  using namespace dealii;

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


  Profile read_profile(const std::string &file, const std::string &where)
  {
    std::vector<Point<2>> points;
    for (const auto &row : read_number_table(file, where, { "x (m)", "y (m)" }))
      points.emplace_back(row[0], row[1]);
    return Profile(points);
  }


  namespace
  {
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
} // namespace scree
