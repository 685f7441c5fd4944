// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_place_field_h
#define scree_geometry_place_field_h

#include <deal.II/base/point.h>

#include <functional>
#include <string>

namespace scree
{
  /// The value of an entry that may differ from place to place, see add_place_entry(): an expression, the value of the
  /// nearest place of a table, or that of a raster, bilinear between the middles of its cells.
  template <int dim>
  class PlaceField
  {
  public:
    /// Reads expression or file. Throws EntryError that begins with `where` (see entry_name()) if it does not read.
    /// @param quantity name and unit of the value, for messages: `Cohesion (Pa)`
    /// @param example of an expression, for messages
    /// @param origin where the map has the origin of x and y, m: places of files are on the map
    PlaceField(const std::string &where,
               const std::string &text,
               const std::string &quantity,
               const std::string &example,
               const dealii::Point<2> &origin);

    /// The value. Throws ValueError, with entry and place, if there is none.
    /// @param depth below the ground, m
    double value(const dealii::Point<dim> &place, const double depth) const
    {
      return value_at(place, depth);
    }

  private:
    std::function<double(const dealii::Point<dim> &, double)> value_at;
  };
} // namespace scree

#endif
