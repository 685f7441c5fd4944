// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/source_map.h>

namespace scree
{
  using namespace dealii;

  void SourceMapParameters::add_parameters(ParameterHandler &prm)
  {
    add_file_entry(prm,
                   "Thickness",
                   thickness,
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the vertical soil thickness above the bed; 0 where "
                   "values are missing. With several entries of this kind, the body occupies the intersection.");
    add_file_entry(prm,
                   "Upper surface",
                   upper_surface,
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the heights of the upper surface of the body; no "
                   "soil where values are missing.");
    add_file_entry(prm,
                   "Outline",
                   outline,
                   "m; 3D. Areas on the map that enclose the body: polygons of a GeoPackage, GeoJSON file, shapefile "
                   "or other vector format of GDAL, or a text file of the corners x, y of one polygon, one per line.");
  }


  void SourceMapParameters::check(const std::string &body,
                                  const unsigned int dim,
                                  const bool has_water,
                                  const bool has_bed) const
  {
    const auto [entry, value] = first();
    require_entry(dim == 3 || !is_set(), { body, entry, value }, "maps are for scenes in space. Write a \"Region\".");
    require_entry(!has_water || !is_set(),
                  { body, entry, value },
                  "bodies by maps are not possible with water yet. Remove subsection Water, or write a \"Region\".");
    require_entry(thickness.empty() || upper_surface.empty(),
                  { body, "Upper surface", upper_surface },
                  "the top is given twice. Keep one of \"Thickness\" and \"Upper surface\".");
    require_entry(
        thickness.empty() || has_bed, { body, "Thickness", thickness }, "\"Thickness\" needs subsection Bed. Add it.");
  }


  namespace
  {
    std::optional<Raster>
    read(const std::string &body, const std::string &entry, const std::string &file, const Point<2> &origin)
    {
      if (file.empty())
        return {};
      return read_raster(file, entry_name(body, entry), origin);
    }

  } // namespace


  SourceMap::SourceMap(const SourceMapParameters &parameters,
                       const std::string &body,
                       const std::shared_ptr<const LevelSet<3>> &ground,
                       const Point<2> &origin,
                       const std::vector<double> &lower,
                       const std::vector<double> &upper)
      : entry(parameters.first())
      , ground(ground)
      , thickness(read(body, "Thickness", parameters.thickness, origin))
      , upper_surface(read(body, "Upper surface", parameters.upper_surface, origin))
  {
    if (!parameters.outline.empty())
      outline = read_outline(parameters.outline, entry_name(body, "Outline"), origin);
    if (thickness || upper_surface)
      check(body, { lower[0], lower[1], lower[2] }, { upper[0], upper[1], upper[2] });
    else if (outline)
      {
        const auto [first, last] = outline->bounds();
        const double rounding    = 1e-6 * first.distance(last); // of coordinates of the map
        require_entry(first[0] >= lower[0] - rounding && first[1] >= lower[1] - rounding &&
                          last[0] <= upper[0] + rounding && last[1] <= upper[1] + rounding,
                      { body, "Outline", parameters.outline },
                      "it reaches from " + number_text(first) + " to " + number_text(last) +
                          " m, beyond the box of subsection Mesh. Look at its coordinate system, or write a larger "
                          "box.");
      }
  }


  void SourceMap::check(const std::string &body, const Point<3> &lower, const Point<3> &upper) const
  {
    const auto require = [&](const bool possible, const double x, const double y, const std::string &remedy) {
      if (!possible)
        require_entry(false, { body, entry.first, entry.second }, "at " + number_text({ x, y }) + " m " + remedy);
    };
    const Raster &map = thickness ? *thickness : *upper_surface;
    bool is_anywhere  = false;
    for (unsigned int row = 0; row < map.n_rows; ++row)
      for (unsigned int column = 0; column < map.n_columns; ++column)
        {
          const double x = map.x + column * map.spacing, y = map.y + row * map.spacing, value = map(column, row);
          require(!thickness || !(value < 0.), x, y, "it is negative. Write 0 where there is no soil.");
          if (std::isnan(value) || (thickness && value == 0.) || (outline && !outline->contains({ x, y })))
            continue;
          is_anywhere = true;
          require(x >= lower[0] && x <= upper[0] && y >= lower[1] && y <= upper[1],
                  x,
                  y,
                  "there is soil outside the box of subsection Mesh. Write a larger box, or nothing there.");
          require(!ground || !ground->is_open({ x, y, lower[2] }),
                  x,
                  y,
                  "there is soil, but no bed below it in the box. Write a bed without gaps there, or a deeper box.");
          const bool ends_in_box = upper_surface ? value <= upper[2] : ground->is_open({ x, y, upper[2] - value });
          require(ends_in_box, x, y, "it reaches above the box of subsection Mesh. Write a higher box.");
        }
    require_entry(is_anywhere, { body, entry.first, entry.second }, "it has no soil anywhere. Look at the file.");
  }


  std::string SourceMap::remark(const std::string &body) const
  {
    std::string result;
    const auto add = [&](const std::optional<Raster> &raster, const std::string &entry) {
      if (raster)
        result +=
            (result.empty() ? "" : "\n") + raster->remark_on_heights(body + ", \"" + entry + '"', "There is no soil.");
    };
    add(thickness, "Thickness");
    add(upper_surface, "Upper surface");
    return result;
  }


} // namespace scree
