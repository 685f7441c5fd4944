// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_raster_formats_quiet_gdal_h
#define scree_geometry_raster_formats_quiet_gdal_h

#include <cpl_error.h>

namespace scree
{
  /// Keeps GDAL from writing on the screen what a message contains in any case, as long as it lives.
  class QuietGdal
  {
  public:
    /// Silences GDAL.
    QuietGdal()
    {
      CPLPushErrorHandler(CPLQuietErrorHandler);
    }
    QuietGdal(const QuietGdal &) = delete; ///< the handlers are a stack

    /// Lets GDAL write as before.
    ~QuietGdal()
    {
      CPLPopErrorHandler();
    }
  };
} // namespace scree

#endif
