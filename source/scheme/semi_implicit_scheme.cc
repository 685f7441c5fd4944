// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/semi_implicit_scheme.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  SemiImplicitScheme<dim>::SemiImplicitScheme(const BackgroundGrid<dim> &grid,
                                              const BoundaryConditions<dim> &walls,
                                              const WaterBoundaryConditions<dim> &water_walls,
                                              const Forcing<dim> &forcing,
                                              const TransferParameters &transfer_parameters,
                                              const WaterParameters &water,
                                              const PressureParameters &parameters)
      : grid(grid)
      , walls(walls)
      , water_walls(water_walls)
      , forcing(forcing)
      , friction(grid, walls)
      , splitting(parameters.splitting_kind())
      , previous_pressure(parameters.previous_pressure_kind())
      , projection(parameters.projection)
      , water_density(water.density)
      , bulk_modulus(water.bulk_modulus)
      , volume_correction(water.volume_correction)
      , fluidisation_porosity(water.fluidisation_porosity)
      , viscosity(water.viscosity)
      , corners(numbered(grid))
      , transfer(grid, transfer_parameters, water, previous_pressure == PreviousPressure::average ? 0. : 1.)
      , mixture(grid)
      , pores(grid)
      , water_nodes(grid)
      , correction(grid.numbering())
      , surface(grid, corners, water_walls, parameters.free_surface_kind())
      , divergence(grid, corners, parameters.divergence_kind())
      , solver(grid, corners, parameters)
  {
    reinit_vectors();
  }


  template <int dim>
  NodeNumbering<dim> SemiImplicitScheme<dim>::numbered(const BackgroundGrid<dim> &grid)
  {
    NodeNumbering<dim> hats(Basis::linear);
    hats.distribute(grid.triangulation(), grid.cell_size());
    return hats;
  }


  template <int dim>
  void SemiImplicitScheme<dim>::reinit()
  {
    corners.distribute(grid.triangulation(), grid.cell_size());
    mixture.reinit();
    pores.reinit();
    water_nodes.reinit();
    correction.reinit();
    surface.reinit();
    solver.reinit();
    reinit_vectors();
  }


  template <int dim>
  void SemiImplicitScheme<dim>::reinit_vectors()
  {
    for (CornerVector *vector : { &pressure, &kept_pressure, &change, &source, &crowding })
      vector->reinit(corners.partitioner());
    friction.reinit();
    has_grid_pressure = false;
  }


  template <int dim>
  void SemiImplicitScheme<dim>::gather(const std::list<SoilBody<dim>> &soil, const std::list<WaterPhase<dim>> &water)
  {
    mixture.clear();
    pores.clear();
    water_nodes.clear();
    for (const auto &body : soil)
      transfer.soil_to_grid(body, mixture, pores);
    for (const auto &part : water)
      transfer.to_grid(part, mixture, water_nodes);
    mixture.finish();
  }


  template <int dim>
  void SemiImplicitScheme<dim>::complete_pores()
  {
    correction.clear();
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        // All fields are active where any is: an absent phase takes the other's velocity.
        pores.activate_cell(cell.cell);
        water_nodes.activate_cell(cell.cell);
        correction.activate_cell(cell.cell);
        if (cell.effective_saturation == 0 || cell.grain_volume == 0)
          continue;
        const unsigned int *nodes = grid.nodes(cell.cell);
        const unsigned int n      = grid.n_nodes_1d();
        const NodeRow *moments    = mixture.grain_moments(record);
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          pores[nodes[i]][PoreField<dim>::grain_volume] +=
              cell.effective_saturation * moments[(i / n) * Mixture<dim>::n_moments][i % n];
      }
  }


  template <int dim>
  void SemiImplicitScheme<dim>::add_pressure_forces(NodalField<dim> &soil)
  {
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      if (mixture.cells()[record].water_volume > 0)
        mixture.add_pressure_gradient(record,
                                      multilinear_of<dim>(corner_pressure(mixture.cells()[record].cell)),
                                      -1.,
                                      soil,
                                      NodalField<dim>::force,
                                      water_nodes,
                                      NodalField<dim>::force);
  }


  template <int dim>
  DragPair<dim> SemiImplicitScheme<dim>::pair_at(const unsigned int node, const NodalField<dim> &soil) const
  {
    DragPair<dim> pair;
    pair.soil_mass  = soil[node][NodalField<dim>::mass];
    pair.water_mass = water_nodes[node][NodalField<dim>::mass];
    pair.drag       = pores[node][PoreField<dim>::drag];
    pair.fixed_soil = pair.fixed_water = 0;
    if (forcing.is_held(node))
      pair.fixed_soil = pair.fixed_water = (1 << dim) - 1;
    else if (const auto faces = grid.node_faces(node); faces != 0)
      {
        pair.fixed_soil  = walls.fixed_components(faces) | friction.stopped_components(node);
        pair.fixed_water = water_walls.fixed_components(faces);
      }
    return pair;
  }


  template <int dim>
  StepBalance<dim> SemiImplicitScheme<dim>::predict(NodalField<dim> &soil, const double time_step)
  {
    StepBalance<dim> balance;
    const double decay = forcing.decay(time_step);
    friction.clear();
    for (const unsigned int node : pores.active_nodes())
      {
        double *pore    = pores[node];
        double *of_soil = soil[node], *of_water = water_nodes[node];
        const double soil_mass  = of_soil[NodalField<dim>::mass];
        const double water_mass = of_water[NodalField<dim>::mass];
        if (soil_mass <= 0. && water_mass <= 0.)
          continue; // Another rank sees this node, but no point acts on it.

        const double water_volume = water_mass / water_density;
        const double pore_volume  = pore[PoreField<dim>::pore_volume];
        pore[PoreField<dim>::drag] *=
            soil_mass <= 0. || water_mass <= 0. ? 0. : time_step * drag_share(water_volume, pore_volume);
        const double grains                  = pore[PoreField<dim>::grain_volume];
        pore[PoreField<dim>::grain_fraction] = grains > 0. ? grains / (grains + water_volume) : 0.;

        const Tensor<1, dim> push = forcing.acceleration(node);
        Tensor<1, dim> soil_impulse, water_impulse, soil_before, water_before;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double soil_momentum  = of_soil[NodalField<dim>::momentum + c];
            const double water_momentum = of_water[NodalField<dim>::momentum + c];
            // Stress adds up to nothing.
            balance.pressure_impulse[c] +=
                time_step * (of_soil[NodalField<dim>::force + c] + of_water[NodalField<dim>::force + c]);
            soil_before[c]  = soil_mass > 0. ? soil_momentum / soil_mass : 0.;
            water_before[c] = water_mass > 0. ? water_momentum / water_mass : 0.;
            soil_impulse[c] = soil_momentum + time_step * (of_soil[NodalField<dim>::force + c] + soil_mass * push[c]);
            water_impulse[c] =
                water_momentum + time_step * (of_water[NodalField<dim>::force + c] + water_mass * push[c]);
          }
        balance.body_impulse += (soil_mass + water_mass) * time_step * push;
        if (forcing.is_damped())
          {
            balance.wall_impulse -= (1. - decay) * (soil_impulse + water_impulse);
            soil_impulse *= decay;
            water_impulse *= decay;
          }

        DragPair<dim> pair = pair_at(node, soil);
        Tensor<1, dim> soil_after, water_after;
        pair.solve(soil_impulse, water_impulse, soil_after, water_after);
        if (soil_mass > 0. && friction.find_contact(node, soil_after))
          {
            soil_impulse += friction.resist(node, pair_at(node, soil), soil_impulse, water_impulse);
            balance.wall_impulse += friction.resistance(node);
            pair = pair_at(node, soil);
            pair.solve(soil_impulse, water_impulse, soil_after, water_after);
          }
        if (pair.fixed_soil != 0 || pair.fixed_water != 0)
          {
            const Tensor<1, dim> soil_wall  = pair.soil_reaction(soil_impulse, water_after);
            const Tensor<1, dim> water_wall = pair.water_reaction(water_impulse, soil_after);
            balance.wall_impulse += soil_wall + water_wall;
            // The work of an impulse is its product with the mean velocity: a reaction at rest does none.
            balance.wall_dissipation -=
                0.5 * (soil_wall * (soil_before + soil_after) + water_wall * (water_before + water_after));
          }
        if (soil_mass <= 0.)
          soil_after = soil_before = water_after;
        if (water_mass <= 0.)
          water_after = water_before = soil_after;
        for (unsigned int c = 0; c < dim; ++c)
          {
            of_soil[NodalField<dim>::velocity + c]         = soil_after[c];
            of_soil[NodalField<dim>::velocity_change + c]  = soil_after[c] - soil_before[c];
            of_water[NodalField<dim>::velocity + c]        = water_after[c];
            of_water[NodalField<dim>::velocity_change + c] = water_after[c] - water_before[c];
          }
      }
    return balance;
  }


  template <int dim>
  void SemiImplicitScheme<dim>::correct(NodalField<dim> &soil, const double time_step, StepBalance<dim> &balance)
  {
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        if (cell.water_volume > 0)
          mixture.add_pressure_gradient(
              record, multilinear_of<dim>(at_corners(change, cell.cell)), -time_step, correction, 0, correction, dim);
      }
    correction.add_contributions();

    for (const unsigned int node : pores.active_nodes())
      {
        double *of_soil = soil[node], *of_water = water_nodes[node];
        const DragPair<dim> pair = pair_at(node, soil);
        if (pair.soil_mass <= 0. && pair.water_mass <= 0.)
          continue;
        Tensor<1, dim> soil_impulse(make_array_view(correction[node], correction[node] + dim));
        Tensor<1, dim> water_impulse(make_array_view(correction[node] + dim, correction[node] + 2 * dim));
        balance.pressure_impulse += soil_impulse + water_impulse;
        DragPair<dim> free_of_drag = pair;
        if (splitting == Splitting::classical)
          free_of_drag.drag = 0.;
        Tensor<1, dim> soil_change, water_change;
        free_of_drag.solve(soil_impulse, water_impulse, soil_change, water_change);

        Tensor<1, dim> soil_before, water_before;
        for (unsigned int c = 0; c < dim; ++c)
          {
            soil_before[c]  = of_soil[NodalField<dim>::velocity + c] - of_soil[NodalField<dim>::velocity_change + c];
            water_before[c] = of_water[NodalField<dim>::velocity + c] - of_water[NodalField<dim>::velocity_change + c];
          }
        if (pair.fixed_soil != 0 || pair.fixed_water != 0)
          {
            const Tensor<1, dim> soil_wall  = free_of_drag.soil_reaction(soil_impulse, water_change);
            const Tensor<1, dim> water_wall = free_of_drag.water_reaction(water_impulse, soil_change);
            balance.wall_impulse += soil_wall + water_wall;
            // Before the correction the nodes were at rest there, so that only the start's velocity counts.
            balance.wall_dissipation -= 0.5 * (soil_wall * soil_before + water_wall * water_before);
            Tensor<1, dim> soil_after = soil_change;
            for (unsigned int c = 0; c < dim; ++c)
              soil_after[c] += of_soil[NodalField<dim>::velocity + c];
            const Tensor<1, dim> more = friction.adjust(node, soil_wall, pair.soil_mass, soil_after);
            Tensor<1, dim> soil_more, water_more;
            free_of_drag.solve(more, Tensor<1, dim>(), soil_more, water_more);
            soil_change += soil_more;
            water_change += water_more;
            balance.wall_impulse += more;
            balance.wall_dissipation -=
                0.5 * (friction.resistance(node) + more) * (soil_before + soil_after + soil_more);
          }
        if (pair.soil_mass <= 0.)
          soil_change = water_change;
        if (pair.water_mass <= 0.)
          water_change = soil_change;
        Tensor<1, dim> slip, slip_before, slip_predicted;
        for (unsigned int c = 0; c < dim; ++c)
          {
            slip_before[c]    = water_before[c] - soil_before[c];
            slip_predicted[c] = of_water[NodalField<dim>::velocity + c] - of_soil[NodalField<dim>::velocity + c];
            of_soil[NodalField<dim>::velocity + c] += soil_change[c];
            of_soil[NodalField<dim>::velocity_change + c] += soil_change[c];
            of_water[NodalField<dim>::velocity + c] += water_change[c];
            of_water[NodalField<dim>::velocity_change + c] += water_change[c];
            slip[c] = of_water[NodalField<dim>::velocity + c] - of_soil[NodalField<dim>::velocity + c];
          }
        // The work of an impulse, as at walls; the classical splitting's drag knows the predicted velocities only.
        balance.drag_dissipation +=
            0.5 * pair.drag * (splitting == Splitting::classical ? slip_predicted : slip) * (slip_before + slip);
      }
    for (const unsigned int corner : surface.wet_corners())
      if (surface.kind(corner) != CornerKind::dry)
        pressure.local_element(corner) += change.local_element(corner);
    pressure.update_ghost_values();
  }


  template <int dim>
  StepBalance<dim> SemiImplicitScheme<dim>::solve(NodalField<dim> &soil,
                                                  const double time_step,
                                                  const double shear_modulus,
                                                  TimerOutput &timer)
  {
    StepBalance<dim> balance;
    {
      TimerOutput::Scope part(timer, "nodes");
      for (const MixtureCell<dim> &cell : mixture.cells())
        soil.activate_cell(cell.cell);
      complete_pores();
      find_pressure();
      add_pressure_forces(soil);
      soil.add_contributions();
      water_nodes.add_contributions();
      pores.add_contributions();
      balance = predict(soil, time_step);
      soil.update_ghosts();
      water_nodes.update_ghosts();
      pores.update_ghosts();
    }
    solve_pressure(soil, time_step, shear_modulus, timer, balance);
    TimerOutput::Scope part(timer, "nodes");
    correct(soil, time_step, balance);
    soil.update_ghosts();
    water_nodes.update_ghosts();
    return balance;
  }


  template class SemiImplicitScheme<2>;
  template class SemiImplicitScheme<3>;
} // namespace scree
