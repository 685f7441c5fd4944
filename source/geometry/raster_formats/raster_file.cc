// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/geometry/raster_formats/quiet_gdal.h>
#include <scree/geometry/raster_formats/raster_writer.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gdal_priv.h>
#include <iterator>
#include <limits>
#include <memory>
#include <ogr_spatialref.h>
#include <set>

namespace scree
{
  namespace
  {
    void require_metres(const OGRSpatialReference &system, const std::string &name)
    {
      if (system.IsGeographic())
        throw EntryError(name +
                         "it is in degrees. Write one in a projected system of coordinates, in m: gdalwarp -t_srs "
                         "EPSG:number makes one.");
      const double unit = system.GetLinearUnits();
      if (std::abs(unit - 1.) > 1e-9)
        throw EntryError(name + "its unit of length is " + number_text(unit) +
                         " m. Write one in a system of coordinates in m: gdalwarp -t_srs EPSG:number makes one.");
    }


    /// Heights of surveys may be in feet where places are in m.
    void require_values_in_metres(GDALDataset &data, const std::string &name)
    {
      const OGRSpatialReference *system = data.GetSpatialRef();
      const char *vertical              = system ? system->GetAttrValue("VERT_CS|UNIT") : nullptr;
      std::string unit                  = data.GetRasterBand(1)->GetUnitType();
      if (unit.empty() && vertical)
        unit = vertical;
      static const std::set<std::string> possible = {
        "", "m", "metre", "meter", "metres", "meters", "degree", "degrees"
      };
      if (possible.count(lower_case(unit)) == 0)
        throw EntryError(name + "its values are in the unit " + scree::quoted(unit) +
                         ". gdal_translate -scale 0 1 0 FACTOR -a_srs EPSG:number IN OUT makes one in m; FACTOR is "
                         "0.3048 for feet.");
    }


    std::ifstream open_text(const std::string &file, const std::string &name)
    {
      if (const std::string value = std::filesystem::path(file).filename(); !std::isnan(number_of(value)))
        throw EntryError(name + "a number is no raster. From an outline, gdal_rasterize -burn " + value +
                         " -tr SIZE SIZE OUTLINE FILE.tif makes one.");
      return open_file(file, name);
    }


    /// Opens a raster behind a mark of byte order, if `text` has passed one.
    std::unique_ptr<GDALDataset> open(std::istream &text, const std::string &file, const std::string &name)
    {
      GDALAllRegister();
      const auto begin       = static_cast<long>(text.tellg());
      const std::string path = begin > 0 ? "/vsisubfile/" + std::to_string(begin) + ',' + file : file;
      std::unique_ptr<GDALDataset> data(
          GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
      std::string reason = CPLGetLastErrorMsg();
      reason.erase(reason.find_last_not_of('.') + 1);
      if (!data || data->GetRasterCount() < 1)
        throw EntryError(name + "GDAL finds no raster in it: " + reason +
                         ". Write GeoTIFF, or an ESRI ASCII grid: it begins with ncols, nrows, xllcorner, yllcorner, "
                         "cellsize.");
      return data;
    }


    /// The coordinate system of the file, else of the .prj file that lies beside it; empty without one.
    std::string system_of(const GDALDataset &data, const std::string &file)
    {
      if (const OGRSpatialReference *system = data.GetSpatialRef())
        return text_of_system(*system);
      std::ifstream in(std::filesystem::path(file).replace_extension(".prj"));
      std::string text{ std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
      text.erase(text.find_last_not_of(" \t\r\n") + 1);
      return text;
    }


    /// The values of an ESRI ASCII grid in the order of the file. Throws EntryError unless all are numbers, and as many
    /// as its size: GDAL reads any other word as 0, ignores what follows the last one and skips a first row of `nan`.
    std::vector<double> values_of_text(std::istream &in, const std::size_t n_values, const std::string &name)
    {
      const auto fail = [&](const std::string &fault, const std::string &word) {
        throw EntryError(name + fault + (word.find(',') == std::string::npos ? "" : ". Decimals have a point: 0.5") +
                         ". Write a complete ESRI ASCII grid.");
      };
      const auto is_number = [](const std::string &word) {
        return std::isfinite(number_of(word)) || lower_case(word) == "nan";
      };
      const std::string heights = "the last of its " + std::to_string(n_values) + " heights";
      std::vector<double> values;
      for (std::string word, entry; in >> word;)
        if (values.empty() && std::isalpha(static_cast<unsigned char>(word[0])) && !is_number(word))
          {
            if (!(in >> entry) || !is_number(entry))
              fail("its head has " + word + " = " + entry, entry);
          }
        else if (!is_number(word))
          fail(scree::quoted(word) + " stands where a height should be", word);
        else if (values.size() == n_values)
          fail("it goes on with " + scree::quoted(word) + " after " + heights, "");
        else
          values.push_back(number_of(word));
      if (values.size() < n_values)
        fail("it ends before " + heights, "");
      return values;
    }


    /// Reads the first band, or the values of a text, whose first row is in the north or the south; what its mask hides
    /// is NaN.
    void read_values(GDALDataset &data,
                     const std::vector<double> &text,
                     const bool from_north,
                     const std::string &name,
                     Raster &raster)
    {
      // The value for missing ones may be rounded otherwise than theirs; no height is as large as 1e30 m.
      constexpr double rounding = 1e-7, largest = 1e30;
      GDALRasterBand &band = *data.GetRasterBand(1);
      int has_missing;
      const double marked  = band.GetNoDataValue(&has_missing);
      const double missing = has_missing && !std::isnan(marked) ? marked : missing_value;
      raster.values.resize(std::size_t(raster.n_columns) * raster.n_rows);
      std::vector<GByte> mask(raster.n_columns, 1);
      const int width = raster.n_columns;
      for (unsigned int row = 0; row < raster.n_rows; ++row)
        {
          double *values = &raster.values[std::size_t(from_north ? raster.n_rows - 1 - row : row) * width];
          if (!text.empty())
            std::copy_n(text.begin() + std::size_t(row) * width, width, values);
          else if (band.RasterIO(GF_Read, 0, row, width, 1, values, width, 1, GDT_Float64, 0, 0, nullptr) != CE_None ||
                   band.GetMaskBand()->RasterIO(
                       GF_Read, 0, row, width, 1, mask.data(), width, 1, GDT_Byte, 0, 0, nullptr) != CE_None)
            throw EntryError(name + "GDAL cannot read row " + std::to_string(row + 1) + ": " + CPLGetLastErrorMsg() +
                             ". Write the raster anew.");
          for (unsigned int column = 0; column < raster.n_columns; ++column)
            values[column] = mask[column] == 0 || !(std::abs(values[column]) < largest) ||
                                     std::abs(values[column] - missing) <= rounding * std::abs(missing)
                                 ? std::numeric_limits<double>::quiet_NaN()
                                 : band.GetScale() * values[column] + band.GetOffset();
        }
    }
  } // namespace


  Raster read_raster(const std::string &file, const std::string &where, const dealii::Point<2> &origin)
  {
    const std::string name = where + " = " + file + ": ";
    std::ifstream in       = open_text(file, name);
    const QuietGdal quiet;
    const auto data = open(in, file, name);
    if (const OGRSpatialReference *system = data->GetSpatialRef())
      require_metres(*system, name);
    require_values_in_metres(*data, name);
    double map[6]; // x = map[0] + map[1] column + map[2] row, y = map[3] + map[4] column + map[5] row
    if (data->GetGeoTransform(map) != CE_None)
      throw EntryError(name + "it does not say where it lies. Write one with coordinates: gdal_translate -a_ullr "
                              "x_min y_max x_max y_min sets them.");
    if (!(map[2] == 0. && map[4] == 0. && map[1] > 0. && std::abs(map[1] - std::abs(map[5])) < 1e-6 * map[1]))
      throw EntryError(name + "its cells must be squares along the axes, but their sides are " +
                       number_text({ map[1], std::abs(map[5]) }) + " m. gdalwarp -tr size size makes one.");
    Raster raster;
    raster.n_columns = data->GetRasterXSize();
    raster.n_rows    = data->GetRasterYSize();
    if (raster.n_columns < 2 || raster.n_rows < 2)
      throw EntryError(name + "it must have 2 columns and 2 rows at least.");
    std::vector<double> text;
    if (data->GetDriverName() == std::string("AAIGrid"))
      text = values_of_text(in, std::size_t(raster.n_columns) * raster.n_rows, name);
    const bool from_north = map[5] < 0.;
    raster.spacing        = map[1];
    raster.x              = map[0] + 0.5 * map[1] - origin[0];
    raster.y              = map[3] + (from_north ? raster.n_rows - 0.5 : 0.5) * map[5] - origin[1];
    raster.system         = system_of(*data, file);

    read_values(*data, text, from_north, name, raster);
    return raster;
  }


  std::string read_raster_system(const std::string &file, const std::string &where)
  {
    const std::string name = where + " = " + file + ": ";
    std::ifstream in       = open_text(file, name);
    const QuietGdal quiet;
    return system_of(*open(in, file, name), file);
  }
} // namespace scree
