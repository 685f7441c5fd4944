// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/box_of_raster.h>
#include <scree/geometry/raster.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace scree
{
  namespace
  {
    /// How far above the ground's highest place the body may reach, m.
    double room_for(const BodyParameters &body,
                    const BedParameters &bed,
                    const double highest,
                    const double relief,
                    const double cell_size)
    {
      const SourceMapParameters &source = body.seeding.source;
      const auto largest                = [&](const std::string &entry, const std::string &file) {
        return read_raster(file, entry_name(body.name, entry), bed.map_origin).range().second;
      };
      if (!source.thickness.empty())
        return largest("Thickness", source.thickness);
      if (!source.upper_surface.empty())
        return std::max(0., largest("Upper surface", source.upper_surface) - highest);
      return 0.25 * relief + 10. * cell_size;
    }
  } // namespace


  BoxOfRaster box_of_raster(const BedParameters &bed, const std::vector<BodyParameters> &bodies, const double cell_size)
  {
    const Raster raster          = read_raster(bed.raster(), entry_name(bed.subsection, "Raster"), bed.map_origin);
    const auto [lowest, highest] = raster.range();
    require_entry(lowest <= highest,
                  bed.subsection,
                  "Raster",
                  bed.raster(),
                  "all its heights are missing (NODATA). Look at the file.");
    double room = 0.;
    for (const BodyParameters &body : bodies)
      room = std::max(room, room_for(body, bed, highest, highest - lowest, cell_size));
    const double floor = cell_size * (std::floor(lowest / cell_size) - 2.);
    return { { raster.x, raster.y, floor },
             { raster.last_x(), raster.last_y(), highest + room + 4. * cell_size },
             lowest,
             highest };
  }


  std::string exact_text(const std::vector<double> &numbers)
  {
    std::ostringstream text;
    text.precision(15);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      text << (i == 0 ? "" : ", ") << numbers[i];
    return text.str();
  }
} // namespace scree
