// SPDX-License-Identifier: LGPL-2.1-or-later

// Steady simple shear at a given rate: tau/p = mu_s + Delta mu/(1 + I_0/I), for any step, in lanes and point by point.
// The part that is kept stays within 0 and 1 for any numbers.

#include <scree/materials/laws/mohr_coulomb.h>

#include <iostream>
#include <numeric>

#include "../expect.h"
#include "../random_numbers.h"
#include "../unit_test.h"
#include "one_point.h"

namespace test_inertial_friction
{
using namespace scree;

constexpr double grain_density = 2650, pressure = 1e3; // kg/m^3, Pa
constexpr InertialFrictionParameters friction{ 1e-3, 0.3, 0.26 };


/// Deviation of tau/p from the law after a shear strain of 1 at the rate, 1/s, in steps of this strain. `n` axes make
/// p.
template <typename Material>
double
deviation(const Material &material, const double slow, const unsigned int n, const double rate, const double strain)
{
  double wanted[4] = { -pressure, -pressure, -pressure, 0 }, b[4], stress[4], internal[3];
  material.initialise(wanted, b, stress, internal);
  UpdateReport report;
  const double increment[4] = { 1, strain, 0, 1 }, one = 1;
  for (unsigned int step = 0; step * strain < 1; ++step)
    material.update(
        { 1, 0, b, stress, internal }, { increment, &one, &one, &one, 1, strain / rate, grain_density }, report);
  expect(double(report.n_unresolved), 0, 0, "unresolved returns");

  const double p      = -std::accumulate(stress, stress + n, 0.) / n;
  const double shear  = std::sqrt(std::pow((stress[0] - stress[1]) / 2, 2) + stress[3] * stress[3]);
  const double number = rate * friction.grain_diameter * std::sqrt(grain_density / p);
  return shear / p / (slow + friction.friction_increase / (1 + friction.reference_number / number)) - 1;
}


template <typename Lanes, typename One>
void test(const Lanes &lanes, const One &one, const double slow, const unsigned int n, const std::string &name)
{
  for (const double rate : { 1e-3, 0.1, 10., 300. })
    for (const double strain : { 1e-5, 9e-4, 5e-3 })
      {
        expect(deviation(lanes, slow, n, rate, strain), 0, 1e-3, name + ", in lanes: deviation of tau/p");
        expect(deviation(one, slow, n, rate, strain), 0, 1e-3, name + ": deviation of tau/p");
      }
  std::cout << name << ": OK" << std::endl;
}


void test_bounds()
{
  const InertialFriction law(friction);
  RandomNumbers random;
  for (unsigned int i = 0; i < 100000; ++i)
    {
      const double gamma = random.log_uniform(1e-20, 10), p = random.log_uniform(1e-6, 1e8),
                   step = random.log_uniform(1e-9, 1e3), modulus = random.log_uniform(1e3, 1e11);
      const double part = law.kept_part<double>(gamma, modulus, p, grain_density, step);
      AssertThrow(part >= 0 && part <= 1, dealii::ExcMessage("part " + std::to_string(part)));
      // The equation of the part, where numbers do not cancel.
      const double whole = gamma / step * friction.grain_diameter * std::sqrt(grain_density / p);
      if (part > 1e-6 && part < 0.999 && p > 1e-3)
        expect(part * modulus * gamma * (friction.reference_number + (1 - part) * whole) /
                   (friction.friction_increase * p * (1 - part) * whole),
               1,
               1e-6,
               "the equation of the part");
    }
  expect(law.kept_part<double>(1e-3, 1e6, 1e3, grain_density, std::numeric_limits<double>::infinity()), 0, 0, "slow");
  expect(law.kept_part<double>(0., 1e6, 1e3, grain_density, 1e-3), 0, 0, "without strain");
  expect(law.kept_part<double>(1e-3, 1e6, 0., grain_density, 1e-3), 0, 0, "without pressure");
  std::cout << "Bounds: OK" << std::endl;
}


void run()
{
  MohrCoulombParameters coulomb;
  coulomb.young_modulus     = 1e8;
  coulomb.inertial_friction = friction;
  const MohrCoulomb faces(coulomb);
  test(HenckyMaterial<2, MohrCoulomb>(faces), OnePointMaterial<2, MohrCoulomb>(faces), 0.5, 2, "Mohr-Coulomb");
  test_bounds();
}

const UnitTest registered("inertial_friction", run);
} // namespace test_inertial_friction


// Output:
// Mohr-Coulomb: OK
// Bounds: OK
