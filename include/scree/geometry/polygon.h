// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_polygon_h
#define scree_geometry_polygon_h

#include <deal.II/base/point.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// A part of the plane with straight edges.
  class Polygon
  {
  public:
    /// @param corners one after the other, m; the last is joined to the first
    explicit Polygon(std::vector<dealii::Point<2>> corners);

    /// Whether a place, m, is inside.
    bool contains(const dealii::Point<2> &x) const;

    /// Lower and upper corner of the box around it, m.
    std::pair<dealii::Point<2>, dealii::Point<2>> bounds() const
    {
      return { lower, upper };
    }

    /// The first edge that one beyond its neighbours crosses or touches; the number of edges if there is none.
    unsigned int first_crossing() const;

  private:
    const dealii::Point<2> &corner(const unsigned int i) const
    {
      return corners[i % corners.size()];
    }

    std::vector<dealii::Point<2>> corners;
    dealii::Point<2> lower, upper; // of the box around it
  };

  /// The polygon of these corners, m; the last may repeat the first. Throws EntryError, which begins with `name`, if
  /// they are fewer than three, or if edges cross.
  Polygon checked_polygon(std::vector<dealii::Point<2>> corners, const std::string &name);

  /// Reads the corners "x, y", m, one a line; the last may repeat the first. Throws EntryError, which begins with
  /// `where` (see entry_name()), if they are fewer than three, or if edges cross.
  /// @param origin where the map has the origin of the polygon's x and y, m
  Polygon read_polygon(const std::string &file, const std::string &where, const dealii::Point<2> &origin);
} // namespace scree

#endif
