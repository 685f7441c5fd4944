// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_preconditioner.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PressurePreconditioner<dim>::PressurePreconditioner(const PressureOperator<dim> &system)
      : system(system)
      , unknowns(system.unknowns())
  {
    const MPI_Comm communicator = system.communicator();
    using Cell                  = typename PressureOperator<dim>::Cell;
    constexpr auto n_vertices   = PressureOperator<dim>::n_vertices;
    if (Utilities::MPI::sum(unknowns.size(), communicator) == 0)
      return; // all vertices are held for now
    // A rank without a row would be refused: it has one that nothing depends on.
    const bool has_none  = unknowns.empty();
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, has_none ? 1 : unknowns.size())[Utilities::MPI::this_mpi_process(communicator)];
    constexpr double no_row = -1.;
    VertexVector rows; // of the matrix, by vertex; doubles hold them exactly
    system.reinit(rows);
    rows = no_row;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      rows.local_element(unknowns[k]) = owned.nth_index_in_set(k);
    rows.update_ghost_values();

    // Calls visit(v, row of v) for the unknown vertices of a cell.
    const auto for_unknowns = [&](const Cell &cell, const auto &visit) {
      for (unsigned int v = 0; v < n_vertices; ++v)
        if (const double row = rows.local_element(system.vertices_of(cell)[v]); row != no_row)
          visit(v, types::global_dof_index(row));
    };
    TrilinosWrappers::SparsityPattern pattern(owned, communicator, Utilities::pow(3, dim));
    for (const auto row : owned)
      pattern.add(row, row);
    for (const Cell &cell : system.cells())
      for_unknowns(cell, [&](const unsigned int, const auto row) {
        for_unknowns(cell, [&](const unsigned int, const auto column) { pattern.add(row, column); });
      });
    pattern.compress();

    matrix.reinit(pattern);
    for (const Cell &cell : system.cells())
      {
        const auto own = system.matrix(cell);
        for_unknowns(cell, [&](const unsigned int v, const auto row) {
          for_unknowns(cell, [&](const unsigned int w, const auto column) { matrix.add(row, column, own[v][w]); });
        });
      }
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      matrix.add(owned.nth_index_in_set(k), owned.nth_index_in_set(k), system.added_to_diagonal(unknowns[k]));
    if (has_none)
      matrix.add(owned.nth_index_in_set(0), owned.nth_index_in_set(0), 1.);
    matrix.compress(VectorOperation::add);

    source.reinit(owned, communicator);
    result.reinit(owned, communicator);
    choose();
  }


  template <int dim>
  void PressurePreconditioner<dim>::choose()
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


  template <int dim>
  void PressurePreconditioner<dim>::make_multigrid(const unsigned int most_on_coarsest)
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic = true;
    Teuchos::ParameterList settings;
    std::unique_ptr<Epetra_MultiVector> constant_modes;
    data.set_parameters(settings, constant_modes, matrix.trilinos_matrix());
    settings.set("coarse: max size", int(most_on_coarsest));
    multigrid.initialize(matrix, settings);
  }


  template <int dim>
  void PressurePreconditioner<dim>::vmult(std::vector<double> &preconditioned, const std::vector<double> &remainder)
  {
    const auto place = [this](const unsigned int k) { return system.place(unknowns[k]); };
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      source.local_element(k) = place(k) != system.none ? remainder[place(k)] : 0.;
    if (chosen != nullptr)
      chosen->vmult(result, source);
    for (unsigned int i = 0; i < remainder.size(); ++i)
      preconditioned[i] = remainder[i] / system.diagonal_of(system.unknowns()[i]);
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      if (place(k) != system.none)
        preconditioned[place(k)] = result.local_element(k);
  }

  template class PressurePreconditioner<2>;
  template class PressurePreconditioner<3>;
} // namespace scree
