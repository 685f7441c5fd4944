// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_h
#define scree_geometry_raster_h

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

class OGRSpatialReference;

namespace scree
{
  /// Numbers at the nodes of a regular grid in the plane, row by row with ascending y; NaN where there is none.
  struct Raster
  {
    unsigned int n_columns = 0, ///< values along x
        n_rows             = 0; ///< values along y
    double x               = 0, ///< of the first column, m
        y                  = 0; ///< of the first row, m
    double spacing         = 0; ///< of the values along both axes, m
    std::vector<double> values; ///< n_columns x n_rows, row by row
    std::string system;         ///< of the map's coordinates: a code such as EPSG:2056, or the text of a .prj file

    /// Value of a column and a row, counted from 0; NaN where it is missing.
    double operator()(const unsigned int column, const unsigned int row) const
    {
      return values[std::size_t(row) * n_columns + column];
    }

    /// Place of the last column, m.
    double last_x() const
    {
      return x + (n_columns - 1) * spacing;
    }

    /// Place of the last row, m.
    double last_y() const
    {
      return y + (n_rows - 1) * spacing;
    }

    /// Smallest and largest value; infinity and minus infinity if all are missing.
    std::pair<double, double> range() const;

    /// Remark on heights for the log, in lines: their range and where its ends are, how many are missing, and
    /// questions about heights that no ground has and about steps steeper than 80 degrees.
    /// @param name of what has the heights, such as `Bed`
    /// @param where_missing a sentence on what is where heights are missing
    std::string remark_on_heights(const std::string &name, const std::string &where_missing) const;

    /// Bilinear between the values; `missing` stands for those that are missing, beyond the raster, too.
    double
    value_at(const double x, const double y, const double missing = std::numeric_limits<double>::quiet_NaN()) const;

  private:
    /// A value with its row and column as a file counts them, from the north and the west, and its place.
    std::string text_of(const unsigned int column, const unsigned int row) const;
  };

  /// Reads the first band of a raster in any format of GDAL. Values are those at the middles of its cells, NaN where
  /// the file marks them as missing. Throws EntryError, which begins with `where` (see entry_name()), if it is none in
  /// m along the axes of a projected system of coordinates.
  /// @param origin where the map has the origin of the raster's x and y, m
  Raster read_raster(const std::string &file, const std::string &where, const dealii::Point<2> &origin);

  /// The Raster::system of a raster alone; empty if it is not known. Throws EntryError if there is no such file.
  std::string read_raster_system(const std::string &file, const std::string &where);

  /// Throws EntryError unless a text such as `EPSG:2056` is a projected system of coordinates in m that GDAL has.
  /// @param name entry and text, for the message: `entry "Coordinate system" = EPSG:1: `
  void require_system_in_metres(const std::string &system, const std::string &name);

  /// The code of the EPSG if the system has it, else the text of a .prj file; without its vertical part.
  std::string text_of_system(const OGRSpatialReference &system);

  /// Whether both texts, each a code or that of a .prj file, are of the same system: also if they name it otherwise but
  /// have the place, m, at the same coordinates. Only names are compared of systems that GDAL does not have.
  bool is_same_system(const std::string &one, const std::string &other, const dealii::Point<2> &place);

  /// What a message calls a system: its code, or its name in the text of a .prj file.
  std::string name_of_system(const std::string &system);

  /// The text of a .prj file.
  std::string prj_text(const std::string &system);

  /// Stands for missing values in files, as in most programs of maps.
  constexpr double missing_value = -9999.;

  /// The content of an ESRI ASCII grid.
  std::string ascii_grid(const Raster &raster);

  /// The content of a GeoTIFF of one band of 32-bit numbers, in the raster's system of coordinates.
  /// @param name of the band, such as `thickness`
  /// @param unit of its values
  std::string geo_tiff(const Raster &raster, const std::string &name, const std::string &unit);
} // namespace scree

#endif
