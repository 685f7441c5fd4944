// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/outline.h>

#include <algorithm>
#include <utility>

namespace scree
{
  using namespace dealii;

  Outline::Outline(std::vector<std::vector<Polygon>> areas)
      : areas(std::move(areas))
  {
  }


  bool Outline::contains(const Point<2> &x) const
  {
    const auto has_place = [&](const Polygon &polygon) { return polygon.contains(x); };
    return std::any_of(areas.begin(), areas.end(), [&](const auto &area) {
      return area.front().contains(x) && std::none_of(area.begin() + 1, area.end(), has_place);
    });
  }


  std::pair<Point<2>, Point<2>> Outline::bounds() const
  {
    auto [lower, upper] = areas.front().front().bounds();
    for (const auto &area : areas)
      for (unsigned int a = 0; a < 2; ++a)
        {
          lower[a] = std::min(lower[a], area.front().bounds().first[a]);
          upper[a] = std::max(upper[a], area.front().bounds().second[a]);
        }
    return { lower, upper };
  }
} // namespace scree
