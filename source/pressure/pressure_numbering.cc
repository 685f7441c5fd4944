// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_numbering.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PressureNumbering<dim>::PressureNumbering(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices)
      : grid(grid)
      , vertices(vertices)
  {
    reinit();
  }


  template <int dim>
  void PressureNumbering<dim>::reinit()
  {
    const auto &nodes = *vertices.partitioner();
    number_of_corner.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), numbers::invalid_unsigned_int);
    numbers_of_ranks.reset();
  }


  template <int dim>
  bool PressureNumbering<dim>::numbers_serve(const Mixture<dim> &mixture) const
  {
    bool serve = numbers_of_ranks != nullptr;
    for (const MixtureCell<dim> &cell : mixture.cells())
      for (unsigned int v = 0; v < n_vertices && serve && cell.water_volume > 0; ++v)
        serve = number_of_corner[vertices.nodes(cell.cell)[v]] != numbers::invalid_unsigned_int;
    return Utilities::MPI::min(int(serve), grid.communicator()) == 1;
  }


  template <int dim>
  std::vector<unsigned int> PressureNumbering<dim>::mark_corners(const Mixture<dim> &mixture, VertexVector &marks) const
  {
    constexpr unsigned int margin = 2;
    std::vector<unsigned int> marked_cells;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        marked_cells.push_back(cell.cell);
    const auto is_touched = [&](const unsigned int cell) {
      return std::any_of(vertices.nodes(cell), vertices.nodes(cell) + n_vertices, [&](const unsigned int vertex) {
        return marks.local_element(vertex) != 0.;
      });
    };
    for (unsigned int layer = 0; layer <= margin; ++layer)
      {
        for (const unsigned int cell : marked_cells)
          for (unsigned int v = 0; v < n_vertices; ++v)
            marks.local_element(vertices.nodes(cell)[v]) += 1.;
        marks.compress(VectorOperation::add);
        if (layer == margin)
          break;
        marks.update_ghost_values();
        marked_cells.clear();
        for (const auto &cell : grid.fine_cells().cells())
          if (grid.fine_cells().is_owned(cell) && is_touched(cell.index))
            marked_cells.push_back(cell.index);
        marks.zero_out_ghost_values();
      }
    return marked_cells;
  }


  template <int dim>
  IndexSet PressureNumbering<dim>::number_marked(VertexVector &marks) const
  {
    const auto begin = marks.begin(), end = begin + vertices.n_owned();
    const auto is_marked = [](const double mark) { return mark > 0.; };
    // Trilinos needs a row of every rank.
    AssertThrow(vertices.n_owned() > 0,
                ExcMessage("One of the " + std::to_string(Utilities::MPI::n_mpi_processes(grid.communicator())) +
                           " ranks has no nodes. Use fewer ranks."));
    if (std::none_of(begin, end, is_marked))
      *begin = 1.;
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        grid.communicator(),
        std::count_if(begin, end, is_marked))[Utilities::MPI::this_mpi_process(grid.communicator())];
    auto next = owned.begin();
    for (auto mark = begin; mark != end; ++mark)
      *mark = is_marked(*mark) ? double(*next++) : -1.;
    marks.update_ghost_values();
    return owned;
  }


  template <int dim>
  bool PressureNumbering<dim>::update(const Mixture<dim> &mixture)
  {
    if (numbers_serve(mixture))
      return false;
    VertexVector global(vertices.partitioner()); // marks at first, then numbers
    const std::vector<unsigned int> numbered_cells = mark_corners(mixture, global);
    const IndexSet owned                           = number_marked(global);
    const auto number_of                           = [&](const unsigned int vertex) {
      return static_cast<types::global_dof_index>(global.local_element(vertex));
    };
    const auto for_corners_of_cells = [&](const auto &act) {
      for (const unsigned int cell : numbered_cells)
        std::for_each(vertices.nodes(cell), vertices.nodes(cell) + n_vertices, act);
    };
    IndexSet ghosts(owned.size());
    for_corners_of_cells([&](const unsigned int vertex) {
      if (vertex >= vertices.n_owned())
        ghosts.add_index(number_of(vertex));
    });
    numbers_of_ranks = std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, grid.communicator());

    std::fill(number_of_corner.begin(), number_of_corner.end(), numbers::invalid_unsigned_int);
    corner_of_number.assign(owned.n_elements() + ghosts.n_elements(), numbers::invalid_unsigned_int);
    const auto take = [&](const unsigned int vertex) {
      number_of_corner[vertex]                   = numbers_of_ranks->global_to_local(number_of(vertex));
      corner_of_number[number_of_corner[vertex]] = vertex;
    };
    for (unsigned int vertex = 0; vertex < vertices.n_owned(); ++vertex)
      if (global.local_element(vertex) >= 0.)
        take(vertex);
    for_corners_of_cells(take);
    return true;
  }

  template class PressureNumbering<2>;
  template class PressureNumbering<3>;
} // namespace scree
