// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_drawing_h
#define scree_geometry_drawing_h

#include <scree/input/input_error.h>

#include <deal.II/base/bounding_box.h>

#include <map>

class OGRGeometry;
class OGRMultiPolygon;
class OGRPolygon;

namespace scree
{
  /// Areas on the map or in a section, such as those of a release; they may overlap.
  class Outline
  {
  public:
    /// @param areas at least one, m
    /// @param origin where they have the origin of the outline's x and y, m
    /// @param thickness of each area, m; empty: not known
    explicit Outline(const OGRMultiPolygon &areas,
                     const dealii::Point<2> &origin = dealii::Point<2>(),
                     std::vector<double> thickness  = {});

    /// Whether a place, m, is in an area and in none of its holes.
    bool contains(const dealii::Point<2> &x) const
    {
      return thickness_at(x) >= 0.;
    }

    /// The largest thickness, m, of the areas that contain a place, 0 if it is not known; -1 outside all of them.
    double thickness_at(const dealii::Point<2> &x) const;

    /// Smallest and largest thickness of the areas, m; zeros if they are not known.
    std::pair<double, double> range_of_thickness() const;

    /// Gives all areas the same thickness, m.
    void set_thickness(const double value)
    {
      thickness.assign(areas.size(), value);
    }

    /// Sum of the areas less their holes, m^2.
    double area() const
    {
      return sum_of_areas;
    }

    /// Lower and upper corner of the box around all areas, m.
    const std::pair<dealii::Point<2>, dealii::Point<2>> &bounds() const
    {
      return box.get_boundary_points();
    }

  private:
    /// The edges of an area by bands of y, so that a place is compared with those of its band only.
    struct Area
    {
      Area(const OGRPolygon &polygon, const dealii::Point<2> &origin);
      bool contains(const dealii::Point<2> &x) const;
      std::size_t band_at(const double y) const;

      dealii::BoundingBox<2> box;
      std::vector<std::pair<dealii::Point<2>, dealii::Point<2>>> edges;
      std::vector<std::vector<unsigned int>> bands; ///< numbers of edges
    };

    std::vector<Area> areas;
    std::vector<double> thickness;
    dealii::BoundingBox<2> box;
    double sum_of_areas = 0.;
  };

  /// Reads the areas of a file in a vector format of GDAL, and their thickness if they have an attribute of that name;
  /// else one area from a text of its corners "x, y", m, one a line.
  /// Throws EntryError, which begins with `where` (see entry_name()), if there is none, if edges cross, or if some
  /// areas only have a thickness.
  /// @param origin where the map has the origin of the outline's x and y, m
  Outline read_outline(const std::string &file, const std::string &where, const dealii::Point<2> &origin);

  /// The coordinate system of an outline, see Raster::system; empty if it is not known.
  std::string read_outline_system(const std::string &file, const std::string &where);

  /// The layers of a plane section, by their names.
  class Drawing
  {
  public:
    /// Reads a file in a vector format of GDAL. The layer of a shape is its attribute `name`, in DXF its layer, else
    /// that of the file. Rows `name, x, y` of a CSV file are corners; those of an area close by themselves.
    /// Throws EntryError, which begins with `where` (see entry_name()), if nothing is in it.
    Drawing(const std::string &file, const std::string &where);

    /// The areas of the layer that an entry names. Closed lines are edges, and holes if they lie in others; areas that
    /// overlap are one. Throws EntryError if there is no such layer, if a line is open, or if edges cross.
    Outline areas(const EntryValue &entry) const;

    /// Corners of the one line of a layer, m, with ascending x. Throws EntryError if there is none.
    std::vector<dealii::Point<2>> line(const EntryValue &entry) const;

    /// Throws EntryError if two layers overlap on more than a hundredth of a cell's width. Returns remarks on gaps
    /// between layers of more than half a cell, and on layers without use, for the log.
    /// @param bodies entries whose layers are areas
    /// @param others names of further layers in use
    std::vector<std::string>
    check(const std::vector<EntryValue> &bodies, const std::vector<std::string> &others, const double cell_size) const;

  private:
    void add(const std::string &layer, const OGRGeometry &shape);
    const std::vector<std::shared_ptr<OGRGeometry>> &layer(const EntryValue &entry) const;
    std::shared_ptr<OGRMultiPolygon> polygons(const EntryValue &entry) const;

    const std::string name; // of the file, as messages begin
    std::map<std::string, std::vector<std::shared_ptr<OGRGeometry>>> layers;
    bool is_table = false; // of corners
  };
} // namespace scree

#endif
