// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_preconditioner.h>
#include <scree/pressure/pressure_solver.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// In the preconditioner: of the inverse diagonal of S, beside the inverse of L. S is far less than L for pressures
    /// that oscillate from vertex to vertex. CG iterations per step with 0.1, 0.2, 0.3: saturated slope 5.0, 4.4, 4.3;
    /// saturated slide on a mountain 97, 96, 104.
    constexpr double part_of_diagonal = 0.2;
  } // namespace


  template <int dim>
  PressureSolver<dim>::~PressureSolver() = default;


  template <int dim>
  PressureSolver<dim>::PressureSolver(const BackgroundGrid<dim> &grid,
                                      const NodeNumbering<dim> &vertices,
                                      SchurOperator<dim> &schur,
                                      const PressureParameters &parameters)
      : grid(grid)
      , vertices(vertices)
      , numbering(grid, vertices)
      , system(grid, vertices, numbering)
      , maximum_iterations(parameters.maximum_iterations)
      , schur(schur)
  {
    reinit();
  }


  template <int dim>
  void PressureSolver<dim>::reinit()
  {
    numbering.reinit();
    preconditioner.reset();
    of_schur.reinit(vertices.partitioner());
    times_schur.reinit(vertices.partitioner());
    is_worn = true;
  }


  template <int dim>
  void PressureSolver<dim>::assemble(const Mixture<dim> &mixture,
                                     const FreeSurface<dim> &surface,
                                     const double time_step,
                                     const std::function<double(unsigned int vertex)> &storage,
                                     GroundRows<dim> *of_ground)
  {
    if (numbering.update(mixture))
      {
        system.reinit();
        for (Joint *vector : { &source,
                               &solution,
                               &residual,
                               &scratch,
                               &last_solution,
                               &remainder,
                               &preconditioned,
                               &product,
                               &direction,
                               &direction_product })
          vector->of_vertices.reinit(numbering.partitioner());
        is_worn = true;
      }
    system.assemble(mixture, surface, time_step, storage);
    storage_of_number.assign(system.n_owned(), 0.);
    diagonal_of_number.assign(system.n_owned(), 0.);
    schur.find_diagonal(times_schur);
    for (unsigned int i = 0; i < storage_of_number.size(); ++i)
      if (system.is_unknown(i))
        {
          storage_of_number[i]  = storage(numbering.vertex(i));
          diagonal_of_number[i] = times_schur.local_element(numbering.vertex(i)) + storage_of_number[i];
        }
    if (of_ground)
      of_ground->set_mobilities(schur.mobilities());
  }


  template <int dim>
  void PressureSolver<dim>::vmult(Joint &target, const Joint &source)
  {
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      of_schur.local_element(numbering.vertex(i)) = system.is_unknown(i) ? source.of_vertices.local_element(i) : 0.;
    schur.vmult(times_schur, target.of_rows, of_schur, source.of_rows);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      target.of_vertices.local_element(i) = system.is_unknown(i)
                                                ? times_schur.local_element(numbering.vertex(i)) +
                                                      storage_of_number[i] * source.of_vertices.local_element(i)
                                                : 0.;
    constexpr double regularisation = 1e-7; // the rows of small facets nearly depend on those beside them
    for (unsigned int k = 0; k < target.of_rows.size(); ++k)
      {
        const GroundRow<dim> &row = (*rows)[k];
        target.of_rows[k] += regularisation * row.diagonal * source.of_rows[k];
        if (row.held == HeldMotion::all || row.held == HeldMotion::along)
          target.of_rows[k] += row.compliance * row.along(source.of_rows[k]);
      }
  }


  template <int dim>
  void PressureSolver<dim>::take(const VertexVector &from, VertexVector &to) const
  {
    to = 0.;
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      if (system.is_unknown(i))
        to.local_element(i) = from.local_element(numbering.vertex(i));
  }


  template <int dim>
  void PressureSolver<dim>::precondition(const Joint &from, Joint &to)
  {
    preconditioner->vmult(to.of_vertices, from.of_vertices);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      if (diagonal_of_number[i] > 0.) // else no part of a cell reaches the vertex
        to.of_vertices.local_element(i) += part_of_diagonal / diagonal_of_number[i] * from.of_vertices.local_element(i);
    if (ground)
      ground->precondition(from.of_rows, to.of_rows);
    restrict_to_free(to);
  }


  template <int dim>
  void PressureSolver<dim>::restrict_to_free(Joint &vector) const
  {
    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (is_held[i])
        vector.of_vertices.local_element(i) = 0.;
    for (unsigned int k = 0; k < vector.of_rows.size(); ++k)
      vector.of_rows[k] = (*rows)[k].held_part(vector.of_rows[k]);
  }


  template <int dim>
  double PressureSolver<dim>::find_release(Joint &result) const
  {
    double square = 0.;
    result.clear(source.of_rows.size());
    for (unsigned int i = 0; i < least_change.size(); ++i)
      if (const double flow = residual.of_vertices.local_element(i); is_held[i] && flow > 0.)
        {
          result.of_vertices.local_element(i) = flow / diagonal_of_number[i];
          square += flow * flow;
        }
    for (unsigned int k = 0; k < residual.of_rows.size(); ++k)
      {
        const GroundRow<dim> &row = (*rows)[k];
        const double flow         = residual.of_rows[k] * row.normal;
        const bool is_at_bound    = row.held == HeldMotion::none || row.held == HeldMotion::along;
        if (is_at_bound && flow > 0. && row.diagonal > 0.)
          {
            result.of_rows[k] = flow / row.diagonal * row.normal;
            square += weight_of_rows * flow * flow;
          }
      }
    return square;
  }


  template <int dim>
  void PressureSolver<dim>::release(const Joint &along)
  {
    for (unsigned int i = 0; i < is_held.size(); ++i)
      is_held[i] = is_held[i] && along.of_vertices.local_element(i) == 0.;
    for (unsigned int k = 0; k < along.of_rows.size(); ++k)
      if (along.of_rows[k].norm_square() > 0.)
        (*rows)[k].held = (*rows)[k].held == HeldMotion::along ? HeldMotion::all : HeldMotion::across;
  }


  template <int dim>
  bool PressureSolver<dim>::presses(const unsigned int k) const
  {
    constexpr double rounded = 1e-14;
    return solution.of_rows[k] * (*rows)[k].normal > rounded * solution.of_rows[k].norm();
  }


  template <int dim>
  double PressureSolver<dim>::step_of_vertex(const unsigned int i) const
  {
    const double change = direction.of_vertices.local_element(i);
    return i < least_change.size() && change < 0. ? (least_change[i] - solution.of_vertices.local_element(i)) / change
                                                  : std::numeric_limits<double>::infinity();
  }


  template <int dim>
  double PressureSolver<dim>::step_of_row(const unsigned int k) const
  {
    const GroundRow<dim> &row = (*rows)[k];
    const bool may_lift       = row.is_unilateral && (row.held == HeldMotion::across || row.held == HeldMotion::all);
    const double change       = direction.of_rows[k] * row.normal;
    return may_lift && change < 0. ? -(solution.of_rows[k] * row.normal) / change
                                   : std::numeric_limits<double>::infinity();
  }


  template <int dim>
  double PressureSolver<dim>::longest_step() const
  {
    double longest = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < is_held.size(); ++i)
      longest = std::min(longest, step_of_vertex(i));
    for (unsigned int k = 0; k < direction.of_rows.size(); ++k)
      longest = std::min(longest, step_of_row(k));
    return longest;
  }


  template <int dim>
  void PressureSolver<dim>::go_to_first_bound(const double length)
  {
    constexpr double rounded = 1e-12; // What reaches its bound within this is on it, whatever rounding leaves.
    const double reach       = (1. + rounded) * length;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (step_of_vertex(i) <= reach)
        solution.of_vertices.local_element(i) = least_change[i];
      else
        solution.of_vertices.local_element(i) += length * direction.of_vertices.local_element(i);
    for (unsigned int k = 0; k < solution.of_rows.size(); ++k)
      {
        const bool is_at_bound = step_of_row(k) <= reach;
        solution.of_rows[k] += length * direction.of_rows[k];
        if (is_at_bound)
          lift_off(k);
      }
  }


  template <int dim>
  void PressureSolver<dim>::lift_off(const unsigned int k)
  {
    const GroundRow<dim> &row = (*rows)[k];
    const bool rubs           = row.held == HeldMotion::all || row.held == HeldMotion::along;
    solution.of_rows[k]       = rubs ? row.along(solution.of_rows[k]) : Tensor<1, dim>();
  }


  template <int dim>
  void PressureSolver<dim>::project()
  {
    for (unsigned int i = 0; i < least_change.size(); ++i)
      if (double &value = solution.of_vertices.local_element(i); system.is_unknown(i))
        value = std::max(value, least_change[i]);
    for (unsigned int k = 0; k < solution.of_rows.size(); ++k)
      if ((*rows)[k].is_unilateral && solution.of_rows[k] * (*rows)[k].normal < 0.)
        lift_off(k);
  }


  template <int dim>
  void PressureSolver<dim>::hold()
  {
    for (unsigned int i = 0; i < least_change.size(); ++i)
      if (system.is_unknown(i) && solution.of_vertices.local_element(i) == least_change[i])
        is_held[i] = true;
    for (unsigned int k = 0; k < solution.of_rows.size(); ++k)
      if (GroundRow<dim> &row = (*rows)[k]; row.is_unilateral && !presses(k))
        row.held = row.held == HeldMotion::all || row.held == HeldMotion::along ? HeldMotion::along : HeldMotion::none;
  }


  template <int dim>
  double PressureSolver<dim>::energy() const
  {
    return -0.5 * (product_of(solution, source) + product_of(solution, residual));
  }


  template <int dim>
  typename PressureSolver<dim>::Iterations PressureSolver<dim>::iterate(const unsigned int most)
  {
    constexpr unsigned int most_of_search = 200; // iterations; then the set of what is held is kept
    const MPI_Comm communicator           = grid.communicator();
    for (Joint *vector : { &preconditioned, &product, &direction })
      vector->clear(source.of_rows.size());
    find_residual();
    Iterations result{ 0, 0. };
    bool is_conjugate      = false; // the next direction to the last one
    double last_projection = 1.;
    for (;; ++result.n)
      {
        remainder = residual;
        restrict_to_free(remainder);
        precondition(remainder, preconditioned);
        std::array<double, 4> sums{
          { local_square(remainder), find_release(scratch), product_of(remainder, preconditioned), energy() }
        };
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                            communicator,
                            ArrayView<double>(sums.data(), sums.size()));
        const auto [free, blocked, projection, energy_before] = sums;
        const bool searches                                   = result.n < most_of_search;
        result.residual                                       = std::sqrt(free + (searches ? blocked : 0.));
        if (result.residual <= accepted || result.n == most)
          return result;

        const bool releases = searches && blocked > free;
        if (releases)
          {
            direction = scratch;
            release(direction);
          }
        else
          direction.sadd(is_conjugate ? projection / last_projection : 0., 1., preconditioned);
        vmult(product, direction);
        const auto of_ranks = Utilities::MPI::min_max_avg(
            std::vector<double>{ product_of(direction, product), product_of(direction, residual), longest_step() },
            communicator);
        const double length    = of_ranks[1].sum / of_ranks[0].sum;
        const double longest   = of_ranks[2].min;
        const bool is_feasible = !searches || length < longest;
        if (!is_feasible)
          last_solution = solution;
        solution.sadd(1., length, direction);
        last_projection = projection;
        is_conjugate    = !releases && is_feasible;
        if (is_feasible)
          {
            residual.sadd(1., -length, product);
            continue;
          }
        project();
        find_residual();
        if (Utilities::MPI::sum(energy(), communicator) > energy_before)
          {
            solution = last_solution;
            go_to_first_bound(longest);
            find_residual();
          }
        hold();
      }
  }


  template <int dim>
  double PressureSolver<dim>::product_of(const Joint &a, const Joint &b)
  {
    double result = 0.;
    for (unsigned int i = 0; i < a.of_vertices.locally_owned_size(); ++i)
      result += a.of_vertices.local_element(i) * b.of_vertices.local_element(i);
    for (unsigned int k = 0; k < a.of_rows.size(); ++k)
      result += a.of_rows[k] * b.of_rows[k];
    return result;
  }


  template <int dim>
  void PressureSolver<dim>::Joint::sadd(const double factor, const double other_factor, const Joint &other)
  {
    of_vertices.sadd(factor, other_factor, other.of_vertices);
    for (unsigned int k = 0; k < of_rows.size(); ++k)
      of_rows[k] = factor * of_rows[k] + other_factor * other.of_rows[k];
  }


  template <int dim>
  double PressureSolver<dim>::local_square(const Joint &vector) const
  {
    double square = 0.;
    for (const double value : vector.of_vertices)
      square += value * value;
    for (const Tensor<1, dim> &value : vector.of_rows)
      square += weight_of_rows * value.norm_square();
    return square;
  }


  template <int dim>
  void PressureSolver<dim>::find_residual()
  {
    residual.clear(source.of_rows.size());
    vmult(residual, solution);
    residual.sadd(-1., 1., source);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      if (!system.is_unknown(i))
        residual.of_vertices.local_element(i) = 0.;
  }


  template <int dim>
  void PressureSolver<dim>::converge(SolveReport &report)
  {
    Iterations last{};
    const auto has_converged = [&](const unsigned int most) {
      last = iterate(most);
      report.n_iterations += last.n;
      return last.residual <= accepted;
    };
    // A front that enters new cells can make the kept preconditioner useless within a step.
    const unsigned int patience = std::min(maximum_iterations, iterations_when_new + iterations_worth_a_preconditioner);
    if (tolerance > 0. && // else nothing flows
        (is_worn || !has_converged(patience)))
      {
        preconditioner.reset(); // before the next one takes memory
        preconditioner             = std::make_unique<PressurePreconditioner<dim>>(system);
        report.made_preconditioner = true;
        const bool is_done         = has_converged(maximum_iterations);
        AssertThrow(
            is_done,
            ExcMessage("The pressure solver did not converge: after " + std::to_string(last.n) +
                       " iterations the residual is " + std::to_string(last.residual / accepted) +
                       " times the accepted one. Remedies: a smaller 'Courant number' in subsection Time step, "
                       "more 'Maximum iterations' or a larger 'Relative tolerance' in subsection Water/Pressure."));
        is_worn             = false;
        iterations_when_new = last.n;
        surplus_iterations  = 0;
      }
  }


  template <int dim>
  void PressureSolver<dim>::start_rows()
  {
    for (unsigned int k = 0; k < source.of_rows.size(); ++k)
      {
        GroundRow<dim> &row   = (*rows)[k];
        const double pressing = row.traction * row.normal;
        if (!row.is_unilateral)
          row.held = row.friction > 0. ? HeldMotion::all : HeldMotion::across;
        else
          row.held = pressing > 0. ? HeldMotion::across : HeldMotion::none;
        if (row.is_unilateral && (pressing <= 0. || row.friction == 0.))
          row.traction = std::max(pressing, 0.) * row.normal;
        source.of_rows[k]   = row.flow;
        solution.of_rows[k] = row.traction;
      }
  }


  template <int dim>
  void PressureSolver<dim>::choose_friction()
  {
    // A row responds by more than its diagonal. By the sum of its row, those of small facets swing between stick and
    // slip.
    constexpr double part_of_response    = 0.3;
    constexpr double most_over_available = 1e6; // Less friction than that is none.
    for (unsigned int k = 0; k < source.of_rows.size(); ++k)
      {
        GroundRow<dim> &row = (*rows)[k];
        if (!row.is_unilateral || row.friction == 0.)
          continue;
        if (!presses(k))
          {
            solution.of_rows[k] = Tensor<1, dim>();
            row.held            = HeldMotion::none;
            row.compliance      = 0.;
            continue;
          }
        Tensor<1, dim> &traction   = solution.of_rows[k];
        const Tensor<1, dim> along = row.along(traction),
                             slip  = row.along(residual.of_rows[k]) + row.compliance * along;
        const double step          = part_of_response * row.diagonal;
        const double available     = row.friction * (traction * row.normal);
        const double needed        = (along + slip / step).norm();
        row.compliance = needed > available ? step * std::min(needed / available - 1., most_over_available) : 0.;
        if (along.norm() > available)
          traction -= (1. - available / along.norm()) * along;
        row.held = HeldMotion::all;
      }
  }


  template <int dim>
  void PressureSolver<dim>::set_tolerance(const double relative)
  {
    std::array<double, 4> squares{}; // at vertices and rows, of `scratch` and `source`
    for (const bool of_source : { false, true })
      {
        const Joint &flow = of_source ? source : scratch;
        for (const double value : flow.of_vertices)
          squares[of_source] += value * value;
        for (unsigned int k = 0; k < flow.of_rows.size(); ++k)
          squares[2 + of_source] += (*rows)[k].friction > 0. ? flow.of_rows[k].norm_square()
                                                             : std::pow(flow.of_rows[k] * (*rows)[k].normal, 2);
      }
    Utilities::MPI::sum(ArrayView<const double>(squares.data(), squares.size()),
                        grid.communicator(),
                        ArrayView<double>(squares.data(), squares.size()));
    const double of_vertices = std::max(squares[0], squares[1]), of_rows = std::max(squares[2], squares[3]);
    constexpr double coarser = 10.; // than at the vertices; tractions follow p
    // Rows count by their own flow: water without pressure at the ground is a small part of all, and has to stop, too.
    weight_of_rows = of_vertices > 0. && of_rows > 0. ? of_vertices / (coarser * coarser * of_rows) : 1.;
    tolerance      = relative * std::sqrt(of_vertices > 0. ? of_vertices : of_rows);
  }


  template <int dim>
  typename PressureSolver<dim>::Result
  PressureSolver<dim>::solve(const Task &task, VertexVector &change, GroundRows<dim> *of_ground)
  {
    constexpr double alone = 0.1; // of the tolerance: rows beside a held pressure decide on creep
    ground                 = of_ground;
    rows                   = ground ? &ground->all : nullptr;
    for (Joint *vector : { &source, &solution, &scratch })
      vector->of_rows.assign(rows ? rows->size() : 0, Tensor<1, dim>());
    take(task.pressure, solution.of_vertices);
    vmult(scratch, solution);
    take(task.flow, source.of_vertices);
    take(change, solution.of_vertices);
    if (rows)
      start_rows();
    set_tolerance(task.has_pressure ? task.relative_tolerance : alone * task.relative_tolerance);
    is_held.assign(system.n_owned(), !task.has_pressure);
    least_change.clear();
    if (task.has_pressure && std::isfinite(task.least_pressure))
      for (unsigned int i = 0; i < is_held.size(); ++i)
        least_change.push_back(task.least_pressure - task.pressure.local_element(numbering.vertex(i)));
    project();
    hold();
    Result result;
    const bool rubs = rows && Utilities::MPI::logical_or(
                                  std::any_of(rows->begin(),
                                              rows->end(),
                                              [](const auto &row) { return row.is_unilateral && row.friction > 0.; }),
                                  grid.communicator());
    if (rubs) // twice, with friction by what was found before
      {
        constexpr double coarser = 3.;
        find_residual();
        choose_friction();
        accepted = coarser * tolerance;
        converge(result.first);
        find_residual();
        choose_friction();
      }
    accepted = tolerance;
    converge(rubs ? result.further : result.first);
    if (task.has_pressure)
      result.n_cavitating = std::count(is_held.begin(), is_held.end(), char(true));
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      change.local_element(numbering.vertex(i)) = system.is_unknown(i) ? solution.of_vertices.local_element(i) : 0.;
    for (unsigned int k = 0; k < solution.of_rows.size(); ++k)
      (*rows)[k].traction = solution.of_rows[k];
    return result;
  }


  template <int dim>
  void PressureSolver<dim>::update_preconditioner_age(const SolveReport &report)
  {
    if (report.made_preconditioner || is_worn) // worn still: nothing flowed, so that none was made
      return;
    surplus_iterations += std::max(int(report.n_iterations) - int(iterations_when_new), 0);
    is_worn = surplus_iterations > iterations_worth_a_preconditioner;
  }

  template class PressureSolver<2>;
  template class PressureSolver<3>;
} // namespace scree
