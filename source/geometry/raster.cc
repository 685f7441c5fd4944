// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <cctype>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

namespace scree
{
  using namespace dealii;

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
           std::to_string(column + 1) + " (x = " + coordinate_text(x + column * spacing) +
           ", y = " + coordinate_text(y + row * spacing) + ")";
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
    const auto missing =
        std::count_if(values.begin(), values.end(), [](const double value) { return std::isnan(value); });
    const auto text = [this](const Place &place) { return text_of(place.first, place.second); };
    if (missing == long(values.size()))
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


  double Raster::value_at(const double x, const double y, const double missing) const
  {
    const double u = (x - this->x) / spacing, v = (y - this->y) / spacing;
    const double i = std::floor(u), j = std::floor(v);
    double sum = 0.;
    for (const unsigned int right : { 0, 1 })
      for (const unsigned int up : { 0, 1 })
        {
          const double weight = (right ? u - i : 1. - (u - i)) * (up ? v - j : 1. - (v - j));
          const double column = i + right, row = j + up;
          const bool is_there = column >= 0 && column < n_columns && row >= 0 && row < n_rows;
          const double value =
              is_there ? (*this)(static_cast<unsigned int>(column), static_cast<unsigned int>(row)) : missing;
          if (weight > 0.)
            sum += weight * (std::isnan(value) ? missing : value);
        }
    return sum;
  }


  namespace
  {
    /// Programs differ in blanks, signs and case: `CH1903+ / LV95`, `CH1903+_LV95`.
    std::string letters_of_name(const std::string &system)
    {
      std::string result;
      for (const char c : lower_case(name_of_system(system)))
        if (std::isalnum(static_cast<unsigned char>(c)))
          result += c;
      return result;
    }


    /// Nothing if GDAL does not have it. Files and the network are not asked.
    std::optional<OGRSpatialReference> known_system(const std::string &system)
    {
      const char *options[] = { "ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr };
      OGRSpatialReference result;
      if (system.empty() || result.SetFromUserInput(system.c_str(), options) != OGRERR_NONE)
        return {};
      result.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      return result;
    }


    /// The text of a .prj file; empty if GDAL cannot write the system so.
    std::string esri_text(const OGRSpatialReference &system)
    {
      char *text            = nullptr;
      const char *options[] = { "FORMAT=WKT1_ESRI", nullptr };
      const bool is_written = system.exportToWkt(&text, options) == OGRERR_NONE;
      const std::string wkt = is_written ? text : "";
      CPLFree(text);
      return wkt;
    }
  } // namespace


  std::string text_of_system(const OGRSpatialReference &with_heights)
  {
    OGRSpatialReference system(with_heights);
    system.StripVertical();
    const char *authority = system.GetAuthorityName(nullptr), *code = system.GetAuthorityCode(nullptr);
    if (authority != nullptr && code != nullptr && std::string(authority) == "EPSG")
      return std::string("EPSG:") + code;
    return esri_text(system);
  }


  std::string name_of_system(const std::string &system)
  {
    const auto begin = system.find('"'), end = system.find('"', begin + 1);
    return begin == std::string::npos || end == std::string::npos ? system : system.substr(begin + 1, end - begin - 1);
  }


  bool is_same_system(const std::string &one, const std::string &other, const dealii::Point<2> &place)
  {
    // Names are no proof: projections of one's own are often called "unknown".
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const auto first = known_system(one), second = known_system(other);
    if (!first || !second)
      return letters_of_name(one) == letters_of_name(other);
    const std::unique_ptr<OGRCoordinateTransformation> transformation(
        OGRCreateCoordinateTransformation(&*first, &*second));
    double x = place[0], y = place[1];
    return first->IsSame(&*second) ||
           (transformation && transformation->Transform(1, &x, &y) && place.distance({ x, y }) < 1e-3);
  }


  void require_system_in_metres(const std::string &text, const std::string &name)
  {
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const auto system = known_system(text);
    if (!system)
      throw EntryError(name + "GDAL knows no such system. Write the code of a projected one, such as EPSG:2056.");
    if (!system->IsProjected())
      throw EntryError(name + "it is no projected system. Write one with coordinates in m, such as EPSG:2056.");
    if (const double unit = system->GetLinearUnits(); std::abs(unit - 1.) > 1e-9)
      throw EntryError(name + "its unit of length is " + number_text(unit) +
                       " m. Write a system with coordinates in m, such as EPSG:2056.");
  }


  std::string prj_text(const std::string &text)
  {
    if (text.find('[') != std::string::npos)
      return text;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const auto system = known_system(text);
    return system ? esri_text(*system) : "";
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


  namespace
  {
    /// The system of a raster, by its code if the EPSG has one for it, which other programs then read, too.
    OGRSpatialReference system_of(const Raster &raster)
    {
      constexpr int confident = 90; // %, of the match
      OGRSpatialReference system;
      if (system.SetFromUserInput(raster.system.c_str()) != OGRERR_NONE)
        return OGRSpatialReference();
      int n_matches = 0, *confidence = nullptr;
      OGRSpatialReferenceH *matches =
          system.GetAuthorityCode(nullptr) == nullptr ? system.FindMatches(nullptr, &n_matches, &confidence) : nullptr;
      if (n_matches > 0 && confidence[0] >= confident)
        system = *OGRSpatialReference::FromHandle(matches[0]);
      OSRFreeSRSArray(matches);
      CPLFree(confidence);
      return system;
    }


    /// Turns the order of the rows round: files begin in the north.
    void flip_rows(std::vector<double> &values, const std::size_t n_columns)
    {
      for (auto first = values.begin(), last = values.end(); last - first >= 2 * long(n_columns); first += n_columns)
        std::swap_ranges(first, first + n_columns, last -= n_columns);
    }


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
        throw EntryError(name + "a number is no raster. Write the path of a GeoTIFF, or of an ESRI ASCII grid.");
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


    /// The values of a band in the order of the file; what its mask hides is NaN.
    std::vector<double> values_of_band(GDALRasterBand &band, const std::string &name)
    {
      const int width = band.GetXSize(), height = band.GetYSize();
      std::vector<double> values(std::size_t(width) * height);
      std::vector<GByte> mask(values.size());
      GDALRasterBand &of_mask = *band.GetMaskBand();
      if (band.RasterIO(GF_Read, 0, 0, width, height, values.data(), width, height, GDT_Float64, 0, 0, nullptr) ||
          of_mask.RasterIO(GF_Read, 0, 0, width, height, mask.data(), width, height, GDT_Byte, 0, 0, nullptr))
        throw EntryError(name + "GDAL cannot read it: " + CPLGetLastErrorMsg() + ". Write the raster anew.");
      for (std::size_t i = 0; i < values.size(); ++i)
        if (mask[i] == 0)
          values[i] = std::numeric_limits<double>::quiet_NaN();
      return values;
    }
  } // namespace


  std::string geo_tiff(const Raster &raster, const std::string &name, const std::string &unit)
  {
    GDALAllRegister();
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const char *const file = "/vsimem/scree_map.tif"; // in memory
    const char *options[]  = { "COMPRESS=DEFLATE", nullptr };
    std::unique_ptr<GDALDataset> data(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file, raster.n_columns, raster.n_rows, 1, GDT_Float32, const_cast<char **>(options)));
    AssertThrow(data, dealii::ExcMessage("GDAL cannot make a GeoTIFF: " + std::string(CPLGetLastErrorMsg())));
    double map[6] = {
      raster.x - 0.5 * raster.spacing, raster.spacing, 0., raster.last_y() + 0.5 * raster.spacing, 0., -raster.spacing
    };
    data->SetGeoTransform(map);
    if (!raster.system.empty())
      {
        const OGRSpatialReference system = system_of(raster);
        data->SetSpatialRef(&system);
      }
    GDALRasterBand &band = *data->GetRasterBand(1);
    band.SetNoDataValue(missing_value);
    band.SetDescription(name.c_str());
    band.SetUnitType(unit.c_str());
    std::vector<double> values = raster.values;
    std::replace_if(
        values.begin(), values.end(), [](const double value) { return std::isnan(value); }, missing_value);
    flip_rows(values, raster.n_columns);
    const int width = raster.n_columns, height = raster.n_rows;
    const bool is_written =
        band.RasterIO(GF_Write, 0, 0, width, height, values.data(), width, height, GDT_Float64, 0, 0, nullptr) ==
        CE_None;
    data.reset(); // completes the file
    vsi_l_offset size = 0;
    GByte *bytes      = VSIGetMemFileBuffer(file, &size, TRUE);
    const std::string content(reinterpret_cast<const char *>(bytes), bytes ? size : 0);
    VSIFree(bytes);
    AssertThrow(is_written && bytes, dealii::ExcMessage("GDAL has no room for a GeoTIFF."));
    return content;
  }


  Raster read_raster(const std::string &file, const std::string &where, const dealii::Point<2> &origin)
  {
    const std::string name = where + " = " + file + ": ";
    std::ifstream in       = open_text(file, name);
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
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
    const bool from_north = map[5] < 0.;
    raster.spacing        = map[1];
    raster.x              = map[0] + 0.5 * map[1] - origin[0];
    raster.y              = map[3] + (from_north ? raster.n_rows - 0.5 : 0.5) * map[5] - origin[1];
    raster.system         = system_of(*data, file);

    GDALRasterBand &band = *data->GetRasterBand(1);
    raster.values        = data->GetDriverName() == std::string("AAIGrid")
                               ? values_of_text(in, std::size_t(raster.n_columns) * raster.n_rows, name)
                               : values_of_band(band, name);
    if (from_north)
      flip_rows(raster.values, raster.n_columns);
    // The value for missing ones may be rounded otherwise than theirs; no height is as large as 1e30 m.
    constexpr double rounding = 1e-7, largest = 1e30;
    int has_missing;
    const double marked  = band.GetNoDataValue(&has_missing);
    const double missing = has_missing && !std::isnan(marked) ? marked : missing_value;
    for (double &value : raster.values)
      value = std::abs(value) < largest && std::abs(value - missing) > rounding * std::abs(missing)
                  ? band.GetScale() * value + band.GetOffset()
                  : std::numeric_limits<double>::quiet_NaN();
    return raster;
  }


  std::string read_raster_system(const std::string &file, const std::string &where)
  {
    const std::string name = where + " = " + file + ": ";
    std::ifstream in       = open_text(file, name);
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    return system_of(*open(in, file, name), file);
  }
} // namespace scree
