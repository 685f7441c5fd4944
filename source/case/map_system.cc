// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/map_system.h>
#include <scree/geometry/outline.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/geometry/raster.h>
#include <scree/input/input_error.h>

#include <utility>
#include <vector>

namespace scree
{
  namespace
  {
    /// The rasters of a case in space: what messages call their entries, and the files.
    std::vector<std::pair<std::string, std::string>> rasters_of(const Parameters &parameters)
    {
      std::vector<std::pair<std::string, std::string>> result;
      const auto add = [&](const std::string &subsection, const std::string &entry, const std::string &file) {
        if (!file.empty())
          result.emplace_back(entry_name(subsection, entry), file);
      };
      add(parameters.bed.subsection, "Raster", parameters.bed.raster());
      for (const ObstacleParameters &obstacle : parameters.obstacles)
        add(obstacle.surface.subsection, "Raster", obstacle.surface.raster());
      for (const BodyParameters &body : parameters.bodies)
        {
          const SourceMapParameters &source = body.seeding.source;
          add(body.name, "Thickness", source.thickness);
          add(body.name, "Upper surface", source.upper_surface);
        }
      return result;
    }


    /// Throws EntryError if an outline has another coordinate system than the maps; without one of theirs it has none.
    void check_outlines(const Parameters &parameters,
                        const std::string &system,
                        const std::string &source,
                        const dealii::Point<2> &place)
    {
      for (const BodyParameters &body : parameters.bodies)
        if (const std::string &file = body.seeding.source.outline; !file.empty())
          {
            const std::string entry = entry_name(body.name, "Outline"), of_outline = read_outline_system(file, entry);
            if (!system.empty() && !of_outline.empty() && !is_same_system(system, of_outline, place))
              throw EntryError(entry + " = " + file + ": its coordinate system is " + name_of_system(of_outline) +
                               ", but that of " + source + " is " + name_of_system(system) +
                               ". All maps of a case must have the same one: convert the outline with ogr2ogr -t_srs.");
          }
    }
  } // namespace


  std::string system_of_maps(const Parameters &parameters)
  {
    if (parameters.dimension != 3)
      return "";
    std::string system = parameters.coordinate_system, source;
    if (!system.empty())
      {
        source = entry_name("", "Coordinate system");
        require_system_in_metres(system, source + " = " + system + ": ");
      }
    // A place of the map.
    const dealii::Point<2> place(parameters.local_origin[0] + parameters.grid.lower_corner[0],
                                 parameters.local_origin[1] + parameters.grid.lower_corner[1]);
    for (const auto &[entry, file] : rasters_of(parameters))
      {
        const std::string of_raster = read_raster_system(file, entry);
        if (of_raster.empty())
          continue;
        if (system.empty())
          system = of_raster, source = entry + " = " + file;
        if (!is_same_system(system, of_raster, place))
          throw EntryError(entry + " = " + file + ": its coordinate system is " + name_of_system(of_raster) +
                           ", but that of " + source + " is " + name_of_system(system) +
                           ". All maps of a case must have the same one: convert the raster with gdalwarp -t_srs.");
      }
    check_outlines(parameters, system, source, place);
    if (parameters.output.maps.write && parameters.output.maps.writes_geo_tiff() && !system.empty())
      require_system_in_metres(system, source + ": its coordinate system is " + name_of_system(system) + ": ");
    return system;
  }
} // namespace scree
