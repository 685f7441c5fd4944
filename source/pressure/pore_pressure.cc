// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pore_pressure.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PorePressure<dim>::PorePressure(const BackgroundGrid<dim> &grid,
                                  const BoundaryConditions<dim> &walls,
                                  const PressureParameters &parameters,
                                  const WaterParameters &water,
                                  const CutCells<dim> *cut_cells,
                                  const GroundGaps<dim> &ground_gaps,
                                  TimerOutput &timer)
      : grid(grid)
      , relative_tolerance(parameters.relative_tolerance)
      , bulk_modulus(water.bulk_modulus)
      , cavitation_pressure(parameters.cavitation_pressure)
      , timer(timer)
      , vertices(grid.vertices())
      , surface(grid, vertices, walls, cut_cells, water.air_entry_pressure)
      , part(grid, vertices, surface, cut_cells, ground_gaps)
      , pair(grid, vertices, part)
      , schur(grid, vertices, surface, part, pair)
      , solver(grid, vertices, surface, schur, parameters)
  {
    reinit_vectors();
  }


  template <int dim>
  void PorePressure<dim>::reinit()
  {
    surface.reinit();
    pair.reinit();
    schur.reinit();
    solver.reinit();
    reinit_vectors();
  }


  template <int dim>
  void PorePressure<dim>::reinit_vectors()
  {
    for (VertexVector *vector : { &pressure, &change, &source, &potential })
      reinit(*vector);
  }


  template <int dim>
  void PorePressure<dim>::locate(const Mixture<dim> &mixture)
  {
    surface.locate(mixture, pressure);
    pressure.update_ghost_values();
    surface.extend(pressure);
  }


  template <int dim>
  typename PorePressure<dim>::AtVertices PorePressure<dim>::at_vertices(const VertexVector &values,
                                                                        const unsigned int cell) const
  {
    AtVertices result;
    for (unsigned int v = 0; v < result.size(); ++v)
      result[v] = values.local_element(vertices.nodes(cell)[v]);
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
                                const MixtureNodes<dim> &nodes,
                                GroundRows<dim> *rows,
                                const bool holds_pressure,
                                const double time_step,
                                Budget<dim> &balance)
  {
    {
      const TimedPart timed(timer, TimerSection::pressure_system);
      find_mobilities(mixture, time_step);
      schur.assemble(mixture, pressed_nodes, rows, time_step);
      schur.find_source(nodes, pressure, source);
      const double storage = bulk_modulus > 0 ? 1. / (bulk_modulus * time_step) : 0.;
      solver.assemble(
          mixture, time_step, [&](const unsigned int vertex) { return storage * surface.water_volume(vertex); }, rows);
    }
    const TimedPart timed(timer, TimerSection::pressure_solve);
    const auto result =
        solver.solve({ source, pressure, relative_tolerance, cavitation_pressure, !holds_pressure }, change, rows);
    solver.update_preconditioner_age(result.first);
    count(result.first, balance);
    count(result.further, balance);
    balance.n_cavitating += result.n_cavitating;
    change.update_ghost_values();
    surface.extend(change);
    tractions.clear();
    if (rows)
      for (const GroundRow<dim> &row : rows->all)
        tractions.push_back(row.traction);
  }


  template <int dim>
  const FlowField<dim> &PorePressure<dim>::prescribed_impulses(const double time_step)
  {
    surface.clear(source); // the last solve() has used it
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) == PressureDofType::prescribed)
        source.local_element(vertex) = pressure.local_element(vertex);
    source.update_ghost_values();
    return schur.impulses(source, time_step, surface.suction_behind());
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
  void PorePressure<dim>::solve_potential(const VertexVector &source, Budget<dim> &balance)
  {
    // It moves a part of a surplus only; what this misses is left to the next steps.
    const double tolerance_of_potential = std::min(1e-2, 100. * relative_tolerance);
    count(solver.solve({ source, pressure, tolerance_of_potential }, potential).first, balance);
    potential.update_ghost_values();
    surface.extend(potential);
  }


  template <int dim>
  void PorePressure<dim>::count(const SolveReport &report, Budget<dim> &balance) const
  {
    if (Utilities::MPI::this_mpi_process(grid.communicator()) != 0)
      return; // All ranks took part; one tells.
    balance.n_iterations += report.n_iterations;
    balance.n_preconditioners += report.made_preconditioner;
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
    state.change         = numbers_of(change);
    state.potential      = numbers_of(potential);
    state.preconditioner = solver.state();
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
    solver.load(state.preconditioner);
  }

  template class PorePressure<2>;
  template class PorePressure<3>;
} // namespace scree
