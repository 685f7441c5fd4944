// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_points_h
#define scree_particles_cell_points_h

#include <scree/particles/cell_places.h>

#include <deal.II/base/config.h>
#include <deal.II/grid/tria.h>
#include <deal.II/particles/particle_handler.h>

#include <cstddef>
#include <type_traits>

namespace scree
{
  /// How many points before their turn kernels ask the memory for records, which lie in no order there.
  constexpr unsigned int points_ahead = 12;

  /// The points of one cell: which slots of the rank's records they fill.
  ///
  /// @tparam Number double, or const double for points that must not change
  template <int dim, typename Number = double>
  struct CellPoints
  {
    using Location = std::conditional_t<std::is_const_v<Number>,
                                        const dealii::Point<dim>,
                                        dealii::Point<dim>>; ///< location; const if the points must not change

    unsigned int cell;         ///< active cell index
    unsigned int n_points;     ///< number of points
    const unsigned int *slots; ///< of the points; those of the cells that follow in cells() lie behind them
    unsigned int stride;       ///< doubles from one slot's properties to the next one's
    Number *properties;        ///< of slot 0
    Location *locations;       ///< of slot 0, m
    const dealii::Point<dim> *reference_locations; ///< of slot 0

    /// Properties of the cell's point `p`.
    Number *properties_of(const unsigned int p) const
    {
      return properties + std::size_t(slots[p]) * stride;
    }

    /// Where the cell's point `p` is, m.
    Location &location_of(const unsigned int p) const
    {
      return locations[slots[p]];
    }

    /// Its place in the cell, from 0 to 1 along each axis.
    const dealii::Point<dim> &reference_location_of(const unsigned int p) const
    {
      return reference_locations[slots[p]];
    }

    /// Asks the memory for the first `n` properties and the place of the point that comes `points_ahead` after point
    /// `p`, here or in the cells that follow. Inlined by force: GCC drops calls of a function that only prefetches.
    DEAL_II_ALWAYS_INLINE inline void prefetch_after(const unsigned int p, const unsigned int n) const
    {
      constexpr unsigned int cache_line = 64 / sizeof(double);
      const Number *record              = properties_of(p + points_ahead);
#pragma GCC unroll 1 // a loop of two or three lines, which GCC would unroll to eight
      for (unsigned int first = 0; first < n; first += cache_line)
        __builtin_prefetch(record + first);
      __builtin_prefetch(record + n - 1);
      __builtin_prefetch(&reference_location_of(p + points_ahead));
    }

    /// The same with all properties.
    DEAL_II_ALWAYS_INLINE inline void prefetch_after(const unsigned int p) const
    {
      prefetch_after(p, stride);
    }

    /// The same, and for its location.
    DEAL_II_ALWAYS_INLINE inline void prefetch_all_after(const unsigned int p) const
    {
      prefetch_after(p);
      __builtin_prefetch(&location_of(p + points_ahead));
    }
  };

  /// The points of one cell of a set that must not change.
  template <int dim>
  using ConstCellPoints = CellPoints<dim, const double>;

  /// One point of a set, as for_each_point() shows it.
  template <int dim, typename Number>
  struct PointView
  {
    unsigned int cell;                                    ///< active cell index
    Number *properties;                                   ///< first of the point's properties
    typename CellPoints<dim, Number>::Location &location; ///< m
    const dealii::Point<dim> &reference_location;         ///< in the cell, from 0 to 1
  };


  /// Calls `act(point)` with a PointView of each of a cell's points. Inlined by force: out of line, a kernel's sums
  /// would go through memory (a sixth more time from points to nodes).
  template <int dim, typename Number, typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_point(const CellPoints<dim, Number> &cell, const Act &act)
  {
    for (unsigned int p = 0; p < cell.n_points; ++p)
      act(PointView<dim, Number>{
          cell.cell, cell.properties_of(p), cell.location_of(p), cell.reference_location_of(p) });
  }


  /// The same for kernels that need most of a record, for all of a set's cells in turn.
  template <int dim, typename Number, typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_record(const CellPoints<dim, Number> &cell, const Act &act)
  {
    for (unsigned int p = 0; p < cell.n_points; ++p)
      {
        cell.prefetch_after(p);
        act(PointView<dim, Number>{
            cell.cell, cell.properties_of(p), cell.location_of(p), cell.reference_location_of(p) });
      }
  }

  /// The cells that a set of points has met: the walk over their faces is done once for each.
  ///
  /// Cells belong to one mesh: clear() removes them.
  template <int dim>
  class CellTable
  {
  public:
    using Iterator = typename dealii::Triangulation<dim>::active_cell_iterator; ///< iterator over the cells of the mesh

    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int, ///< stands for no cell
        unknown                        = none - 1;                              ///< for one that was not asked for yet

    /// A cell of the mesh as its points need it.
    struct Cell
    {
      /// Reads a cell of the mesh; its neighbours are not known yet.
      explicit Cell(const Iterator &iterator)
          : iterator(iterator)
          , index(iterator->active_cell_index())
          , corner(iterator->vertex(0))
      {
        neighbours.fill(unknown);
        // The mesh's first vertex is the lower corner of the box.
        const dealii::Point<dim> lower = iterator->get_triangulation().get_vertices()[0];
        CellPlace<dim> place;
        for (unsigned int a = 0; a < dim; ++a)
          {
            width[a] = iterator->vertex(1 << a)[a] - corner[a];
            place[a] = static_cast<int>(std::lround((corner[a] - lower[a]) / width[a]));
          }
        number = curve_number<dim>(place);
      }

      /// Place of `x` in the cell, as by deal.II's MappingCartesian, to the last digit.
      ///
      /// @param x location, m: a Point, or an array of `dim` batches
      template <typename Number, typename Location>
      std::array<Number, dim> place_of(const Location &x) const
      {
        std::array<Number, dim> place;
        for (unsigned int a = 0; a < dim; ++a)
          place[a] = (x[a] - corner[a]) / width[a];
        return place;
      }

      Iterator iterator;                            ///< the cell in the mesh
      unsigned int index;                           ///< active cell index
      std::uint64_t number;                         ///< of its place on the curve through the mesh
      dealii::Point<dim> corner;                    ///< lower corner, m
      dealii::Tensor<1, dim> width;                 ///< m
      std::array<unsigned int, 2 * dim> neighbours; ///< their numbers in the table, face by face, as far as known
    };

    /// Removes all cells, when the mesh changes.
    void clear()
    {
      cells.clear();
      numbers.clear();
    }

    /// The number of a cell in the table; it is added if it is not there.
    unsigned int number_of(const Iterator &cell)
    {
      if (numbers.empty())
        numbers.assign(cell->get_triangulation().n_active_cells(), none);
      unsigned int &number = numbers[cell->active_cell_index()];
      if (number == none)
        {
          number = cells.size();
          cells.emplace_back(cell);
        }
      return number;
    }

    /// The cell of a number that number_of() has returned.
    const Cell &operator[](const unsigned int number) const
    {
      return cells[number];
    }

    /// The cell one or no step along each axis from cell `number` that holds the location `x`, m; none if this rank
    /// has none.
    unsigned int neighbour_with(const unsigned int number, const dealii::Point<dim> &x);

  private:
    unsigned int neighbour(const unsigned int number, const unsigned int face);

    std::vector<Cell> cells;
    std::vector<unsigned int> numbers; // by active cell index
  };
} // namespace scree

#endif
