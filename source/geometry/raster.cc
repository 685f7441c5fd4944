// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/gdal_raster.h>
#include <scree/geometry/raster.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>

namespace scree
{
  namespace
  {
    std::string on_decimals(const std::string &word)
    {
      return word.find(',') == std::string::npos ? "" : ". Decimals have a point: 0.5, not 0,5";
    }


    /// The lines at the top of an ESRI ASCII grid.
    class Header
    {
    public:
      /// Reads up to the first value, which is left in the file.
      /// @param name of entry and file, for messages
      Header(std::istream &in, const std::string &name)
          : name(name)
      {
        std::string word, value;
        auto place = in.tellg();
        while (in >> word && is_key(word) && in >> value)
          {
            entries[lower_case(word)] = value;
            place                     = in.tellg();
          }
        in.clear();
        in.seekg(place);
      }

      bool has(const std::string &key) const
      {
        return entries.count(key) > 0;
      }

      /// The width of the square cells; GDAL writes two of them if they differ.
      double cell_size() const
      {
        if (has("cellsize") || !has("dx") || !has("dy"))
          return number("cellsize");
        const double dx = number("dx"), dy = number("dy");
        if (!(std::abs(dx - dy) < 1e-6 * std::abs(dx)))
          throw EntryError(name + "its cells are no squares: dx = " + number_text(dx) + ", dy = " + number_text(dy) +
                           ". gdalwarp -tr SIZE SIZE makes one with squares.");
        return dx;
      }

      /// Whether missing values are written as `nan`.
      bool misses_nan() const
      {
        return has("nodata_value") && lower_case(entries.at("nodata_value")) == "nan";
      }

      double number(const std::string &key) const
      {
        const double value = has(key) ? number_of(entries.at(key)) : std::numeric_limits<double>::quiet_NaN();
        if (!std::isfinite(value))
          throw EntryError(name + "its head has no number " + scree::quoted(key) +
                           (has(key) ? ", but " + scree::quoted(entries.at(key)) + on_decimals(entries.at(key)) : "") +
                           ". An ESRI ASCII grid begins with ncols, nrows, xllcorner, yllcorner, cellsize.");
        return value;
      }

      /// Where the first value is along an axis: the grid tells the corner of its cell or its middle.
      double origin(const std::string &axis, const double spacing) const
      {
        return has(axis + "llcenter") ? number(axis + "llcenter") : number(axis + "llcorner") + spacing / 2.;
      }

    private:
      /// Keys begin with a letter; a missing height may be written as `nan`.
      static bool is_key(const std::string &word)
      {
        return std::isalpha(static_cast<unsigned char>(word[0])) && std::isnan(number_of(word)) &&
               lower_case(word) != "nan";
      }

      const std::string name;
      std::map<std::string, std::string> entries;
    };


    /// Whether a file begins with text; then it is left where it begins.
    bool is_text(std::istream &in)
    {
      const auto begin = in.tellg();
      char first[64];
      in.read(first, sizeof(first));
      const bool is_text = std::all_of(
          first, first + in.gcount(), [](const unsigned char c) { return std::isprint(c) || std::isspace(c); });
      in.clear();
      in.seekg(begin);
      return is_text;
    }
  } // namespace


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


  namespace
  {
    /// The text of the .prj file that lies beside a grid; empty without one.
    std::string system_beside(const std::string &file)
    {
      std::ifstream in(std::filesystem::path(file).replace_extension(".prj"));
      return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
    }


    Raster read_ascii_raster(std::istream &in, const std::string &name)
    {
      const Header head(in, name);
      const double columns = head.number("ncols"), rows = head.number("nrows");
      constexpr double most = 1e9;
      if (!(columns >= 2 && rows >= 2 && columns * rows <= most && columns == std::floor(columns) &&
            rows == std::floor(rows)))
        throw EntryError(name + "ncols = " + number_text(columns) + " and nrows = " + number_text(rows) +
                         " must be whole numbers, 2 at least.");
      Raster raster;
      raster.n_columns = static_cast<unsigned int>(columns);
      raster.n_rows    = static_cast<unsigned int>(rows);
      raster.spacing   = head.cell_size();
      if (!(raster.spacing > 0))
        throw EntryError(name + "cellsize = " + number_text(raster.spacing) + " must be positive, in m.");
      raster.x              = head.origin("x", raster.spacing);
      raster.y              = head.origin("y", raster.spacing);
      const bool may_be_nan = head.misses_nan();
      const double missing  = head.has("nodata_value") && !may_be_nan ? head.number("nodata_value") : -9999.;

      raster.values.resize(std::size_t(raster.n_columns) * raster.n_rows);
      std::string word;
      for (unsigned int row = raster.n_rows; row-- > 0;) // from the north
        for (unsigned int column = 0; column < raster.n_columns; ++column)
          {
            in >> word;
            const double value = in ? number_of(word) : std::numeric_limits<double>::quiet_NaN();
            if (!std::isfinite(value) && !(in && may_be_nan && lower_case(word) == "nan"))
              throw EntryError(name +
                               (in ? scree::quoted(word) + " stands where a height should be" + on_decimals(word)
                                   : "it ends before the last of its " + number_text(columns * rows) + " heights") +
                               ". Write a complete ESRI ASCII grid.");
            raster.values[std::size_t(row) * raster.n_columns + column] =
                value == missing ? std::numeric_limits<double>::quiet_NaN() : value;
          }
      if (in >> word)
        throw EntryError(name + "it goes on with " + scree::quoted(word) + " after the last of its " +
                         number_text(columns * rows) + " heights. Write a complete ESRI ASCII grid.");
      return raster;
    }
  } // namespace


  Raster read_raster(const std::string &file, const std::string &where, const dealii::Point<2> &origin)
  {
    const std::string name = where + " = " + file + ": ";
    std::ifstream in       = open_file(file, name);
    const bool is_ascii    = is_text(in);
    Raster raster          = is_ascii ? read_ascii_raster(in, name) : read_gdal_raster(file, name);
    if (is_ascii)
      raster.system = system_beside(file);
    raster.x -= origin[0];
    raster.y -= origin[1];
    return raster;
  }
} // namespace scree
