// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_table_h
#define scree_particles_cell_table_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <cstdint>
#include <vector>

namespace scree
{
  /// A cell of the mesh as its points need it.
  template <int dim>
  struct TableCell
  {
    using Iterator = typename dealii::Triangulation<dim>::active_cell_iterator; ///< iterator over the cells of the mesh

    /// Reads a cell of the mesh; its neighbours are not known yet.
    explicit TableCell(const Iterator &iterator);

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

  /// The cells that a set of points has met: the walk over their faces is done once for each.
  ///
  /// Cells belong to one mesh: clear() removes them.
  template <int dim>
  class CellTable
  {
  public:
    using Iterator = typename TableCell<dim>::Iterator; ///< iterator over the cells of the mesh

    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int; ///< stands for no cell

    /// Removes all cells, when the mesh changes.
    void clear();

    /// The number of a cell in the table; it is added if it is not there.
    unsigned int number_of(const Iterator &cell);

    /// The cell of a number that number_of() has returned.
    const TableCell<dim> &operator[](const unsigned int number) const
    {
      return cells[number];
    }

    /// The cell one or no step along each axis from cell `number` that holds the location `x`, m; none if this rank
    /// has none.
    unsigned int neighbour_with(const unsigned int number, const dealii::Point<dim> &x);

  private:
    static constexpr unsigned int unknown = none - 1;

    unsigned int neighbour(const unsigned int number, const unsigned int face);

    std::vector<TableCell<dim>> cells;
    std::vector<unsigned int> numbers; // by active cell index
  };
} // namespace scree

#endif
