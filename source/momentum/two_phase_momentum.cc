// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/two_phase_momentum.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Field = NodalField<dim>;

    /// Kinetic energy, J, of what walls stop, from the velocities before beside theirs. Forces do work with the
    /// velocity of the step's end, and so none on what is stopped.
    template <int dim>
    double stopped_energy(const DragBlock<dim> &pair, const SoilAndWater<dim> &before)
    {
      return 0.5 * (pair.soil_mass * pair.held_soil.held_part(before.soil).norm_square() +
                    pair.water_mass * pair.held_water.held_part(before.water).norm_square());
    }
  } // namespace


  template <int dim>
  TwoPhaseMomentum<dim>::TwoPhaseMomentum(WetNodes<dim> &nodes,
                                          const Constraints<dim> &constraints,
                                          const WallGaps<dim> &wall_gaps,
                                          const BodyForces<dim> &forcing,
                                          const double water_density,
                                          TimerOutput &timer)
      : nodes(nodes)
      , constraints(constraints)
      , wall_gaps(wall_gaps)
      , forcing(forcing)
      , water_density(forcing.mass_scaling() * water_density)
      , timer(timer)
      , friction(constraints)
  {
  }


  template <int dim>
  DragBlock<dim> TwoPhaseMomentum<dim>::drag_block_at(const unsigned int node) const
  {
    DragBlock<dim> pair;
    pair.soil_mass  = nodes.soil[node][Field<dim>::mass];
    pair.water_mass = nodes.water[node][Field<dim>::mass];
    pair.drag       = nodes.pores[node][Pores::drag];
    if (const NodeConstraints<dim> *walls = constraints.at(node))
      {
        pair.held_soil  = friction.held(node);
        pair.held_water = walls->water_constraint;
      }
    return pair;
  }


  template <int dim>
  DragBlock<dim> TwoPhaseMomentum<dim>::pressed_block_at(const unsigned int node) const
  {
    DragBlock<dim> pair = drag_block_at(node);
    pair.soil_mass *= nodes.pores[node][Pores::pressed_soil];
    pair.water_mass *= nodes.pores[node][Pores::pressed_water];
    return pair;
  }


  template <int dim>
  SoilAndWater<dim> TwoPhaseMomentum<dim>::velocity_of_walls(const unsigned int node) const
  {
    const NodeConstraints<dim> *walls = constraints.at(node);
    if (walls == nullptr)
      return SoilAndWater<dim>();
    const Tensor<1, dim> &closing = wall_gaps.closing_velocity(node);
    return { walls->soil_velocity + closing, walls->water_velocity + closing };
  }


  template <int dim>
  bool TwoPhaseMomentum<dim>::is_rigid(const unsigned int node) const
  {
    const NodeConstraints<dim> *walls = constraints.at(node);
    return walls != nullptr && walls->is_rigid;
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::find_flux_inertia(const double time_step)
  {
    nodes.for_occupied([&](const unsigned int node) {
      double *pore = nodes.pores[node], *soil = nodes.soil[node], *water = nodes.water[node];
      const double mass = water[Field<dim>::mass];
      if (is_rigid(node) && soil[Field<dim>::mass] <= 0.)
        soil[Field<dim>::mass] = mass; // A is defined; the velocity is prescribed.
      const bool has_both         = mass > 0. && soil[Field<dim>::mass] > 0.;
      const double inverse        = has_both ? 1. + water_density * pore[Pores::local_solid_volume] / mass : 1.;
      const double inertia        = mass + water_density * pore[Pores::flux_inertia];
      const double square         = inverse * inverse;
      pore[Pores::grain_fraction] = mass > 0. ? 1. - 1. / inverse : 1.;
      pore[Pores::coupling]       = has_both ? std::max(inertia / square - mass, 0.) : 0.;
      pore[Pores::drag]           = pore[Pores::coupling] + (has_both ? time_step * pore[Pores::drag] / square : 0.);
      pore[Pores::inertial_drag] *= has_both ? time_step / (square * inverse) : 0.;
      for (unsigned int c = 0; has_both && c < dim; ++c)
        {
          double &momentum = water[Field<dim>::momentum + c];
          const double own = (momentum + pore[Pores::excess_momentum + c]) / inverse;
          soil[Field<dim>::momentum + c] += momentum - own;
          momentum = own;
        }
    });
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::add_pressure_forces(const FlowField<dim> &impulses,
                                                  const PressureOperators<dim> &operators,
                                                  const double time_step)
  {
    nodes.for_occupied([&](const unsigned int node) {
      SoilAndWater<dim> forces = forces_of_flow<dim>(impulses[node], nodes.porosity(node), false);
      const double least       = closures::least_inertia * water_density * operators.filled_volume(node);
      const auto share         = [&](Tensor<1, dim> &force, const double mass) {
        const double pressed = mass > 0. ? std::max(least / mass, 1.) : 1.;
        force *= mass > 0. ? 1. / (pressed * time_step) : 0.;
        return pressed;
      };
      nodes.pores[node][Pores::pressed_soil]  = share(forces.soil, nodes.soil[node][Field<dim>::mass]);
      nodes.pores[node][Pores::pressed_water] = share(forces.water, nodes.water[node][Field<dim>::mass]);
      nodes.add(node, Field<dim>::force, forces);
    });
  }


  template <int dim>
  SoilAndWater<dim>
  TwoPhaseMomentum<dim>::velocities_at_start(const unsigned int node, const double kept, Budget<dim> &balance) const
  {
    const auto velocity_of = [](const double *values) {
      const double mass = values[Field<dim>::mass];
      return mass > 0. ? vector_of<dim>(values + Field<dim>::momentum) / mass : Tensor<1, dim>();
    };
    SoilAndWater<dim> result{ velocity_of(nodes.soil[node]), velocity_of(nodes.water[node]) };
    DragBlock<dim> inertia;
    inertia.soil_mass  = nodes.soil[node][Field<dim>::mass];
    inertia.water_mass = nodes.water[node][Field<dim>::mass];
    inertia.drag       = nodes.pores[node][Pores::coupling];
    if (inertia.drag <= 0.)
      return result;
    const SoilAndWater<dim> momentum{ inertia.soil_mass * result.soil, inertia.water_mass * result.water };
    if (is_rigid(node))
      inertia.held_soil.hold_all();
    result = inertia.solve(momentum);
    if (is_rigid(node)) // The water's points keep what its nodes do not take of their momentum.
      balance.wall_impulse += kept * (momentum.soil + momentum.water - inertia.water_mass * result.water);
    return result;
  }


  template <int dim>
  SoilAndWater<dim>
  TwoPhaseMomentum<dim>::impulses_at(const unsigned int node, const double time_step, Budget<dim> &balance) const
  {
    const Tensor<1, dim> push = forcing.acceleration(node);
    const auto impulse_of     = [&](const double *values) {
      const double mass          = values[Field<dim>::mass];
      const Tensor<1, dim> force = vector_of<dim>(values + Field<dim>::force);
      balance.pressure_impulse += time_step * force; // Stress adds up to nothing.
      balance.body_impulse += mass * time_step * push;
      return vector_of<dim>(values + Field<dim>::momentum) + time_step * (force + mass * push);
    };
    SoilAndWater<dim> impulses{ impulse_of(nodes.soil[node]), impulse_of(nodes.water[node]) };
    if (forcing.is_damped())
      {
        const double decay = forcing.decay(time_step);
        balance.wall_impulse -= (1. - decay) * (impulses.soil + impulses.water);
        impulses *= decay;
      }
    return impulses;
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::count_walls(const unsigned int node,
                                          const SoilAndWater<dim> &impulses,
                                          Budget<dim> &balance) const
  {
    const NodeConstraints<dim> &walls = *constraints.at(node);
    balance.wall_impulse += impulses.soil + impulses.water;
    balance.soil_walls.add(walls.soil_faces, impulses.soil);
    balance.water_walls.add(walls.water_faces, impulses.water);
  }


  template <int dim>
  SoilAndWater<dim> TwoPhaseMomentum<dim>::solve_node(const unsigned int node,
                                                      SoilAndWater<dim> impulses,
                                                      const SoilAndWater<dim> &before,
                                                      Budget<dim> &balance)
  {
    const double inertial = nodes.pores[node][Pores::inertial_drag];
    double &drag          = nodes.pores[node][Pores::drag];
    const double slow     = drag;
    drag += inertial * (before.water - before.soil).norm(); // Contacts are found with the drag of the start.
    DragBlock<dim> pair                   = drag_block_at(node);
    const SoilAndWater<dim> wall_velocity = velocity_of_walls(node);
    // Velocities beside those of the walls: these hold what is left.
    const Tensor<1, dim> drag_of_walls = pair.drag * (wall_velocity.water - wall_velocity.soil);
    impulses.soil -= pair.soil_mass * wall_velocity.soil - drag_of_walls;
    impulses.water -= pair.water_mass * wall_velocity.water + drag_of_walls;
    SoilAndWater<dim> after = pair.solve(impulses);
    if (pair.soil_mass > 0. && friction.find_contact(node, after.soil))
      {
        impulses.soil += friction.resist(node, drag_block_at(node), impulses);
        count_walls(node, { friction.resistance(node), Tensor<1, dim>() }, balance);
        pair  = drag_block_at(node);
        after = pair.solve(impulses);
      }
    if (inertial > 0.)
      {
        pair.drag = slow;
        pair.drag = drag = slow + inertial * pair.slip_speed(impulses, inertial);
        after            = pair.solve(impulses);
      }
    if (pair.is_held())
      {
        const SoilAndWater<dim> walls = pair.reactions(impulses, after);
        count_walls(node, walls, balance);
        balance.wall_dissipation -= walls * wall_velocity;
      }
    after += wall_velocity;
    pair.follow(after);
    return after;
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::predict(const double time_step, const double kept, Budget<dim> &balance)
  {
    const TimedPart part(timer, TimerSection::nodes);
    friction.clear();
    nodes.for_occupied([&](const unsigned int node) {
      SoilAndWater<dim> before         = velocities_at_start(node, kept, balance);
      const SoilAndWater<dim> impulses = impulses_at(node, time_step, balance);
      const SoilAndWater<dim> after    = solve_node(node, impulses, before, balance);
      // A phase that is absent has no motion of its own to change.
      if (!nodes.has_soil(node))
        before.soil = after.soil;
      if (!nodes.has_water(node))
        before.water = after.water;
      nodes.set_velocities(node, before, after);
    });
    nodes.update_velocity_ghosts();
    nodes.pores.update_ghosts();
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::correct_at_walls(const unsigned int node,
                                               const DragBlock<dim> &pair,
                                               const SoilAndWater<dim> &impulses,
                                               SoilAndWater<dim> &change,
                                               Budget<dim> &balance) const
  {
    const SoilAndWater<dim> walls = pair.reactions(impulses, change), before = nodes.velocities_before(node);
    count_walls(node, walls, balance);
    const SoilAndWater<dim> wall_velocity = velocity_of_walls(node);
    balance.wall_dissipation += stopped_energy(pair, before - wall_velocity) - walls * wall_velocity;
    const Tensor<1, dim> soil_after = nodes.velocities(node).soil + change.soil;
    // Beside the speed at which the soil closes a gap: friction acts along the wall.
    const Tensor<1, dim> more = friction.adjust(node, walls.soil, pair.soil_mass, soil_after - wall_velocity.soil);
    const SoilAndWater<dim> further = pair.solve({ more, Tensor<1, dim>() });
    change += further;
    count_walls(node, { more, Tensor<1, dim>() }, balance);
    balance.wall_dissipation -= 0.5 * (friction.resistance(node) + more) * (before.soil + soil_after + further.soil);
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::correct(const FlowField<dim> &of_flow, Budget<dim> &balance)
  {
    const TimedPart part(timer, TimerSection::nodes);
    nodes.for_occupied([&](const unsigned int node) {
      const SoilAndWater<dim> impulses = forces_of_flow<dim>(of_flow[node], nodes.porosity(node), nodes.has_soil(node));
      const DragBlock<dim> pair        = pressed_block_at(node);
      const SoilAndWater<dim> before = nodes.velocities_before(node), predicted = nodes.velocities(node);
      SoilAndWater<dim> change = pair.solve(impulses);
      if (pair.is_held())
        correct_at_walls(node, pair, impulses, change, balance);
      balance.pressure_impulse += impulses.soil + impulses.water -
                                  (pair.soil_mass - nodes.soil[node][Field<dim>::mass]) * change.soil -
                                  (pair.water_mass - nodes.water[node][Field<dim>::mass]) * change.water;
      pair.follow(change);
      nodes.add_to_velocities(node, change);
      const Tensor<1, dim> slip = predicted.water - predicted.soil + change.water - change.soil;
      // The work of an impulse, as at walls.
      const double drag = pair.drag - nodes.pores[node][Pores::coupling];
      balance.drag_dissipation += 0.5 * drag * slip * (before.water - before.soil + slip);
    });
    nodes.update_velocity_ghosts();
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::count_pressure_work(const FlowField<dim> &of_flow, Budget<dim> &balance) const
  {
    nodes.for_occupied([&](const unsigned int node) {
      SoilAndWater<dim> impulses = forces_of_flow<dim>(of_flow[node], nodes.porosity(node), false);
      impulses.soil /= nodes.pores[node][Pores::pressed_soil];
      impulses.water /= nodes.pores[node][Pores::pressed_water];
      balance.pressure_work += 0.5 * (impulses * (nodes.velocities_before(node) + nodes.velocities(node)));
    });
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::push(const unsigned int node, const SoilAndWater<dim> &impulses, Budget<dim> &balance)
  {
    const DragBlock<dim> pair = drag_block_at(node);
    SoilAndWater<dim> change  = pair.solve(impulses);
    if (pair.is_held())
      {
        const SoilAndWater<dim> walls = pair.reactions(impulses, change);
        count_walls(node, walls, balance);
        balance.wall_dissipation -= walls * velocity_of_walls(node);
      }
    pair.follow(change);
    nodes.add_to_velocities(node, change);
  }

  template class TwoPhaseMomentum<2>;
  template class TwoPhaseMomentum<3>;
} // namespace scree
