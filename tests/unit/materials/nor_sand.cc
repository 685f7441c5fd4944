// SPDX-License-Identifier: LGPL-2.1-or-later
// Nor-Sand: random and extreme returns are numbers without tension, never outside the yield surface, never unresolved.
// Sand pulled apart bears nothing until the gap is closed again, to the volume where it came apart.
#include "one_point.h"

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/table.h>

namespace test_nor_sand
{
struct Range
{
  unsigned int n_updates;
  double smallest_strain, largest_strain, smallest_image_pressure, largest_image_pressure;
};


void test_returns(const std::string &name,
                  const NorSandParameters &parameters,
                  const Range &range,
                  RandomNumbers &random)
{
  const NorSand law(parameters);
  UpdateReport report;
  unsigned int n_elastic = 0;
  for (unsigned int i = 0; i < range.n_updates; ++i)
    {
      // A state on or inside the yield surface, then a strain increment.
      const double image_pressure = random.log_uniform(range.smallest_image_pressure, range.largest_image_pressure);
      const double pressure       = image_pressure * random.log_uniform(1e-3, 2.298);
      const double volume_strain  = -parameters.swelling_index * std::log(pressure / 1000);
      const double size           = random.log_uniform(range.smallest_strain, range.largest_strain);
      PrincipalValues strain, stress;
      for (double &value : strain)
        value = volume_strain / 3 + size * random.uniform(-1, 1);

      const PrincipalValues trial = strain;
      double internal[2]          = { image_pressure, 0 };
      n_elastic += !return_point(law, strain, internal, random.log_uniform(0.8, 1.5), stress, report);

      const double mean               = (stress[0] + stress[1] + stress[2]) / 3;
      const auto [dissipation, scale] = energy_taken(trial, strain, stress);
      require(std::isfinite(internal[0]) && internal[0] > 0 && internal[1] >= 0, name + ": not a number");
      require(mean <= 0, name + ": tension");
      require(dissipation >= -1e-10 * scale, name + ": energy made");
      if (mean < 0)
        {
          const auto now = law.trial_of(strain, 1, internal);
          require(now.eta - now.stress_ratio < 1e-8, name + ": outside the yield surface");
          const double expected = 1000 * std::exp(-(strain[0] + strain[1] + strain[2]) / parameters.swelling_index);
          expect(-mean / expected, 1, 1e-9, name + ": stress over that of the strain");
        }
    }
  require(report.n_unresolved == 0, name + ": unresolved " + std::to_string(report.n_unresolved));
  // The sample must reach every branch, or the test proves nothing.
  require(n_elastic > 0 && report.n_fallbacks > 0 && report.n_vertices > 0 && report.n_separated > 0,
          name + ": a branch was not visited");
}


void test_gap()
{
  constexpr double pressure = 1e4, step = 5e-5;
  PointOfMaterial<2> sand("Nor-Sand", -pressure, -pressure);
  const UpdateReport &report = sand.report;
  const double *stress       = sand.stress;
  double volume_strain       = 0; // ln J
  const auto stretch         = [&](const double strain) {
    volume_strain += 3 * strain;
    sand.update(std::exp(strain) * Tensor<2, 2>(unit_symmetric_tensor<2>()), std::exp(strain));
  };

  // From 10 kPa to the minimum pressure the sand swells by kappa ln(10 kPa/1 Pa).
  const NorSandParameters law;
  const double contact = law.swelling_index * std::log(pressure / law.minimum_pressure);
  for (unsigned int i = 0; i < 400; ++i)
    {
      stretch(step);
      require((stress[0] < 0) == (volume_strain < contact), "Wrong contact on the way out.");
    }
  require(report.n_separated > 0 && sand.material->elastic_energy(sand.left_cauchy_green) < 1e-2,
          "The sand should be apart and store nothing.");
  // A wide step is taken in many sub-steps, yet the point is apart once.
  const UpdateReport before = report;
  stretch(0.01);
  require(report.n_substeps > before.n_substeps + 5 && report.n_separated == before.n_separated + 1,
          "A point that is pulled on is apart once.");
  stretch(-0.01);
  while (volume_strain > 1e-9)
    {
      stretch(-step);
      require((stress[0] < 0) == (volume_strain < contact), "Wrong contact on the way back.");
    }
  require(report.n_unresolved == 0, "Unresolved returns.");
  expect(-stress[0] / pressure, 0.197818, 1e-6, "pressure after the gap over that before, which no bounce may exceed");
}


const UnitTest registered("nor_sand", [] {
  const Range common  = { 3000000, 1e-6, 1e-1, 1e1, 1e6 };
  const Range extreme = { 200000, 1e-3, 10, 1e-10, 1e10 };
  RandomNumbers random;
  NorSandParameters parameters;
  test_returns("dense", parameters, common, random);
  test_returns("dense, extreme", parameters, extreme, random);
  parameters.initial_specific_volume = 1.736;
  test_returns("loose, extreme", parameters, extreme, random);
  parameters.potential_constant = 0.1;
  test_returns("not associated, extreme", parameters, extreme, random);
  parameters.potential_constant = parameters.yield_constant = 0;
  test_returns("Cam-Clay N = 0, extreme", parameters, extreme, random);
  test_gap();
});
} // namespace test_nor_sand
