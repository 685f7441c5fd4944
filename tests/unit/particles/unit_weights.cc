// SPDX-License-Identifier: LGPL-2.1-or-later

// Grains and pores of unit weights: each pair of entries gives back the soil that it is of, and contradictions are
// told.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/seeding/seeding.h>

namespace test_unit_weights
{
constexpr double g = 9.81, rho_w = 1000, rho_s = 2650, n = 0.4;
constexpr double dry = (1 - n) * rho_s * g, saturated = dry + n * rho_w * g;

void compare(const std::string &name, const UnitWeights &given)
{
  const GrainsAndPores found = grains_and_pores("Soil", given, g, rho_w);
  require(std::abs(found.grain_density / rho_s - 1) < 1e-12 && std::abs(found.porosity - n) < 1e-12,
          name + ": another soil");
}

void refuse(const std::string &name, const UnitWeights &given, const std::string &word)
{
  try
    {
      grains_and_pores("Soil", given, g, rho_w);
    }
  catch (const EntryError &error)
    {
      require(std::string(error.what()).find(word) != std::string::npos, error.what());
      return;
    }
  require(false, name + ": not refused");
}

void run()
{
  compare("both unit weights", { dry, saturated, 2500, false, {} });
  compare("both, and what follows", { dry, saturated, rho_s, true, n });
  compare("dry, porosity", { dry, 0, 2500, false, n });
  compare("dry, grain density", { dry, 0, rho_s, true, {} });
  compare("saturated, porosity", { 0, saturated, 2500, false, n });
  compare("saturated, grain density", { 0, saturated, rho_s, true, {} });
  refuse("another porosity", { dry, saturated, 2500, false, 0.3 }, "contradicts");
  refuse("another grain density", { dry, saturated, 2600, true, {} }, "contradicts");
  refuse("exchanged", { saturated, dry, 2500, false, {} }, "porosity of -");
  refuse("kN/m^3", { 0, saturated / 1e3, 2500, false, {} }, "1e3 N/m^3");
}

const UnitTest registered("unit_weights", run);
} // namespace test_unit_weights


// Output:
// both unit weights: OK
// both, and what follows: OK
// dry, porosity: OK
// dry, grain density: OK
// saturated, porosity: OK
// saturated, grain density: OK
// another porosity: refused, OK
// another grain density: refused, OK
// exchanged: refused, OK
// kN/m^3: refused, OK
