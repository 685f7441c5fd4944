// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_formats_coordinate_system_h
#define scree_geometry_raster_formats_coordinate_system_h

#include <deal.II/base/point.h>

#include <string>

class OGRSpatialReference;

namespace scree
{
  /// Throws EntryError unless a text such as `EPSG:2056` is a projected system of coordinates in m that GDAL has.
  /// @param name entry and text, for the message: `entry "Coordinate system" = EPSG:1: `
  void require_system_in_metres(const std::string &system, const std::string &name);

  /// Whether both texts, each a code or that of a .prj file, are of the same system: also if they name it otherwise but
  /// have the place, m, at the same coordinates. Only names are compared of systems that GDAL does not have.
  bool is_same_system(const std::string &one, const std::string &other, const dealii::Point<2> &place);

  /// What a message calls a system: its code, or its name in the text of a .prj file.
  std::string name_of_system(const std::string &system);

  /// The text of a .prj file.
  std::string prj_text(const std::string &system);

  /// The code of the EPSG if the system has it, else the text of a .prj file; without its vertical part.
  std::string text_of_system(const OGRSpatialReference &system);
} // namespace scree

#endif
