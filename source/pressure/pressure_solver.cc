// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_preconditioner.h>
#include <scree/pressure/pressure_solver.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Diagonal of S by SchurOperator::find_diagonal() over that of L, of a vertex inside water,
    /// with splines.
    template <int dim>
    constexpr double inside_water = dim == 2 ? 0.079 : 0.055;

    /// Of this rank's numbers.
    double local_square(const VertexVector &vector)
    {
      return std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.);
    }
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
                                     const std::function<double(unsigned int vertex)> &storage)
  {
    if (numbering.update(mixture))
      {
        system.reinit();
        for (VertexVector *vector :
             { &source, &solution, &scratch, &remainder, &preconditioned, &product, &direction, &direction_product })
          vector->reinit(numbering.partitioner());
        is_worn = true;
      }
    system.assemble(mixture, surface, time_step, storage);
    storage_of_number.resize(system.n_owned());
    scale_of_number.resize(system.n_owned());
    schur.find_diagonal(times_schur);
    for (unsigned int i = 0; i < storage_of_number.size(); ++i)
      if (system.is_unknown(i))
        {
          storage_of_number[i]  = storage(numbering.vertex(i));
          const double diagonal = times_schur.local_element(numbering.vertex(i)) + storage_of_number[i];
          const double inside   = inside_water<dim> * system.diagonal_of(i);
          // No part of a cell reaches a vertex with a diagonal of 0: its p follows the neighbours.
          scale_of_number[i] = diagonal > 0. ? std::sqrt(std::max(inside / diagonal, 1.)) : 1.;
        }
      else
        storage_of_number[i] = scale_of_number[i] = 0.;
  }


  template <int dim>
  void PressureSolver<dim>::vmult(VertexVector &target, const VertexVector &source)
  {
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      of_schur.local_element(numbering.vertex(i)) = system.is_unknown(i) ? source.local_element(i) : 0.;
    schur.vmult(times_schur, of_schur);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      target.local_element(i) = system.is_unknown(i) ? times_schur.local_element(numbering.vertex(i)) +
                                                           storage_of_number[i] * source.local_element(i)
                                                     : 0.;
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
    const auto n_owned = system.n_owned();
    vmult(remainder, solution);
    remainder.sadd(-1., 1., source);
    direction         = 0.;
    direction_product = 0.;
    Iterations result{ 0, remainder.l2_norm() };
    double last_projection = 1., last_length = 1.;
    while (result.residual > tolerance && result.n < most)
      {
        for (unsigned int i = 0; i < n_owned; ++i)
          scratch.local_element(i) = scale_of_number[i] * remainder.local_element(i);
        preconditioner->vmult(preconditioned, scratch);
        for (unsigned int i = 0; i < n_owned; ++i)
          preconditioned.local_element(i) *= scale_of_number[i];
        vmult(product, preconditioned);
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
                            grid.communicator(),
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
        preconditioner.reset(); // before the next one takes memory
        preconditioner             = std::make_unique<PressurePreconditioner<dim>>(system);
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
  SolveReport PressureSolver<dim>::solve(const VertexVector &rhs,
                                         const VertexVector &pressure,
                                         const double relative_tolerance,
                                         VertexVector &change)
  {
    take(pressure, solution);
    vmult(scratch, solution);
    take(rhs, source);
    take(change, solution);
    const std::vector<double> squares{ local_square(scratch), local_square(source) };
    std::vector<double> of_ranks(2);
    Utilities::MPI::sum(squares, grid.communicator(), of_ranks);
    tolerance = relative_tolerance * std::sqrt(std::max(of_ranks[0], of_ranks[1]));
    SolveReport report;
    converge(report);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      change.local_element(numbering.vertex(i)) = system.is_unknown(i) ? solution.local_element(i) : 0.;
    return report;
  }


  template <int dim>
  void PressureSolver<dim>::solve_held(const std::vector<char> &is_held, VertexVector &residual, SolveReport &report)
  {
    VertexVector held(numbering.partitioner()), &right_side = residual;
    right_side = source;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      held.local_element(i) = is_held[i] ? solution.local_element(i) : 0.;
    vmult(scratch, held);

    // The held vertices leave the system like those of a drained wall.
    system.hold(is_held);
    for (unsigned int i = 0; i < is_held.size(); ++i)
      {
        source.local_element(i)   = system.is_unknown(i) ? source.local_element(i) - scratch.local_element(i) : 0.;
        solution.local_element(i) = system.is_unknown(i) ? solution.local_element(i) : 0.;
      }
    converge(report);
    system.release();

    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (is_held[i])
        solution.local_element(i) = held.local_element(i);
    source = right_side;
    vmult(scratch, solution);
    residual = scratch;
    residual -= source;
  }


  template <int dim>
  std::pair<SolveReport, unsigned int>
  PressureSolver<dim>::enforce_least_pressure(const double least, const VertexVector &pressure, VertexVector &change)
  {
    constexpr unsigned int most_sweeps = 5; // Vertices below after them are held without another solve.
    std::pair<SolveReport, unsigned int> result;
    std::vector<char> is_held(system.n_owned(), false);
    VertexVector residual;
    const auto bound = [&](const unsigned int i) { return least - pressure.local_element(numbering.vertex(i)); };
    for (unsigned int sweep = 0;; ++sweep)
      {
        bool has_changed = false;
        for (unsigned int i = 0; i < is_held.size(); ++i)
          if (system.is_unknown(i))
            {
              const bool holds = is_held[i] ? residual.local_element(i) >= -tolerance || sweep == most_sweeps
                                            : solution.local_element(i) < bound(i);
              has_changed      = has_changed || holds != bool(is_held[i]);
              is_held[i]       = holds;
              if (holds)
                solution.local_element(i) = bound(i);
            }
        if (sweep == most_sweeps || !Utilities::MPI::logical_or(has_changed, grid.communicator()))
          break;
        if (sweep == 0)
          residual.reinit(numbering.partitioner());
        solve_held(is_held, residual, result.first);
      }
    result.second = std::count(is_held.begin(), is_held.end(), true);
    for (unsigned int i = 0; i < system.n_owned(); ++i)
      change.local_element(numbering.vertex(i)) = system.is_unknown(i) ? solution.local_element(i) : 0.;
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
