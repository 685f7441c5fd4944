// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_operator.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PressureOperator<dim>::PressureOperator(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices)
      : grid(grid)
      , vertices(vertices)
      , diagonals(vertices)
  {
    reinit();
    // Hat functions on the unit cell: one-dimensional mass and stiffness, multiplied.
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int w = 0; w < n_vertices; ++w)
        {
          double sum = 0;
          for (unsigned int a = 0; a < dim; ++a)
            {
              double product = 1;
              for (unsigned int b = 0; b < dim; ++b)
                {
                  const bool same = ((v ^ w) >> b & 1) == 0;
                  product *= b == a ? (same ? 1. : -1.) : (same ? 1. / 3. : 1. / 6.);
                }
              sum += product;
            }
          laplacian[v][w] = sum;
        }
  }


  template <int dim>
  void PressureOperator<dim>::reinit()
  {
    diagonals.reinit();
    unknown_vertices.clear();
    places.assign(vertices.n_owned(), none);
  }


  template <int dim>
  void PressureOperator<dim>::assemble(const Mixture<dim> &mixture,
                                       const FreeSurface<dim> &surface,
                                       const double time_step,
                                       const std::function<double(unsigned int vertex)> &storage)
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    const double scale       = time_step * cell_volume / (grid.cell_size() * grid.cell_size());
    bool is_anchored         = false; // something beside differences of pressure matters
    double largest_mobility  = 0;
    diagonals.clear();
    wet_cells.clear();
    for (const MixtureCell<dim> &mixed : mixture.cells())
      if (mixed.water_volume > 0)
        {
          wet_cells.push_back({ mixed.cell, scale * mixed.mobility });
          diagonals.activate_cell(mixed.cell);
          largest_mobility        = std::max(largest_mobility, wet_cells.back().mobility);
          const CellMatrix own    = matrix(wet_cells.back());
          const unsigned int *all = vertices.nodes(mixed.cell);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              is_anchored = is_anchored || surface.kind(all[v]) != PressureDofType::unknown || storage(all[v]) > 0.;
              if (surface.kind(all[v]) != PressureDofType::unknown)
                continue;
              diagonals[all[v]][whole] += own[v][v];
              // A vertex beside the surface follows the unknown one; this keeps the matrix symmetric.
              for (unsigned int w = 0; w < n_vertices; ++w)
                if (surface.kind(all[w]) == PressureDofType::surface)
                  diagonals[all[v]][added] += own[v][w] * surface.ratio(all[w], all[v]);
            }
        }
    diagonals.add_contributions();
    for (const unsigned int vertex : unknown_vertices)
      places[vertex] = none;
    unknown_vertices.clear();
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) == PressureDofType::unknown)
        {
          places[vertex] = unknown_vertices.size();
          unknown_vertices.push_back(vertex);
          diagonals[vertex][added] += storage(vertex);
          diagonals[vertex][whole] += diagonals[vertex][added];
        }
    const std::vector<double> own{ largest_mobility, double(is_anchored) };
    std::vector<double> all_ranks(2);
    Utilities::MPI::max(own, grid.communicator(), all_ranks);
    AssertThrow(all_ranks[0] == 0. || all_ranks[1] == 1.,
                ExcMessage("Water fills the box, and all its walls are closed: nothing sets the level of its pressure. "
                           "Remedies: a drained wall in subsection Boundaries/Water, a 'Bulk modulus' in subsection "
                           "Water, or a box that is higher than the water."));
  }


  template <int dim>
  void PressureOperator<dim>::save(PreconditionerState &state) const
  {
    const FineCells<dim> &cells = grid.fine_cells();
    state.mobilities.clear();
    state.diagonal.clear();
    for (const Cell &cell : wet_cells)
      state.mobilities.emplace_back(cells.cells()[cells.of_index(cell.cell)].number, cell.mobility);
    for (const unsigned int vertex : unknown_vertices)
      state.diagonal.emplace_back(place_of_vertex(grid, vertices, vertex), added_to_diagonal(vertex));
  }


  template <int dim>
  void PressureOperator<dim>::load(const PreconditionerState &state)
  {
    std::map<std::uint64_t, unsigned int> own_cells;
    for (const auto &cell : grid.fine_cells().cells())
      if (grid.fine_cells().is_owned(cell))
        own_cells[cell.number] = cell.index;
    reinit();
    wet_cells.clear();
    for (const auto &[place, mobility] : state.mobilities)
      if (const auto cell = own_cells.find(place); cell != own_cells.end())
        {
          wet_cells.push_back({ cell->second, mobility });
          diagonals.activate_cell(cell->second);
        }
    const auto own_vertices = vertices_by_place(grid, vertices);
    for (const auto &[place, number] : state.diagonal)
      if (const auto vertex = own_vertices.find(place); vertex != own_vertices.end())
        {
          unknown_vertices.push_back(vertex->second);
          diagonals[vertex->second][added] = number;
        }
  }

  template class PressureOperator<2>;
  template class PressureOperator<3>;
} // namespace scree
