// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster_format.h>
#include <scree/geometry/raster_formats/raster_writer.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

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


    /// Whether a file begins with text.
    RasterClaim claim_ascii_raster(std::istream &in, const std::string &)
    {
      char first[64];
      in.read(first, sizeof(first));
      const bool is_text = std::all_of(
          first, first + in.gcount(), [](const unsigned char c) { return std::isprint(c) || std::isspace(c); });
      return is_text ? RasterClaim::contents : RasterClaim::none;
    }


    Raster read_ascii_raster(std::istream &in, const std::string &, const std::string &name)
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
      const double missing  = head.has("nodata_value") && !may_be_nan ? head.number("nodata_value") : missing_value;

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


    const RegisterRasterFormat registered_ascii("ESRI ASCII grid", claim_ascii_raster, read_ascii_raster);
  } // namespace


  std::string system_beside(const std::string &file, const std::string &)
  {
    std::ifstream in(std::filesystem::path(file).replace_extension(".prj"));
    std::string text{ std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
    return text;
  }


  std::string ascii_grid(const Raster &raster)
  {
    std::ostringstream text;
    text << std::setprecision(15) << "ncols " << raster.n_columns << "\nnrows " << raster.n_rows << "\nxllcorner "
         << raster.x - 0.5 * raster.spacing << "\nyllcorner " << raster.y - 0.5 * raster.spacing << "\ncellsize "
         << raster.spacing << "\nNODATA_value " << missing_value << '\n'
         << std::setprecision(9);
    for (unsigned int row = raster.n_rows; row-- > 0;) // from the north
      for (unsigned int column = 0; column < raster.n_columns; ++column)
        {
          const double value = raster(column, row);
          text << (std::isnan(value) ? missing_value : value) << (column + 1 < raster.n_columns ? ' ' : '\n');
        }
    return text.str();
  }
} // namespace scree
