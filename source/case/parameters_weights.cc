// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/box_of_raster.h>
#include <scree/case/parameters.h>
#include <scree/seeding/unit_weights.h>

namespace scree
{
  void Parameters::take_unit_weights()
  {
    for (const BodyParameters &body : bodies)
      {
        const SeedingParameters &seeding = body.seeding;
        if (!seeding.has_unit_weights())
          continue;
        UnitWeights given{ seeding.dry_unit_weight,
                           seeding.saturated_unit_weight,
                           seeding.grain_density,
                           file.sets(body.name, "Grain density"),
                           {} };
        if (const double porosity = body.initial_porosity(); porosity > 0 || seeding.initial_porosity >= 0)
          given.porosity = porosity;
        const GrainsAndPores result = grains_and_pores(body.name, given, size_of_gravity(), water.density);
        require_entry(has_water || seeding.dry_unit_weight > 0,
                      body.name,
                      "Saturated unit weight",
                      seeding.saturated_unit_weight,
                      "the scene is dry, and the soil would weigh less than this. Write \"Dry unit weight\" (in total "
                      "stress the same value), or add subsection Water.");
        handler.enter_subsection(body.name);
        handler.set("Grain density", exact_text({ result.grain_density }));
        handler.set("Initial porosity", exact_text({ result.porosity }));
        handler.leave_subsection();
      }
  }
} // namespace scree
