// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/preconditioner.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  /// What is made of L.
  template <int dim>
  struct PressurePreconditioner<dim>::Inverse
  {
    TrilinosWrappers::SparseMatrix matrix; // The others refer to it.
    TrilinosWrappers::PreconditionAMG multigrid;
    TrilinosWrappers::PreconditionBlockwiseDirect blocks;
    TrilinosWrappers::PreconditionBase *chosen = nullptr; // null: there was no unknown

    std::vector<unsigned int> unknowns; // owned vertices of the rows
    VertexVector source, result;        // by row

    /// Factorises the matrix.
    void choose()
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(matrix.get_mpi_communicator());
      // One rank solves the coarsest level while the others wait; so many rows it may have on a single rank, and on
      // several.
      constexpr unsigned int one_level = 2000, most_on_coarsest = 128;
      // More blocks than these take so many more iterations that they do not pay.
      constexpr unsigned int most_blocks = 3;
      const bool is_small                = matrix.m() <= one_level;
      if (is_small && n_ranks > 1 && n_ranks <= most_blocks)
        {
          blocks.initialize(matrix);
          chosen = &blocks;
        }
      else
        {
          make_multigrid(is_small || n_ranks == 1 ? one_level : most_on_coarsest);
          chosen = &multigrid;
        }
    }

    void make_multigrid(const unsigned int most_on_coarsest)
    {
      TrilinosWrappers::PreconditionAMG::AdditionalData data;
      data.elliptic = true;
      Teuchos::ParameterList settings;
      std::unique_ptr<Epetra_MultiVector> constant_modes;
      data.set_parameters(settings, constant_modes, matrix.trilinos_matrix());
      settings.set("coarse: max size", int(most_on_coarsest));
      multigrid.initialize(matrix, settings);
    }
  };


  template <int dim>
  PressurePreconditioner<dim>::~PressurePreconditioner() = default;


  template <int dim>
  PressurePreconditioner<dim>::PressurePreconditioner(const BackgroundGrid<dim> &grid,
                                                      const NodeNumbering<dim> &vertices,
                                                      const FreeSurface<dim> &surface)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
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
  void PressurePreconditioner<dim>::reinit()
  {
    inverse.reset();
    diagonals.reinit();
    cells.clear();
    unknowns.clear();
    places.assign(vertices.n_owned(), none);
  }


  template <int dim>
  void PressurePreconditioner<dim>::assemble(const Mixture<dim> &mixture, const double time_step, const double storage)
  {
    const double scale =
        time_step * Utilities::fixed_power<dim>(grid.cell_size()) / (grid.cell_size() * grid.cell_size());
    bool is_anchored           = storage > 0.; // something beside differences of pressure matters
    double largest_conductance = 0;
    diagonals.clear();
    cells.clear();
    for (const MixtureCell<dim> &mixed : mixture.cells())
      if (mixed.water_volume > 0)
        {
          const double conductance = scale * mixed.mobility;
          cells.push_back({ mixed.cell, conductance });
          diagonals.activate_cell(mixed.cell);
          largest_conductance     = std::max(largest_conductance, conductance);
          const unsigned int *all = vertices.nodes(mixed.cell);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              is_anchored = is_anchored || surface.kind(all[v]) != PressureDofType::unknown;
              if (surface.kind(all[v]) != PressureDofType::unknown)
                continue;
              diagonals[all[v]][whole] += conductance * laplacian[v][v];
              // A vertex beside the surface follows the unknown one; this keeps the matrix symmetric.
              for (unsigned int w = 0; w < n_vertices; ++w)
                if (surface.kind(all[w]) == PressureDofType::surface)
                  diagonals[all[v]][added] += conductance * laplacian[v][w] * surface.ratio(all[w], all[v]);
            }
        }
    diagonals.add_contributions();
    set_unknowns(storage);
    const std::vector<double> own{ largest_conductance, double(is_anchored) };
    std::vector<double> all_ranks(2);
    Utilities::MPI::max(own, grid.communicator(), all_ranks);
    AssertThrow(all_ranks[0] == 0. || all_ranks[1] == 1.,
                ExcMessage("Water fills the box, and all its walls are closed: nothing sets the level of its pressure. "
                           "Remedies: a drained wall in subsection Boundaries/Water, a 'Bulk modulus' in subsection "
                           "Water, or a box that is higher than the water."));
  }


  template <int dim>
  void PressurePreconditioner<dim>::set_unknowns(const double storage)
  {
    for (const unsigned int vertex : unknowns)
      places[vertex] = none;
    unknowns = surface.unknowns();
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      {
        places[unknowns[i]] = i;
        double *of_vertex   = diagonals[unknowns[i]];
        of_vertex[added] += storage * surface.water_volume(unknowns[i]);
        of_vertex[whole] += of_vertex[added];
      }
  }


  template <int dim>
  void PressurePreconditioner<dim>::make(PreconditionerState &state)
  {
    const FineCells<dim> &fine_cells = grid.fine_cells();
    state.conductances.clear();
    state.diagonal.clear();
    for (const Cell &cell : cells)
      state.conductances.emplace_back(fine_cells.cells()[fine_cells.of_index(cell.cell)].number, cell.conductance);
    for (const unsigned int vertex : unknowns)
      state.diagonal.emplace_back(place_of_vertex(grid, vertices, vertex), diagonals[vertex][added]);

    inverse.reset(); // before the next one takes memory
    inverse                     = std::make_unique<Inverse>();
    inverse->unknowns           = unknowns;
    const MPI_Comm communicator = grid.communicator();
    if (Utilities::MPI::sum(unknowns.size(), communicator) == 0)
      return; // all vertices are held for now
    // A rank without a row would be refused: it has one that nothing depends on.
    const bool has_none  = unknowns.empty();
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, has_none ? 1 : unknowns.size())[Utilities::MPI::this_mpi_process(communicator)];
    constexpr double no_row = -1.;
    VertexVector rows(vertices.partitioner()); // of the matrix, by vertex; doubles hold them exactly
    rows = no_row;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      rows.local_element(unknowns[k]) = owned.nth_index_in_set(k);
    rows.update_ghost_values();

    // Calls visit(v, row of v) for the unknown vertices of a cell.
    const auto for_unknowns = [&](const Cell &cell, const auto &visit) {
      for (unsigned int v = 0; v < n_vertices; ++v)
        if (const double row = rows.local_element(vertices.nodes(cell.cell)[v]); row != no_row)
          visit(v, types::global_dof_index(row));
    };
    TrilinosWrappers::SparsityPattern pattern(owned, communicator, Utilities::pow(3, dim));
    for (const auto row : owned)
      pattern.add(row, row);
    for (const Cell &cell : cells)
      for_unknowns(cell, [&](const unsigned int, const auto row) {
        for_unknowns(cell, [&](const unsigned int, const auto column) { pattern.add(row, column); });
      });
    pattern.compress();

    TrilinosWrappers::SparseMatrix &matrix = inverse->matrix;
    matrix.reinit(pattern);
    for (const Cell &cell : cells)
      for_unknowns(cell, [&](const unsigned int v, const auto row) {
        for_unknowns(cell, [&](const unsigned int w, const auto column) {
          matrix.add(row, column, cell.conductance * laplacian[v][w]);
        });
      });
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      matrix.add(owned.nth_index_in_set(k), owned.nth_index_in_set(k), diagonals[unknowns[k]][added]);
    if (has_none)
      matrix.add(owned.nth_index_in_set(0), owned.nth_index_in_set(0), 1.);
    matrix.compress(VectorOperation::add);

    inverse->source.reinit(owned, communicator);
    inverse->result.reinit(owned, communicator);
    inverse->choose();
  }


  template <int dim>
  void PressurePreconditioner<dim>::load(PreconditionerState &state)
  {
    std::map<std::uint64_t, unsigned int> own_cells;
    for (const auto &cell : grid.fine_cells().cells())
      if (grid.fine_cells().is_owned(cell))
        own_cells[cell.number] = cell.index;
    reinit();
    for (const auto &[place, conductance] : state.conductances)
      if (const auto cell = own_cells.find(place); cell != own_cells.end())
        {
          cells.push_back({ cell->second, conductance });
          diagonals.activate_cell(cell->second);
        }
    const auto own_vertices = vertices_by_place(grid, vertices);
    for (const auto &[place, number] : state.diagonal)
      if (const auto vertex = own_vertices.find(place); vertex != own_vertices.end())
        {
          unknowns.push_back(vertex->second);
          diagonals[vertex->second][added] = number;
        }
    make(state);
  }


  template <int dim>
  void PressurePreconditioner<dim>::vmult(std::vector<double> &preconditioned, const std::vector<double> &remainder)
  {
    for (unsigned int i = 0; i < remainder.size(); ++i)
      preconditioned[i] = remainder[i] / diagonals[unknowns[i]][whole];
    if (inverse->chosen == nullptr)
      return;
    const std::vector<unsigned int> &rows = inverse->unknowns;
    const auto place                      = [&](const unsigned int row) { return places[rows[row]]; };
    for (unsigned int k = 0; k < rows.size(); ++k)
      inverse->source.local_element(k) = place(k) != none ? remainder[place(k)] : 0.;
    inverse->chosen->vmult(inverse->result, inverse->source);
    for (unsigned int k = 0; k < rows.size(); ++k)
      if (place(k) != none)
        preconditioned[place(k)] = inverse->result.local_element(k);
  }

  template class PressurePreconditioner<2>;
  template class PressurePreconditioner<3>;
} // namespace scree
