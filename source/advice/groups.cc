// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/groups.h>

namespace scree
{
  namespace
  {
    /// At which the conductivity is defined, m/s^2, whatever the scene's.
    constexpr double earth_gravity = 9.81;
  } // namespace


  Groups groups_of(const SceneNumbers &scene)
  {
    Groups groups;
    const double H = scene.height, g = scene.gravity, M = scene.constrained_modulus();
    groups.cells_over_height = H / scene.cell_size;
    groups.wave_speed        = scene.mean.speed();
    groups.motion_time       = g > 0 ? std::sqrt(H / g) : groups.wave_speed > 0 ? H / groups.wave_speed : 0.;
    if (!scene.has_soil)
      return groups;
    const double weight       = scene.density() * g * H; // Pa
    groups.own_strain         = weight / M;
    groups.shear_stress_ratio = scene.mean.shear_modulus > 0 ? weight / scene.mean.shear_modulus : 0.;
    groups.mach_number        = std::sqrt(g * H) / groups.wave_speed;
    if (!scene.has_water)
      return groups;
    const double unit_weight         = scene.water_density * earth_gravity; // N/m^3
    groups.consolidation_coefficient = scene.conductivity * M / unit_weight;
    groups.drainage_time             = H * H / groups.consolidation_coefficient;
    groups.drainage                  = groups.motion_time > 0 ? groups.drainage_time / groups.motion_time : 0.;
    groups.time_factor               = scene.end_time / groups.drainage_time;
    const double n = scene.porosity, drag = n * n * unit_weight / scene.conductivity; // N s/m^4
    groups.drag_time = 1. / (drag * (1. / ((1. - n) * scene.grain_density) + 1. / (n * scene.water_density)));
    return groups;
  }


  double conductivity_for(const SceneNumbers &scene, const double drainage)
  {
    const Groups groups = groups_of(scene);
    return scene.conductivity * groups.drainage / drainage;
  }
} // namespace scree
