// SPDX-License-Identifier: LGPL-2.1-or-later

// Random and extreme returns: always a number, never tension, never outside the yield surface, never unresolved.

#include <scree/materials/laws/nor_sand.h>

#include <deal.II/base/exceptions.h>

#include <iostream>

#include "../random_numbers.h"
#include "one_point.h"

#include "../unit_test.h"

namespace test_nor_sand_random
{
using namespace dealii;
using namespace scree;

struct Range
{
  unsigned int n_updates;
  double smallest_strain, largest_strain, smallest_image_pressure, largest_image_pressure;
};


void test(const std::string &name, const NorSandParameters &parameters, const Range &range, RandomNumbers &random)
{
  const NorSand law(parameters);
  UpdateReport report;
  double largest_yield = -1e300, smallest_dissipation = 1e300, largest_stress_error = 0;
  unsigned int n_elastic = 0;
  for (unsigned int i = 0; i < range.n_updates; ++i)
    {
      // A state on or inside the yield surface, then a strain increment.
      const double image_pressure = random.log_uniform(range.smallest_image_pressure, range.largest_image_pressure);
      const double pressure       = image_pressure * random.log_uniform(1e-3, 2.298);
      const double volume_strain  = -parameters.swelling_index * std::log(pressure / 1000);
      const double size           = random.log_uniform(range.smallest_strain, range.largest_strain);
      PrincipalValues strain;
      for (double &value : strain)
        value = volume_strain / 3 + size * random.uniform(-1, 1);

      const PrincipalValues trial  = strain;
      double internal_variables[2] = { image_pressure, 0 };
      PrincipalValues stress;
      n_elastic += !return_point(law, strain, internal_variables, random.log_uniform(0.8, 1.5), stress, report);

      const double mean = (stress[0] + stress[1] + stress[2]) / 3;
      double sum = 0, dissipation = 0, scale = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          sum += stress[k] + strain[k];
          dissipation += stress[k] * (trial[k] - strain[k]);
          scale += std::abs(stress[k]) * (std::abs(trial[k]) + std::abs(strain[k]));
        }
      AssertThrow(std::isfinite(sum) && std::isfinite(internal_variables[0]) && internal_variables[0] > 0 &&
                      internal_variables[1] >= 0,
                  ExcMessage(name + ": not a number"));
      AssertThrow(mean <= 0, ExcMessage(name + ": tension " + std::to_string(mean)));
      if (scale > 0)
        smallest_dissipation = std::min(smallest_dissipation, dissipation / scale);
      if (mean < 0)
        {
          largest_yield         = std::max(largest_yield, law.yield(strain, internal_variables[0]));
          const double expected = 1000 * std::exp(-(strain[0] + strain[1] + strain[2]) / parameters.swelling_index);
          largest_stress_error  = std::max(largest_stress_error, std::abs(mean + expected) / expected);
        }
    }
  AssertThrow(largest_yield < 1e-8,
              ExcMessage(name + ": outside the yield surface by " + std::to_string(largest_yield)));
  AssertThrow(smallest_dissipation > -1e-10,
              ExcMessage(name + ": dissipation " + std::to_string(smallest_dissipation)));
  AssertThrow(largest_stress_error < 1e-9, ExcMessage(name + ": stress is not that of the strain"));
  AssertThrow(report.n_unresolved == 0, ExcMessage(name + ": unresolved " + std::to_string(report.n_unresolved)));
  // The sample must reach every branch, or the test proves nothing.
  AssertThrow(n_elastic > 0 && report.n_fallbacks > 0 && report.n_vertices > 0 && report.n_separated > 0,
              ExcMessage(name + ": a branch was not visited"));
  std::cout << name << ", " << range.n_updates << " updates: OK" << std::endl;
}


void run()
{
  const Range common  = { 3000000, 1e-6, 1e-1, 1e1, 1e6 };
  const Range extreme = { 200000, 1e-3, 10, 1e-10, 1e10 };
  RandomNumbers random;
  NorSandParameters parameters;
  test("dense", parameters, common, random);
  test("dense, extreme", parameters, extreme, random);
  parameters.initial_specific_volume = 1.736;
  test("loose, extreme", parameters, extreme, random);
  parameters.potential_constant = 0.1;
  test("not associated, extreme", parameters, extreme, random);
  parameters.potential_constant = parameters.yield_constant = 0;
  test("Cam-Clay N = 0, extreme", parameters, extreme, random);
}

const UnitTest registered("nor_sand_random", run);
} // namespace test_nor_sand_random


// Output:
// dense, 3000000 updates: OK
// dense, extreme, 200000 updates: OK
// loose, extreme, 200000 updates: OK
// not associated, extreme, 200000 updates: OK
// Cam-Clay N = 0, extreme, 200000 updates: OK
