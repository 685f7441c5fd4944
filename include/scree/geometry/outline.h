// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_outline_h
#define scree_geometry_outline_h

#include <scree/geometry/polygon.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// Areas on the map, such as those of a release; they may overlap.
  class Outline
  {
  public:
    /// @param areas at least one: the edge and the holes of each, m
    explicit Outline(std::vector<std::vector<Polygon>> areas);

    /// Whether a place, m, is in an area and in none of its holes.
    bool contains(const dealii::Point<2> &x) const;

    /// Lower and upper corner of the box around all areas, m.
    std::pair<dealii::Point<2>, dealii::Point<2>> bounds() const;

  private:
    std::vector<std::vector<Polygon>> areas;
  };

  /// Reads the areas of a file in a vector format of GDAL, else one by read_polygon(). Throws
  /// EntryError, which begins with `where` (see entry_name()), if there is none, or if edges cross.
  /// @param origin where the map has the origin of the outline's x and y, m
  Outline read_outline(const std::string &file, const std::string &where, const dealii::Point<2> &origin);

  /// The coordinate system of an outline, see Raster::system; empty if it is not known.
  std::string read_outline_system(const std::string &file, const std::string &where);
} // namespace scree

#endif
