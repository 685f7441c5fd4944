// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/two_phase_momentum.h>
#include <scree/tensor/vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Field = NodalField<dim>;

    template <int dim>
    void add_to(double *components, const Tensor<1, dim> &vector)
    {
      for (unsigned int c = 0; c < dim; ++c)
        components[c] += vector[c];
    }

    /// Adds a change of velocity to velocity and velocity change of a node.
    template <int dim>
    void add_to_velocities(const SoilAndWater<dim> &change, double *of_soil, double *of_water)
    {
      for (const unsigned int first : { Field<dim>::velocity, Field<dim>::velocity_change })
        {
          add_to(of_soil + first, change.soil);
          add_to(of_water + first, change.water);
        }
    }

    /// Another rank may see a node on which no point acts.
    template <int dim>
    bool is_empty(const MixtureNodes<dim> &nodes, const unsigned int node)
    {
      return nodes.soil[node][Field<dim>::mass] <= 0. && nodes.water[node][Field<dim>::mass] <= 0.;
    }

    template <int dim>
    Tensor<1, dim> velocity_of_sums(const double *values)
    {
      const double mass = values[Field<dim>::mass];
      return mass > 0. ? vector_of<dim>(values + Field<dim>::momentum) / mass : Tensor<1, dim>();
    }

    template <int dim>
    Tensor<1, dim> velocity_at_start(const double *values)
    {
      return vector_of<dim>(values + Field<dim>::velocity) - vector_of<dim>(values + Field<dim>::velocity_change);
    }

    template <int dim>
    double work_of(const SoilAndWater<dim> &impulses, const SoilAndWater<dim> &velocities)
    {
      return impulses.soil * velocities.soil + impulses.water * velocities.water;
    }

    /// Kinetic energy, J, of what walls stop, from the velocities before beside theirs. Forces do work with the
    /// velocity of the step's end, and so none on what is stopped.
    template <int dim>
    double stopped_energy(const DragBlock<dim> &pair, const SoilAndWater<dim> &before)
    {
      return 0.5 * (pair.soil_mass * pair.held_soil.held_part(before.soil).norm_square() +
                    pair.water_mass * pair.held_water.held_part(before.water).norm_square());
    }

    template <int dim>
    void write_motion(double *values, const Tensor<1, dim> &before, const Tensor<1, dim> &after)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          values[Field<dim>::velocity + c]        = after[c];
          values[Field<dim>::velocity_change + c] = after[c] - before[c];
        }
    }
  } // namespace


  template <int dim>
  TwoPhaseMomentum<dim>::TwoPhaseMomentum(const BackgroundGrid<dim> &grid,
                                          const Constraints<dim> &constraints,
                                          const WallGaps<dim> &wall_gaps,
                                          const BodyForces<dim> &forcing,
                                          const double water_density,
                                          TimerOutput &timer)
      : constraints(constraints)
      , wall_gaps(wall_gaps)
      , forcing(forcing)
      , grid(grid)
      , water_density(forcing.mass_scaling() * water_density)
      , timer(timer)
      , friction(constraints)
  {
    friction.reinit(grid.n_owned_nodes());
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::reinit()
  {
    friction.reinit(grid.n_owned_nodes());
  }


  template <int dim>
  DragBlock<dim> TwoPhaseMomentum<dim>::drag_block_at(const MixtureNodes<dim> &nodes, const unsigned int node) const
  {
    DragBlock<dim> pair;
    pair.soil_mass  = nodes.soil[node][Field<dim>::mass];
    pair.water_mass = nodes.water[node][Field<dim>::mass];
    pair.drag       = nodes.pores[node][PoreField<dim>::drag];
    if (const NodeConstraints<dim> *walls = constraints.at(node))
      {
        pair.held_soil  = friction.held(node);
        pair.held_water = walls->water_constraint;
      }
    return pair;
  }


  template <int dim>
  DragBlock<dim> TwoPhaseMomentum<dim>::pressed_block_at(const MixtureNodes<dim> &nodes, const unsigned int node) const
  {
    DragBlock<dim> pair = drag_block_at(nodes, node);
    pair.soil_mass *= nodes.pores[node][PoreField<dim>::pressed_soil];
    pair.water_mass *= nodes.pores[node][PoreField<dim>::pressed_water];
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
  void TwoPhaseMomentum<dim>::assign_rigid_mass(const MixtureNodes<dim> &nodes, const unsigned int node) const
  {
    if (is_rigid(node) && nodes.soil[node][Field<dim>::mass] <= 0.)
      nodes.soil[node][Field<dim>::mass] = nodes.water[node][Field<dim>::mass];
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::find_flux_inertia(const MixtureNodes<dim> &nodes,
                                                const NodalField<dim> &excess,
                                                const double time_step)
  {
    for (const unsigned int node : nodes.pores.active_nodes())
      {
        if (is_empty(nodes, node))
          continue;
        assign_rigid_mass(nodes, node);
        double *pore = nodes.pores[node], *soil = nodes.soil[node], *water = nodes.water[node];
        const double mass    = water[Field<dim>::mass];
        const bool has_both  = mass > 0. && soil[Field<dim>::mass] > 0.;
        const double inverse = has_both ? 1. + water_density * pore[PoreField<dim>::local_solid_volume] / mass : 1.;
        const double inertia = mass + water_density * pore[PoreField<dim>::flux_inertia];
        const double square  = inverse * inverse;
        pore[PoreField<dim>::grain_fraction] = mass > 0. ? 1. - 1. / inverse : 1.;
        pore[PoreField<dim>::coupling]       = has_both ? std::max(inertia / square - mass, 0.) : 0.;
        pore[PoreField<dim>::drag] =
            pore[PoreField<dim>::coupling] + (has_both ? time_step * pore[PoreField<dim>::drag] / square : 0.);
        pore[PoreField<dim>::inertial_drag] *= has_both ? time_step / (square * inverse) : 0.;
        if (has_both)
          for (unsigned int c = 0; c < dim; ++c)
            {
              double &momentum = water[Field<dim>::momentum + c];
              const double own = (momentum + excess[node][Field<dim>::momentum + c]) / inverse;
              soil[Field<dim>::momentum + c] += momentum - own;
              momentum = own;
            }
      }
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::find_pressed_nodes(const MixtureNodes<dim> &nodes, PorePressure<dim> &pressure) const
  {
    PressedNodes<dim> &pressed = pressure.pressed_nodes;
    pressed.all.clear();
    pressed.held.clear();
    pressed.without_grains.clear();
    const auto look_for_grains = [&](const unsigned int node) {
      if (nodes.soil[node][Field<dim>::mass] > 0. && nodes.water[node][Field<dim>::mass] > 0. &&
          nodes.pores[node][PoreField<dim>::grain_fraction] <= 0.)
        pressed.without_grains.push_back(node);
    };
    for (unsigned int node = grid.n_owned_nodes(); node < grid.numbering().n_local(); ++node)
      look_for_grains(node);
    for (const unsigned int node : nodes.pores.active_nodes())
      {
        if (is_empty(nodes, node))
          continue;
        look_for_grains(node);
        const DragBlock<dim> pair = pressed_block_at(nodes, node);
        pressed.all.push_back({ node,
                                1. - nodes.pores[node][PoreField<dim>::grain_fraction],
                                drag_mobility(pair.soil_mass, pair.water_mass, pair.drag),
                                PressedNode<dim>::free });
        if (!pair.is_held())
          continue;
        pressed.all.back().held = pressed.held.size();
        pressed.held.push_back(pair);
      }
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::add_pressure_forces(const MixtureNodes<dim> &nodes,
                                                  PorePressure<dim> &pressure,
                                                  const double time_step) const
  {
    const FlowField<dim> &impulses = pressure.impulses(time_step);
    for (const unsigned int node : nodes.pores.active_nodes())
      {
        if (is_empty(nodes, node))
          continue;
        const PressedNode<dim> pressed{ node, 1. - nodes.pores[node][PoreField<dim>::grain_fraction], {}, 0 };
        const SoilAndWater<dim> of_phases = PressedNodes<dim>::forces(pressed, impulses[node]);
        const double least                = closures::least_inertia * water_density * pressure.filled_volume(node);
        const auto add                    = [&](double *values, double &share, const Tensor<1, dim> &impulse) {
          const double mass = values[Field<dim>::mass];
          share             = mass > 0. ? std::max(least / mass, 1.) : 1.;
          if (mass > 0.)
            add_to(values + Field<dim>::force, 1. / (share * time_step) * impulse);
        };
        add(nodes.soil[node], nodes.pores[node][PoreField<dim>::pressed_soil], of_phases.soil);
        add(nodes.water[node], nodes.pores[node][PoreField<dim>::pressed_water], of_phases.water);
      }
  }


  template <int dim>
  SoilAndWater<dim> TwoPhaseMomentum<dim>::impulses_at(const MixtureNodes<dim> &nodes,
                                                       const unsigned int node,
                                                       const double time_step,
                                                       Budget<dim> &balance) const
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
        impulses.soil *= decay;
        impulses.water *= decay;
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
  SoilAndWater<dim> TwoPhaseMomentum<dim>::solve_node(const MixtureNodes<dim> &nodes,
                                                      const unsigned int node,
                                                      SoilAndWater<dim> &impulses,
                                                      const SoilAndWater<dim> &before,
                                                      Budget<dim> &balance)
  {
    const double inertial = nodes.pores[node][PoreField<dim>::inertial_drag];
    double &drag          = nodes.pores[node][PoreField<dim>::drag];
    const double slow     = drag;
    drag += inertial * (before.water - before.soil).norm(); // Contacts are found with the drag of the start.
    DragBlock<dim> pair                   = drag_block_at(nodes, node);
    const SoilAndWater<dim> wall_velocity = velocity_of_walls(node);
    // Velocities beside those of the walls: these hold what is left.
    const Tensor<1, dim> drag_of_walls = pair.drag * (wall_velocity.water - wall_velocity.soil);
    impulses.soil -= pair.soil_mass * wall_velocity.soil - drag_of_walls;
    impulses.water -= pair.water_mass * wall_velocity.water + drag_of_walls;
    SoilAndWater<dim> after = pair.solve(impulses);
    if (pair.soil_mass > 0. && friction.find_contact(node, after.soil))
      {
        impulses.soil += friction.resist(node, drag_block_at(nodes, node), impulses);
        count_walls(node, { friction.resistance(node), Tensor<1, dim>() }, balance);
        pair  = drag_block_at(nodes, node);
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
        balance.wall_dissipation -= work_of(walls, wall_velocity);
      }
    after.soil += wall_velocity.soil;
    after.water += wall_velocity.water;
    pair.follow(after);
    return after;
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::predict(const MixtureNodes<dim> &nodes,
                                      const double time_step,
                                      const double kept,
                                      Budget<dim> &balance)
  {
    const TimedPart part(timer, TimerSection::nodes);
    friction.clear();
    for (const unsigned int node : nodes.pores.active_nodes())
      {
        if (is_empty(nodes, node))
          continue;
        SoilAndWater<dim> before{ velocity_of_sums<dim>(nodes.soil[node]), velocity_of_sums<dim>(nodes.water[node]) };
        if (const double coupling = nodes.pores[node][PoreField<dim>::coupling]; coupling > 0.)
          {
            DragBlock<dim> inertia;
            inertia.soil_mass  = nodes.soil[node][Field<dim>::mass];
            inertia.water_mass = nodes.water[node][Field<dim>::mass];
            inertia.drag       = coupling;
            const SoilAndWater<dim> momentum{ inertia.soil_mass * before.soil, inertia.water_mass * before.water };
            const bool soil_rests = is_rigid(node);
            if (soil_rests)
              inertia.held_soil.hold_all();
            before = inertia.solve(momentum);
            if (soil_rests) // The water's points keep what its nodes do not take of their momentum.
              balance.wall_impulse += kept * (momentum.soil + momentum.water - inertia.water_mass * before.water);
          }
        SoilAndWater<dim> impulses    = impulses_at(nodes, node, time_step, balance);
        const SoilAndWater<dim> after = solve_node(nodes, node, impulses, before, balance);
        // A phase that is absent has no motion of its own to change.
        if (nodes.soil[node][Field<dim>::mass] <= 0.)
          before.soil = after.soil;
        if (nodes.water[node][Field<dim>::mass] <= 0.)
          before.water = after.water;
        write_motion(nodes.soil[node], before.soil, after.soil);
        write_motion(nodes.water[node], before.water, after.water);
      }
    nodes.update_velocity_ghosts();
    nodes.pores.update_ghosts();
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::correct_at_walls(const unsigned int node,
                                               const DragBlock<dim> &pair,
                                               const SoilAndWater<dim> &impulses,
                                               const SoilAndWater<dim> &before,
                                               const Tensor<1, dim> &soil_predicted,
                                               SoilAndWater<dim> &change,
                                               Budget<dim> &balance) const
  {
    const SoilAndWater<dim> walls = pair.reactions(impulses, change);
    count_walls(node, walls, balance);
    const SoilAndWater<dim> wall_velocity = velocity_of_walls(node);
    balance.wall_dissipation +=
        stopped_energy(pair, { before.soil - wall_velocity.soil, before.water - wall_velocity.water }) -
        work_of(walls, wall_velocity);
    const Tensor<1, dim> soil_after = soil_predicted + change.soil;
    // Beside the speed at which the soil closes a gap: friction acts along the wall.
    const Tensor<1, dim> more = friction.adjust(node, walls.soil, pair.soil_mass, soil_after - wall_velocity.soil);
    const SoilAndWater<dim> further = pair.solve({ more, Tensor<1, dim>() });
    change.soil += further.soil;
    change.water += further.water;
    count_walls(node, { more, Tensor<1, dim>() }, balance);
    balance.wall_dissipation -= 0.5 * (friction.resistance(node) + more) * (before.soil + soil_after + further.soil);
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::correct(const MixtureNodes<dim> &nodes,
                                      PorePressure<dim> &pressure,
                                      const double time_step,
                                      Budget<dim> &balance)
  {
    const TimedPart part(timer, TimerSection::nodes);
    const FlowField<dim> &of_flow = pressure.impulses_of_change(time_step);
    for (const PressedNode<dim> &pressed : pressure.pressed_nodes.all)
      {
        const unsigned int node = pressed.node;
        double *of_soil = nodes.soil[node], *of_water = nodes.water[node];
        const SoilAndWater<dim> impulses = PressedNodes<dim>::forces(pressed, of_flow[node]);
        const DragBlock<dim> pair        = pressed_block_at(nodes, node);
        SoilAndWater<dim> change         = pair.solve(impulses);
        const SoilAndWater<dim> before{ velocity_at_start<dim>(of_soil), velocity_at_start<dim>(of_water) };
        const Tensor<1, dim> soil_predicted = vector_of<dim>(of_soil + Field<dim>::velocity);
        const Tensor<1, dim> slip_predicted = vector_of<dim>(of_water + Field<dim>::velocity) - soil_predicted;
        if (pair.is_held())
          correct_at_walls(node, pair, impulses, before, soil_predicted, change, balance);
        balance.pressure_impulse += impulses.soil + impulses.water -
                                    (pair.soil_mass - of_soil[Field<dim>::mass]) * change.soil -
                                    (pair.water_mass - of_water[Field<dim>::mass]) * change.water;
        pair.follow(change);
        add_to_velocities(change, of_soil, of_water);
        const Tensor<1, dim> slip = slip_predicted + change.water - change.soil;
        // The work of an impulse, as at walls.
        const double drag = pair.drag - nodes.pores[node][PoreField<dim>::coupling];
        balance.drag_dissipation += 0.5 * drag * slip * (before.water - before.soil + slip);
      }
    nodes.update_velocity_ghosts();
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::count_pressure_work(const MixtureNodes<dim> &nodes,
                                                  PorePressure<dim> &pressure,
                                                  const double time_step,
                                                  Budget<dim> &balance) const
  {
    if (!pressure.prescribes_values())
      return;
    const FlowField<dim> &of_flow = pressure.prescribed_impulses(time_step);
    for (const PressedNode<dim> &pressed : pressure.pressed_nodes.all)
      {
        const unsigned int node    = pressed.node;
        SoilAndWater<dim> impulses = PressedNodes<dim>::forces(pressed, of_flow[node]);
        impulses.soil /= nodes.pores[node][PoreField<dim>::pressed_soil];
        impulses.water /= nodes.pores[node][PoreField<dim>::pressed_water];
        const double *of_soil = nodes.soil[node], *of_water = nodes.water[node];
        const SoilAndWater<dim> sums{ velocity_at_start<dim>(of_soil) + vector_of<dim>(of_soil + Field<dim>::velocity),
                                      velocity_at_start<dim>(of_water) +
                                          vector_of<dim>(of_water + Field<dim>::velocity) };
        balance.pressure_work += 0.5 * work_of(impulses, sums);
      }
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::push(const MixtureNodes<dim> &nodes,
                                   const unsigned int node,
                                   const SoilAndWater<dim> &impulses,
                                   Budget<dim> &balance) const
  {
    const DragBlock<dim> pair      = drag_block_at(nodes, node);
    const SoilAndWater<dim> change = pair.solve(impulses);
    if (pair.is_held())
      {
        const SoilAndWater<dim> walls = pair.reactions(impulses, change);
        count_walls(node, walls, balance);
        balance.wall_dissipation -= work_of(walls, velocity_of_walls(node));
      }
    add(nodes, node, change);
  }


  template <int dim>
  void TwoPhaseMomentum<dim>::add(const MixtureNodes<dim> &nodes, const unsigned int node, SoilAndWater<dim> change)
  {
    double *of_soil = nodes.soil[node], *of_water = nodes.water[node];
    follow(of_soil[Field<dim>::mass], of_water[Field<dim>::mass], change);
    add_to_velocities(change, of_soil, of_water);
  }

  template class TwoPhaseMomentum<2>;
  template class TwoPhaseMomentum<3>;
} // namespace scree
