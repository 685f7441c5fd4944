// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_points_h
#define scree_particles_cell_points_h

#include <deal.II/base/config.h>
#include <deal.II/base/point.h>

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
} // namespace scree

#endif
