// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/node_numbering.h>
#include <scree/deal_ii_versions.h>


#include <map>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The walls of the box that a cell touches.
    template <int dim>
    OpenKnots walls_of(const CellPlace<dim> &place, const CellPlace<dim> &n)
    {
      OpenKnots walls = 0;
      for (unsigned int a = 0; a < dim; ++a)
        walls |= (place[a] == 0) << (2 * a) | (place[a] == n[a] - 1) << (2 * a + 1);
      return walls;
    }
  } // namespace


  template <int dim>
  void NodeNumbering<dim>::distribute(const FineCells<dim> &cells)
  {
    cell_open_knots.assign(cells.mesh().n_active_cells(), 0);
    for (const Cell &cell : cells.cells())
      cell_open_knots[cell.index] = walls_of<dim>(cell.place, cells.box().n);

    unsigned int n_owned    = 0;
    Homes homes             = number_own(cells, n_owned);
    const auto global_nodes = number_all(cells, homes, n_owned);
    place_nodes(cells, global_nodes);
  }


  template <int dim>
  std::pair<CellPlace<dim>, unsigned int>
  NodeNumbering<dim>::home(const CellPlace<dim> &cell, const unsigned int i, const CellPlace<dim> &n) const
  {
    CellPlace<dim> place;
    unsigned int node = 0;
    for (unsigned int a = 0, rest = i, power = 1; a < dim; ++a, rest /= n_nodes_1d(), power *= n_nodes_1d())
      {
        const int along = cell[a] + int(rest % n_nodes_1d());
        place[a]        = std::clamp(along - 1, 0, n[a] - 1);
        node += power * (along - place[a]);
      }
    return { place, node };
  }


  template <int dim>
  void
  NodeNumbering<dim>::exchange(const FineCells<dim> &cells, const types::global_dof_index first, Homes &homes) const
  {
    for (auto &number : homes)
      if (number != none)
        number += first;
    using CellIterator         = typename Triangulation<dim>::active_cell_iterator;
    using Numbers              = std::vector<types::global_dof_index>;
    const unsigned int n_nodes = n_nodes_per_cell();
    GridTools::exchange_cell_data_to_ghosts<Numbers, parallel::distributed::Triangulation<dim>>(
        cells.mesh(),
        [&](const CellIterator &cell) {
          const unsigned int c = cells.of_index(cell->active_cell_index());
          if (c == none)
            return std::optional<Numbers>();
          const auto begin = homes.begin() + std::size_t(c) * n_nodes;
          return std::optional<Numbers>(Numbers(begin, begin + n_nodes));
        },
        [&](const CellIterator &cell, const Numbers &numbers) {
          const unsigned int c = cells.of_index(cell->active_cell_index());
          std::copy(numbers.begin(), numbers.end(), homes.begin() + std::size_t(c) * n_nodes);
        });
  }


  template <int dim>
  std::vector<types::global_dof_index>
  NodeNumbering<dim>::number_all(const FineCells<dim> &cells, Homes &homes, unsigned int n_owned)
  {
    const MPI_Comm communicator = communicator_of(cells.mesh());
    const unsigned int n_nodes  = n_nodes_per_cell();
    // Nodes that live in no fine cell, by the number of that cell and which one of its nodes it is.
    std::map<std::pair<std::uint64_t, unsigned int>, unsigned int> homeless;
    // Of each node of this rank's cells: the cell it lives in and which one it is there, or `none` and its number.
    std::vector<std::pair<unsigned int, unsigned int>> found;
    found.reserve(cells.cells().size() * n_nodes);
    for (const Cell &cell : cells.cells())
      for (unsigned int i = 0; cells.is_owned(cell) && i < n_nodes; ++i)
        {
          const auto [place, node] = home(cell.place, i, cells.box().n);
          found.emplace_back(cells.find(place), node);
          if (found.back().first == none)
            {
              const auto [entry, is_new] = homeless.emplace(std::make_pair(curve_number<dim>(place), node), n_owned);
              n_owned += is_new;
              found.back().second = entry->second;
            }
        }
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, n_owned)[Utilities::MPI::this_mpi_process(communicator)];
    const types::global_dof_index first = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    exchange(cells, first, homes);

    std::vector<types::global_dof_index> numbers(std::size_t(cells.mesh().n_active_cells()) * n_nodes,
                                                 numbers::invalid_dof_index),
        foreign;
    const auto *home_of = found.data();
    for (const Cell &cell : cells.cells())
      for (unsigned int i = 0; cells.is_owned(cell) && i < n_nodes; ++i)
        {
          const auto [c, node] = *home_of++;
          auto &number         = numbers[std::size_t(cell.index) * n_nodes + i];
          number               = c == none ? first + node : homes[std::size_t(c) * n_nodes + node];
          if (c != none && !cells.is_owned(cells.cells()[c]))
            foreign.push_back(number);
        }
    std::sort(foreign.begin(), foreign.end());
    foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
    IndexSet ghosts(owned.size());
    ghosts.add_indices(foreign.begin(), foreign.end());
    distribution = std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, communicator);
    return numbers;
  }


  template <int dim>
  void NodeNumbering<dim>::place_nodes(const FineCells<dim> &cells,
                                       const std::vector<types::global_dof_index> &global_nodes)
  {
    const unsigned int n = n_nodes_1d(), n_nodes = n_nodes_per_cell();
    cell_nodes.assign(global_nodes.size(), numbers::invalid_unsigned_int);
    positions.assign(distribution->locally_owned_size() + distribution->n_ghost_indices(), Point<dim>());
    face_flags.assign(positions.size(), 0);
    for (const Cell &cell : cells.cells())
      if (cells.is_owned(cell))
        {
          const std::size_t first = std::size_t(cell.index) * n_nodes;
          const OpenKnots open    = cell_open_knots[cell.index];
          const Point<dim> corner = cells.box().corner(cell.place);
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const unsigned int node = distribution->global_to_local(global_nodes[first + i]);
              cell_nodes[first + i]   = node;
              for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
                {
                  const unsigned int position = rest % n;
                  const unsigned int face     = 2 * a + (position == n - 1);
                  positions[node][a] =
                      corner[a] + cells.box().width * (n == 3 ? CellBasis<dim, 3>::node_positions(open, a)[position]
                                                              : CellBasis<dim, 2>::node_positions(open, a)[position]);
                  if (position == 0 || position == n - 1)
                    face_flags[node] |= open & (1 << face);
                }
            }
        }
  }

  template class NodeNumbering<2>;
  template class NodeNumbering<3>;
} // namespace scree
