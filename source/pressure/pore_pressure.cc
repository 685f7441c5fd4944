// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pore_pressure.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Speed at which water and the grains of a cell pass each other, m/s: mean over the grains.
    template <int dim>
    double mean_slip(const BackgroundGrid<dim> &grid,
                     const Mixture<dim> &mixture,
                     const unsigned int record,
                     const NodalField<dim> &soil,
                     const NodalField<dim> &water)
    {
      const MixtureCell<dim> &cell = mixture.cells()[record];
      const unsigned int *nodes    = grid.nodes(cell.cell);
      const unsigned int n         = grid.n_nodes_1d();
      double sum                   = 0;
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        {
          const double *of_soil  = soil[nodes[i]] + NodalField<dim>::velocity;
          const double *of_water = water[nodes[i]] + NodalField<dim>::velocity;
          double square          = 0;
          for (unsigned int c = 0; c < dim; ++c)
            square += (of_water[c] - of_soil[c]) * (of_water[c] - of_soil[c]);
          sum += mixture.grain_volumes(record, i / n)[i % n] * std::sqrt(square);
        }
      return sum / cell.grain_volume;
    }


    /// Square of the largest differences between the nodes of a cell, axis by axis, of the mixture's velocity at the
    /// start of the step, m^2/s^2.
    template <int dim>
    double largest_difference(const BackgroundGrid<dim> &grid,
                              const unsigned int cell,
                              const NodalField<dim> &soil,
                              const NodalField<dim> &water,
                              const PoreField<dim> &pores)
    {
      const unsigned int *nodes = grid.nodes(cell);
      double square             = 0;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto at_start = [&](const double *values) {
            return values[NodalField<dim>::velocity + c] - values[NodalField<dim>::velocity_change + c];
          };
          double least = std::numeric_limits<double>::max(), most = -least;
          for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
            {
              const unsigned int node = nodes[i];
              if (soil[node][NodalField<dim>::mass] + water[node][NodalField<dim>::mass] <= 0.)
                continue;
              const double grains   = pores[node][PoreField<dim>::grain_fraction];
              const double velocity = grains * at_start(soil[node]) + (1. - grains) * at_start(water[node]);
              least                 = std::min(least, velocity);
              most                  = std::max(most, velocity);
            }
          if (most > least)
            square += (most - least) * (most - least);
        }
      return square;
    }
  } // namespace


  template <int dim>
  PorePressure<dim>::PorePressure(const BackgroundGrid<dim> &grid,
                                  const WaterBoundaryConditions<dim> &walls,
                                  const PressureParameters &parameters,
                                  const WaterParameters &water,
                                  const Tensor<1, dim> &gravity,
                                  const CutCells<dim> *cut_cells,
                                  const GroundGaps<dim> &ground_gaps,
                                  TimerOutput &timer)
      : grid(grid)
      , relative_tolerance(parameters.relative_tolerance)
      , projection(parameters.projection)
      , bulk_modulus(water.bulk_modulus)
      , cavitation_pressure(parameters.cavitation_pressure)
      , variational(parameters.is_variational())
      , timer(timer)
      , vertices(numbered(grid))
      , surface(grid, vertices, walls, gravity, cut_cells, water.air_entry_pressure, variational)
      , part(grid, vertices, surface, cut_cells, ground_gaps)
      , pair(grid, vertices, part)
      , schur(grid, vertices, surface, part, pair)
      , gaps(grid, vertices, surface)
      , divergence(grid, vertices, surface, gravity.norm(), cut_cells, ground_gaps)
      , solver(grid, vertices, parameters)
      , memory(vertices, variational ? 0. : parameters.fading, water, grid.cell_size())
  {
    if (variational)
      solver.set_matrix(schur);
    reinit_vectors();
  }


  template <int dim>
  NodeNumbering<dim> PorePressure<dim>::numbered(const BackgroundGrid<dim> &grid)
  {
    NodeNumbering<dim> vertices(Basis::linear);
    vertices.distribute(grid.fine_cells());
    return vertices;
  }


  template <int dim>
  void PorePressure<dim>::reinit()
  {
    vertices.distribute(grid.fine_cells());
    surface.reinit();
    gaps.reinit();
    pair.reinit();
    schur.reinit();
    solver.reinit();
    memory.reinit();
    reinit_vectors();
  }


  template <int dim>
  void PorePressure<dim>::reinit_vectors()
  {
    for (VertexVector *vector : { &pressure, &change, &source })
      reinit(*vector);
    if (has_menisci())
      for (VertexVector *vector : { &pull, &pull_change })
        reinit(*vector);
  }


  template <int dim>
  void PorePressure<dim>::locate(const Mixture<dim> &mixture)
  {
    surface.locate(mixture, pressure);
    memory.fade(surface, pressure);
    pressure.update_ghost_values();
    extrapolate(mixture, true, pressure);
  }


  template <int dim>
  void PorePressure<dim>::extrapolate(const Mixture<dim> &mixture, const bool is_start, VertexVector &values)
  {
    if (has_menisci())
      surface.extrapolate_with_menisci(mixture, is_start, values, is_start ? pull : pull_change);
    else if (variational)
      surface.extend(values);
    else
      surface.extrapolate(mixture, values);
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
  void PorePressure<dim>::compute_pressure_coefficients(Mixture<dim> &mixture,
                                                        const NodalField<dim> &soil,
                                                        const NodalField<dim> &water,
                                                        const double time_step) const
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      if (MixtureCell<dim> &cell = mixture.cells()[record]; cell.water_volume > 0)
        {
          const double V_s = cell.effective_saturation * cell.grain_volume, V_w = cell.water_volume;
          const double a = cell.soil_mass, b = cell.water_mass;
          double mobility = V_w * V_w / b;
          if (a > 0.)
            {
              const double porosity = 1. - grain_fraction_of(V_s, V_w, cell.effective_saturation * cell.pore_volume);
              if (cell.inertial > 0)
                cell.drag += porosity * cell.inertial * mean_slip(grid, mixture, record, soil, water);
              cell.drag *= cell.drag_share * porosity;
              const double C       = cell.drag * time_step;
              const double squares = V_s * V_s * (b + C) + 2. * V_s * V_w * C + V_w * V_w * (a + C);
              mobility = cell.is_rigid ? V_w * V_w / (b + C) : squares / (a * b + C * (a + b)); // rigid: a is endless
            }
          cell.mobility = mobility / (cell_volume * std::min(cell.fill, 1.));
        }
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
  void PorePressure<dim>::assemble(const Mixture<dim> &mixture, const double time_step, const double shear_modulus)
  {
    const double storage = bulk_modulus > 0 ? 1. / (bulk_modulus * time_step) : 0.;
    const double tau     = projection > 0 && shear_modulus > 0 ? projection / (2. * shear_modulus * time_step) : 0.;
    solver.assemble(
        mixture,
        surface,
        time_step,
        [&](const unsigned int vertex) { return storage * surface.water_volume(vertex); },
        tau);
  }


  template <int dim>
  void PorePressure<dim>::solve(Mixture<dim> &mixture,
                                const MixtureNodes<dim> &nodes,
                                const double time_step,
                                const double shear_modulus,
                                Budget<dim> &balance)
  {
    {
      const TimedPart timed(timer, TimerSection::pressure_system);
      if (variational)
        {
          find_mobilities(mixture, time_step);
          schur.assemble(mixture, pressed_nodes, time_step);
          schur.find_source(nodes, pressure, source);
          surface.clear(change);
        }
      else
        {
          divergence.integrate(mixture, nodes.soil, nodes.water, nodes.pores, time_step, source);
          compute_pressure_coefficients(mixture, nodes.soil, nodes.water, time_step);
        }
      assemble(mixture, time_step, shear_modulus);
    }
    const TimedPart timed(timer, TimerSection::pressure_solve);
    const SolveReport report = solver.solve(source, pressure, relative_tolerance, change);
    solver.update_preconditioner_age(report);
    count(report, balance);
    const auto [more, n_cavitating] = solver.enforce_least_pressure(
        [&](const unsigned int vertex) { return surface.least_pressure(vertex, cavitation_pressure); },
        pressure,
        change);
    count(more, balance);
    balance.n_cavitating += n_cavitating;
    change.update_ghost_values();
    extrapolate(mixture, false, change);
  }


  template <int dim>
  void PorePressure<dim>::accept_change(const Mixture<dim> &mixture,
                                        const NodalField<dim> &soil,
                                        const NodalField<dim> &water,
                                        const PoreField<dim> &pores)
  {
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) != PressureDofType::dry)
        pressure.local_element(vertex) += change.local_element(vertex);
    pressure.update_ghost_values();
    memory.find_forgotten(mixture, surface, pressure, [&](const unsigned int cell) {
      return largest_difference(grid, cell, soil, water, pores);
    });
  }


  template <int dim>
  void PorePressure<dim>::solve_potential(const Mixture<dim> &mixture,
                                          const VertexVector &source,
                                          VertexVector &potential,
                                          Budget<dim> &balance)
  {
    // It moves a part of a surplus only; what this misses is left to the next steps.
    const double tolerance_of_potential = std::min(1e-2, 100. * relative_tolerance);
    count(solver.solve(source, pressure, tolerance_of_potential, potential), balance);
    potential.update_ghost_values();
    if (variational)
      surface.extend(potential);
    else
      surface.extrapolate(mixture, potential);
  }


  template <int dim>
  void PorePressure<dim>::count(const SolveReport &report, Budget<dim> &balance) const
  {
    if (Utilities::MPI::this_mpi_process(grid.triangulation().get_communicator()) != 0)
      return; // All ranks took part; one tells.
    balance.n_iterations += report.n_iterations;
    balance.n_preconditioners += report.made_preconditioner;
  }

  template class PorePressure<2>;
  template class PorePressure<3>;
} // namespace scree
