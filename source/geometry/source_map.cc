// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/source_map.h>

namespace scree
{
  using namespace dealii;

  void SourceMapParameters::add_parameters(ParameterHandler &prm)
  {
    add_file_entry(
        prm,
        "Thickness",
        thickness,
        "m; 3D. Vertical soil thickness above the bed: a raster (ESRI ASCII grid or GeoTIFF), 0 where values "
        "are missing, or one number for all areas of \"Outline\". With several entries of this kind, the body "
        "occupies the intersection.");
    add_file_entry(prm,
                   "Upper surface",
                   upper_surface,
                   "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the heights of the upper surface of the body; no "
                   "soil where values are missing.");
    add_file_entry(
        prm,
        "Outline",
        outline,
        "m; 3D. Areas on the map that enclose the body: polygons of a GeoPackage, GeoJSON file, shapefile "
        "or other vector format of GDAL, or a text file of the corners x, y of one polygon, one per line. "
        "Without \"Thickness\" and \"Upper surface\", an attribute thickness of the polygons, m, is the soil "
        "thickness above the bed.");
    prm.add_parameter(
        "Layer", layer, "2D. Layer of \"Drawing\" whose areas the body occupies, in place of \"Region\". Empty: none.");
  }


  void SourceMapParameters::check(const std::string &body,
                                  const unsigned int dim,
                                  const bool has_free_water,
                                  const bool has_bed) const
  {
    const auto [entry, value] = first();
    require_entry(layer.empty() || (thickness.empty() && upper_surface.empty() && outline.empty()),
                  { body, entry, value },
                  "maps are for scenes in space, and layers for plane ones. Keep one of them.");
    if (!layer.empty())
      return;
    require_entry(dim == 3 || !is_set(),
                  { body, entry, value },
                  "maps are for scenes in space. Write a \"Region\" or a \"Layer\".");
    require_entry(!has_free_water || !is_set(),
                  { body, entry, value },
                  "free water beside bodies by maps is not possible yet. Water in the pores is: in subsection Water "
                  "write \"Region = same\" or a \"Phreatic surface\" alone.");
    require_entry(thickness.empty() || upper_surface.empty(),
                  { body, "Upper surface", upper_surface },
                  "the top is given twice. Keep one of \"Thickness\" and \"Upper surface\".");
    require_entry(
        thickness.empty() || has_bed, { body, "Thickness", thickness }, "\"Thickness\" needs subsection Bed. Add it.");
    require_entry(!has_one_thickness() || (number_of(thickness) > 0. && !outline.empty()),
                  { body, "Thickness", thickness },
                  "a number is the thickness of the areas of an \"Outline\", above 0. Write that entry, too, or the "
                  "path of a raster.");
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


    /// Throws EntryError unless the areas lie in the box.
    void require_in_box(const Outline &areas,
                        const EntryValue &entry,
                        const std::vector<double> &lower,
                        const std::vector<double> &upper,
                        const std::string &remedy)
    {
      const auto [first, last] = areas.bounds();
      const double rounding    = 1e-6 * first.distance(last); // of coordinates of the map
      const double box         = Point<2>(lower[0], lower[1]).distance(Point<2>(upper[0], upper[1]));
      const bool is_in_mm      = first.distance(last) > 100. * box;
      require_entry(first[0] >= lower[0] - rounding && first[1] >= lower[1] - rounding &&
                        last[0] <= upper[0] + rounding && last[1] <= upper[1] + rounding,
                    entry,
                    "it reaches from " + number_text(first) + " to " + number_text(last) +
                        " m, beyond the box of subsection Mesh. " +
                        (is_in_mm ? "Coordinates are in m; scale by 0.001 what is drawn in mm." : remedy));
    }
  } // namespace


  SourceMap::SourceMap(const EntryValue &layer,
                       Outline areas,
                       const std::vector<double> &lower,
                       const std::vector<double> &upper)
      : entry(layer.entry, layer.value)
      , outline(std::move(areas))
  {
    require_in_box(*outline, layer, lower, upper, "Write a larger box, or look at the coordinates of the drawing.");
  }


  SourceMap::SourceMap(const SourceMapParameters &parameters,
                       const std::string &body,
                       const bool has_expression,
                       const std::shared_ptr<const LevelSet<3>> &ground,
                       const Point<2> &origin,
                       const std::vector<double> &lower,
                       const std::vector<double> &upper)
      : entry(parameters.first())
      , ground(ground)
      , thickness(read(body, "Thickness", parameters.has_one_thickness() ? "" : parameters.thickness, origin))
      , upper_surface(read(body, "Upper surface", parameters.upper_surface, origin))
  {
    if (!parameters.outline.empty())
      outline = read_outline(parameters.outline, entry_name(body, "Outline"), origin);
    const auto range     = outline ? outline->range_of_thickness() : std::make_pair(0., 0.);
    const bool is_raster = thickness || upper_surface, is_used = !is_raster && !parameters.has_one_thickness();
    if (range.second > 0.)
      note = (is_used ? "" : "Unusual value: ") + entry_name(body, "Outline") + " = " + parameters.outline +
             ": its areas have an attribute thickness of " + number_text(range.first) + " to " +
             number_text(range.second) + " m" +
             (is_used ? "." : ", which is not used beside " + quoted(entry.first) + ". Remove one of the two.");
    if (outline && parameters.has_one_thickness())
      outline->set_thickness(number_of(parameters.thickness));
    areas_have_thickness = !is_raster && outline && outline->range_of_thickness().second > 0.;
    const auto require   = [&](const bool possible, const std::string &remedy) {
      require_entry(possible, { body, "Outline", parameters.outline }, remedy);
    };
    require(
        is_layer() || has_expression,
        "nothing says how high the body is. Write a number or a raster as \"Thickness\", give the areas an attribute "
        "thickness, or write a \"Region\".");
    require(!areas_have_thickness || ground, "the thickness of its areas is that above a bed. Add subsection Bed.");
    if (outline && !is_raster)
      require_in_box(*outline,
                     { body, "Outline", parameters.outline },
                     lower,
                     upper,
                     "Look at its coordinate system, or write a larger box.");
    if (is_layer())
      check(body, { lower[0], lower[1], lower[2] }, { upper[0], upper[1], upper[2] });
  }


  namespace
  {
    /// The thickness of areas at nodes over the box around them; NaN outside of them.
    Raster samples_of(const Outline &outline)
    {
      constexpr unsigned int n = 256;
      const auto [first, last] = outline.bounds();
      Raster samples;
      samples.x         = first[0];
      samples.y         = first[1];
      samples.spacing   = std::max(last[0] - first[0], last[1] - first[1]) / n;
      samples.n_columns = 1 + std::floor((last[0] - first[0]) / samples.spacing);
      samples.n_rows    = 1 + std::floor((last[1] - first[1]) / samples.spacing);
      for (unsigned int i = 0; i < samples.n_columns * samples.n_rows; ++i)
        {
          const double value = outline.thickness_at({ samples.x + i % samples.n_columns * samples.spacing,
                                                      samples.y + i / samples.n_columns * samples.spacing });
          samples.values.push_back(value > 0. ? value : std::nan(""));
        }
      return samples;
    }
  } // namespace


  void SourceMap::check(const std::string &body, const Point<3> &lower, const Point<3> &upper) const
  {
    const auto require = [&](const bool possible, const double x, const double y, const std::string &remedy) {
      if (!possible)
        require_entry(false, { body, entry.first, entry.second }, "at " + number_text({ x, y }) + " m " + remedy);
    };
    const Raster samples = areas_have_thickness ? samples_of(*outline) : Raster();
    const Raster &map    = thickness ? *thickness : upper_surface ? *upper_surface : samples;
    bool is_anywhere     = areas_have_thickness;
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
    std::string result = note;
    const auto add     = [&](const std::optional<Raster> &raster, const std::string &entry) {
      if (raster)
        result +=
            (result.empty() ? "" : "\n") + raster->remark_on_heights(body + ", \"" + entry + '"', "There is no soil.");
    };
    add(thickness, "Thickness");
    add(upper_surface, "Upper surface");
    return result;
  }


} // namespace scree
