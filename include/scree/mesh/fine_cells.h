// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_fine_cells_h
#define scree_mesh_fine_cells_h

#include <scree/particles/cell_places.h>

#include <deal.II/base/utilities.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace scree
{
  /// Where points are to be put, for who looks for them in a box.
  template <int dim>
  struct PlacesOfPoints
  {
    /// Whether any are put in the cell with this lower corner, m.
    std::function<bool(const dealii::Point<dim> &corner)> in_cell;

    /// Whether the place x, m, of that cell shows that they are.
    std::function<bool(const dealii::Point<dim> &corner, const dealii::Point<dim> &x)> at_place;

    /// Places that in_cell() looks at.
    unsigned int n_places_of_cell;
  };

  /// Blocks of all ranks with cells in which points are put. All cells are looked at closely if these are few; else
  /// each at one place or some, spread evenly over cell and box, and closely only cells near those where that finds
  /// points: a part is missed only if no larger than a cell or so, and on its own. Throws on all ranks what `places`
  /// throws. Collective.
  template <int dim>
  Blocks occupied_blocks(const CellsOfBox<dim> &box, const PlacesOfPoints<dim> &places, const MPI_Comm communicator);

  /// The cells that hold nodes, of this rank and around it: those of the finest size inside the box.
  ///
  /// Their order is that of the curve through the mesh, whatever the mesh was before: so a run that goes on from a
  /// checkpoint adds in the same order as one that was not interrupted.
  template <int dim>
  class FineCells
  {
  public:
    /// A fine cell of this rank or a ghost.
    struct Cell
    {
      std::uint64_t number;                                              ///< of its place on the curve
      CellPlace<dim> place;                                              ///< numbers along the axes of the box
      unsigned int index;                                                ///< active cell index
      dealii::types::subdomain_id owner;                                 ///< rank
      typename dealii::Triangulation<dim>::active_cell_iterator in_mesh; ///< the cell of the mesh
    };

    /// No cells yet.
    FineCells(const dealii::parallel::distributed::Triangulation<dim> &mesh, const CellsOfBox<dim> &box)
        : triangulation(mesh)
        , cells_of_box(box)
        , rank(dealii::Utilities::MPI::this_mpi_process(communicator_of(mesh)))
    {
    }

    /// Finds them on the current mesh, and sets the CellUse of all cells. Collective.
    void reinit()
    {
      list_cells();
      make_table();
      if (triangulation.n_global_active_cells() == cells_of_box.n_cells())
        return; // All cells are inner ones.
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && holds_nodes(cell))
          if (!is_inner(cell_list[entry_of_index[cell->active_cell_index()]].place))
            cell->set_user_index(static_cast<unsigned int>(CellUse::edge));
      exchange_uses();
    }

    /// Cells of this rank and its ghosts.
    const std::vector<Cell> &cells() const
    {
      return cell_list;
    }

    /// How many are this rank's.
    unsigned int n_owned() const
    {
      return std::count_if(cell_list.begin(), cell_list.end(), [this](const Cell &cell) { return is_owned(cell); });
    }

    /// Whether the cell belongs to this rank.
    bool is_owned(const Cell &cell) const
    {
      return cell.owner == rank;
    }

    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int; ///< stands for no cell, see find()

    /// Where in cells() the cell of this place is, or `none`.
    unsigned int find(const CellPlace<dim> &place) const;

    /// This rank's cell of the box that is nearest to a place; null if it has none there.
    const Cell *own_cell_at(const dealii::Point<dim> &x) const
    {
      const unsigned int entry = find(cells_of_box.place_near(x));
      return entry == none || !is_owned(cell_list[entry]) ? nullptr : &cell_list[entry];
    }

    /// A place, m, in a cell, from 0 to 1 along each axis.
    dealii::Point<dim> place_in(const Cell &cell, const dealii::Point<dim> &x) const
    {
      return dealii::Point<dim>((x - cells_of_box.corner(cell.place)) / cells_of_box.width);
    }

    /// Where in cells() the cell with this active cell index is, or `none`.
    unsigned int of_index(const unsigned int index) const
    {
      return entry_of_index[index];
    }

    /// Corner, cell width and number of cells of the box.
    const CellsOfBox<dim> &box() const
    {
      return cells_of_box;
    }

    /// The distributed mesh, with larger cells, too.
    const dealii::parallel::distributed::Triangulation<dim> &mesh() const
    {
      return triangulation;
    }

  private:
    void list_cells();
    void make_table();

    /// Whether all neighbours of a cell in the box are fine.
    bool is_inner(const CellPlace<dim> &place) const
    {
      for (unsigned int i = 0; i < unsigned(dealii::Utilities::pow(3, dim)); ++i)
        {
          CellPlace<dim> neighbour = place;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= 3)
            neighbour[a] += int(rest % 3) - 1;
          if (cells_of_box.contains(neighbour) && find(neighbour) == none)
            return false;
        }
      return true;
    }

    /// Tells other ranks which of this rank's cells are at the edge. Collective.
    void exchange_uses() const
    {
      using CellIterator = typename dealii::Triangulation<dim>::active_cell_iterator;
      dealii::GridTools::exchange_cell_data_to_ghosts<unsigned int, dealii::parallel::distributed::Triangulation<dim>>(
          triangulation,
          [](const CellIterator &cell) { return std::optional<unsigned int>(cell->user_index()); },
          [](const CellIterator &cell, const unsigned int &use) { cell->set_user_index(use); });
    }

    const dealii::parallel::distributed::Triangulation<dim> &triangulation;
    const CellsOfBox<dim> cells_of_box;
    const dealii::types::subdomain_id rank;
    std::vector<Cell> cell_list;
    std::vector<unsigned int> entry_of_index;
    std::vector<unsigned int> table; // of entries, by scattered numbers, with open addressing
  };
} // namespace scree

#endif
