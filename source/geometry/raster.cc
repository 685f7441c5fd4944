// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  std::size_t Raster::n_missing() const
  {
    return std::count_if(values.begin(), values.end(), [](const double value) { return std::isnan(value); });
  }


  std::pair<double, double> Raster::range() const
  {
    std::pair<double, double> result(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (const double value : values)
      if (!std::isnan(value))
        result = { std::min(result.first, value), std::max(result.second, value) };
    return result;
  }


  std::string Raster::text_of(const unsigned int column, const unsigned int row) const
  {
    return number_text((*this)(column, row)) + " m in row " + std::to_string(n_rows - row) + ", column " +
           std::to_string(column + 1) + " (x = " + number_text(x + column * spacing) +
           ", y = " + number_text(y + row * spacing) + ")";
  }


  std::string Raster::remark_on_heights(const std::string &name, const std::string &where_missing) const
  {
    constexpr double lowest_on_earth = -500., highest_on_earth = 9000.; // m, of dry ground
    const double steep = std::tan(80. * dealii::numbers::PI / 180.);
    using Place        = std::pair<unsigned int, unsigned int>; // column and row
    Place lowest(0, 0), highest(0, 0), strange(0, 0), below(0, 0), above(0, 0);
    std::size_t n_strange = 0, n_steps = 0;
    double largest_step = 0.;
    const auto at       = [this](const Place &place) { return (*this)(place.first, place.second); };
    const auto compare  = [&](const Place &one, const Place &other) {
      const double step = std::abs(at(one) - at(other));
      n_steps += step > steep * spacing;
      if (step > largest_step) // false where one is missing
        largest_step = step, below = one, above = other;
    };
    for (unsigned int row = n_rows; row-- > 0;) // from the north, as the file has them
      for (unsigned int column = 0; column < n_columns; ++column)
        {
          const Place place(column, row);
          if (std::isnan(at(place)))
            continue;
          lowest  = at(lowest) <= at(place) ? lowest : place;
          highest = at(highest) >= at(place) ? highest : place;
          if (!(at(place) >= lowest_on_earth && at(place) <= highest_on_earth) && n_strange++ == 0)
            strange = place;
          if (column > 0)
            compare({ column - 1, row }, place);
          if (row + 1 < n_rows)
            compare({ column, row + 1 }, place);
        }
    const std::size_t missing = n_missing();
    const auto text           = [this](const Place &place) { return text_of(place.first, place.second); };
    if (missing == values.size())
      return name + ": all heights of the raster are missing (NODATA). " + where_missing;
    std::string result = name + ": heights of the raster from " + text(lowest) + " to " + text(highest);
    if (missing > 0)
      result += "\n" + name + ": " + std::to_string(missing) + " of " + std::to_string(values.size()) +
                " heights of the raster are missing (NODATA). " + where_missing;
    if (n_strange > 0)
      result += "\nUnusual value: " + name + ": " + std::to_string(n_strange) + " heights of the raster lie outside " +
                number_text(lowest_on_earth) + " to " + number_text(highest_on_earth) + " m, the first is " +
                text(strange) + ". If they stand for missing ones, write that value as NODATA_value.";
    if (n_steps > 0)
      result += "\nUnusual value: " + name + ": " + std::to_string(n_steps) +
                " steps between neighbouring heights of the raster are steeper than 80 degrees; the largest is from " +
                text(below) + " to " + text(above) + '.';
    return result;
  }


  namespace
  {
    /// Bilinear between the four values around a place; `missing` makes a number of one that is NaN.
    template <typename Missing>
    double bilinear(const Raster &raster, const double x, const double y, const Missing &missing)
    {
      const double u = (x - raster.x) / raster.spacing, v = (y - raster.y) / raster.spacing;
      const double i = std::floor(u), j = std::floor(v);
      double sum = 0.;
      for (const unsigned int right : { 0, 1 })
        for (const unsigned int up : { 0, 1 })
          {
            const double weight = (right ? u - i : 1. - (u - i)) * (up ? v - j : 1. - (v - j));
            const double column = i + right, row = j + up;
            const bool is_there = column >= 0 && column < raster.n_columns && row >= 0 && row < raster.n_rows;
            if (weight > 0.)
              sum +=
                  weight * missing(is_there ? raster(static_cast<unsigned int>(column), static_cast<unsigned int>(row))
                                            : std::numeric_limits<double>::quiet_NaN());
          }
      return sum;
    }
  } // namespace


  double Raster::value_at(const double x, const double y) const
  {
    return bilinear(*this, x, y, [](const double value) { return value; });
  }


  double Raster::value_or_zero_at(const double x, const double y) const
  {
    return bilinear(*this, x, y, [](const double value) { return std::isnan(value) ? 0. : value; });
  }
} // namespace scree
