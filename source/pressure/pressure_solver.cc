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
        if (row.held == HeldMotion::all)
          target.of_rows[k] += row.compliance * row.along(source.of_rows[k]);
      }
  }


  template <int dim>
  void PressureSolver<dim>::keep_held_motion(typename GroundRows<dim>::Vectors &flows) const
  {
    for (unsigned int k = 0; k < flows.size(); ++k)
      flows[k] = (*rows)[k].held_part(flows[k]);
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
  typename PressureSolver<dim>::Iterations PressureSolver<dim>::iterate(const unsigned int most)
  {
    const unsigned int n_owned = system.n_owned(), n_rows = source.of_rows.size();
    find_residual();
    remainder = residual;
    keep_held_motion(remainder.of_rows);
    direction.clear(n_rows);
    direction_product.clear(n_rows);
    preconditioned.clear(n_rows);
    product.clear(n_rows);
    Iterations result{ 0, std::sqrt(Utilities::MPI::sum(local_square(remainder), grid.communicator())) };
    double last_projection = 1., last_length = 1.;
    while (result.residual > accepted && result.n < most)
      {
        preconditioner->vmult(preconditioned.of_vertices, remainder.of_vertices);
        for (unsigned int i = 0; i < n_owned; ++i)
          if (diagonal_of_number[i] > 0.) // else no part of a cell reaches the vertex
            preconditioned.of_vertices.local_element(i) +=
                part_of_diagonal / diagonal_of_number[i] * remainder.of_vertices.local_element(i);
        if (ground)
          ground->precondition(remainder.of_rows, preconditioned.of_rows);
        vmult(product, preconditioned);
        keep_held_motion(product.of_rows);

        double rr = 0, rz = 0, zw = 0, rw = 0, ww = 0, rs = 0, ws = 0, ss = 0;
        const auto add = [&](const double weight, const auto &r, const auto &z, const auto &w, const auto &s) {
          rz += r * z;
          zw += z * w;
          rr += weight * (r * r);
          rw += weight * (r * w);
          ww += weight * (w * w);
          rs += weight * (r * s);
          ws += weight * (w * s);
          ss += weight * (s * s);
        };
        const double *r = remainder.of_vertices.begin(), *z = preconditioned.of_vertices.begin(),
                     *w = product.of_vertices.begin(), *s = direction_product.of_vertices.begin();
        for (unsigned int i = 0; i < n_owned; ++i)
          add(1., r[i], z[i], w[i], s[i]);
        for (unsigned int k = 0; k < n_rows; ++k)
          add(weight_of_rows,
              remainder.of_rows[k],
              preconditioned.of_rows[k],
              product.of_rows[k],
              direction_product.of_rows[k]);
        std::array<double, 8> sums{ { rr, rz, zw, rw, ww, rs, ws, ss } };
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                            grid.communicator(),
                            ArrayView<double>(sums.data(), sums.size()));
        std::tie(rr, rz, zw, rw, ww, rs, ws, ss) = std::tuple_cat(sums);

        const double turn      = result.n == 0 ? 0. : rz / last_projection;
        const double curvature = zw - (result.n == 0 ? 0. : turn * rz / last_length);
        const double length    = rz / curvature;
        direction.sadd(turn, 1., preconditioned);
        direction_product.sadd(turn, 1., product);
        solution.sadd(1., length, direction);
        remainder.sadd(1., -length, direction_product);
        last_projection = rz;
        last_length     = length;
        ++result.n;

        const double square =
            rr - 2. * length * (rw + turn * rs) + length * length * (ww + 2. * turn * ws + turn * turn * ss);
        constexpr double rounded_away = 1e-8;
        result.residual               = square > rounded_away * rr
                                            ? std::sqrt(square)
                                            : std::sqrt(Utilities::MPI::sum(local_square(remainder), grid.communicator()));
      }
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
    const bool holds_some = std::find(is_held.begin(), is_held.end(), char(true)) != is_held.end();
    const bool any_held   = Utilities::MPI::logical_or(holds_some, grid.communicator());
    if (any_held)
      system.hold(is_held);
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
    if (any_held)
      system.release();
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
        else if (pressing > 0. || row.flow * row.normal > 0.)
          row.held = HeldMotion::across;
        else
          row.held = HeldMotion::none;
        if (row.is_unilateral && (pressing <= 0. || row.friction == 0.))
          row.traction = std::max(pressing, 0.) * row.normal;
        source.of_rows[k]   = row.flow;
        solution.of_rows[k] = row.traction;
      }
  }


  template <int dim>
  double PressureSolver<dim>::choose_vertices(const Task &task, const bool releases)
  {
    double change = 0.;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (system.is_unknown(i))
        {
          double &value      = solution.of_vertices.local_element(i);
          const double left  = residual.of_vertices.local_element(i);
          const double least = task.least_pressure - task.pressure.local_element(numbering.vertex(i));
          const bool holds   = is_held[i] ? !releases || left <= accepted : value < least;
          if (holds != bool(is_held[i]))
            change += holds ? std::pow(diagonal_of_number[i] * (least - value), 2) : left * left;
          is_held[i] = holds;
          if (holds)
            value = least;
        }
    return change;
  }


  template <int dim>
  double PressureSolver<dim>::choose_rows(const bool releases)
  {
    double change = 0.;
    for (unsigned int k = 0; k < source.of_rows.size(); ++k)
      {
        GroundRow<dim> &row = (*rows)[k];
        if (!row.is_unilateral)
          continue;
        Tensor<1, dim> &traction = solution.of_rows[k];
        const double pressing = traction * row.normal, inflow = residual.of_rows[k] * row.normal;
        if (row.held == HeldMotion::none && inflow > 0.)
          {
            row.held = HeldMotion::across;
            change += inflow * inflow;
          }
        else if (releases && row.held != HeldMotion::none && pressing <= 0.)
          {
            change += (row.diagonal * traction).norm_square();
            row.held       = HeldMotion::none;
            row.compliance = 0.;
            traction       = Tensor<1, dim>();
          }
      }
    return weight_of_rows * change;
  }


  template <int dim>
  double PressureSolver<dim>::choose_friction()
  {
    // A row responds by more than its diagonal. By the sum of its row, those of small facets swing between stick and
    // slip.
    constexpr double part_of_response = 0.3;
    double change                     = 0.;
    for (unsigned int k = 0; k < source.of_rows.size(); ++k)
      {
        GroundRow<dim> &row = (*rows)[k];
        if (!row.is_unilateral || row.friction == 0. || row.held == HeldMotion::none ||
            solution.of_rows[k] * row.normal <= 0.)
          continue;
        const Tensor<1, dim> &traction = solution.of_rows[k];
        const Tensor<1, dim> along     = row.along(traction),
                             slip      = row.along(residual.of_rows[k]) + row.compliance * along;
        const double step              = part_of_response * row.diagonal;
        const double available         = row.friction * (traction * row.normal);
        const double needed            = (along + slip / step).norm();
        const double before            = row.compliance;
        row.compliance                 = needed > available ? step * (needed / available - 1.) : 0.;
        change += row.held == HeldMotion::all ? std::pow(row.compliance - before, 2) * along.norm_square()
                                              : slip.norm_square();
        row.held = HeldMotion::all;
      }
    return weight_of_rows * change;
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
    constexpr unsigned int most_sweeps   = 5;   // What changes after them is held without another solve.
    constexpr unsigned int most_releases = 3;   // Then rows are only added, so that the search ends.
    constexpr double coarser             = 10.; // friction that changes by less has been found
    constexpr double alone               = 0.1; // of the tolerance: rows beside a held pressure decide on creep
    ground                               = of_ground;
    rows                                 = ground ? &ground->all : nullptr;
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
    Result result;
    const bool rubs = rows && Utilities::MPI::logical_or(
                                  std::any_of(rows->begin(),
                                              rows->end(),
                                              [](const auto &row) { return row.is_unilateral && row.friction > 0.; }),
                                  grid.communicator());
    constexpr unsigned int most_passes = 2; // between pressure and friction
    if (rubs)
      {
        find_residual();
        choose_friction();
      }
    // What is held is searched for with coarser solves.
    const double coarsest = rows ? 3. * tolerance : tolerance;
    accepted              = coarsest;
    for (unsigned int pass = 1;; ++pass)
      {
        for (unsigned int sweep = 0;; ++sweep)
          {
            converge(pass == 1 && sweep == 0 ? result.first : result.further);
            const bool is_last = sweep == most_sweeps;
            double found       = 0.;
            if (rows || sweep > 0)
              find_residual();
            if (task.has_pressure)
              found += choose_vertices(task, pass == 1 && !is_last);
            if (rows && !is_last)
              found += choose_rows(pass == 1 && sweep < most_releases);
            found = std::sqrt(Utilities::MPI::sum(found, grid.communicator()));
            if (is_last || (found <= tolerance && accepted == tolerance))
              break;
            accepted = sweep + 1 == most_sweeps ? tolerance : std::clamp(found / coarser, tolerance, coarsest);
          }
        if (!rubs || pass == most_passes ||
            Utilities::MPI::sum(choose_friction(), grid.communicator()) <= std::pow(coarser * tolerance, 2))
          break;
      }
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
