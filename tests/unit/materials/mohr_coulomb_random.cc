// SPDX-License-Identifier: LGPL-2.1-or-later

// Random returns: on the yield surface, dissipating, dilating as the dilation angle says; a gap is kept and closed.

#include <scree/materials/laws/mohr_coulomb.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_mohr_coulomb_random
{
using namespace dealii;
using namespace scree;

/// On faces and edges the plastic volume strain is sin psi times the sum of the sizes of the principal plastic strains.
double dilation_error(const PrincipalValues &trial, const PrincipalValues &strain, const double sine)
{
  double volume = 0, size = 0;
  for (unsigned int k = 0; k < 3; ++k)
    {
      volume += trial[k] - strain[k];
      size += std::abs(trial[k] - strain[k]);
    }
  return std::abs(volume - sine * size);
}


void test_random(const std::string &name, const MohrCoulombParameters &parameters, RandomNumbers &random)
{
  const MohrCoulomb law(parameters);
  const double bulk = law.bulk_modulus(0), sine = std::sin(parameters.dilation_angle * numbers::PI / 180);
  UpdateReport report;
  double largest_yield = 0, smallest_dissipation = 0, largest_again = 0, largest_stress_error = 0, largest_dilation = 0;
  unsigned int n_elastic = 0, n_plastic = 0, n_faces = 0;
  for (unsigned int i = 0; i < 1000000; ++i)
    {
      const double size = random.log_uniform(1e-6, 1e-1), mean = random.uniform(-1, 0.3) * size;
      PrincipalValues strain;
      for (double &value : strain)
        value = mean + size * random.uniform(-1, 1);

      const PrincipalValues trial = strain;
      double plastic_shear_strain = 0;
      PrincipalValues stress, again_stress;
      const unsigned long long n_vertices = report.n_vertices + report.n_separated;
      const Response response             = law.return_map(strain, &plastic_shear_strain, 1, stress, report);
      const bool at_vertex                = report.n_vertices + report.n_separated > n_vertices;
      (response == Response::elastic ? n_elastic : n_plastic) += 1;

      double scale = bulk * size + parameters.cohesion, dissipation = 0, volume_strain = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          dissipation += stress[k] * (trial[k] - strain[k]);
          volume_strain += strain[k];
        }
      largest_yield        = std::max(largest_yield, law.yield(stress) / scale);
      smallest_dissipation = std::min(smallest_dissipation, dissipation / (scale * size));
      AssertThrow(plastic_shear_strain >= 0, ExcMessage(name + ": plastic shear strain is negative"));
      if (at_vertex)
        continue;

      // The returned stress is that of the returned strain, and returns to itself.
      for (unsigned int k = 0; k < 3; ++k)
        {
          const double elastic = bulk * volume_strain + 2 * law.shear_modulus() * (strain[k] - volume_strain / 3);
          largest_stress_error = std::max(largest_stress_error, std::abs(elastic - stress[k]) / scale);
        }
      PrincipalValues again = strain;
      law.return_map(again, &plastic_shear_strain, 1, again_stress, report);
      for (unsigned int k = 0; k < 3; ++k)
        largest_again = std::max(largest_again, std::abs(again_stress[k] - stress[k]) / scale);

      PrincipalValues sorted = stress;
      std::sort(sorted.begin(), sorted.end());
      const bool on_cut_off = sorted[2] > parameters.tension_cut_off - 1e-3 * scale;
      if (response == Response::plastic && !on_cut_off)
        {
          ++n_faces;
          largest_dilation = std::max(largest_dilation, dilation_error(trial, strain, sine) / size);
        }
    }
  AssertThrow(largest_yield < 1e-10, ExcMessage(name + ": outside the yield surface"));
  AssertThrow(smallest_dissipation > -1e-12, ExcMessage(name + ": creates energy"));
  AssertThrow(largest_again < 1e-10, ExcMessage(name + ": a returned stress returns elsewhere"));
  AssertThrow(largest_stress_error < 1e-10, ExcMessage(name + ": stress is not that of the strain"));
  AssertThrow(largest_dilation < 1e-10, ExcMessage(name + ": wrong dilation"));
  AssertThrow(report.n_unresolved == 0, ExcMessage(name + ": unresolved"));
  AssertThrow(n_elastic > 1000 && n_faces > 1000 && report.n_vertices + report.n_separated > 1000,
              ExcMessage(name + ": a branch was not visited"));
  std::cout << name << ": OK" << std::endl;
}


void test_gap()
{
  const MohrCoulomb law{ MohrCoulombParameters() };
  UpdateReport report;
  PrincipalValues strain      = { { -0.01, -0.01, -0.01 } }, stress;
  double plastic_shear_strain = 0;
  law.return_map(strain, &plastic_shear_strain, 1, stress, report);
  const double start = stress[0];

  const double steps[4] = { 0.05, -0.02, -0.019, -0.011 }; // along each axis: apart, nearer, nearer, closed
  for (unsigned int i = 0; i < 4; ++i)
    {
      for (double &value : strain)
        value += steps[i];
      strain[0] += i < 3 ? 1e-4 : 0; // Grains apart bear no shear, and shear does not close the gap.
      strain[1] -= i < 3 ? 1e-4 : 0;
      law.return_map(strain, &plastic_shear_strain, 1, stress, report);
      AssertThrow(i == 3 || stress[0] == 0, ExcMessage("Stress across a gap."));
    }
  AssertThrow(std::abs(stress[0] / start - 1) < 1e-12, ExcMessage("The gap was forgotten."));
  std::cout << "gap kept and closed: OK, stress before and after " << start << ' ' << stress[0] << " Pa" << std::endl;
}


void run()
{
  RandomNumbers random;
  MohrCoulombParameters parameters;
  test_random("phi 30, psi 0", parameters, random);
  parameters.dilation_angle = 10;
  test_random("phi 30, psi 10", parameters, random);
  parameters.cohesion = 1e3;
  test_random("phi 30, psi 10, c 1 kPa, no tension", parameters, random);
  parameters.tension_cut_off = 500;
  test_random("phi 30, psi 10, c 1 kPa, cut-off 500 Pa", parameters, random);
  parameters.tension_cut_off = 1e3 / std::tan(numbers::PI / 6) * (1 - 1e-14);
  test_random("phi 30, psi 10, c 1 kPa, cut-off at the apex", parameters, random);
  parameters.friction_angle = parameters.dilation_angle = 0;
  parameters.tension_cut_off                            = 200;
  test_random("phi 0, c 1 kPa, cut-off 200 Pa", parameters, random);
  test_gap();
}

const UnitTest registered("mohr_coulomb_random", run);
} // namespace test_mohr_coulomb_random
