// SPDX-License-Identifier: LGPL-2.1-or-later
// Nor-Sand (Jefferies-Been): stored energy, derivatives of the residuals, and random returns: never outside the yield
// surface or the cap, never unresolved. Cyclic shear towards the critical void ratio, against an independent program of
// the equations (other paths: tests/element).
#include "one_point.h"

#include <scree/materials/laws/nor_sand.h>

namespace test_jefferies_been
{
using Law = JefferiesBeen;

/// Stress is the derivative of the energy, and the strain of a stress gives that stress back.
void test_energy(const double exponent, RandomNumbers &random)
{
  const PressureElasticity law(80e6, 0.2, exponent, 1e5);
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const double p = random.log_uniform(1e3, 1e6), eta = random.uniform(0., 1.),
                   h = 1e-3 * p / (80e6 * std::pow(p / 1e5, exponent));
      double volume, shear;
      law.strain_of(std::log(p), p, eta, volume, shear);
      const double X = law.opening(volume), found = 3. * law.g * shear / X;
      expect(std::exp(law.log_pressure(X, found)) / p, 1, 1e-11, "p of the strain of p");
      expect(found, eta, 1e-11, "eta of the strain of eta");
      const auto slope = [&](const double of_volume, const double of_shear) {
        const auto energy = [&](const double of_v, const double of_s) {
          return law.energy<double>(volume + of_v, (shear + of_s) * (shear + of_s));
        };
        return (energy(of_volume, of_shear) - energy(-of_volume, -of_shear)) / (2 * h * p);
      };
      expect(slope(h, 0), 1, 1e-5, "dW/de_v over p");
      expect(slope(0, h), eta, 1e-5, "dW/de_s over p");
    }
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
}


/// States of 10 Pa to 10 MPa, psi -.35 to .15, on or inside the yield surface and the cap.
void test_returns(const std::string &name, const JefferiesBeenParameters &parameters, const double largest_strain)
{
  constexpr unsigned int n = 100000; // the documentation has numbers of a million
  RandomNumbers random;              // Each test draws its own: others do not change it.
  const Law law(parameters);
  UpdateReport report;
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
      const auto [lost, scale] = energy_taken(trial, strain, stress);
      require(stress[0] + stress[1] + stress[2] <= 0, name + ": tension");
      require(std::isfinite(internal[0]) && internal[0] > 0 && internal[1] >= 0, name + ": variables");
      if (scale == 0)
        continue;
      require(lost / scale > -1e-10, name + ": energy made");
      // The trial state has the image pressure after the cap.
      const auto now      = law.trial_of(strain, J, internal);
      log_image           = std::log(internal[0]);
      const auto of_image = law.image(now.volume, log_image, now.lode_ratio);
      require(now.eta - of_image.ratio * (1. - now.log_pressure + log_image) < 1e-8, name + ": outside the surface");
      require(log_image - now.log_pressure - of_image.limit < 1e-6, name + ": beyond the cap");
    }
  require(report.n_unresolved == 0, name + ": unresolved " + std::to_string(report.n_unresolved));
  require(n_elastic > 0 && report.n_fallbacks > 0 && report.n_separated > 0, name + ": a branch was not visited");
}


/// A set that lies near the Erksak tests.
JefferiesBeenParameters erksak(const double void_ratio)
{
  JefferiesBeenParameters parameters;
  parameters.critical_stress_ratio = 1.17;
  parameters.volumetric_coupling   = 0.066;
  parameters.state_dilatancy       = 4.28;
  parameters.hardening_modulus     = 77;
  parameters.hardening_slope       = 688;
  parameters.initial_void_ratio    = void_ratio;
  return parameters;
}


/// Cycles of simple shear of +-1 % in plane strain under constant vertical stress; the void ratio after ten of them.
double cyclic_void_ratio(const JefferiesBeenParameters &parameters, const double pressure)
{
  MaterialParameters law;
  law.law                           = "Nor-Sand (Jefferies-Been)";
  law.of<JefferiesBeenParameters>() = parameters;
  const auto material               = make_material<2>(law);
  struct State
  {
    double b[4], stress[4] = {}, internal[2], J = 1;
  } state;
  UpdateReport report;
  const double start[4] = { -pressure, -pressure, -pressure, 0 }, one = 1;
  material->initialise(start, state.b, state.stress, state.internal);
  const auto sheared = [&](const double shear, const double stretch) {
    State next               = state;
    const double increment[] = { 1, shear, 0, 1 + stretch };
    next.J *= 1 + stretch;
    material->update({ 1, 0, next.b, next.stress, next.internal }, { increment, &one, &next.J, &one }, report);
    return next;
  };
  double stretch = 0;
  for (unsigned int step = 0; step < 40000; ++step)
    {
      const double shear = (step % 4000 < 1000 || step % 4000 >= 3000 ? 1 : -1) * 1e-5;
      const auto error   = [&](const double y) { return sheared(shear, y).stress[1] / pressure + 1; };
      double before = stretch - 1e-7, error_before = error(before), error_now = error(stretch);
      for (unsigned int i = 0; i < 40 && std::abs(error_now) > 1e-8 && error_now != error_before; ++i)
        {
          const double next =
              stretch - std::clamp(error_now * (stretch - before) / (error_now - error_before), -1e-5, 1e-5);
          before       = stretch;
          error_before = error_now;
          stretch      = next;
          error_now    = error(stretch);
        }
      state = sheared(shear, stretch);
    }
  require(report.n_unresolved == 0, "Unresolved returns.");
  return (1 + parameters.initial_void_ratio) * state.J - 1;
}


const UnitTest registered("jefferies_been", [] {
  RandomNumbers random;
  for (const double exponent : { 0., 0.5, 0.9 })
    test_energy(exponent, random);
  JefferiesBeenParameters line;
  line.initial_void_ratio = 0.65;
  test_derivatives<Law::Hardening::law>(line, random);
  test_derivatives<Law::Hardening::cap>(line, random);
  for (const double largest : { 1e-3, 1e-2, 1e-1 })
    {
      const std::string to = ", increments to " + std::to_string(largest);
      test_returns("line" + to, line, largest);
      JefferiesBeenParameters coupled = line;
      coupled.volumetric_coupling     = 0.4;
      coupled.hardening_modulus       = 200;
      test_returns("N = 0.4" + to, coupled, largest);
    }

  expect(cyclic_void_ratio(erksak(0.79), 100e3), 0.750, 0.003, "cyclic shear, void ratio from 0.79");
  expect(cyclic_void_ratio(erksak(0.65), 100e3), 0.709, 0.0028, "cyclic shear, void ratio from 0.65");
});
} // namespace test_jefferies_been
