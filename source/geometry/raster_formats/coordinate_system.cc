// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/geometry/raster_formats/quiet_gdal.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cpl_conv.h>
#include <memory>
#include <ogr_spatialref.h>
#include <optional>

namespace scree
{
  std::string name_of_system(const std::string &system)
  {
    const auto begin = system.find('"'), end = system.find('"', begin + 1);
    return begin == std::string::npos || end == std::string::npos ? system : system.substr(begin + 1, end - begin - 1);
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


    /// Whether the coordinates of a place in one system are, within 1 mm, those in the other one.
    bool has_same_coordinates(const OGRSpatialReference &one, const OGRSpatialReference &other, double x, double y)
    {
      const std::unique_ptr<OGRCoordinateTransformation> transformation(
          OGRCreateCoordinateTransformation(&one, &other));
      const double x_before = x, y_before = y;
      return transformation && transformation->Transform(1, &x, &y) && std::hypot(x - x_before, y - y_before) < 1e-3;
    }
  } // namespace


  bool is_same_system(const std::string &one, const std::string &other, const dealii::Point<2> &place)
  {
    // Names are no proof: projections of one's own are often called "unknown".
    const QuietGdal quiet;
    if (const auto first = known_system(one), second = known_system(other); first && second)
      return first->IsSame(&*second) || has_same_coordinates(*first, *second, place[0], place[1]);
    return letters_of_name(one) == letters_of_name(other);
  }


  void require_system_in_metres(const std::string &text, const std::string &name)
  {
    const QuietGdal quiet;
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
    const QuietGdal quiet;
    const auto system     = known_system(text);
    char *result          = nullptr;
    const char *options[] = { "FORMAT=WKT1_ESRI", nullptr };
    const bool is_written = system && system->exportToWkt(&result, options) == OGRERR_NONE;
    const std::string wkt = is_written ? result : "";
    CPLFree(result);
    return wkt;
  }


  std::string text_of_system(const OGRSpatialReference &with_heights)
  {
    OGRSpatialReference system(with_heights);
    system.StripVertical();
    const char *authority = system.GetAuthorityName(nullptr), *code = system.GetAuthorityCode(nullptr);
    if (authority != nullptr && code != nullptr && std::string(authority) == "EPSG")
      return std::string("EPSG:") + code;
    char *text            = nullptr;
    const char *options[] = { "FORMAT=WKT1_ESRI", nullptr };
    const bool is_known   = system.exportToWkt(&text, options) == OGRERR_NONE;
    const std::string wkt = is_known ? text : "";
    CPLFree(text);
    return wkt;
  }
} // namespace scree
