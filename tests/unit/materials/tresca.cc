// SPDX-License-Identifier: LGPL-2.1-or-later
// Tresca and Herschel-Bulkley: random returns against the equations of the strength; shear against
// tau = s_u(gamma - tau/G) and at several rates; strength of the place; strength divided by a factor.
#include "one_point.h"

namespace test_tresca
{
constexpr unsigned int of_place = 3; // internal variable
constexpr double slow           = std::numeric_limits<double>::infinity();

TrescaParameters fast_clay()
{
  TrescaParameters parameters = sensitive_clay();
  parameters.rate_increase    = 0.1;
  return parameters;
}


TrescaParameters mud(const double consistency, const double index)
{
  HerschelBulkleyParameters parameters;
  parameters.strength    = 6e3;
  parameters.consistency = consistency;
  parameters.index       = index;
  return parameters;
}


/// Strength of a point that shears at this rate, Pa.
double strength_at(const TrescaParameters &parameters, const double slow_strength, const double rate)
{
  return slow_strength * (1 + parameters.rate_increase * std::log10(std::max(1., rate / parameters.reference_rate))) +
         parameters.consistency * std::pow(rate, parameters.index);
}


double shear_stress(const PrincipalValues &stress)
{
  return 0.5 * (*std::max_element(stress.begin(), stress.end()) - *std::min_element(stress.begin(), stress.end()));
}


/// Every return meets the equation of the strength at its own plastic shear.
void test_random(const std::string &name, const TrescaParameters &parameters, RandomNumbers &random)
{
  const Tresca law(parameters);
  double strength        = 0;
  unsigned int n_sheared = 0;
  random_returns(
      name,
      law,
      random,
      100000,
      [&](RandomReturn &point) {
        point.internal[2]        = random.uniform(-0.01, 0.5); // kappa
        point.time_step          = random.log_uniform(1e-7, 1e3);
        point.internal[of_place] = random.log_uniform(1e2, 1e5);
        return strength          = law.slow_strength(point.internal);
      },
      [&](const RandomReturn &point) {
        const double scale   = point.scale;
        const double tension = *std::max_element(point.stress.begin(), point.stress.end()) - parameters.tension_cut_off;
        require(tension / scale <= 1e-10, name + ": tension");
        if (!point.is_plastic || tension > -1e-9 * scale) // the cut-off shears, too
          return;
        ++n_sheared;
        // Plastic shear is a difference of stresses, which bounds what is known of it.
        const double found = shear_stress(point.stress), rounding = 1e-14 * scale / law.shear_modulus;
        const auto at = [&](const double shear) {
          return strength_at(parameters, strength, std::max(0., shear) / point.time_step);
        };
        const double low = at(point.internal[1] - rounding), high = at(point.internal[1] + rounding);
        require((low - found) / scale <= 1e-10 && (found - high) / scale <= 1e-10, name + ": strength");
      });
  require(n_sheared > 100000, name + ": shear was not visited");
}


/// Pure shear to `gamma` in `n` steps at a rate, 1/s: shear stress after each, Pa.
std::vector<double>
shear(const TrescaParameters &parameters, const double gamma, const unsigned int n, const double rate)
{
  const Tresca law(parameters);
  PrincipalValues strain{}, stress;
  double internal[4]    = { 0, 0, 0, parameters.strength };
  const double pressure = 1e6; // the law has no friction
  UpdateReport report;
  std::vector<double> result;
  for (double &value : strain)
    value = -pressure / (3 * law.bulk_modulus(0));
  for (unsigned int step = 0; step < n; ++step)
    {
      strain[0] += 0.5 * gamma / n;
      strain[2] -= 0.5 * gamma / n;
      return_point(law, strain, internal, 1, stress, report, rate > 0 ? gamma / n / rate : slow);
      result.push_back(shear_stress(stress));
    }
  return result;
}


void test_rates()
{
  TrescaParameters parameters = fast_clay();
  parameters.sensitivity      = 1;
  for (const double rate : { 3e-6, 3e-4, 3. })
    expect(shear(parameters, 0.2, 1000, rate).back(), 2e4 * (1 + 0.1 * std::log10(rate / 3e-6)), 2., "clay");
  expect(shear(parameters, 0.2, 1000, 1e-8).back(), 2e4, 1e-6, "clay slower than the reference");
  for (const double index : { 0.5, 1., 1.5 })
    for (const double rate : { 0.01, 1. })
      expect(shear(mud(2e3, index), 100 * rate, 10000, rate).back(), 6e3 + 2e3 * std::pow(rate, index), 1e-3, "mud");
  // Viscous beyond all steps: elastic.
  const TrescaParameters stiff = mud(1e15, 1);
  expect(shear(stiff, 0.2, 10, 1).back(), Tresca(stiff).shear_modulus * 0.2, 1e-3, "stiff mud");
}


void test_place()
{
  TrescaParameters parameters  = sensitive_clay();
  parameters.strength_of_place = "1e3 + 2e3*(5 - y) + 100*depth";
  double internal[4]           = {};
  const PlaceVariables<2> values(Tresca(parameters).place_variables, "Soil/Tresca");
  values.set(Point<2>(1., 2.), 3., internal);
  expect(internal[of_place], 7300, 1e-9, "strength of the place");
  parameters.divide_strength(1.6);
  expect(Tresca(parameters).slow_strength(internal), 7300 / 1.6, 1e-9, "divided strength of the place");
  TrescaParameters of_mud = mud(2e3, 1);
  of_mud.divide_strength(2);
  expect(Tresca(of_mud).slow_strength(internal), 7300 / 2., 1e-9, "divided yield stress");
}


const UnitTest registered("tresca", [] {
  RandomNumbers random;
  TrescaParameters with_cut_off = fast_clay();
  with_cut_off.tension_cut_off  = 2e3;
  test_random("slow clay", sensitive_clay(), random);
  test_random("clay", fast_clay(), random);
  test_random("clay with cut-off", with_cut_off, random);
  test_random("mud, n = 0.5", mud(2e3, 0.5), random);
  test_random("mud, n = 1", mud(2e3, 1), random);
  test_random("mud, n = 1.5", mud(2e3, 1.5), random);
  // The remoulding strain is that to 95 % of the fall.
  const TrescaParameters slow_clay = sensitive_clay();
  test_falling_shear(
      Tresca(slow_clay), 0.5, { 2e4, 2e4 / slow_clay.sensitivity, 3 / slow_clay.remoulding_strain }, 1e-2, 0.3);
  test_rates();
  test_place();
});
} // namespace test_tresca
