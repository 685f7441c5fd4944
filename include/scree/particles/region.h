// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_region_h
#define scree_particles_region_h

#include <scree/geometry/source_map.h>
#include <scree/particles/point_set.h>

#include <deal.II/base/function.h>

namespace scree
{
  /// A part of space: inside where an expression of the coordinates is true (not 0), and maps agree if there are any;
  /// of water also where a water table is above, and not where others are.
  template <int dim>
  class Region
  {
  public:
    /// @param where entry_name(), for the message if the expression does not parse
    /// @param map null without maps or a layer
    /// @param table whose open is dry; null without
    /// @param others what they contain is outside
    Region(const std::string &where,
           const std::string &expression,
           const std::shared_ptr<const SourceMap> &map                 = nullptr,
           const std::shared_ptr<const LevelSet<dim>> &table           = nullptr,
           const std::vector<std::shared_ptr<const SourceMap>> &others = {})
        : function(parse_expression<dim>(where, expression, 1))
        , map(map)
        , table(table)
        , others(others)
    {
    }

    /// Throws ValueError if the expression is no number there.
    bool contains(const dealii::Point<dim> &x) const
    {
      return !(map && !map->contains(x)) && holds(x);
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
      return function->value(x) != 0. && !(table && table->is_open(x)) &&
             std::none_of(others.begin(), others.end(), [&](const auto &other) { return other->contains(x); });
    }

    /// Corners of the cube, a little inside it: a region may end at its face.
    static dealii::Point<dim> corner(const dealii::Point<dim> &lower, const double width, const unsigned int vertex);
    static dealii::Point<dim> middle(const dealii::Point<dim> &lower, const double width)
    {
      dealii::Point<dim> middle = lower;
      for (unsigned int a = 0; a < dim; ++a)
        middle[a] += width / 2.;
      return middle;
    }

    /// part_of_cube() where maps bound the region: by vertical lines, so that it may be thinner than the cube.
    std::pair<double, dealii::Point<dim>> part_by_lines(const dealii::Point<dim> &lower, const double width) const;

    std::unique_ptr<Expression<dim>> function;
    std::shared_ptr<const SourceMap> map;
    std::shared_ptr<const LevelSet<dim>> table;
    std::vector<std::shared_ptr<const SourceMap>> others;
  };

  /// A point to be.
  template <int dim>
  struct Seed
  {
    typename dealii::Triangulation<dim>::active_cell_iterator cell; ///< cell in which it stands
    dealii::Point<dim> location;                                    ///< m
    double volume;                                                  ///< m^3 (2D: per m)
    double filled = 1.;    ///< part of a cube of the lattice that its region covers, of several the sum
    bool stays    = false; ///< in its cell, however little it is: free water has a pressure there

    static constexpr double least_filled = 0.25; ///< seeds that fill less are slivers

    /// Whether it fills less than `least_filled` of its cube.
    bool is_sliver() const
    {
      return filled < least_filled;
    }

    /// Takes the volume, m^3, and what it fills from another place and moves to the common centroid.
    void take_in(const dealii::Point<dim> &from, const double more_volume, const double more_filled)
    {
      volume += more_volume;
      filled += more_filled;
      location += more_volume / volume * (from - location);
    }
  };

  /// What a material fills of the cube with this lower corner, m, and width, m: the seed without its cell, with what
  /// its region covers as `filled`, m^3 (2D: m^2), of which the volume of the material itself is a part in pores.
  template <int dim>
  using PartOfCube = std::function<Seed<dim>(const dealii::Point<dim> &lower, const double width)>;

  /// The seeds of this rank's cells on a lattice of cubes. Cubes covered by less than a quarter join the nearest fuller
  /// one of their cell.
  /// @param n points along each axis of a cell
  template <int dim>
  std::vector<Seed<dim>> lattice_seeds(const dealii::Triangulation<dim> &triangulation,
                                       const double cell_size,
                                       const unsigned int n,
                                       const PartOfCube<dim> &part_of_cube);

  /// Writes a new point's properties, which are 0 before.
  template <int dim>
  using FillProperties = std::function<void(const Seed<dim> &seed, std::vector<double> &properties)>;

  /// Makes points of the seeds. Collective.
  template <int dim>
  void insert_points(PointSet<dim> &points,
                     const std::vector<Seed<dim>> &seeds,
                     const double cell_size,
                     const MPI_Comm communicator,
                     const FillProperties<dim> &fill);
} // namespace scree

#endif
