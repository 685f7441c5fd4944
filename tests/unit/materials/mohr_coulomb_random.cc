// SPDX-License-Identifier: LGPL-2.1-or-later

// Random returns: on the yield surface, dissipating, dilating as the dilation angle says. What opens at the vertex or
// at a cut-off is kept and closed, without a change of energy.

#include <scree/materials/laws/tresca.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <iostream>

#include "../unit_test.h"
#include "one_point.h"

namespace test_mohr_coulomb_random
{
using namespace dealii;
using namespace scree;

/// Derivative of the energy along principal axis k, over +- `step`, Pa; exact but where the axis opens or closes.
double energy_slope(const MohrCoulomb &law, const PrincipalValues &strain, const unsigned int k, const double step)
{
  PrincipalValues more = strain, less = strain;
  more[k] += step;
  less[k] -= step;
  return (law.energy(more) - law.energy(less)) / (2 * step);
}


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
  const double bulk = law.bulk_modulus(0), shear = law.shear_modulus();
  const double sine = std::sin(parameters.dilation_angle * numbers::PI / 180);
  UpdateReport report;
  double largest_yield = 0, smallest_dissipation = 0, largest_again = 0, largest_dilation = 0;
  double largest_stress_error = 0, largest_open_error = 0;
  unsigned int n_elastic = 0, n_plastic = 0, n_faces = 0;
  for (unsigned int i = 0; i < 1000000; ++i)
    {
      const double size           = random.log_uniform(1e-6, 1e-1);
      PrincipalValues strain      = random_strain(random, size);
      const PrincipalValues trial = strain;
      double plastic_shear_strain = 0;
      PrincipalValues stress, again_stress;
      const unsigned long long n_vertices = report.n_vertices + report.n_separated;
      const bool is_plastic               = return_point(law, strain, &plastic_shear_strain, 1, stress, report);
      const bool at_vertex                = report.n_vertices + report.n_separated > n_vertices;
      (is_plastic ? n_plastic : n_elastic) += 1;

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

      PrincipalValues sorted = stress;
      std::sort(sorted.begin(), sorted.end());
      const bool on_cut_off = sorted[2] > parameters.tension_cut_off - 1e-3 * scale;

      // The returned stress is that of the returned strain, open or not, and returns to itself.
      for (unsigned int k = 0; k < 3; ++k)
        if (on_cut_off)
          largest_open_error =
              std::max(largest_open_error, std::abs(energy_slope(law, strain, k, 1e-4 * size) - stress[k]) / scale);
        else
          {
            const double elastic = bulk * volume_strain + 2 * shear * (strain[k] - volume_strain / 3);
            largest_stress_error = std::max(largest_stress_error, std::abs(elastic - stress[k]) / scale);
          }
      PrincipalValues again = strain;
      return_point(law, again, &plastic_shear_strain, 1, again_stress, report);
      for (unsigned int k = 0; k < 3; ++k)
        largest_again = std::max(largest_again, std::abs(again_stress[k] - stress[k]) / scale);

      if (is_plastic && !on_cut_off)
        {
          ++n_faces;
          largest_dilation = std::max(largest_dilation, dilation_error(trial, strain, sine) / size);
        }
    }
  AssertThrow(largest_yield < 1e-10, ExcMessage(name + ": outside the yield surface"));
  AssertThrow(smallest_dissipation > -1e-12, ExcMessage(name + ": creates energy"));
  AssertThrow(largest_again < 1e-10, ExcMessage(name + ": a returned stress returns elsewhere"));
  AssertThrow(largest_stress_error < 1e-10, ExcMessage(name + ": stress is not that of the strain"));
  AssertThrow(largest_open_error < 2e-4,
              ExcMessage(name + ": the energy of soil that is open is not that of the stress"));
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
  return_point(law, strain, &plastic_shear_strain, 1, stress, report);
  const double start = stress[0];

  const double steps[4] = { 0.05, -0.02, -0.019, -0.011 }; // along each axis: apart, nearer, nearer, closed
  for (unsigned int i = 0; i < 4; ++i)
    {
      for (double &value : strain)
        value += steps[i];
      strain[0] += i < 3 ? 1e-4 : 0; // Grains apart bear no shear, and shear does not close the gap.
      strain[1] -= i < 3 ? 1e-4 : 0;
      return_point(law, strain, &plastic_shear_strain, 1, stress, report);
      AssertThrow(i == 3 || stress[0] == 0, ExcMessage("Stress across a gap."));
    }
  AssertThrow(std::abs(stress[0] / start - 1) < 1e-12, ExcMessage("The gap was forgotten."));
  std::cout << "gap kept and closed: OK, stress before and after " << start << ' ' << stress[0] << " Pa" << std::endl;
}


/// Soil whose first axis opens and closes again: the stress stays at the cut-off until the opening has closed, then it
/// is that of the start, and so is the energy. Soil that opens further is apart; its gap closes if it is pressed from
/// all sides.
/// @param plastic_shear of the point
/// @param update from trial strain to strain and stress
template <typename Update>
void test_opening(const std::string &name,
                  const MohrCoulomb &law,
                  const double cut_off,
                  const double *plastic_shear,
                  const Update &update)
{
  PrincipalValues strain = { { -1e-4, -1e-4, -1e-4 } }, stress;
  update(strain, stress);
  const PrincipalValues start = stress;
  const double energy_before = law.energy(strain), opening = 0.8 * MohrCoulomb::largest_opening;
  double energy_of_half = 0, left = 0, left_energy = 0, work_error = 0;
  for (unsigned int wave = 0; wave < 10; ++wave)
    for (const double part : { 1, 1, -1, -1 })
      {
        strain[0] += part * opening / 2;
        update(strain, stress);
        const double energy = law.energy(strain);
        if (strain[0] > opening / 4)
          {
            left = std::max(left, std::abs(stress[0] - cut_off));
            if (strain[0] > 0.75 * opening)
              work_error = std::max(work_error, std::abs(energy - energy_of_half - cut_off * opening / 2));
            energy_of_half = energy;
            continue;
          }
        for (unsigned int k = 0; k < 3; ++k)
          left = std::max(left, std::abs(stress[k] - start[k]));
        left_energy = std::max(left_energy, std::abs(energy - energy_before));
      }
  AssertThrow(left < 1e-9 * std::abs(start[0]), ExcMessage(name + ": a wave has left stress behind"));
  AssertThrow(*plastic_shear == 0, ExcMessage(name + ": an opening is no plastic shear"));
  AssertThrow(left_energy < 1e-9 * energy_before, ExcMessage(name + ": a wave has made or lost energy"));
  AssertThrow(work_error <= 1e-9 * cut_off, ExcMessage(name + ": the energy is not the work of the cut-off"));

  for (const int part : { 1, -1 })
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double change = 0.1 * MohrCoulomb::largest_opening;
        for (unsigned int k = 0; k < 3; ++k)
          strain[k] += part > 0 ? (k == 0 ? change : 0) : -change / 3;
        update(strain, stress);
        if (strain[0] + strain[1] + strain[2] > 1.1 * MohrCoulomb::largest_opening)
          for (const double value : stress)
            AssertThrow(value == cut_off, ExcMessage(name + ": stress in soil that is apart"));
      }
  for (unsigned int k = 0; k < 3; ++k)
    AssertThrow(std::abs(stress[k] - start[k]) < 1e-9 * std::abs(start[k]),
                ExcMessage(name + ": the gap of soil that was apart has not closed"));
  std::cout << name << ", opening at the cut-off kept and closed: OK" << std::endl;
}


void test_openings(const double cut_off)
{
  UpdateReport report;
  const std::string name = "cut-off " + std::to_string(static_cast<int>(cut_off)) + " Pa: ";
  MohrCoulombParameters parameters;
  parameters.cohesion        = 1e5;
  parameters.tension_cut_off = cut_off;
  const MohrCoulomb perfectly_plastic(parameters);
  double variables[1] = {};
  test_opening(name + "perfectly plastic", perfectly_plastic, cut_off, variables, [&](auto &strain, auto &stress) {
    return_point(perfectly_plastic, strain, variables, 1, stress, report);
  });
  parameters.softening.strain   = 0.1;
  parameters.softening.cohesion = 5e4;
  const SofteningMohrCoulomb softening(parameters);
  double of_softening[3] = {};
  test_opening(name + "softening", softening, cut_off, of_softening, [&](auto &strain, auto &stress) {
    return_point(softening, strain, of_softening, 1, stress, report);
  });
  TrescaParameters clay;
  clay.tension_cut_off = cut_off;
  const Tresca tresca(clay);
  double of_clay[4] = { 0, 0, 0, 1e5 };
  test_opening(name + "Tresca", tresca, cut_off, of_clay, [&](auto &strain, auto &stress) {
    return_point(tresca, strain, of_clay, 1, stress, report);
  });
}


/// The apex lies at c / tan(phi); an angle of direct shear is phi with associated flow, and tan(phi) takes the place of
/// sin(phi) without dilation (Davis 1968).
void test_strength()
{
  MohrCoulombParameters parameters;
  parameters.friction_angle = 30;
  parameters.cohesion       = 1e3;
  expect(parameters.apex(), 1e3 * std::sqrt(3.), 1e-9, "apex, Pa");
  parameters.angle_kind = "direct shear or repose";
  expect(parameters.sine(), 1. / std::sqrt(3.), 1e-12, "sin(phi) of direct shear, psi = 0");
  parameters.dilation_angle = 30;
  expect(parameters.sine(), 0.5, 1e-12, "sin(phi) of direct shear, psi = phi");
  std::cout << "strength: OK" << std::endl;
}


void run()
{
  test_strength();
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
  test_openings(0);
  test_openings(2000);
}

const UnitTest registered("mohr_coulomb_random", run);
} // namespace test_mohr_coulomb_random


// Output:
// strength: OK
// phi 30, psi 0: OK
// phi 30, psi 10: OK
// phi 30, psi 10, c 1 kPa, no tension: OK
// phi 30, psi 10, c 1 kPa, cut-off 500 Pa: OK
// phi 30, psi 10, c 1 kPa, cut-off at the apex: OK
// phi 0, c 1 kPa, cut-off 200 Pa: OK
// gap kept and closed: OK, stress before and after -25000 -25000 Pa
// cut-off 0 Pa: perfectly plastic, opening at the cut-off kept and closed: OK
// cut-off 0 Pa: softening, opening at the cut-off kept and closed: OK
// cut-off 0 Pa: Tresca, opening at the cut-off kept and closed: OK
// cut-off 2000 Pa: perfectly plastic, opening at the cut-off kept and closed: OK
// cut-off 2000 Pa: softening, opening at the cut-off kept and closed: OK
// cut-off 2000 Pa: Tresca, opening at the cut-off kept and closed: OK
