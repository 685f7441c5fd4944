// SPDX-License-Identifier: LGPL-2.1-or-later

// Softening Mohr-Coulomb: random returns with a strength of each point, against the law without softening, in lanes and
// point by point; pure shear against tau = c(gamma - tau/G).

#include <scree/materials/laws/mohr_coulomb.h>

#include <algorithm>
#include <iostream>

#include "../unit_test.h"
#include "one_point.h"

namespace test_softening
{
using namespace dealii;
using namespace scree;

MohrCoulombParameters clay()
{
  MohrCoulombParameters parameters;
  parameters.young_modulus            = 1e7;
  parameters.cohesion                 = 2e4;
  parameters.friction_angle           = 0;
  parameters.softening.strain         = 0.05;
  parameters.softening.cohesion       = 5e3;
  parameters.softening.friction_angle = 0;
  return parameters;
}


double largest_difference(const PrincipalValues &a, const PrincipalValues &b)
{
  double largest = 0;
  for (unsigned int k = 0; k < 3; ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}


void test_random(const std::string &name, const MohrCoulombParameters &parameters, RandomNumbers &random)
{
  const SofteningMohrCoulomb law(parameters);
  const bool is_continuous = parameters.cohesion > 0; // grains apart do not dilate
  UpdateReport report;
  double largest_yield = 0, smallest_dissipation = 0, largest_again = 0, largest_slope = 0;
  unsigned int n_plastic = 0;
  for (unsigned int i = 0; i < 1000000; ++i)
    {
      const double size           = random.log_uniform(1e-6, 1e-1);
      const PrincipalValues trial = random_strain(random, size);
      const double kappa          = random.uniform(-0.01, 0.2);
      const auto strength         = law.strength(kappa);
      const double scale          = law.bulk_modulus(0) * size + parameters.cohesion;

      PrincipalValues strain = trial, stress;
      double internal[3]     = { 0, kappa, kappa };
      const auto n_vertices  = report.n_vertices + report.n_separated;
      n_plastic += return_point(law, strain, internal, 1, stress, report);
      const bool at_vertex = report.n_vertices + report.n_separated > n_vertices;
      largest_yield        = std::max(largest_yield, law.yield(stress, strength) / scale);
      double dissipation   = 0;
      for (unsigned int k = 0; k < 3; ++k)
        dissipation += stress[k] * (trial[k] - strain[k]);
      smallest_dissipation = std::min(smallest_dissipation, dissipation / (scale * size));
      // Over the other plastic strain: 1.5 in triaxial, sqrt(3) in plane shear.
      AssertThrow(internal[1] >= kappa + 1.4999 * internal[0] - 1e-12 &&
                      internal[1] <= kappa + 1.7321 * internal[0] + 1e-12,
                  ExcMessage(name + ": kappa is not that of the plastic strain"));
      AssertThrow(internal[1] == internal[2], ExcMessage(name + ": without averages, kappa sets the strength"));
      AssertThrow(!at_vertex || internal[1] == kappa, ExcMessage(name + ": kappa grows where grains are apart"));

      PrincipalValues near = trial, near_stress;
      const double shift   = 1e-6 * size;
      for (double &value : near)
        value += shift * random.uniform(-1, 1);
      double near_internal[3] = { 0, kappa, kappa };
      return_point(law, near, near_internal, 1, near_stress, report);
      if (is_continuous)
        largest_slope =
            std::max(largest_slope, largest_difference(stress, near_stress) / (law.bulk_modulus(0) * shift));

      if (at_vertex)
        continue;
      PrincipalValues again = strain, again_stress;
      internal[2]           = kappa;
      return_point(law, again, internal, 1, again_stress, report);
      largest_again = std::max(largest_again, largest_difference(again_stress, stress) / scale);
    }
  AssertThrow(largest_yield < 1e-10, ExcMessage(name + ": outside the yield surface"));
  AssertThrow(smallest_dissipation > -1e-12, ExcMessage(name + ": creates energy"));
  AssertThrow(largest_again < 1e-10, ExcMessage(name + ": a returned stress returns elsewhere"));
  AssertThrow(largest_slope < 100, ExcMessage(name + ": stress jumps: " + std::to_string(largest_slope)));
  AssertThrow(report.n_unresolved == 0, ExcMessage(name + ": unresolved"));
  AssertThrow(n_plastic > 100000, ExcMessage(name + ": plastic states were not visited"));
  std::cout << name << ": OK" << std::endl;
}


/// Strength that does not fall within the strains of the test is that of the law without softening.
void test_peak(const std::string &name, MohrCoulombParameters parameters, RandomNumbers &random)
{
  parameters.softening = {};
  const MohrCoulomb perfect(parameters);
  parameters.softening.strain   = 1e30;
  parameters.softening.cohesion = 0;
  const SofteningMohrCoulomb law(parameters);
  UpdateReport report;
  for (unsigned int i = 0; i < 200000; ++i)
    {
      const double size      = random.log_uniform(1e-6, 1e-1);
      PrincipalValues strain = random_strain(random, size), of_perfect = strain, stress, stress_of_perfect;
      double internal[3] = {}, internal_of_perfect[1] = {};
      return_point(law, strain, internal, 1, stress, report);
      return_point(perfect, of_perfect, internal_of_perfect, 1, stress_of_perfect, report);
      const double scale = perfect.bulk_modulus(0) * size + parameters.cohesion;
      expect(largest_difference(stress, stress_of_perfect) / scale, 0, 1e-10, name + ": difference of stress");
      expect(internal[0], internal_of_perfect[0], 1e-10 * size, name + ": plastic shear strain");
    }
  std::cout << name << ", as without softening: OK" << std::endl;
}


template <int dim>
void test_lanes(const std::string &name, const MohrCoulombParameters &parameters, RandomNumbers &random)
{
  scree::test_lanes<dim, 3>(name, SofteningMohrCoulomb(parameters), 2e-3, parameters.softening.strain, random);
}


/// Largest error of tau over the peak on a path to gamma = 0.3 in `n` steps, against tau = c(gamma - tau/G).
double error_of_shear(const unsigned int n)
{
  const MohrCoulombParameters parameters = clay();
  const SofteningMohrCoulomb law(parameters);
  const double G = law.shear_modulus(), residual = 5e3, fall = 1.5e4;
  PrincipalValues strain{}, stress;
  double internal[3] = {}, largest = 0, exact = 0;
  UpdateReport report;
  const double compression = -0.01; // of the start; the law has no friction
  for (double &value : strain)
    value = compression;
  for (unsigned int step = 1; step <= n; ++step)
    {
      const double gamma = 0.3 * step / n;
      strain[0] += 0.15 / n;
      strain[2] -= 0.15 / n;
      return_point(law, strain, internal, 1, stress, report);
      if (G * gamma < parameters.cohesion)
        exact = G * gamma;
      else
        for (unsigned int i = 0; i < 50; ++i)
          exact = residual + fall * std::exp(-(gamma - exact / G) / 0.05);
      largest = std::max(largest, std::abs((stress[0] - stress[2]) / 2 - exact) / parameters.cohesion);
    }
  return largest;
}


void test_shear()
{
  const double coarse = error_of_shear(1000), fine = error_of_shear(4000);
  expect(coarse, 0, 6e-3, "error of tau in 1000 steps");
  expect(coarse / fine, 4, 0.2, "gain of four times as many steps"); // first order
  std::cout << "Pure shear: OK" << std::endl;
}


void run()
{
  RandomNumbers random;
  MohrCoulombParameters parameters = clay();
  test_random("phi 0, c 20 to 5 kPa", parameters, random);
  test_peak("phi 0, c", parameters, random);
  test_lanes<2>("phi 0, c 20 to 5 kPa", parameters, random);
  test_lanes<3>("phi 0, c 20 to 5 kPa", parameters, random);
  parameters.tension_cut_off = 2e3;
  test_random("phi 0, c 20 to 5 kPa, cut-off 2 kPa", parameters, random);

  parameters.tension_cut_off          = 0;
  parameters.friction_angle           = 35;
  parameters.dilation_angle           = 10;
  parameters.softening.friction_angle = 25;
  parameters.softening.dilation_angle = 0;
  test_random("phi 35 to 25, psi 10 to 0, c 20 to 5 kPa", parameters, random);
  test_peak("phi 35, psi 10, c", parameters, random);
  test_lanes<2>("phi 35 to 25, psi 10 to 0, c 20 to 5 kPa", parameters, random);
  test_lanes<3>("phi 35 to 25, psi 10 to 0, c 20 to 5 kPa", parameters, random);
  parameters.softening.cohesion = 0;
  test_random("phi 35 to 25, psi 10 to 0, c 20 kPa to 0", parameters, random);
  parameters.cohesion = 0;
  test_random("phi 35 to 25, psi 10 to 0, no cohesion", parameters, random);
  test_shear();
}

const UnitTest registered("softening", run);
} // namespace test_softening


// Output:
// phi 0, c 20 to 5 kPa: OK
// phi 0, c, as without softening: OK
// 2D, phi 0, c 20 to 5 kPa, in lanes: OK
// 3D, phi 0, c 20 to 5 kPa, in lanes: OK
// phi 0, c 20 to 5 kPa, cut-off 2 kPa: OK
// phi 35 to 25, psi 10 to 0, c 20 to 5 kPa: OK
// phi 35, psi 10, c, as without softening: OK
// 2D, phi 35 to 25, psi 10 to 0, c 20 to 5 kPa, in lanes: OK
// 3D, phi 35 to 25, psi 10 to 0, c 20 to 5 kPa, in lanes: OK
// phi 35 to 25, psi 10 to 0, c 20 kPa to 0: OK
// phi 35 to 25, psi 10 to 0, no cohesion: OK
// Pure shear: OK
