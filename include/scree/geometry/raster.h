// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_h
#define scree_geometry_raster_h

#include <deal.II/base/point.h>

#include <string>
#include <utility>
#include <vector>

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

    /// Values that are missing.
    std::size_t n_missing() const;

    /// Smallest and largest value; infinity and minus infinity if all are missing.
    std::pair<double, double> range() const;

    /// Remark on heights for the log, in lines: their range and where its ends are, how many are missing, and
    /// questions about heights that no ground has and about steps steeper than 80 degrees.
    /// @param name of what has the heights, such as `Bed`
    /// @param where_missing a sentence on what is where heights are missing
    std::string remark_on_heights(const std::string &name, const std::string &where_missing) const;

    /// Bilinear between the values; NaN where one that counts is missing.
    double value_at(const double x, const double y) const;

    /// The same with 0 for what is missing, beyond the values, too.
    double value_or_zero_at(const double x, const double y) const;

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
} // namespace scree

#endif
