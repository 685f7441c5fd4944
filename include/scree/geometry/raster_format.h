// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_format_h
#define scree_geometry_raster_format_h

#include <scree/geometry/raster.h>

#include <istream>
#include <string>

namespace scree
{
  /// Why a format of rasters would read a file; the format with the largest one does.
  enum class RasterClaim
  {
    none,
    any,      ///< what nobody else reads
    contents, ///< by how the file begins
    ending    ///< by its name
  };

  /// The text of the .prj file that lies beside a raster; empty without one.
  std::string system_beside(const std::string &file, const std::string &name);

  /// Adds a format of rasters; its source file has one as a static constant.
  class RegisterRasterFormat
  {
  public:
    /// @param name of the format; of formats with the same claim the first one in the order of names reads
    /// @param claim (file's contents, its path)
    /// @param read (contents from their beginning, path, entry and path for messages); throws EntryError
    /// @param system (path, entry and path for messages); of the map's coordinates, see Raster::system
    RegisterRasterFormat(const std::string &name,
                         RasterClaim (*claim)(std::istream &, const std::string &),
                         Raster (*read)(std::istream &, const std::string &, const std::string &),
                         std::string (*system)(const std::string &, const std::string &) = system_beside);
  };
} // namespace scree

#endif
