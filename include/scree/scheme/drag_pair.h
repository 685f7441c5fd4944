// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_drag_pair_h
#define scree_scheme_drag_pair_h

#include <deal.II/base/tensor.h>

namespace scree
{
  /// Soil and water at a node, tied by drag: [[m_s + C, -C], [-C, m_w + C]] v = r, component by component. Components
  /// that a wall fixes are 0; a phase that is absent takes no part.
  template <int dim>
  struct DragPair
  {
    double soil_mass, water_mass;         ///< kg
    double drag;                          ///< C = D dt, kg; 0 where a phase is absent
    unsigned int fixed_soil, fixed_water; ///< bit c for component c

    /// Velocities, m/s, from impulses, N s. Free of differences, so that any drag is good.
    void solve(const dealii::Tensor<1, dim> &soil_impulse,
               const dealii::Tensor<1, dim> &water_impulse,
               dealii::Tensor<1, dim> &soil_velocity,
               dealii::Tensor<1, dim> &water_velocity) const
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          const bool soil_moves  = soil_mass > 0 && ((fixed_soil >> c) & 1) == 0;
          const bool water_moves = water_mass > 0 && ((fixed_water >> c) & 1) == 0;
          double &v_s = soil_velocity[c], &v_w = water_velocity[c];
          v_s = v_w = 0.;
          if (soil_moves && water_moves)
            {
              const double determinant = soil_mass * water_mass + drag * (soil_mass + water_mass);
              const double shared      = drag * (soil_impulse[c] + water_impulse[c]);
              v_s                      = (water_mass * soil_impulse[c] + shared) / determinant;
              v_w                      = (soil_mass * water_impulse[c] + shared) / determinant;
            }
          else if (soil_moves)
            v_s = soil_impulse[c] / (soil_mass + drag);
          else if (water_moves)
            v_w = water_impulse[c] / (water_mass + drag);
        }
    }

    /// The impulses of the walls, N s: what the fixed components need to stay 0.
    dealii::Tensor<1, dim> soil_reaction(const dealii::Tensor<1, dim> &soil_impulse,
                                         const dealii::Tensor<1, dim> &water_velocity) const
    {
      return reaction(fixed_soil, soil_mass, soil_impulse, water_velocity);
    }
    dealii::Tensor<1, dim> water_reaction(const dealii::Tensor<1, dim> &water_impulse,
                                          const dealii::Tensor<1, dim> &soil_velocity) const
    {
      return reaction(fixed_water, water_mass, water_impulse, soil_velocity);
    }

  private:
    dealii::Tensor<1, dim> reaction(const unsigned int fixed,
                                    const double mass,
                                    const dealii::Tensor<1, dim> &impulse,
                                    const dealii::Tensor<1, dim> &other_velocity) const
    {
      dealii::Tensor<1, dim> wall;
      for (unsigned int c = 0; c < dim; ++c)
        if (mass > 0 && ((fixed >> c) & 1))
          wall[c] = -impulse[c] - drag * other_velocity[c];
      return wall;
    }
  };
} // namespace scree

#endif
