// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/seeding/unit_weights.h>

#include <cmath>

namespace scree
{
  namespace
  {
    GrainsAndPores solve(const UnitWeights &given, const double gravity, const double water_density)
    {
      const double dry = given.dry / gravity, saturated = given.saturated / gravity; // kg/m^3
      double porosity = given.porosity.value_or(0.);
      if (given.dry > 0 && given.saturated > 0)
        porosity = (saturated - dry) / water_density;
      else if (!given.porosity)
        porosity = given.dry > 0 ? 1. - dry / given.grain_density
                                 : (given.grain_density - saturated) / (given.grain_density - water_density);
      const double bulk_density = given.dry > 0 ? dry : saturated - porosity * water_density;
      return { bulk_density / (1. - porosity), porosity };
    }
  } // namespace


  GrainsAndPores
  grains_and_pores(const std::string &body, const UnitWeights &given, const double gravity, const double water_density)
  {
    const std::string entry = given.dry > 0 ? "Dry unit weight" : "Saturated unit weight";
    const double value      = given.dry > 0 ? given.dry : given.saturated;
    const auto require      = [&](const bool possible, const std::string &remedy) {
      require_entry(possible, body, entry, value, remedy);
    };
    require(gravity > 0,
            "without gravity nothing has a weight. Change entry \"Gravity\", or write a \"Grain density\".");
    const GrainsAndPores result = solve(given, gravity, water_density);
    const std::string with      = given.dry > 0 && given.saturated > 0
                                      ? "with \"Saturated unit weight\" = " + number_text(given.saturated)
                                  : given.porosity ? "with a porosity of " + number_text(*given.porosity)
                                                   : "with \"Grain density\" = " + number_text(given.grain_density);
    const std::string unit      = " Look at the units: N/m^3 (1 kN/m^3 = 1e3 N/m^3).";
    require(result.porosity >= 0 && result.porosity <= 0.999 && result.grain_density > 0 &&
                std::isfinite(result.grain_density),
            with + " it gives a porosity of " + number_text(result.porosity) + " and grains of " +
                number_text(result.grain_density) + " kg/m^3." + unit);
    constexpr double tolerance = 1e-3;
    require(!given.has_grain_density ||
                std::abs(result.grain_density - given.grain_density) <= tolerance * given.grain_density,
            with + " it gives grains of " + number_text(result.grain_density) + " kg/m^3, and \"Grain density\" = " +
                number_text(given.grain_density) + " contradicts that. Remove one of the entries.");
    require(!given.porosity || std::abs(result.porosity - *given.porosity) <= tolerance,
            with + " it gives a porosity of " + number_text(result.porosity) +
                ", and the porosity of \"Initial porosity\" or of the law, " + number_text(*given.porosity) +
                ", contradicts that. Remove one of the entries.");
    return result;
  }
} // namespace scree
