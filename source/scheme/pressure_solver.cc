// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/pressure_solver.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of this rank's numbers.
    double local_square(const CornerVector &vector)
    {
      return std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.);
    }
  } // namespace


  template <int dim>
  struct PressureSolver<dim>::Preconditioner
  {
    TrilinosWrappers::SparseMatrix matrix; // The others refer to it.
    TrilinosWrappers::PreconditionAMG multigrid;
    TrilinosWrappers::PreconditionBlockwiseDirect blocks;
    TrilinosWrappers::PreconditionBase *chosen = nullptr; // null: there was no unknown

    std::vector<unsigned int> unknowns; // owned numbers of the rows
    CornerVector source, result;        // by row

    void choose();
    void make_multigrid(const unsigned int most_on_coarsest);
  };


  template <int dim>
  void PressureSolver<dim>::Preconditioner::choose()
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
  void PressureSolver<dim>::Preconditioner::make_multigrid(const unsigned int most_on_coarsest)
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
  PressureSolver<dim>::~PressureSolver() = default;


  template <int dim>
  PressureSolver<dim>::PressureSolver(const BackgroundGrid<dim> &grid,
                                      const NodeNumbering<dim> &corners,
                                      const PressureParameters &parameters)
      : grid(grid)
      , corners(corners)
      , maximum_iterations(parameters.maximum_iterations)
  {
    // Hat functions on the unit cell: one-dimensional mass and stiffness, multiplied.
    for (unsigned int v = 0; v < n_corners; ++v)
      for (unsigned int w = 0; w < n_corners; ++w)
        {
          double sum = 0, mass = 1;
          for (unsigned int a = 0; a < dim; ++a)
            {
              double product = 1;
              for (unsigned int b = 0; b < dim; ++b)
                {
                  const bool same = ((v ^ w) >> b & 1) == 0;
                  product *= b == a ? (same ? 1. : -1.) : (same ? 1. / 3. : 1. / 6.);
                }
              sum += product;
              mass *= ((v ^ w) >> a & 1) == 0 ? 1. / 3. : 1. / 6.;
            }
          laplacian[v][w]   = sum;
          fluctuation[v][w] = mass - 1. / (n_corners * n_corners);
        }
    reinit();
  }


  template <int dim>
  void PressureSolver<dim>::reinit()
  {
    const auto &nodes = *corners.partitioner();
    number_of_corner.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), numbers::invalid_unsigned_int);
    partitioner.reset();
    preconditioner.reset();
    is_worn = true;
  }


  template <int dim>
  bool PressureSolver<dim>::numbers_serve(const Mixture<dim> &mixture) const
  {
    bool serve = partitioner != nullptr;
    for (const MixtureCell<dim> &cell : mixture.cells())
      for (unsigned int v = 0; v < n_corners && serve && cell.water_volume > 0; ++v)
        serve = number_of_corner[corners.nodes(cell.cell)[v]] != numbers::invalid_unsigned_int;
    return Utilities::MPI::min(int(serve), grid.triangulation().get_communicator()) == 1;
  }


  template <int dim>
  std::vector<unsigned int> PressureSolver<dim>::mark_corners(const Mixture<dim> &mixture, CornerVector &marks) const
  {
    constexpr unsigned int margin = 2;
    std::vector<unsigned int> marked_cells;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        marked_cells.push_back(cell.cell);
    const auto is_touched = [&](const unsigned int cell) {
      return std::any_of(corners.nodes(cell), corners.nodes(cell) + n_corners, [&](const unsigned int corner) {
        return marks.local_element(corner) != 0.;
      });
    };
    for (unsigned int layer = 0; layer <= margin; ++layer)
      {
        for (const unsigned int cell : marked_cells)
          for (unsigned int v = 0; v < n_corners; ++v)
            marks.local_element(corners.nodes(cell)[v]) += 1.;
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
  IndexSet PressureSolver<dim>::number_marked(CornerVector &marks) const
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    const auto begin = marks.begin(), end = begin + corners.n_owned();
    const auto is_marked = [](const double mark) { return mark > 0.; };
    // Trilinos needs a row of every rank.
    AssertThrow(corners.n_owned() > 0, ExcMessage("A rank has no node of its own. Remedy: fewer ranks."));
    if (std::none_of(begin, end, is_marked))
      *begin = 1.;
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, std::count_if(begin, end, is_marked))[Utilities::MPI::this_mpi_process(communicator)];
    auto next = owned.begin();
    for (auto mark = begin; mark != end; ++mark)
      *mark = is_marked(*mark) ? double(*next++) : -1.;
    marks.update_ghost_values();
    return owned;
  }


  template <int dim>
  void PressureSolver<dim>::number(const Mixture<dim> &mixture)
  {
    if (numbers_serve(mixture))
      return;
    CornerVector global(corners.partitioner()); // marks at first, then numbers
    const std::vector<unsigned int> numbered_cells = mark_corners(mixture, global);
    const IndexSet owned                           = number_marked(global);
    const auto number_of                           = [&](const unsigned int corner) {
      return static_cast<types::global_dof_index>(global.local_element(corner));
    };
    const auto for_corners_of_cells = [&](const auto &act) {
      for (const unsigned int cell : numbered_cells)
        std::for_each(corners.nodes(cell), corners.nodes(cell) + n_corners, act);
    };
    IndexSet ghosts(owned.size());
    for_corners_of_cells([&](const unsigned int corner) {
      if (corner >= corners.n_owned())
        ghosts.add_index(number_of(corner));
    });
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, grid.triangulation().get_communicator());

    std::fill(number_of_corner.begin(), number_of_corner.end(), numbers::invalid_unsigned_int);
    corner_of_number.assign(owned.n_elements() + ghosts.n_elements(), numbers::invalid_unsigned_int);
    const auto take = [&](const unsigned int corner) {
      number_of_corner[corner]                   = partitioner->global_to_local(number_of(corner));
      corner_of_number[number_of_corner[corner]] = corner;
    };
    for (unsigned int corner = 0; corner < corners.n_owned(); ++corner)
      if (global.local_element(corner) >= 0.)
        take(corner);
    for_corners_of_cells(take);

    for (CornerVector *vector : { &source,
                                  &solution,
                                  &scratch,
                                  &whole_diagonal,
                                  &remainder,
                                  &preconditioned,
                                  &product,
                                  &direction,
                                  &direction_product })
      vector->reinit(partitioner);
    is_worn = true;
  }


  template <int dim>
  void PressureSolver<dim>::assemble(const Mixture<dim> &mixture,
                                     const FreeSurfaceLocator<dim> &surface,
                                     const double time_step,
                                     const std::function<double(unsigned int corner)> &storage,
                                     const double projection)
  {
    number(mixture);
    is_unknown.assign(corner_of_number.size(), false);
    diagonal.assign(partitioner->locally_owned_size(), 0.);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (surface.kind(corner_of_number[i]) == CornerKind::unknown)
        {
          is_unknown[i] = true;
          diagonal[i]   = storage(corner_of_number[i]);
        }

    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    const double scale       = time_step * cell_volume / (grid.cell_size() * grid.cell_size());
    bool is_anchored         = false; // something beside differences of pressure matters
    double largest_mobility  = 0;
    scratch                  = 0.;
    whole_diagonal           = 0.;
    cells.clear();
    for (const MixtureCell<dim> &mixed : mixture.cells())
      if (mixed.water_volume > 0)
        {
          cells.emplace_back();
          Cell &cell              = cells.back();
          cell.mobility           = scale * mixed.mobility;
          largest_mobility        = std::max(largest_mobility, cell.mobility);
          cell.projection         = projection * mixed.volume * std::min(mixed.fill, 1.);
          const CellMatrix own    = matrix(cell);
          const unsigned int *all = corners.nodes(mixed.cell);
          for (unsigned int v = 0; v < n_corners; ++v)
            {
              cell.numbers[v] = number_of_corner[all[v]];
              is_anchored     = is_anchored || surface.kind(all[v]) != CornerKind::unknown || storage(all[v]) > 0.;
              if (surface.kind(all[v]) != CornerKind::unknown)
                continue;
              is_unknown[cell.numbers[v]] = true;
              whole_diagonal.local_element(cell.numbers[v]) += own[v][v];
              // A corner beside the surface follows the unknown one; this keeps the matrix symmetric.
              for (unsigned int w = 0; w < n_corners; ++w)
                if (surface.kind(all[w]) == CornerKind::surface)
                  scratch.local_element(cell.numbers[v]) += own[v][w] * surface.ratio(all[w], all[v]);
            }
        }
    scratch.compress(VectorOperation::add);
    whole_diagonal.compress(VectorOperation::add);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      {
        diagonal[i] += scratch.local_element(i);
        whole_diagonal.local_element(i) += diagonal[i];
      }
    const std::vector<double> own{ largest_mobility, double(is_anchored) };
    std::vector<double> all_ranks(2);
    Utilities::MPI::max(own, grid.triangulation().get_communicator(), all_ranks);
    AssertThrow(all_ranks[0] == 0. || all_ranks[1] == 1.,
                ExcMessage("Water fills the box, and all its walls are closed: nothing sets the level of its pressure. "
                           "Remedies: a drained wall in subsection Boundaries/Water, a 'Bulk modulus' in subsection "
                           "Water, or a box that is higher than the water."));
  }


  template <int dim>
  typename PressureSolver<dim>::CellMatrix PressureSolver<dim>::matrix(const Cell &cell) const
  {
    CellMatrix own;
    for (unsigned int v = 0; v < n_corners; ++v)
      for (unsigned int w = 0; w < n_corners; ++w)
        own[v][w] = cell.mobility * laplacian[v][w] + cell.projection * fluctuation[v][w];
    return own;
  }


  template <int dim>
  void PressureSolver<dim>::Operator::vmult(CornerVector &target, const CornerVector &source) const
  {
    target = 0.;
    source.update_ghost_values();
    for (const Cell &cell : solver.cells)
      {
        std::array<double, n_corners> values;
        for (unsigned int v = 0; v < n_corners; ++v)
          values[v] = solver.is_unknown[cell.numbers[v]] ? source.local_element(cell.numbers[v]) : 0.;
        for (unsigned int v = 0; v < n_corners; ++v)
          if (solver.is_unknown[cell.numbers[v]])
            {
              double flux = 0, fluctuation = 0;
              for (unsigned int w = 0; w < n_corners; ++w)
                flux += solver.laplacian[v][w] * values[w];
              if (cell.projection > 0)
                for (unsigned int w = 0; w < n_corners; ++w)
                  fluctuation += solver.fluctuation[v][w] * values[w];
              target.local_element(cell.numbers[v]) += cell.mobility * flux + cell.projection * fluctuation;
            }
      }
    target.compress(VectorOperation::add);
    source.zero_out_ghost_values();
    for (unsigned int i = 0; i < solver.diagonal.size(); ++i)
      target.local_element(i) += solver.diagonal[i] * source.local_element(i);
  }


  template <int dim>
  void PressureSolver<dim>::make_preconditioner()
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    preconditioner              = std::make_unique<Preconditioner>();
    auto &unknowns              = preconditioner->unknowns;
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (is_unknown[i])
        unknowns.push_back(i);
    if (Utilities::MPI::sum(unknowns.size(), communicator) == 0)
      return; // all corners are held for now
    // A rank without a row would be refused: it has one that nothing depends on.
    const bool has_none  = unknowns.empty();
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, has_none ? 1 : unknowns.size())[Utilities::MPI::this_mpi_process(communicator)];
    CornerVector rows(partitioner); // of the matrix, by number; doubles hold them exactly
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      rows.local_element(unknowns[k]) = owned.nth_index_in_set(k);
    rows.update_ghost_values();

    // Calls visit(v, row of v) for the unknown corners of a cell.
    const auto for_unknowns = [&](const Cell &cell, const auto &visit) {
      for (unsigned int v = 0; v < n_corners; ++v)
        if (is_unknown[cell.numbers[v]])
          visit(v, types::global_dof_index(rows.local_element(cell.numbers[v])));
    };
    TrilinosWrappers::SparsityPattern pattern(owned, communicator, Utilities::pow(3, dim));
    for (const auto row : owned)
      pattern.add(row, row);
    for (const Cell &cell : cells)
      for_unknowns(cell, [&](const unsigned int, const auto row) {
        for_unknowns(cell, [&](const unsigned int, const auto column) { pattern.add(row, column); });
      });
    pattern.compress();

    auto &matrix_of_all = preconditioner->matrix;
    matrix_of_all.reinit(pattern);
    for (const Cell &cell : cells)
      {
        const CellMatrix own = matrix(cell);
        for_unknowns(cell, [&](const unsigned int v, const auto row) {
          for_unknowns(cell,
                       [&](const unsigned int w, const auto column) { matrix_of_all.add(row, column, own[v][w]); });
        });
      }
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      matrix_of_all.add(owned.nth_index_in_set(k), owned.nth_index_in_set(k), diagonal[unknowns[k]]);
    if (has_none)
      matrix_of_all.add(owned.nth_index_in_set(0), owned.nth_index_in_set(0), 1.);
    matrix_of_all.compress(VectorOperation::add);

    preconditioner->source.reinit(owned, communicator);
    preconditioner->result.reinit(owned, communicator);
    preconditioner->choose();
  }


  template <int dim>
  void PressureSolver<dim>::take(const CornerVector &from, CornerVector &to) const
  {
    to = 0.;
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (is_unknown[i])
        to.local_element(i) = from.local_element(corner_of_number[i]);
  }


  template <int dim>
  void PressureSolver<dim>::precondition()
  {
    const auto &unknowns = preconditioner->unknowns;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      preconditioner->source.local_element(k) = is_unknown[unknowns[k]] ? remainder.local_element(unknowns[k]) : 0.;
    if (preconditioner->chosen != nullptr)
      preconditioner->chosen->vmult(preconditioner->result, preconditioner->source);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      preconditioned.local_element(i) =
          is_unknown[i] ? remainder.local_element(i) / whole_diagonal.local_element(i) : 0.;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      if (is_unknown[unknowns[k]])
        preconditioned.local_element(unknowns[k]) = preconditioner->result.local_element(k);
  }


  template <int dim>
  typename PressureSolver<dim>::Iterations PressureSolver<dim>::iterate(const unsigned int most)
  {
    const Operator system{ *this };
    const auto n_owned = diagonal.size();
    system.vmult(remainder, solution);
    remainder.sadd(-1., 1., source);
    direction         = 0.;
    direction_product = 0.;
    Iterations result{ 0, remainder.l2_norm() };
    double last_projection = 1., last_length = 1.;
    while (result.residual > tolerance && result.n < most)
      {
        precondition();
        system.vmult(product, preconditioned);
        const double *r = remainder.begin(), *z = preconditioned.begin(), *w = product.begin();
        const double *s = direction_product.begin();
        double rr = 0, rz = 0, zw = 0, rw = 0, ww = 0, rs = 0, ws = 0, ss = 0;
        for (unsigned int i = 0; i < n_owned; ++i)
          {
            rr += r[i] * r[i];
            rz += r[i] * z[i];
            zw += z[i] * w[i];
            rw += r[i] * w[i];
            ww += w[i] * w[i];
            rs += r[i] * s[i];
            ws += w[i] * s[i];
            ss += s[i] * s[i];
          }
        std::array<double, 8> sums{ { rr, rz, zw, rw, ww, rs, ws, ss } };
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                            grid.triangulation().get_communicator(),
                            ArrayView<double>(sums.data(), sums.size()));
        std::tie(rr, rz, zw, rw, ww, rs, ws, ss) = std::tuple_cat(sums);

        const double turn      = result.n == 0 ? 0. : rz / last_projection;
        const double curvature = zw - (result.n == 0 ? 0. : turn * rz / last_length);
        const double length    = rz / curvature;
        direction.sadd(turn, 1., preconditioned);
        direction_product.sadd(turn, 1., product);
        solution.add(length, direction);
        remainder.add(-length, direction_product);
        last_projection = rz;
        last_length     = length;
        ++result.n;

        const double square =
            rr - 2. * length * (rw + turn * rs) + length * length * (ww + 2. * turn * ws + turn * turn * ss);
        constexpr double rounded_away = 1e-8;
        result.residual               = square > rounded_away * rr ? std::sqrt(square) : remainder.l2_norm();
      }
    return result;
  }


  template <int dim>
  void PressureSolver<dim>::converge(SolveReport &report)
  {
    Iterations last{};
    const auto has_converged = [&](const unsigned int most) {
      last = iterate(most);
      report.n_iterations += last.n;
      return last.residual <= tolerance;
    };
    // A front that enters new cells can make the kept preconditioner useless within a step.
    const unsigned int patience = std::min(maximum_iterations, iterations_when_new + iterations_worth_a_preconditioner);
    if (tolerance > 0. && // else nothing flows
        (is_worn || !has_converged(patience)))
      {
        make_preconditioner();
        report.made_preconditioner = true;
        const bool is_done         = has_converged(maximum_iterations);
        AssertThrow(
            is_done,
            ExcMessage("The pressure solver did not converge: after " + std::to_string(last.n) +
                       " iterations the residual is " + std::to_string(last.residual / tolerance) +
                       " times the wanted one. Remedies: a smaller 'Courant number' in subsection Time step, "
                       "more 'Maximum iterations' or a larger 'Relative tolerance' in subsection Water/Pressure."));
        is_worn             = false;
        iterations_when_new = last.n;
        surplus_iterations  = 0;
      }
  }


  template <int dim>
  SolveReport PressureSolver<dim>::solve(const CornerVector &rhs,
                                         const CornerVector &pressure,
                                         const double relative_tolerance,
                                         CornerVector &change)
  {
    take(pressure, solution);
    Operator{ *this }.vmult(scratch, solution);
    take(rhs, source);
    take(change, solution);
    constexpr double rounding = 1e-12;
    const std::vector<double> squares{ local_square(scratch), local_square(source) };
    std::vector<double> of_ranks(2);
    Utilities::MPI::sum(squares, grid.triangulation().get_communicator(), of_ranks);
    tolerance = std::max(rounding * std::sqrt(of_ranks[0]), relative_tolerance * std::sqrt(of_ranks[1]));
    SolveReport report;
    converge(report);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      change.local_element(corner_of_number[i]) = is_unknown[i] ? solution.local_element(i) : 0.;
    return report;
  }


  template <int dim>
  void PressureSolver<dim>::solve_held(const std::vector<char> &is_held, CornerVector &residual, SolveReport &report)
  {
    const Operator system{ *this };
    CornerVector held(partitioner), &right_side = residual;
    right_side = source;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      held.local_element(i) = is_held[i] ? solution.local_element(i) : 0.;
    system.vmult(scratch, held);

    // The held corners leave the system like those of a drained wall.
    const std::vector<char> all_unknown = is_unknown;
    CornerVector marks(partitioner);
    for (unsigned int i = 0; i < is_held.size(); ++i)
      marks.local_element(i) = is_held[i];
    marks.update_ghost_values();
    for (unsigned int i = 0; i < is_unknown.size(); ++i)
      is_unknown[i] = is_unknown[i] && marks.local_element(i) == 0.;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      {
        source.local_element(i)   = is_unknown[i] ? source.local_element(i) - scratch.local_element(i) : 0.;
        solution.local_element(i) = is_unknown[i] ? solution.local_element(i) : 0.;
      }
    converge(report);
    is_unknown = all_unknown;

    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (is_held[i])
        solution.local_element(i) = held.local_element(i);
    source = right_side;
    system.vmult(scratch, solution);
    residual = scratch;
    residual -= source;
  }


  template <int dim>
  std::pair<SolveReport, unsigned int>
  PressureSolver<dim>::keep_above(const double least, const CornerVector &pressure, CornerVector &change)
  {
    constexpr unsigned int most_sweeps = 5; // Corners below after them are held without another solve.
    const MPI_Comm communicator        = grid.triangulation().get_communicator();
    std::pair<SolveReport, unsigned int> result;
    std::vector<char> is_held(diagonal.size(), false);
    CornerVector residual;
    const auto bound = [&](const unsigned int i) { return least - pressure.local_element(corner_of_number[i]); };
    for (unsigned int sweep = 0;; ++sweep)
      {
        bool has_changed = false;
        for (unsigned int i = 0; i < is_held.size(); ++i)
          if (is_unknown[i])
            {
              const bool holds = is_held[i] ? residual.local_element(i) >= -tolerance || sweep == most_sweeps
                                            : solution.local_element(i) < bound(i);
              has_changed      = has_changed || holds != bool(is_held[i]);
              is_held[i]       = holds;
              if (holds)
                solution.local_element(i) = bound(i);
            }
        if (sweep == most_sweeps || !Utilities::MPI::logical_or(has_changed, communicator))
          break;
        if (sweep == 0)
          residual.reinit(partitioner);
        solve_held(is_held, residual, result.first);
      }
    result.second = std::count(is_held.begin(), is_held.end(), true);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      change.local_element(corner_of_number[i]) = is_unknown[i] ? solution.local_element(i) : 0.;
    return result;
  }


  template <int dim>
  void PressureSolver<dim>::judge_preconditioner(const SolveReport &report)
  {
    if (report.made_preconditioner || is_worn) // worn still: nothing flowed, so that none was made
      return;
    surplus_iterations += std::max(int(report.n_iterations) - int(iterations_when_new), 0);
    is_worn = surplus_iterations > iterations_worth_a_preconditioner;
  }

  template class PressureSolver<2>;
  template class PressureSolver<3>;
} // namespace scree
