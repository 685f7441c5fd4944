// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/fine_cells.h>
#include <scree/deal_ii_versions.h>
#include <scree/particles/cell_use.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    std::size_t scatter(const std::uint64_t number)
    {
      return (number * 0x9e3779b97f4a7c15) >> 20; // Fibonacci hashing, Knuth 1973
    }
  } // namespace


  template <int dim>
  FineCells<dim>::FineCells(const parallel::distributed::Triangulation<dim> &mesh, const CellsOfBox<dim> &box)
      : triangulation(mesh)
      , cells_of_box(box)
      , rank(Utilities::MPI::this_mpi_process(communicator_of(mesh)))
  {
  }


  template <int dim>
  void FineCells<dim>::reinit()
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


  template <int dim>
  void FineCells<dim>::list_cells()
  {
    const CellsOfBox<dim> &box = cells_of_box;
    cell_list.clear();
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const CellPlace<dim> place = box.place_of_corner(cell->vertex(0));
          const bool is_fine         = cell->vertex(1)[0] - cell->vertex(0)[0] < 1.5 * box.width;
          const CellUse use = !box.contains(place) ? CellUse::outside : is_fine ? CellUse::inner : CellUse::coarse;
          cell->set_user_index(static_cast<unsigned int>(use));
          if (use != CellUse::inner)
            continue;
          cell_list.push_back({ curve_number<dim>(place), place, cell->active_cell_index(), cell->subdomain_id() });
          // Halving again and again rounds in another way for each depth of the mesh.
          for (const unsigned int v : cell->vertex_indices())
            {
              CellPlace<dim> at = place;
              for (unsigned int a = 0; a < dim; ++a)
                at[a] += v >> a & 1;
              cell->vertex(v) = box.corner(at);
            }
        }
    std::sort(cell_list.begin(), cell_list.end(), [](const Cell &a, const Cell &b) { return a.number < b.number; });
    entry_of_index.assign(triangulation.n_active_cells(), none);
    for (unsigned int entry = 0; entry < cell_list.size(); ++entry)
      entry_of_index[cell_list[entry].index] = entry;
  }


  template <int dim>
  void FineCells<dim>::make_table()
  {
    std::size_t size = 1;
    while (size < 2 * cell_list.size())
      size *= 2;
    table.assign(size, none);
    for (unsigned int entry = 0; entry < cell_list.size(); ++entry)
      {
        std::size_t slot = scatter(cell_list[entry].number) & (size - 1);
        while (table[slot] != none)
          slot = (slot + 1) & (size - 1);
        table[slot] = entry;
      }
  }


  template <int dim>
  unsigned int FineCells<dim>::find(const CellPlace<dim> &place) const
  {
    if (!cells_of_box.contains(place))
      return none;
    const std::uint64_t number = curve_number<dim>(place);
    const std::size_t mask     = table.size() - 1;
    for (std::size_t slot = scatter(number) & mask; table[slot] != none; slot = (slot + 1) & mask)
      if (cell_list[table[slot]].number == number)
        return table[slot];
    return none;
  }


  template <int dim>
  bool FineCells<dim>::is_inner(const CellPlace<dim> &place) const
  {
    for (unsigned int i = 0; i < unsigned(Utilities::pow(3, dim)); ++i)
      {
        CellPlace<dim> neighbour = place;
        for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= 3)
          neighbour[a] += int(rest % 3) - 1;
        if (cells_of_box.contains(neighbour) && find(neighbour) == none)
          return false;
      }
    return true;
  }


  template <int dim>
  void FineCells<dim>::exchange_uses() const
  {
    using CellIterator = typename Triangulation<dim>::active_cell_iterator;
    GridTools::exchange_cell_data_to_ghosts<unsigned int, parallel::distributed::Triangulation<dim>>(
        triangulation,
        [](const CellIterator &cell) { return std::optional<unsigned int>(cell->user_index()); },
        [](const CellIterator &cell, const unsigned int &use) { cell->set_user_index(use); });
  }

  template class FineCells<2>;
  template class FineCells<3>;
} // namespace scree
