// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/polygon.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Twice the area of the triangle, positive if it is to the left of a to b.
    double area(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }


    /// Whether two edges have a place in common.
    bool meet(const Point<2> &a, const Point<2> &b, const Point<2> &c, const Point<2> &d)
    {
      for (unsigned int i = 0; i < 2; ++i)
        if (std::max(a[i], b[i]) < std::min(c[i], d[i]) || std::max(c[i], d[i]) < std::min(a[i], b[i]))
          return false;
      const auto on_both_sides = [](const double one, const double other) {
        return !((one > 0. && other > 0.) || (one < 0. && other < 0.));
      };
      return on_both_sides(area(a, b, c), area(a, b, d)) && on_both_sides(area(c, d, a), area(c, d, b));
    }
  } // namespace


  Polygon::Polygon(std::vector<Point<2>> corners)
      : corners(std::move(corners))
      , lower(this->corners.front())
      , upper(lower)
  {
    for (const Point<2> &corner : this->corners)
      for (unsigned int a = 0; a < 2; ++a)
        {
          lower[a] = std::min(lower[a], corner[a]);
          upper[a] = std::max(upper[a], corner[a]);
        }
  }


  bool Polygon::contains(const Point<2> &x) const
  {
    for (unsigned int a = 0; a < 2; ++a)
      if (x[a] < lower[a] || x[a] > upper[a])
        return false;
    bool is_inside = false; // a ray along x crosses an odd number of edges
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Point<2> &a = corner(i), &b = corner(i + 1);
        if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
          is_inside = !is_inside;
      }
    return is_inside;
  }


  unsigned int Polygon::first_crossing() const
  {
    const unsigned int n = corners.size();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i + 2; j < n; ++j)
        if ((j + 1) % n != i && meet(corner(i), corner(i + 1), corner(j), corner(j + 1)))
          return i;
    return n;
  }


  Polygon checked_polygon(std::vector<Point<2>> corners, const std::string &name)
  {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > 1 && corners.front() == corners.back())
      corners.pop_back();
    if (corners.size() < 3)
      throw EntryError(name + "it has " + std::to_string(corners.size()) +
                       " corners. Write three or more, x, y in m, one a line, in their order around the place.");
    const Polygon polygon(corners);
    const unsigned int edge = polygon.first_crossing();
    if (edge < corners.size())
      throw EntryError(name + "its edge from " + number_text(corners[edge]) +
                       " m is crossed or touched by another. Write the corners in their order around the place.");
    return polygon;
  }


  Polygon read_polygon(const std::string &file, const std::string &where, const Point<2> &origin)
  {
    const std::string name = where + " = " + file + ": ";
    std::vector<Point<2>> corners;
    for (const auto &row : read_number_table(file, where, { "x (m)", "y (m)" }, FirstColumn::any))
      corners.emplace_back(row[0] - origin[0], row[1] - origin[1]);
    return checked_polygon(std::move(corners), name);
  }
} // namespace scree
