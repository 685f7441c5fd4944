// SPDX-License-Identifier: LGPL-2.1-or-later
// Nor-Sand (Jefferies-Been): stored energy, derivatives, and random returns: never outside the yield surface or the
// cap, never unresolved.
#include <scree/materials/laws/nor_sand.h>

#include <iostream>

#include "../expect.h"
#include "../random_numbers.h"
#include "one_point.h"

#include "../unit_test.h"

namespace test_jefferies_been_random
{
using namespace dealii;
using namespace scree;

using Law = JefferiesBeen;

/// Stress is the derivative of the energy, and a closed cycle of 50 kPa costs nothing.
void test_energy(const double exponent)
{
  const PressureElasticity law(80e6, 0.2, exponent, 1e5);
  const auto stress = [&](const double volume, const double shear, double &p, double &q) {
    const double X = law.opening(volume), eta = 3. * law.g * shear / X;
    p = std::exp(law.log_pressure(X, eta));
    q = eta * p;
  };
  double p, q, p_old, q_old, work = 0, turned = 0, volume, shear;
  law.strain_of(std::log(50e3), 50e3, 0.3, volume, shear);
  stress(volume, shear, p, q);
  expect(p / 50e3, 1, 1e-12, "p of the strain of p");
  expect(q / p, 0.3, 1e-12, "eta of the strain of eta");
  const double h = 1e-8;
  expect((law.energy(volume + h, shear) - law.energy(volume - h, shear)) / (2 * h) / p, 1, 1e-6, "dW/de_v over p");
  expect((law.energy(volume, shear + h) - law.energy(volume, shear - h)) / (2 * h) / q, 1, 1e-6, "dW/de_s over q");

  constexpr unsigned int n = 100000;
  for (unsigned int i = 1; i <= n; ++i)
    {
      const double angle = 2 * numbers::PI * i / n, before = 2 * numbers::PI * (i - 1) / n, size = 2e-5;
      p_old = p;
      q_old = q;
      stress(volume + size * (std::cos(angle) - 1), shear + size * std::sin(angle), p, q);
      const double of_volume = 0.5 * (p + p_old) * size * (std::cos(angle) - std::cos(before));
      const double of_shear  = 0.5 * (q + q_old) * size * (std::sin(angle) - std::sin(before));
      work += of_volume + of_shear;
      turned += std::abs(of_volume) + std::abs(of_shear);
    }
  AssertThrow(std::abs(work) < 1e-10 * turned, ExcMessage("work of a cycle " + std::to_string(work / turned * 1e10)));
  std::cout << "n = " << exponent << ", energy: OK" << std::endl;
}


/// The derivatives of the residuals against differences.
template <Law::Hardening hardening>
void test_derivatives(const JefferiesBeenParameters &parameters, RandomNumbers &random)
{
  const Law law(parameters);
  constexpr double h = 1e-6;
  double worst       = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const double p           = random.log_uniform(10, 1e7);
      const PrincipalValues to = { { -random.uniform(0.7, 1) * p, -random.uniform(0.7, 1) * p, -p } };
      PrincipalValues strain, stress;
      double internal[2];
      law.initialise(to, strain, stress, internal);
      strain[0] += 1e-3;
      const auto trial   = law.trial_of(strain, random.uniform(0.95, 1.05), internal);
      const double log_p = trial.log_pressure + random.uniform(-.5, .5), r = random.uniform(-.3, .8);
      const auto at = [&](const double dp, const double dr) {
        return law.residual<hardening, double>(trial, trial.X, trial.shear_strain, log_p + dp, r + dr);
      };
      const auto now = at(0, 0), p_up = at(h, 0), p_down = at(-h, 0), r_up = at(0, h), r_down = at(0, -h);
      const auto compare = [&](const double value, const double up, const double down) {
        worst = std::max(worst, std::abs(value - (up - down) / (2 * h)) / (1 + std::abs(value)));
      };
      compare(now.first_x, p_up.first, p_down.first);
      compare(now.first_r, r_up.first, r_down.first);
      compare(now.second_x, p_up.second, p_down.second);
      compare(now.second_r, r_up.second, r_down.second);
    }
  expect(worst, 0, 1e-5, "derivatives");
  std::cout << "derivatives: OK" << std::endl;
}


/// States of 10 Pa to 10 MPa, psi -.35 to .15, on or inside the yield surface and the cap.
void test_returns(const std::string &name,
                  const JefferiesBeenParameters &parameters,
                  const double largest_strain,
                  const unsigned int n)
{
  RandomNumbers random; // Each test draws its own: others do not change it.
  const Law law(parameters);
  UpdateReport report;
  double yield = -1e300, cap = -1e300, dissipation = 1e300;
  unsigned int n_elastic = 0;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double log_p = std::log(random.log_uniform(10, 1e7));
      const double e     = std::max(0.3, random.uniform(-0.35, 0.15) - law.line.state(1., log_p));
      const double J     = (1 + e) / (1 + parameters.initial_void_ratio);
      PrincipalValues s, strain, stress;
      double sum = 0, square = 0;
      for (double &value : s)
        {
          value = random.uniform(-1, 1);
          sum += value;
        }
      for (double &value : s)
        {
          value -= sum / 3;
          square += value * value;
        }
      const double M   = law.lode_ratio(StrainInvariants<double>{ 0, square, s[0] * s[1] * s[2] });
      double log_image = log_p + random.uniform(-0.5, 0.5);
      for (unsigned int pass = 0; pass < 20; ++pass)
        log_image = std::min(log_image, log_p + law.image(1 + e, log_image, M).limit);
      const double eta = std::max(0., law.image(1 + e, log_image, M).ratio * (1 - log_p + log_image)) *
                         std::sqrt(random.uniform(0, 1));
      double volume, shear;
      law.elastic.strain_of(log_p, 0., eta, volume, shear);
      shear *= std::sqrt(1.5 / square);
      const double size = random.log_uniform(1e-6, largest_strain);
      for (unsigned int k = 0; k < 3; ++k)
        strain[k] = shear * s[k] - volume / 3 + size * random.uniform(-1, 1);

      const PrincipalValues trial = strain;
      double internal[2]          = { std::exp(log_image), 0 };
      n_elastic += !return_point(law, strain, internal, J, stress, report);
      double lost = 0, scale = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          AssertThrow(std::isfinite(strain[k] + stress[k]), ExcMessage(name + ": not a number"));
          lost += stress[k] * (trial[k] - strain[k]);
          scale += std::abs(stress[k]) * (std::abs(trial[k]) + std::abs(strain[k]));
        }
      AssertThrow(stress[0] + stress[1] + stress[2] <= 0, ExcMessage(name + ": tension"));
      AssertThrow(std::isfinite(internal[0]) && internal[0] > 0 && internal[1] >= 0, ExcMessage(name + ": variables"));
      if (scale == 0)
        continue;
      dissipation = std::min(dissipation, lost / scale);
      yield       = std::max(yield, law.yield(strain, internal, J));
      cap         = std::max(cap, law.beyond_cap(strain, internal, J));
    }
  if (n > 100000)
    std::cout << name << ": elastic " << n_elastic << ", fallbacks " << report.n_fallbacks << ", vertices "
              << report.n_vertices << ", separated " << report.n_separated << ", unresolved " << report.n_unresolved
              << "; yield " << yield << ", cap " << cap << ", dissipation " << dissipation << std::endl;
  AssertThrow(report.n_unresolved == 0, ExcMessage(name + ": unresolved " + std::to_string(report.n_unresolved)));
  AssertThrow(yield < 1e-8, ExcMessage(name + ": outside the yield surface by " + std::to_string(yield)));
  AssertThrow(cap < 1e-6, ExcMessage(name + ": beyond the cap by " + std::to_string(cap)));
  AssertThrow(dissipation > -1e-10, ExcMessage(name + ": dissipation " + std::to_string(dissipation)));
  AssertThrow(n_elastic > 0 && report.n_fallbacks > 0 && report.n_separated > 0,
              ExcMessage(name + ": a branch was not visited"));
  std::cout << name << ": OK" << std::endl;
}


void run()
{
  for (const double exponent : { 0., 0.5, 0.9 })
    test_energy(exponent);
  RandomNumbers random;
  JefferiesBeenParameters line;
  line.initial_void_ratio = 0.65;
  test_derivatives<Law::Hardening::law>(line, random);
  test_derivatives<Law::Hardening::cap>(line, random);

  constexpr unsigned int n = 100000; // the documentation has numbers of a million
  for (const double largest : { 1e-3, 1e-2, 1e-1 })
    {
      const std::string to = ", increments to " + std::to_string(largest);
      test_returns("line" + to, line, largest, n);
      JefferiesBeenParameters coupled = line;
      coupled.volumetric_coupling     = 0.4;
      coupled.hardening_modulus       = 200;
      test_returns("N = 0.4" + to, coupled, largest, n);
    }
}

const UnitTest registered("jefferies_been_random", run);
} // namespace test_jefferies_been_random


// Output:
// n = 0, energy: OK
// n = 0.5, energy: OK
// n = 0.9, energy: OK
// derivatives: OK
// derivatives: OK
// line, increments to 0.001000: OK
// N = 0.4, increments to 0.001000: OK
// line, increments to 0.010000: OK
// N = 0.4, increments to 0.010000: OK
// line, increments to 0.100000: OK
// N = 0.4, increments to 0.100000: OK
