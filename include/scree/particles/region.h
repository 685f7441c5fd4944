// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_region_h
#define scree_particles_region_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/source_map.h>
#include <scree/input/expression.h>

#include <memory>
#include <string>
#include <utility>

namespace scree
{
  /// A part of space: inside where an expression of the coordinates is true (not 0), and maps agree if there are any;
  /// of water also where a water table is above.
  template <int dim>
  class Region
  {
  public:
    /// @param where entry_name(), for the message if the expression does not parse
    /// @param map null without maps; not in 2D
    /// @param table whose open is dry; null without
    Region(const std::string &where,
           const std::string &expression,
           const std::shared_ptr<const SourceMap> &map       = nullptr,
           const std::shared_ptr<const LevelSet<dim>> &table = nullptr);

    /// Throws ValueError if the expression is no number there.
    bool contains(const dealii::Point<dim> &x) const
    {
      if constexpr (dim == 3)
        if (map && !map->contains(x))
          return false;
      return holds(x);
    }

    /// Places that touches_cube() looks at.
    static constexpr unsigned int n_places_of_cube = (1 << dim) + 1;

    /// Whether part_of_cube() may find any of the region there.
    bool touches_cube(const dealii::Point<dim> &lower, const double width) const;

    /// Volume, m^3, and centroid, m, of the part of the region that lies in a small cube, by sampling; where maps bound
    /// it, by vertical lines.
    /// @param ground only what is in its open counts, cut exactly where ground and region are plane; null: all
    std::pair<double, dealii::Point<dim>>
    part_of_cube(const dealii::Point<dim> &lower, const double width, const LevelSet<dim> *ground = nullptr) const;

  private:
    /// What is asked besides the maps.
    bool holds(const dealii::Point<dim> &x) const
    {
      return function->value(x) != 0. && !(table && table->is_open(x));
    }

    /// Corners of the cube, a little inside it: a region may end at its face.
    static dealii::Point<dim> corner(const dealii::Point<dim> &lower, const double width, const unsigned int vertex);
    static dealii::Point<dim> middle(const dealii::Point<dim> &lower, const double width);

    /// part_of_cube() where maps bound the region: by vertical lines, so that it may be thinner than the cube.
    std::pair<double, dealii::Point<dim>> part_by_lines(const dealii::Point<dim> &lower, const double width) const;

    std::unique_ptr<Expression<dim>> function;
    std::shared_ptr<const SourceMap> map;
    std::shared_ptr<const LevelSet<dim>> table;
  };
} // namespace scree

#endif
