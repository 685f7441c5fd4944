// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/bodies/drag_law.h>

#include <algorithm>

namespace scree
{
  namespace
  {
    constexpr double standard_gravity = 9.81; // m/s^2
  }                                           // namespace


  DragLaw::DragLaw(const WaterParameters &water, const double initial_porosity)
      : unit_weight(water.density * standard_gravity)
      , is_constant(water.grain_diameter == 0 && water.conductivity_law_kind() == ConductivityLaw::constant)
      , per_grains(water.grain_diameter > 0 ? 1.75 * water.density / water.grain_diameter : 0.)
  {
    if (water.grain_diameter > 0)
      factor = unit_weight * water.grain_diameter * water.grain_diameter / (150. * water.viscosity);
    else
      factor = is_constant ? water.conductivity
                           : water.conductivity / kozeny_carman(std::max(initial_porosity, smallest_porosity));
  }
} // namespace scree
