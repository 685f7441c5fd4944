// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/source_map.h>
#include <scree/input/input_error.h>
#include <scree/input/case_entries.h>

#include <algorithm>
#include <cmath>

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


  std::pair<std::string, std::string> SourceMapParameters::first() const
  {
    if (!thickness.empty())
      return { "Thickness", thickness };
    if (!upper_surface.empty())
      return { "Upper surface", upper_surface };
    return { "Outline", outline };
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


  bool SourceMap::contains(const Point<3> &x) const
  {
    if (outline && !outline->contains({ x[0], x[1] }))
      return false;
    if (upper_surface && !(x[2] < upper_surface->value_at(x[0], x[1])))
      return false;
    const double part = thickness ? thickness->value_or_zero_at(x[0], x[1]) : 0.;
    if (thickness && !(part > 0.))
      return false;
    // Less than a thickness above the ground is what would be below it by that much less.
    return !ground || (ground->is_open(x) && (!thickness || !ground->is_open({ x[0], x[1], x[2] - part })));
  }


  double SourceMap::ground_between(const double x, const double y, const double lower, const double upper) const
  {
    if (!ground || ground->is_open({ x, y, lower }))
      return lower;
    if (!ground->is_open({ x, y, upper }))
      return upper;
    constexpr unsigned int n_halvings = 24;
    double below = lower, above = upper;
    for (unsigned int i = 0; i < n_halvings; ++i)
      {
        const double middle                                 = 0.5 * (below + above);
        (ground->is_open({ x, y, middle }) ? above : below) = middle;
      }
    return above;
  }


  std::pair<double, double>
  SourceMap::part_of_line(const double x, const double y, const double lower, const double upper) const
  {
    const std::pair<double, double> nothing{ lower, lower };
    const double part = thickness ? thickness->value_or_zero_at(x, y) : 0.;
    const double over = upper_surface ? upper_surface->value_at(x, y) : upper;
    if ((thickness && !(part > 0.)) || !(over > lower) || (outline && !outline->contains({ x, y })))
      return nothing;
    double top = std::min(upper, over);
    if (thickness)
      top = std::min(top, part + ground_between(x, y, lower - part, upper - part));
    return { ground_between(x, y, lower, upper), top };
  }
} // namespace scree
