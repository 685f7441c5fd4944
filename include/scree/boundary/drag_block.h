// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_drag_block_h
#define scree_boundary_drag_block_h

#include <scree/boundary/node_constraint.h>
#include <scree/mixture/wet_nodes.h>

#include <cmath>

namespace scree
{
  /// What an impulse of 1 N s on a phase does to it, and to the other phase, 1/kg.
  struct InverseMasses
  {
    double soil = 0., ///< of the soil, by an impulse on the soil
        water   = 0., ///< of the water, by an impulse on the water
        other   = 0.; ///< of the one, by an impulse on the other
  };

  /// The same of two masses and their drag, kg, that no wall holds; the drag is 0 where a phase is absent.
  inline InverseMasses inverse_masses(const double soil_mass, const double water_mass, const double drag)
  {
    if (soil_mass > 0. && water_mass > 0.)
      {
        const double determinant = soil_mass * water_mass + drag * (soil_mass + water_mass);
        return { (water_mass + drag) / determinant, (soil_mass + drag) / determinant, drag / determinant };
      }
    return { soil_mass > 0. ? 1. / soil_mass : 0., water_mass > 0. ? 1. / water_mass : 0., 0. };
  }

  /// Soil and water at a node, tied by drag: [[m_s + C, -C], [-C, m_w + C]] v = r, where walls leave them free to move;
  /// a phase that is absent takes no part. What walls hold of the two phases is taken to be along or across each other.
  template <int dim>
  struct DragBlock
  {
    double soil_mass = 0,                 ///< kg
        water_mass   = 0;                 ///< kg
    double drag      = 0;                 ///< C_i, kg: drag times step, and coupling; 0 where a phase is absent
    ConstrainedDirections<dim> held_soil, ///< held by walls
        held_water;                       ///< held by walls

    /// Whether walls hold any direction of soil or water.
    bool is_held() const
    {
      return held_soil.any() || held_water.any();
    }

    /// Whether both phases have mass.
    bool has_both() const
    {
      return soil_mass > 0 && water_mass > 0;
    }

    /// Velocities, m/s, from impulses, N s. Free of differences, so that any drag is good.
    DEAL_II_ALWAYS_INLINE inline SoilAndWater<dim> solve(const SoilAndWater<dim> &impulses) const
    {
      return is_held() ? solve_held(impulses) : solve_free(impulses);
    }

    /// What is left of two vectors without their held directions.
    SoilAndWater<dim> free_part(const SoilAndWater<dim> &vectors) const
    {
      return { held_soil.free_part(vectors.soil), held_water.free_part(vectors.water) };
    }

    /// The impulses, N s, that give free velocities, m/s: solve() finds these from them.
    SoilAndWater<dim> impulses(const SoilAndWater<dim> &velocity) const
    {
      const dealii::Tensor<1, dim> drag_impulse = drag * (velocity.water - velocity.soil);
      return free_part({ soil_mass * velocity.soil - drag_impulse, water_mass * velocity.water + drag_impulse });
    }

    /// A phase without mass takes the other's vector.
    void follow(SoilAndWater<dim> &vectors) const
    {
      if (soil_mass <= 0.)
        vectors.soil = vectors.water;
      if (water_mass <= 0.)
        vectors.water = vectors.soil;
    }

    /// Speed at which soil and water pass each other, m/s, if the drag is C + `inertial` times this speed: exact where
    /// walls hold all or nothing of a phase, or the flow is along or across them.
    /// @param inertial kg s/m
    double slip_speed(const SoilAndWater<dim> &impulses, const double inertial) const
    {
      if (!has_both())
        return 0.;
      const dealii::Tensor<1, dim> slip =
          held_water.free_part(impulses.water) / water_mass - held_soil.free_part(impulses.soil) / soil_mass;
      const double speed = slip.norm(); // without drag
      if (speed == 0.)
        return 0.;
      // What an impulse of 1 N s between soil and water changes: w + compliance (C + inertial w) w = speed.
      const dealii::Tensor<1, dim> along = slip / speed;
      const double compliance =
          held_soil.free_part(along).norm_square() / soil_mass + held_water.free_part(along).norm_square() / water_mass;
      const double slowed = 1. + compliance * drag;
      return 2. * speed / (slowed + std::sqrt(slowed * slowed + 4. * compliance * inertial * speed));
    }

    /// The impulses of the walls, N s: what the held directions need for the velocity there to stay 0.
    SoilAndWater<dim> reactions(const SoilAndWater<dim> &impulses, const SoilAndWater<dim> &velocity) const
    {
      SoilAndWater<dim> walls;
      if (soil_mass > 0)
        walls.soil = held_soil.held_part(-impulses.soil - drag * velocity.water);
      if (water_mass > 0)
        walls.water = held_water.held_part(-impulses.water - drag * velocity.soil);
      return walls;
    }

  private:
    SoilAndWater<dim> solve_held(const SoilAndWater<dim> &impulses) const
    {
      const SoilAndWater<dim> free = free_part(impulses);
      if (!has_both())
        return solve_free(free);
      // Where both can move they share the drag's impulse; where one is held, the other drags along it.
      ConstrainedDirections<dim> held = held_soil;
      held.hold(held_water);
      const SoilAndWater<dim> with{ held.free_part(free.soil), held.free_part(free.water) };
      SoilAndWater<dim> velocity = solve_free(with);
      if (held_water.any())
        velocity.soil += (free.soil - with.soil) / (soil_mass + drag);
      if (held_soil.any())
        velocity.water += (free.water - with.water) / (water_mass + drag);
      return free_part(velocity);
    }

    DEAL_II_ALWAYS_INLINE inline SoilAndWater<dim> solve_free(const SoilAndWater<dim> &impulses) const
    {
      SoilAndWater<dim> velocity;
      if (has_both())
        {
          const double inverse                = 1. / (soil_mass * water_mass + drag * (soil_mass + water_mass));
          const dealii::Tensor<1, dim> shared = drag * (impulses.soil + impulses.water);
          velocity.soil                       = inverse * (water_mass * impulses.soil + shared);
          velocity.water                      = inverse * (soil_mass * impulses.water + shared);
        }
      else if (soil_mass > 0)
        velocity.soil = impulses.soil / soil_mass;
      else if (water_mass > 0)
        velocity.water = impulses.water / water_mass;
      return velocity;
    }
  };
} // namespace scree

#endif
