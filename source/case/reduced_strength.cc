// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/box_of_raster.h>
#include <scree/case/parameters.h>
#include <scree/materials/laws/mohr_coulomb.h>

namespace scree
{
  void Parameters::reduce_strength(const double factor)
  {
    set("Safety", "Strength factor", exact_text({ factor })); // for the record, and for the bed's raster of angles
    bool has_strength = false;
    for (BodyParameters &body : bodies)
      {
        if (body.initial_state.stress_kind() == InitialStress::k0)
          body.initial_state.k0 = exact_text({ body.k0() }); // of the soil as it is
        has_strength = body.material.divide_strength(factor) || has_strength;
        body.material.check(body.name); // The law must be possible with that strength, too.
      }
    require_entry(has_strength,
                  "Safety",
                  "Strength factor",
                  factor,
                  "no body has a law with strength that could be reduced. Write another \"Material\".");

    const auto reduce = [factor](double &angle) { angle = divided_angle(angle, factor); };
    reduce(bed.friction_angle);
    for (ObstacleParameters &obstacle : obstacles)
      reduce(obstacle.surface.friction_angle);
    for (ContactParameters &contact : contacts)
      reduce(contact.friction_angle);
    for (std::string *wall : { &boundaries.left,
                               &boundaries.right,
                               &boundaries.front,
                               &boundaries.back,
                               &boundaries.bottom,
                               &boundaries.top })
      if (const std::string friction = "friction "; wall->rfind(friction, 0) == 0)
        *wall = friction + exact_text({ divided_angle(number_of(wall->substr(friction.size())), factor) });
  }
} // namespace scree
