// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_box_of_raster_h
#define scree_case_box_of_raster_h

#include <scree/case/body_parameters.h>
#include <scree/geometry/bed_parameters.h>

namespace scree
{
  /// A box around the ground of a raster.
  struct BoxOfRaster
  {
    std::vector<double> lower, ///< corner, m; not yet of whole cells
        upper;                 ///< corner, m; not yet of whole cells
    double lowest,             ///< height of the raster, m
        highest;               ///< height of the raster, m
  };

  /// The box that a bed's raster asks for: its outline, two cells below the lowest height, and four cells above the
  /// highest soil. How high a body reaches that is given by an expression is not known: room for it is a quarter of the
  /// relief and ten cells. Throws EntryError if a file cannot be read or has no heights.
  BoxOfRaster
  box_of_raster(const BedParameters &bed, const std::vector<BodyParameters> &bodies, const double cell_size);

  /// Numbers as they must be written to be the same when they are read again, within 15 digits.
  std::string exact_text(const std::vector<double> &numbers);
} // namespace scree

#endif
