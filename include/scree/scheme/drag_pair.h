// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_drag_pair_h
#define scree_scheme_drag_pair_h

#include <scree/grid/node_constraint.h>

#include <cmath>

namespace scree
{
  /// A vector of the soil and one of the water at a node.
  template <int dim>
  struct SoilAndWater
  {
    dealii::Tensor<1, dim> soil, water;
  };

  /// What an impulse of 1 N s on a phase does to it, and to the other phase, 1/kg.
  struct DragMobility
  {
    double soil = 0., water = 0., other = 0.;
  };

  /// The same of two masses and their drag, kg, that no wall holds; the drag is 0 where a phase is absent.
  inline DragMobility drag_mobility(const double soil_mass, const double water_mass, const double drag)
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
  struct DragPair
  {
    double soil_mass = 0, water_mass = 0; ///< kg
    double drag = 0;                      ///< C = D dt, kg; 0 where a phase is absent
    HeldDirections<dim> held_soil, held_water;

    bool is_held() const
    {
      return held_soil.any() || held_water.any();
    }

    /// Velocities, m/s, from impulses, N s. Free of differences, so that any drag is good.
    SoilAndWater<dim> solve(const SoilAndWater<dim> &impulses) const
    {
      SoilAndWater<dim> velocity;
      const dealii::Tensor<1, dim> soil  = held_soil.free_part(impulses.soil),
                                   water = held_water.free_part(impulses.water);
      if (soil_mass > 0 && water_mass > 0)
        {
          // Where both can move they share the drag's impulse; where one is held, the other drags along it.
          HeldDirections<dim> held = held_soil;
          held.hold(held_water);
          const dealii::Tensor<1, dim> soil_with = held.free_part(soil), water_with = held.free_part(water);
          const double determinant            = soil_mass * water_mass + drag * (soil_mass + water_mass);
          const dealii::Tensor<1, dim> shared = drag * (soil_with + water_with);
          velocity.soil                       = (water_mass * soil_with + shared) / determinant;
          velocity.water                      = (soil_mass * water_with + shared) / determinant;
          if (held_water.any())
            velocity.soil += (soil - soil_with) / (soil_mass + drag);
          if (held_soil.any())
            velocity.water += (water - water_with) / (water_mass + drag);
          velocity.soil  = held_soil.free_part(velocity.soil);
          velocity.water = held_water.free_part(velocity.water);
        }
      else if (soil_mass > 0)
        velocity.soil = soil / (soil_mass + drag);
      else if (water_mass > 0)
        velocity.water = water / (water_mass + drag);
      return velocity;
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
      if (soil_mass <= 0 || water_mass <= 0)
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
  };
} // namespace scree

#endif
