// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_groups_h
#define scree_advice_groups_h

#include <scree/advice/scene_numbers.h>

namespace scree
{
  /// The scales of a scene and the dimensionless groups they make; doc/running.md, "Cost estimate",
  /// has the formulas and their sources. A number that a scene does not have is 0.
  struct Groups
  {
    double motion_time        = 0; ///< sqrt(H/g), s; without gravity H over the wave speed
    double wave_speed         = 0; ///< sqrt(M/rho) of the mean soil, m/s
    double own_strain         = 0; ///< rho g H/M, -: strain of the lowest soil under its own weight
    double shear_stress_ratio = 0; ///< rho g H/G, -
    double mach_number        = 0; ///< sqrt(g H) over the wave speed, -: 1 where motion is as fast as pressure waves

    double consolidation_coefficient = 0; ///< c_v = k M/(rho_w g), m^2/s
    double drainage_time             = 0; ///< H^2/c_v, s
    double drainage                  = 0; ///< drainage time over motion time, -
    double time_factor               = 0; ///< T_v = end time over drainage time, -
    double drag_time                 = 0; ///< in which drag takes the slip between soil and water, s

    double cells_over_height = 0; ///< H/h, -
  };

  /// Computes the groups of a scene of soil and water.
  Groups groups_of(const SceneNumbers &scene);

  /// Conductivity, m/s, at which drainage time over motion time is `drainage`.
  double conductivity_for(const SceneNumbers &scene, const double drainage);
} // namespace scree

#endif
