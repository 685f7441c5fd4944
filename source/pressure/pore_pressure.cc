// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pore_pressure.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PorePressure<dim>::PorePressure(const BackgroundGrid<dim> &grid,
                                  FreeSurface<dim> &surface,
                                  PressureOperators<dim> &operators,
                                  const PressureParameters &parameters,
                                  const WaterParameters &water,
                                  TimerOutput &timer)
      : grid(grid)
      , relative_tolerance(parameters.relative_tolerance)
      , bulk_modulus(water.bulk_modulus)
      , cavitation_pressure(parameters.cavitation_pressure)
      , maximum_iterations(parameters.maximum_iterations)
      , timer(timer)
      , vertices(grid.vertices())
      , surface(surface)
      , operators(operators)
      , preconditioner(grid, vertices, surface)
      , program(
            grid.communicator(),
            [this](Vector &target, const Vector &source) { vmult(target, source); },
            [this](Vector &target, const Vector &source) { precondition(target, source); })
  {
    reinit_vectors();
  }


  template <int dim>
  void PorePressure<dim>::reinit()
  {
    preconditioner.reinit();
    own_state = PreconditionerState();
    reinit_vectors();
  }


  template <int dim>
  void PorePressure<dim>::reinit_vectors()
  {
    for (VertexVector *vector : { &pressure, &change, &potential, &prescribed })
      vector->reinit(vertices.partitioner());
  }


  template <int dim>
  void PorePressure<dim>::locate(const Mixture<dim> &mixture)
  {
    surface.locate(mixture, pressure);
    pressure.update_ghost_values();
    surface.extend(pressure);
    pressure.update_ghost_values();
  }


  template <int dim>
  typename PorePressure<dim>::AtVertices PorePressure<dim>::pressure_of(const unsigned int cell) const
  {
    const VertexVector *suction = surface.suction_behind();
    AtVertices result;
    for (unsigned int v = 0; v < result.size(); ++v)
      {
        const unsigned int vertex = vertices.nodes(cell)[v];
        result[v]                 = pressure.local_element(vertex) + (suction ? suction->local_element(vertex) : 0.);
      }
    return result;
  }


  template <int dim>
  void PorePressure<dim>::find_mobilities(Mixture<dim> &mixture, const double time_step) const
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (MixtureCell<dim> &cell : mixture.cells())
      if (const double volume = cell.bulk_volume; volume > 0.)
        {
          const double both = cell.soil_mass + cell.water_mass, flux = cell.mass_of_flux;
          const double alone       = cell.inertia_of_flux + time_step * cell.drag_of_flux;
          const double determinant = both * alone - flux * flux;
          const bool moves         = cell.soil_mass > 0. && !cell.is_rigid && determinant > 1e-12 * both * alone;
          const double inverse     = moves ? (alone - 2. * flux + both) / determinant : 1. / alone;
          cell.mobility            = volume * volume * inverse / (cell_volume * std::min(volume / cell_volume, 1.));
        }
  }


  template <int dim>
  void PorePressure<dim>::solve(Mixture<dim> &mixture,
                                const WetNodes<dim> &nodes,
                                const typename PressureOperators<dim>::BlockAt &block_at,
                                GroundRows<dim> *rows,
                                const bool holds_pressure,
                                const double time_step,
                                Budget<dim> &balance)
  {
    std::vector<double> source;
    {
      const TimedPart timed(timer, TimerSection::pressure_system);
      find_mobilities(mixture, time_step);
      operators.assemble(mixture, nodes, block_at, rows, time_step);
      operators.find_source(nodes, pressure, source);
      const double compressibility = bulk_modulus > 0 ? 1. / (bulk_modulus * time_step) : 0.;
      preconditioner.assemble(mixture, time_step, compressibility);
      operators.find_diagonal(diagonal);
      storage.clear();
      for (unsigned int i = 0; i < diagonal.size(); ++i)
        {
          storage.push_back(compressibility * surface.water_volume(surface.unknowns()[i]));
          diagonal[i] += storage[i];
        }
      if (rows)
        rows->set_responses(operators.inverse_masses(), time_step);
    }
    const TimedPart timed(timer, TimerSection::pressure_solve);
    constexpr double alone = 0.1; // of the tolerance: rows beside a held pressure decide on creep
    begin(source, rows);
    const SolveReport report = find_solution(change,
                                             holds_pressure ? alone * relative_tolerance : relative_tolerance,
                                             cavitation_pressure,
                                             holds_pressure,
                                             balance);
    update_preconditioner_age(report);
    if (!holds_pressure)
      balance.n_cavitating += program.n_held();
    tractions = program.solution.tractions;
    for (unsigned int k = 0; k < tractions.size(); ++k)
      rows->all[k].traction = tractions[k];
  }


  template <int dim>
  void PorePressure<dim>::solve_potential(const std::vector<double> &source, Budget<dim> &balance)
  {
    // It moves a part of a surplus only; what this misses is left to the next steps.
    const double tolerance_of_potential = std::min(1e-2, 100. * relative_tolerance);
    begin(source, nullptr);
    find_solution(potential, tolerance_of_potential, -std::numeric_limits<double>::infinity(), false, balance);
  }


  template <int dim>
  void PorePressure<dim>::begin(const std::vector<double> &source, GroundRows<dim> *of_ground)
  {
    ground = of_ground;
    program.begin(diagonal.size(), ground ? &ground->all : nullptr);
    program.source.pressures = source;
  }


  template <int dim>
  typename PorePressure<dim>::SolveReport PorePressure<dim>::find_solution(VertexVector &solution,
                                                                           const double relative,
                                                                           const double least,
                                                                           const bool holds_pressure,
                                                                           Budget<dim> &balance)
  {
    constexpr double coarser = 3.; // of the solve that friction is found from
    const bool rubs          = start_rows();
    const double tolerance   = find_tolerance(relative);
    start_pressures(solution, least, holds_pressure);
    SolveReport report = converge(rubs ? coarser * tolerance : tolerance, balance);
    if (rubs)
      {
        choose_friction();
        program.find_residual();
        report.made_preconditioner = converge(tolerance, balance).made_preconditioner || report.made_preconditioner;
      }
    surface.extend(program.solution.pressures, solution);
    return report;
  }


  template <int dim>
  void PorePressure<dim>::vmult(Vector &target, const Vector &source)
  {
    operators.vmult(target, source);
    for (unsigned int i = 0; i < target.pressures.size(); ++i)
      target.pressures[i] += storage[i] * source.pressures[i];
    constexpr double regularisation = 1e-7; // the rows of small facets nearly depend on those beside them
    for (unsigned int k = 0; k < target.tractions.size(); ++k)
      {
        const GroundRow<dim> &row = ground->all[k];
        target.tractions[k] += regularisation * row.diagonal * source.tractions[k];
        if (row.holds_along)
          target.tractions[k] += row.compliance * row.along(source.tractions[k]);
      }
  }


  template <int dim>
  void PorePressure<dim>::precondition(Vector &target, const Vector &source)
  {
    // Of the inverse diagonal of S, beside the inverse of L. S is far less than L for pressures that oscillate from
    // vertex to vertex. CG iterations per step with 0.1, 0.2, 0.3: saturated slope 5.0, 4.4, 4.3; saturated slide on a
    // mountain 97, 96, 104.
    constexpr double part_of_diagonal = 0.2;
    preconditioner.vmult(target.pressures, source.pressures);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (diagonal[i] > 0.) // else no part of a cell reaches the vertex
        target.pressures[i] += part_of_diagonal / diagonal[i] * source.pressures[i];
    if (ground)
      ground->precondition(source.tractions, target.tractions);
  }


  template <int dim>
  bool PorePressure<dim>::start_rows()
  {
    bool rubs = false;
    for (unsigned int k = 0; ground && k < ground->all.size(); ++k)
      {
        GroundRow<dim> &row   = ground->all[k];
        const double pressing = row.traction * row.normal;
        row.holds_across      = !row.is_unilateral || pressing > 0.;
        row.holds_along       = !row.is_unilateral && row.friction > 0.;
        if (row.is_unilateral && (pressing <= 0. || row.friction == 0.))
          row.traction = std::max(pressing, 0.) * row.normal;
        program.source.tractions[k]   = row.flow;
        program.solution.tractions[k] = row.traction;
        rubs                          = rubs || (row.is_unilateral && row.friction > 0.);
      }
    return ground && Utilities::MPI::logical_or(rubs, grid.communicator());
  }


  template <int dim>
  double PorePressure<dim>::find_tolerance(const double relative)
  {
    Vector whole, flow_of_pressure;
    whole.clear(diagonal.size(), program.source.tractions.size());
    surface.take(pressure, whole.pressures);
    vmult(flow_of_pressure, whole);
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
    const ArrayView<double> all(squares.data(), squares.size());
    Utilities::MPI::sum(ArrayView<const double>(all), grid.communicator(), all);
    const double of_vertices = std::max(squares[0], squares[1]), of_rows = std::max(squares[2], squares[3]);
    constexpr double coarser = 10.; // than at the vertices; tractions follow p
    // Rows count by their own flow: water without pressure at the ground is a small part of all, and has to stop, too.
    program.weight_of_rows = of_vertices > 0. && of_rows > 0. ? of_vertices / (coarser * coarser * of_rows) : 1.;
    return relative * std::sqrt(of_vertices > 0. ? of_vertices : of_rows);
  }


  template <int dim>
  void PorePressure<dim>::start_pressures(const VertexVector &first, const double least, const bool holds_pressure)
  {
    std::vector<double> least_change;
    for (const unsigned int vertex : surface.unknowns())
      if (!holds_pressure)
        least_change.push_back(least - pressure.local_element(vertex));
    const auto start = [&] {
      program.set_bounds(least_change, diagonal);
      program.find_residual();
    };
    std::vector<double> &guess = program.solution.pressures;
    if (ground) // Friction must not depend on whether there is a guess.
      {
        start();
        choose_friction();
      }
    if (!holds_pressure)
      surface.take(first, guess);
    start();
    // The bound on the energy holds from a first guess that makes none.
    if (!holds_pressure && Utilities::MPI::sum(program.energy(), grid.communicator()) > 0.)
      {
        guess.assign(diagonal.size(), 0.);
        start();
      }
  }


  template <int dim>
  void PorePressure<dim>::choose_friction()
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
        row.holds_across = row.holds_along = program.presses(k);
        if (!row.holds_across)
          {
            traction       = Tensor<1, dim>();
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
      }
  }


  template <int dim>
  typename PorePressure<dim>::SolveReport PorePressure<dim>::converge(const double accepted, Budget<dim> &balance)
  {
    SolveReport report;
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
        preconditioner.make(own_state);
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
    if (Utilities::MPI::this_mpi_process(grid.communicator()) == 0) // All ranks took part; one counts.
      {
        balance.n_iterations += report.n_iterations;
        balance.n_preconditioners += report.made_preconditioner;
      }
    return report;
  }


  template <int dim>
  void PorePressure<dim>::update_preconditioner_age(const SolveReport &report)
  {
    if (report.made_preconditioner || own_state.is_worn) // worn still: nothing flowed, so that none was made
      return;
    own_state.surplus_iterations += std::max(int(report.n_iterations) - int(own_state.iterations_when_new), 0);
    own_state.is_worn = own_state.surplus_iterations > iterations_worth_a_preconditioner;
  }


  template <int dim>
  const FlowField<dim> &PorePressure<dim>::prescribed_impulses(const double time_step)
  {
    surface.clear(prescribed);
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) == PressureDofType::prescribed)
        prescribed.local_element(vertex) = pressure.local_element(vertex);
    prescribed.update_ghost_values();
    return operators.impulses(prescribed, time_step, surface.suction_behind());
  }


  template <int dim>
  void PorePressure<dim>::accept_change()
  {
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) != PressureDofType::dry)
        pressure.local_element(vertex) += change.local_element(vertex);
    pressure.update_ghost_values();
  }


  template <int dim>
  void PorePressure<dim>::save(SolverState<dim> &state) const
  {
    const auto numbers_of = [this](const VertexVector &values) {
      NumbersByPlace own;
      for (unsigned int vertex = 0; vertex < vertices.n_owned(); ++vertex)
        if (values.local_element(vertex) != 0.)
          own.emplace_back(place_of_vertex(grid, vertices, vertex), values.local_element(vertex));
      return join(grid.communicator(), own);
    };
    state.change                      = numbers_of(change);
    state.potential                   = numbers_of(potential);
    state.preconditioner              = own_state;
    state.preconditioner.conductances = join(grid.communicator(), own_state.conductances);
    state.preconditioner.diagonal     = join(grid.communicator(), own_state.diagonal);
  }


  template <int dim>
  void PorePressure<dim>::load(const SolverState<dim> &state)
  {
    const auto own = vertices_by_place(grid, vertices);
    const auto set = [&](const NumbersByPlace &numbers, VertexVector &values) {
      for (const auto &[place, number] : numbers)
        if (const auto vertex = own.find(place); vertex != own.end())
          values.local_element(vertex->second) = number;
    };
    set(state.change, change);
    set(state.potential, potential);
    if (state.preconditioner.is_worn)
      return; // The next solve makes another one.
    own_state = state.preconditioner;
    preconditioner.load(own_state);
  }

  template class PorePressure<2>;
  template class PorePressure<3>;
} // namespace scree
