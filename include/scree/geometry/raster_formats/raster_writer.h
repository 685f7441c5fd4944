// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_formats_raster_writer_h
#define scree_geometry_raster_formats_raster_writer_h

#include <scree/geometry/raster.h>

#include <string>

namespace scree
{
  /// Stands for missing values in files, as in most programs of maps.
  constexpr double missing_value = -9999.;

  /// The content of an ESRI ASCII grid.
  std::string ascii_grid(const Raster &raster);

  /// The content of a GeoTIFF of one band of 32-bit numbers, in the raster's system of coordinates.
  /// @param name of the band, such as `thickness`
  /// @param unit of its values
  std::string geo_tiff(const Raster &raster, const std::string &name, const std::string &unit);
} // namespace scree

#endif
