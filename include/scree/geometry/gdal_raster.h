// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_gdal_raster_h
#define scree_geometry_gdal_raster_h

#include <scree/geometry/raster.h>

namespace scree
{
  /// Reads the first band of a raster in any format that GDAL knows, such as GeoTIFF. Throws EntryError if there is
  /// none, if it is not in m along the axes of a projected system of coordinates, or if Scree was built without GDAL.
  /// @param name of entry and file, for messages
  Raster read_gdal_raster(const std::string &file, const std::string &name);
} // namespace scree

#endif
