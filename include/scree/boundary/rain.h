// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_rain_h
#define scree_boundary_rain_h

#include <scree/input/expression.h>
#include <scree/mesh/background_grid.h>
#include <scree/particles/cell_places.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// Subsection Rain.
  struct RainParameters
  {
    std::string rate; ///< m/s, of t; empty: no rain

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Whether it rains.
    bool is_set() const
    {
      return !rate.empty();
    }

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2, one number an axis
    /// @param has_own_points whether there is water with points of its own
    /// @param air_entry pressure of the water, Pa
    void check(const std::vector<double> &gravity,
               const bool has_own_points,
               const double air_entry,
               const unsigned int n_bodies) const;
  };

  /// What rain enters.
  struct RainedSoil
  {
    double spacing;  ///< of the points, m
    double porosity; ///< at the start
  };

  /// Where the rain is that fell, m^3 (2D: m^2).
  struct RainBooks
  {
    double fell     = 0, ///< in all
        entered     = 0, ///< as points of water
        beside_soil = 0, ///< on columns without soil
        waiting     = 0; ///< for a whole drop, less what waited at the start

    /// What a run that goes on needs.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &fell &entered &beside_soil &waiting;
    }
  };

  /// Rain on the soil: drops that appear at its surface, each a point of water at rest.
  ///
  /// The box is cut into upright columns as wide as the spacing of the water's points. The depth of rain of a column is
  /// counted, and a drop of the depth that fills the pores of one spacing falls as often as this depth is reached;
  /// columns take turns. A drop fills the pores at the surface, if they are empty, or else lies on the soil or on the
  /// water there.
  template <int dim>
  class Rain
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::active_cell_iterator; ///< cells of the mesh

    /// A drop.
    struct Drop
    {
      unsigned int column;         ///< number
      dealii::Point<dim> location; ///< m
    };

    /// What the columns hold.
    struct Columns
    {
      std::vector<double> soil;   ///< heights of the highest points, m; minus infinity: there are none
      std::vector<double> water;  ///< the same of the water
      std::vector<int> has_soil;  ///< by column and slot, from the soil's surface down to half a cell
      std::vector<double> filled; ///< the same, by water, as a part of the pores
    };

    /// @param spacing of the water's points, m
    Rain(const RainParameters &parameters,
         const BackgroundGrid<dim> &grid,
         const double spacing,
         const RainedSoil &soil);

    /// Finds the cells of the current mesh.
    void reinit();

    /// Counts what falls in a step, s; returns whether drops are due.
    bool count(const double time, const double time_step);

    /// Columns without anything.
    Columns no_columns() const;

    /// Takes a point of soil or of water at `x` into account in the heights.
    void find_top(const dealii::Point<dim> &x, std::vector<double> &heights) const;

    /// Fills slots with a point of soil at `x`, once all heights are known.
    void fill_with_soil(const dealii::Point<dim> &x, Columns &columns) const;

    /// The same with a point of water.
    /// @param volume m^3
    void fill_with_water(const dealii::Point<dim> &x, const double volume, Columns &columns) const;

    /// The drops that are due; columns without soil have none. Their depth is taken off. All ranks see the same.
    /// @param columns of all ranks
    std::vector<Drop> drops(const Columns &columns);

    /// Volume of a drop, m^3 (2D: per m).
    double volume() const
    {
      return depth * std::pow(spacing, dim - 1);
    }

    /// This rank's fine cell that holds a place; null if there is none.
    const CellIterator *cell_at(const dealii::Point<dim> &x) const;

    /// Counts a drop again that found no cell.
    void postpone(const Drop &drop)
    {
      take(drop.column, -depth, books.entered);
    }

    /// Where the rain is.
    RainBooks account() const;

    /// Area on which it rains, m^2 (2D: m).
    double area() const;

    /// What a run that goes on needs.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &due &books;
    }

  private:
    /// Takes a depth off what is due in a column, and adds it to a volume.
    void take(const unsigned int column, const double taken, double &volume);

    /// Middle of a column at the box's floor.
    dealii::Point<dim> foot(const unsigned int column) const;

    /// Calls `act(column)` for the columns whose middle is at most `reach` away from `x` along each axis.
    template <typename Function>
    void for_columns_near(const dealii::Point<dim> &x, const double reach, const Function &act) const;

    /// Height of the soil's surface in a column.
    double surface(const unsigned int column, const Columns &columns) const;

    /// Whether the slots of a cell's width have room for a drop, and the uppermost of the column is empty.
    bool has_room(const unsigned int column, const Columns &columns) const;

    /// Where a drop appears.
    double height_of_drop(const unsigned int column, const Columns &columns) const;

    const BackgroundGrid<dim> &grid;
    const double spacing; // m
    const RainedSoil soil;
    const double depth; // of a drop, m
    std::unique_ptr<Expression<1>> rate;
    std::array<unsigned int, dim - 1> n; // columns along the axes
    unsigned int n_slots;                // of a column, one spacing high
    std::vector<double> due;             // depth of rain that has not become a drop, m
    RainBooks books;
    std::map<CellPlace<dim>, CellIterator> own_cells;
  };
} // namespace scree

#endif
