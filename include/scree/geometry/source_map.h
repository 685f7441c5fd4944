// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_source_map_h
#define scree_geometry_source_map_h

#include <scree/geometry/bed_parameters.h>
#include <scree/geometry/drawing.h>

#include <optional>

namespace scree
{
  /// Where a body is, by maps or by a layer of a drawing: entries of its subsection.
  struct SourceMapParameters
  {
    std::string thickness, ///< file of thicknesses above the bed, or one thickness of all areas of the outline, m
        upper_surface,     ///< file of heights, m
        outline,           ///< file of polygons on the map, m
        layer;             ///< of the drawing, in the plane

    /// Declares the entries in the subsection that the handler is in.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations; `body` is the name of the subsection.
    void check(const std::string &body, const unsigned int dim, const bool has_free_water, const bool has_bed) const;

    /// Whether any of them is given.
    bool is_set() const
    {
      return !layer.empty() || !thickness.empty() || !upper_surface.empty() || !outline.empty();
    }

    /// Whether entry "Thickness" is a number and no file.
    bool has_one_thickness() const
    {
      return !std::isnan(number_of(thickness));
    }

    /// Entry and value of the first that is given, for messages.
    std::pair<std::string, std::string> first() const
    {
      if (!layer.empty())
        return { "Layer", layer };
      if (!thickness.empty())
        return { "Thickness", thickness };
      if (!upper_surface.empty())
        return { "Upper surface", upper_surface };
      return { "Outline", outline };
    }
  };

  /// The part of space that a body's maps bound: above its bed, by less than a thickness or up to an upper surface,
  /// within an outline. Between their values rasters are bilinear; where a thickness is missing it is 0, where a height
  /// is missing the body is not. Areas of an outline have one thickness each. In the plane: the areas of a layer.
  class SourceMap
  {
  public:
    /// Reads the files; throws EntryError if they are no source in the box and above the bed.
    /// @param body name of the subsection
    /// @param has_expression whether an expression bounds the body, too
    /// @param ground the bed; null without it
    /// @param origin of the map
    /// @param lower, upper corners of the box, m
    SourceMap(const SourceMapParameters &parameters,
              const std::string &body,
              const bool has_expression,
              const std::shared_ptr<const LevelSet<3>> &ground,
              const dealii::Point<2> &origin,
              const std::vector<double> &lower,
              const std::vector<double> &upper);

    /// The areas of a layer, in the plane. Throws EntryError if they reach beyond the box.
    /// @param lower, upper corners of the box, m
    SourceMap(const EntryValue &layer,
              Outline areas,
              const std::vector<double> &lower,
              const std::vector<double> &upper);

    /// Whether a place, m, is inside the body.
    bool contains(const dealii::Point<2> &x) const
    {
      return outline->contains(x);
    }

    /// The same in space.
    bool contains(const dealii::Point<3> &x) const
    {
      if (outline && !outline->contains({ x[0], x[1] }))
        return false;
      if (upper_surface && !(x[2] < upper_surface->value_at(x[0], x[1])))
        return false;
      const double part = thickness_at(x[0], x[1]);
      if (has_thickness() && !(part > 0.))
        return false;
      // Less than a thickness above the ground is what would be below it by that much less.
      return !ground || (ground->is_open(x) && (!has_thickness() || !ground->is_open({ x[0], x[1], x[2] - part })));
    }

    /// Whether maps alone bound the body below and above, so that part_of_line() may be asked.
    bool is_layer() const
    {
      return has_thickness() || upper_surface;
    }

    /// Of the outline, m^2; 0 without.
    double area() const
    {
      return outline ? outline->area() : 0.;
    }

    /// The heights, m, between which the body is above x, y of the map and above ground, as far as they are between two
    /// others; nothing is there if the second is not larger. The ground must not overhang.
    std::pair<double, double> part_of_line(const double x, const double y, const double lower, const double upper) const
    {
      const std::pair<double, double> nothing{ lower, lower };
      const double part = thickness_at(x, y);
      const double over = upper_surface ? upper_surface->value_at(x, y) : upper;
      if ((has_thickness() && !(part > 0.)) || !(over > lower) || (outline && !outline->contains({ x, y })))
        return nothing;
      double top = std::min(upper, over);
      if (has_thickness())
        top = std::min(top, part + ground_between(x, y, lower - part, upper - part));
      return { ground_between(x, y, lower, upper), top };
    }

    /// Remarks on the heights of its surfaces for the log, in lines; empty: none.
    /// @param body its name
    std::string remark(const std::string &body) const;

    /// Entry and value, for messages.
    const std::pair<std::string, std::string> entry;

  private:
    bool has_thickness() const
    {
      return thickness || areas_have_thickness;
    }

    /// Vertical, m; 0 without or where it is missing.
    double thickness_at(const double x, const double y) const
    {
      return thickness ? thickness->value_at(x, y, 0.) : areas_have_thickness ? outline->thickness_at({ x, y }) : 0.;
    }

    /// Throws EntryError unless every place with a value that counts lies in the box and on ground.
    void check(const std::string &body, const dealii::Point<3> &lower, const dealii::Point<3> &upper) const;

    /// The height, m, between two others from which on a place above x, y of the map is above ground.
    double ground_between(const double x, const double y, const double lower, const double upper) const
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

    const std::shared_ptr<const LevelSet<3>> ground;
    std::optional<Raster> thickness, upper_surface;
    std::optional<Outline> outline;
    std::string note;                  // for the log, on the thickness of its areas
    bool areas_have_thickness = false; // and no other entry says what is above the ground
  };
} // namespace scree

#endif
