// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/source_map.h>
#include <scree/geometry/triangle_surface.h>
#include <scree/input/input_error.h>
#include <scree/input/named_file.h>

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
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the vertical soil thickness above the bed or \"Lower "
                   "surface\"; 0 where "
                   "values are missing. With several entries of this kind, the body occupies the intersection.");
    add_file_entry(prm,
                   "Upper surface",
                   upper_surface,
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the heights of the upper surface of the body; no "
                   "soil where values are missing.");
    add_file_entry(prm,
                   "Lower surface",
                   lower_surface,
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the heights of the lower surface of the body; "
                   "alternative to the bed. No "
                   "soil where values are missing.");
    add_file_entry(prm,
                   "Outline",
                   outline,
                   "m; 3D. Areas on the map that enclose the body: polygons of a GeoPackage, GeoJSON file, shapefile "
                   "or other vector format of GDAL, or a text file of the corners x, y of one polygon, one per line.");
    add_file_entry(
        prm, "Closed surface", closed_surface, "m; 3D. STL file of the surface of the solid that the body occupies.");
  }


  std::pair<std::string, std::string> SourceMapParameters::first() const
  {
    if (!thickness.empty())
      return { "Thickness", thickness };
    if (!upper_surface.empty())
      return { "Upper surface", upper_surface };
    if (!closed_surface.empty())
      return { "Closed surface", closed_surface };
    if (!lower_surface.empty())
      return { "Lower surface", lower_surface };
    return { "Outline", outline };
  }


  void SourceMapParameters::check(const std::string &body,
                                  const unsigned int dim,
                                  const bool has_water,
                                  const bool has_bed) const
  {
    const auto [entry, value] = first();
    require_entry(dim == 3 || !is_set(),
                  body,
                  entry,
                  value,
                  "maps and solids of triangles are for scenes in space. Write a \"Region\".");
    require_entry(!has_water || !is_set(),
                  body,
                  entry,
                  value,
                  "bodies by maps or a closed surface are not possible with water yet. Remove subsection Water, or "
                  "write a \"Region\".");
    require_entry(thickness.empty() || upper_surface.empty(),
                  body,
                  "Upper surface",
                  upper_surface,
                  "the top is given twice. Keep one of \"Thickness\" and \"Upper surface\".");
    require_entry(thickness.empty() || has_bed || !lower_surface.empty(),
                  body,
                  "Thickness",
                  thickness,
                  "\"Thickness\" needs subsection Bed. Add it, or write a \"Lower surface\".");
    require_entry(is_region() || lower_surface.empty(),
                  body,
                  "Lower surface",
                  lower_surface,
                  "the body has no upper surface. Write a \"Thickness\" or an \"Upper surface\".");
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


    /// Throws EntryError unless the solid lies in the box.
    std::unique_ptr<LevelSet<3>> read_solid(const std::string &body,
                                            const std::string &file,
                                            const std::vector<double> &lower,
                                            const std::vector<double> &upper)
    {
      const std::string entry   = "Closed surface";
      auto solid                = read_triangle_surface(file, entry_name(body, entry));
      const auto &[first, last] = solid->bounds();
      const double tolerance    = 1e-6 * first.distance(last); // STL files hold seven digits
      bool is_in_box            = true;
      for (unsigned int a = 0; a < 3; ++a)
        is_in_box = is_in_box && first[a] >= lower[a] - tolerance && last[a] <= upper[a] + tolerance;
      require_entry(is_in_box,
                    body,
                    entry,
                    file,
                    "it reaches from " + number_text(first) + " to " + number_text(last) +
                        " m, beyond the box of subsection Mesh. Look at its unit of length and its origin, or write a "
                        "larger box.");
      return solid;
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
      , lower_surface(read(body, "Lower surface", parameters.lower_surface, origin))
  {
    if (!parameters.outline.empty())
      outline = read_outline(parameters.outline, entry_name(body, "Outline"), origin);
    if (!parameters.closed_surface.empty())
      solid = read_solid(body, parameters.closed_surface, lower, upper);
    if (thickness || upper_surface)
      check(body, { lower[0], lower[1], lower[2] }, { upper[0], upper[1], upper[2] });
    else if (outline)
      {
        const auto [first, last] = outline->bounds();
        const double rounding    = 1e-6 * first.distance(last); // of coordinates of the map
        require_entry(first[0] >= lower[0] - rounding && first[1] >= lower[1] - rounding &&
                          last[0] <= upper[0] + rounding && last[1] <= upper[1] + rounding,
                      body,
                      "Outline",
                      parameters.outline,
                      "it reaches from " + number_text(first) + " to " + number_text(last) +
                          " m, beyond the box of subsection Mesh. Look at its coordinate system, or write a larger "
                          "box.");
      }
  }


  void SourceMap::check(const std::string &body, const Point<3> &lower, const Point<3> &upper) const
  {
    const auto require = [&](const bool possible, const double x, const double y, const std::string &remedy) {
      if (!possible)
        require_entry(false, body, entry.first, entry.second, "at " + number_text({ x, y }) + " m " + remedy);
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
          const double bottom = lower_surface ? lower_surface->value_at(x, y) : lower[2];
          require(!std::isnan(bottom), x, y, "there is soil, but the lower surface has no height. Write one.");
          require(lower_surface || !ground || !ground->is_open({ x, y, lower[2] }),
                  x,
                  y,
                  "there is soil, but no bed below it in the box. Write a bed without gaps there, or a deeper box.");
          const bool ends_in_box = upper_surface   ? value <= upper[2]
                                   : lower_surface ? bottom + value <= upper[2]
                                                   : ground->is_open({ x, y, upper[2] - value });
          require(ends_in_box, x, y, "it reaches above the box of subsection Mesh. Write a higher box.");
        }
    require_entry(is_anywhere, body, entry.first, entry.second, "it has no soil anywhere. Look at the file.");
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
    add(lower_surface, "Lower surface");
    return result;
  }


  bool SourceMap::contains(const Point<3> &x) const
  {
    if (solid && solid->is_open(x))
      return false;
    if (outline && !outline->contains({ x[0], x[1] }))
      return false;
    if (upper_surface && !(x[2] < upper_surface->value_at(x[0], x[1])))
      return false;
    const double part = thickness ? thickness->value_or_zero_at(x[0], x[1]) : 0.;
    if (thickness && !(part > 0.))
      return false;
    if (lower_surface)
      {
        const double above = x[2] - lower_surface->value_at(x[0], x[1]);
        return above > 0. && (!thickness || above < part);
      }
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
    const double under = lower_surface ? lower_surface->value_at(x, y) : lower;
    if (!(under < upper))
      return nothing;
    double top = std::min(upper, over);
    if (thickness)
      top = std::min(top, part + (lower_surface ? under : ground_between(x, y, lower - part, upper - part)));
    return { std::max(under, ground_between(x, y, lower, upper)), top };
  }
} // namespace scree
