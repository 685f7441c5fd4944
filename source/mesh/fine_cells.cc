// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/deal_ii_versions.h>
#include <scree/input/input_error.h>
#include <scree/mesh/fine_cells.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <iterator>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Steps of a sequence of places that are spread evenly over the unit square or cube (Roberts 2018).
    constexpr double steps_of_sequence[2][3] = { { 0.7548776662466927, 0.5698402909980532, 0. },
                                                 { 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 } };

    /// Looks for points in the blocks of a box.
    template <int dim>
    class BlockSearch
    {
    public:
      BlockSearch(const CellsOfBox<dim> &box, const PlacesOfPoints<dim> &places)
          : box(box)
          , places(places)
      {
        constexpr double most_places = 2e6; // in the whole box: a second or less on one rank
        n_looks = std::max(1u, static_cast<unsigned int>(std::min(most_places / box.n_cells(), 1e6)));
      }

      /// Whether each cell is looked at closely.
      bool is_close() const
      {
        return n_looks >= places.n_places_of_cell;
      }

      /// @param number of the block: where in the sequence its looks begin
      bool finds(const CellPlace<dim> &block, const std::uint64_t number) const
      {
        if (is_close())
          return finds_closely(block);
        return any_cell(block, [&](const Point<dim> &corner, const unsigned int cell) {
          for (unsigned int i = 0; i < n_looks; ++i)
            if (places.at_place(corner, place((number * cells_of_block + cell) * n_looks + i, corner)))
              return true;
          return false;
        });
      }

      bool finds_closely(const CellPlace<dim> &block) const
      {
        return any_cell(block, [&](const Point<dim> &corner, const unsigned int) { return places.in_cell(corner); });
      }

    private:
      static constexpr unsigned int cells_of_block = 1 << dim;

      template <class Look>
      bool any_cell(const CellPlace<dim> &block, const Look &look) const
      {
        for (unsigned int v = 0; v < cells_of_block; ++v)
          {
            CellPlace<dim> cell;
            for (unsigned int a = 0; a < dim; ++a)
              cell[a] = 2 * block[a] + (v >> a & 1);
            if (box.contains(cell) && look(box.corner(cell), v))
              return true;
          }
        return false;
      }

      Point<dim> place(const std::uint64_t index, const Point<dim> &corner) const
      {
        Point<dim> x = corner;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double along = 0.5 + index * steps_of_sequence[dim - 2][a];
            x[a] += box.width * (along - std::floor(along));
          }
        return x;
      }

      const CellsOfBox<dim> &box;
      const PlacesOfPoints<dim> &places;
      unsigned int n_looks;
    };


    /// Calls a function with the numbers below `n` that are this rank's share; what it throws, all ranks throw.
    template <class Call>
    void share(const std::uint64_t n, const MPI_Comm communicator, const Call &call)
    {
      const std::uint64_t rank    = Utilities::MPI::this_mpi_process(communicator);
      const std::uint64_t n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      on_all_ranks(communicator, [&] {
        for (std::uint64_t i = n * rank / n_ranks; i < n * (rank + 1) / n_ranks; ++i)
          call(i);
      });
    }
  } // namespace


  template <int dim>
  Blocks occupied_blocks(const CellsOfBox<dim> &box, const PlacesOfPoints<dim> &places, const MPI_Comm communicator)
  {
    const BlockSearch<dim> search(box, places);
    const CellPlace<dim> n = box.n_blocks();
    std::uint64_t n_all    = 1;
    for (const int along : n)
      n_all *= along;
    Blocks own;
    share(n_all, communicator, [&](const std::uint64_t number) {
      CellPlace<dim> block;
      std::uint64_t rest = number;
      for (unsigned int a = 0; a < dim; rest /= n[a++])
        block[a] = rest % n[a];
      if (search.finds(block, number))
        own.push_back(curve_number<dim>(block));
    });
    Blocks found = all_blocks(own, communicator);
    for (Blocks last = found, seen = found; !search.is_close() && !last.empty();)
      {
        Blocks beside;
        const Blocks around = with_margin<dim>(last, 1, n);
        std::set_difference(around.begin(), around.end(), seen.begin(), seen.end(), std::back_inserter(beside));
        seen.insert(seen.end(), beside.begin(), beside.end());
        make_unique(seen);
        own.clear();
        share(beside.size(), communicator, [&](const std::uint64_t i) {
          if (search.finds_closely(curve_place<dim>(beside[i])))
            own.push_back(beside[i]);
        });
        last = all_blocks(own, communicator);
        found.insert(found.end(), last.begin(), last.end());
        make_unique(found);
      }
    return found;
  }

  template decltype(occupied_blocks<2>) occupied_blocks<2>;
  template decltype(occupied_blocks<3>) occupied_blocks<3>;


  namespace
  {
    std::size_t scatter(const std::uint64_t number)
    {
      return (number * 0x9e3779b97f4a7c15) >> 20; // Fibonacci hashing, Knuth 1973
    }
  } // namespace


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
          cell_list.push_back(
              { curve_number<dim>(place), place, cell->active_cell_index(), cell->subdomain_id(), cell });
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


  template class FineCells<2>;
  template class FineCells<3>;
} // namespace scree
