// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_preconditioner.h>
#include <scree/pressure/pressure_solver.h>

#include <algorithm>
#include <cmath>

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
                                      const FreeSurface<dim> &surface,
                                      SchurOperator<dim> &schur,
                                      const PressureParameters &parameters)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
      , system(grid, vertices)
      , maximum_iterations(parameters.maximum_iterations)
      , schur(schur)
      , program(
            grid.communicator(),
            [this](Vector &target, const Vector &source) { vmult(target, source); },
            [this](Vector &target, const Vector &source) { precondition(target, source); })
  {
    reinit();
  }


  template <int dim>
  void PressureSolver<dim>::reinit()
  {
    system.reinit();
    preconditioner.reset();
    of_schur.reinit(vertices.partitioner());
    times_schur.reinit(vertices.partitioner());
    own_state = PreconditionerState();
  }


  template <int dim>
  void PressureSolver<dim>::assemble(const Mixture<dim> &mixture,
                                     const double time_step,
                                     const std::function<double(unsigned int vertex)> &storage,
                                     GroundRows<dim> *of_ground)
  {
    system.assemble(mixture, surface, time_step, storage);
    storage_of_unknown.clear();
    diagonal.clear();
    schur.find_diagonal(times_schur);
    for (const unsigned int vertex : system.unknowns())
      {
        storage_of_unknown.push_back(storage(vertex));
        diagonal.push_back(times_schur.local_element(vertex) + storage(vertex));
      }
    if (of_ground)
      of_ground->set_mobilities(schur.mobilities());
  }


  template <int dim>
  void PressureSolver<dim>::vmult(Vector &target, const Vector &source)
  {
    const std::vector<unsigned int> &unknowns = system.unknowns();
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      of_schur.local_element(unknowns[i]) = source.pressures[i];
    schur.vmult(times_schur, target.tractions, of_schur, source.tractions);
    target.pressures.resize(unknowns.size());
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      target.pressures[i] = times_schur.local_element(unknowns[i]) + storage_of_unknown[i] * source.pressures[i];
    constexpr double regularisation = 1e-7; // the rows of small facets nearly depend on those beside them
    for (unsigned int k = 0; k < target.tractions.size(); ++k)
      {
        const GroundRow<dim> &row = ground->all[k];
        target.tractions[k] += regularisation * row.diagonal * source.tractions[k];
        if (row.holds_along())
          target.tractions[k] += row.compliance * row.along(source.tractions[k]);
      }
  }


  template <int dim>
  void PressureSolver<dim>::take(const VertexVector &from, std::vector<double> &to) const
  {
    to.clear();
    for (const unsigned int vertex : system.unknowns())
      to.push_back(from.local_element(vertex));
  }


  template <int dim>
  void PressureSolver<dim>::precondition(Vector &target, const Vector &source)
  {
    preconditioner->vmult(target.pressures, source.pressures);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (diagonal[i] > 0.) // else no part of a cell reaches the vertex
        target.pressures[i] += part_of_diagonal / diagonal[i] * source.pressures[i];
    if (ground)
      ground->precondition(source.tractions, target.tractions);
  }


  template <int dim>
  void PressureSolver<dim>::converge(const double accepted, SolveReport &report)
  {
    typename BoundedProgram<dim>::Iterations last{};
    const auto has_converged = [&](const unsigned int most) {
      last = program.iterate(most, accepted);
      report.n_iterations += last.n;
      return last.residual <= accepted;
    };
    // A front that enters new cells can make the kept preconditioner useless within a step.
    const unsigned int patience =
        std::min(maximum_iterations, own_state.iterations_when_new + iterations_worth_a_preconditioner);
    if (accepted > 0. && // else nothing flows
        (own_state.is_worn || !has_converged(patience)))
      {
        preconditioner.reset(); // before the next one takes memory
        preconditioner = std::make_unique<PressurePreconditioner<dim>>(system);
        system.save(own_state);
        report.made_preconditioner = true;
        const bool is_done         = has_converged(maximum_iterations);
        AssertThrow(
            is_done,
            ExcMessage("The pressure solver did not converge: after " + std::to_string(last.n) +
                       " iterations the residual is " + std::to_string(last.residual / accepted) +
                       " times the accepted one. Remedies: a smaller 'Courant number' in subsection Time step, "
                       "more 'Maximum iterations' or a larger 'Relative tolerance' in subsection Water/Pressure."));
        own_state.is_worn             = false;
        own_state.iterations_when_new = last.n;
        own_state.surplus_iterations  = 0;
      }
  }


  template <int dim>
  bool PressureSolver<dim>::start_rows()
  {
    bool rubs = false;
    for (unsigned int k = 0; ground && k < ground->all.size(); ++k)
      {
        GroundRow<dim> &row   = ground->all[k];
        const double pressing = row.traction * row.normal;
        if (!row.is_unilateral)
          row.held = row.friction > 0. ? HeldMotion::all : HeldMotion::across;
        else
          row.held = pressing > 0. ? HeldMotion::across : HeldMotion::none;
        if (row.is_unilateral && (pressing <= 0. || row.friction == 0.))
          row.traction = std::max(pressing, 0.) * row.normal;
        program.source.tractions[k]   = row.flow;
        program.solution.tractions[k] = row.traction;
        rubs                          = rubs || (row.is_unilateral && row.friction > 0.);
      }
    return ground && Utilities::MPI::logical_or(rubs, grid.communicator());
  }


  template <int dim>
  void PressureSolver<dim>::choose_friction()
  {
    // A row responds by more than its diagonal. By the sum of its row, those of small facets swing between stick and
    // slip.
    constexpr double part_of_response    = 0.3;
    constexpr double most_over_available = 1e6; // Less friction than that is none.
    for (unsigned int k = 0; k < ground->all.size(); ++k)
      {
        GroundRow<dim> &row      = ground->all[k];
        Tensor<1, dim> &traction = program.solution.tractions[k];
        if (!row.is_unilateral || row.friction == 0.)
          continue;
        if (!program.presses(k))
          {
            traction       = Tensor<1, dim>();
            row.held       = HeldMotion::none;
            row.compliance = 0.;
            continue;
          }
        const Tensor<1, dim> along = row.along(traction),
                             slip  = row.along(program.residual().tractions[k]) + row.compliance * along;
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
  double PressureSolver<dim>::find_tolerance(const double relative)
  {
    std::array<double, 4> squares{}; // at vertices and rows, of the flow of the pressure and of the source
    for (const bool of_source : { false, true })
      {
        const Vector &flow = of_source ? program.source : flow_of_pressure;
        for (const double value : flow.pressures)
          squares[of_source] += value * value;
        for (unsigned int k = 0; k < flow.tractions.size(); ++k)
          {
            const GroundRow<dim> &row = ground->all[k];
            squares[2 + of_source] +=
                row.friction > 0. ? flow.tractions[k].norm_square() : std::pow(flow.tractions[k] * row.normal, 2);
          }
      }
    Utilities::MPI::sum(ArrayView<const double>(squares.data(), squares.size()),
                        grid.communicator(),
                        ArrayView<double>(squares.data(), squares.size()));
    const double of_vertices = std::max(squares[0], squares[1]), of_rows = std::max(squares[2], squares[3]);
    constexpr double coarser = 10.; // than at the vertices; tractions follow p
    // Rows count by their own flow: water without pressure at the ground is a small part of all, and has to stop, too.
    program.weight_of_rows = of_vertices > 0. && of_rows > 0. ? of_vertices / (coarser * coarser * of_rows) : 1.;
    return relative * std::sqrt(of_vertices > 0. ? of_vertices : of_rows);
  }


  template <int dim>
  void PressureSolver<dim>::start_pressures(const Task &task, const VertexVector &change)
  {
    std::vector<double> least_change;
    for (const unsigned int vertex : system.unknowns())
      if (task.has_pressure)
        least_change.push_back(task.least_pressure - task.pressure.local_element(vertex));
    const auto start = [&] {
      program.set_bounds(least_change, diagonal);
      program.find_residual();
    };
    std::vector<double> &guess = program.solution.pressures;
    guess.assign(diagonal.size(), 0.);
    if (ground) // Friction must not depend on whether there is a guess.
      {
        start();
        choose_friction();
      }
    if (task.has_pressure)
      take(change, guess);
    start();
    // The bound on the energy holds from a first guess that makes none.
    if (task.has_pressure && Utilities::MPI::sum(program.energy(), grid.communicator()) > 0.)
      {
        guess.assign(diagonal.size(), 0.);
        start();
      }
  }


  template <int dim>
  typename PressureSolver<dim>::Result
  PressureSolver<dim>::solve(const Task &task, VertexVector &change, GroundRows<dim> *of_ground)
  {
    constexpr double alone = 0.1; // of the tolerance: rows beside a held pressure decide on creep
    ground                 = of_ground;
    program.begin(diagonal.size(), ground ? &ground->all : nullptr);
    take(task.pressure, program.solution.pressures);
    vmult(flow_of_pressure, program.solution);
    take(task.flow, program.source.pressures);
    const bool rubs = start_rows();
    const double tolerance =
        find_tolerance(task.has_pressure ? task.relative_tolerance : alone * task.relative_tolerance);
    start_pressures(task, change);
    Result result;
    if (rubs) // twice, with friction by what was found before
      {
        constexpr double coarser = 3.;
        converge(coarser * tolerance, result.first);
        choose_friction();
        program.find_residual();
      }
    converge(tolerance, rubs ? result.further : result.first);
    if (task.has_pressure)
      result.n_cavitating = program.n_held();
    surface.clear(change);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      change.local_element(system.unknowns()[i]) = program.solution.pressures[i];
    for (unsigned int k = 0; ground && k < ground->all.size(); ++k)
      ground->all[k].traction = program.solution.tractions[k];
    return result;
  }


  template <int dim>
  void PressureSolver<dim>::update_preconditioner_age(const SolveReport &report)
  {
    if (report.made_preconditioner || own_state.is_worn) // worn still: nothing flowed, so that none was made
      return;
    own_state.surplus_iterations += std::max(int(report.n_iterations) - int(own_state.iterations_when_new), 0);
    own_state.is_worn = own_state.surplus_iterations > iterations_worth_a_preconditioner;
  }


  template <int dim>
  PreconditionerState PressureSolver<dim>::state() const
  {
    PreconditionerState all = own_state;
    all.mobilities          = join(grid.communicator(), own_state.mobilities);
    all.diagonal            = join(grid.communicator(), own_state.diagonal);
    return all;
  }


  template <int dim>
  void PressureSolver<dim>::load(const PreconditionerState &state)
  {
    own_state = state;
    if (state.is_worn)
      return;
    system.load(state);
    system.save(own_state); // of this rank alone
    preconditioner = std::make_unique<PressurePreconditioner<dim>>(system);
  }

  template class PressureSolver<2>;
  template class PressureSolver<3>;
} // namespace scree
