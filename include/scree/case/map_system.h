// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_map_system_h
#define scree_case_map_system_h

#include <scree/case/parameters.h>

#include <string>

namespace scree
{
  /// The coordinate system of the case's maps, see Raster::system: that of entry `Coordinate system`, else that of the
  /// first raster that has one; empty if none is known. Throws EntryError if the entry is no such system, or if rasters
  /// have others.
  std::string system_of_maps(const Parameters &parameters);
} // namespace scree

#endif
