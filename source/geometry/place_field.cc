// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/place_field.h>
#include <scree/geometry/raster.h>
#include <scree/input/case_entries.h>
#include <scree/input/expression.h>
#include <scree/input/number_table.h>

#include <deal.II/numerics/rtree.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double most_extents = 10; // of a table, to which its values still reach

    /// Places and the values there.
    template <int dim>
    auto
    read_places(const std::string &file, const std::string &where, const std::string &quantity, const Point<2> &origin)
    {
      std::vector<std::string> columns{ "x (m)", "y (m)", "z (m)" };
      columns.resize(dim);
      columns.push_back(quantity);
      std::vector<std::pair<Point<dim>, double>> places;
      for (const auto &row : read_number_table(file, where, columns, FirstColumn::any))
        {
          places.emplace_back(Point<dim>(), row[dim]);
          for (unsigned int a = 0; a < dim; ++a)
            places.back().first[a] = row[a] - (a < 2 ? origin[a] : 0.);
        }
      return places;
    }
  } // namespace


  template <int dim>
  PlaceField<dim>::PlaceField(const std::string &where,
                              const std::string &text,
                              const std::string &quantity,
                              const std::string &example,
                              const Point<2> &origin)
  {
    if (!names_place_file(text))
      value_at = [expression = std::shared_ptr<Expression<dim>>(parse_expression<dim>(
                      where, text, 1, "depth", example))](const Point<dim> &place, const double depth) {
        expression->set_time(depth);
        return expression->value(place);
      };
    else if (is_raster(text))
      value_at = [raster = read_raster(text, where, origin), name = where + " = " + text](const Point<dim> &place,
                                                                                          const double) {
        const double value = raster.value_at(place[0], place[1]);
        if (std::isnan(value))
          throw ValueError(name + ": there is no value at " + number_text(place) +
                           " m. Use a raster that covers the whole body.");
        return value;
      };
    else
      {
        const auto places   = pack_rtree(read_places<dim>(text, where, quantity, origin));
        const auto box      = places.bounds();
        const double extent = boost::geometry::distance(box.min_corner(), box.max_corner());
        value_at            = [places, extent, name = where + " = " + text](const Point<dim> &place, const double) {
          const auto nearest = places.qbegin(boost::geometry::index::nearest(place, 1));
          const double away  = place.distance(nearest->first);
          if (away > most_extents * extent)
            throw ValueError(name + ": the nearest place of " + number_text(place) + " m is " + number_text(away) +
                             " m away, and the places are within " + number_text(extent) +
                             " m. Look at their coordinates, m on the map, and at \"Local origin\".");
          return nearest->second;
        };
      }
  }

  template class PlaceField<2>;
  template class PlaceField<3>;
} // namespace scree
