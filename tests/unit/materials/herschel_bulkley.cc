// SPDX-License-Identifier: LGPL-2.1-or-later

// A layer of mud flows down a plane: a column of points with explicit steps, against the closed form
// u = (rho g sin/K)^(1/n) [z_y^(1/n + 1) - (z_y - z)^(1/n + 1)]/(1/n + 1) below a plug of tau_y/(rho g sin).

#include <scree/materials/laws/tresca.h>

#include <iostream>

#include "../expect.h"
#include "../unit_test.h"

namespace test_herschel_bulkley
{
using namespace dealii;
using namespace scree;

constexpr double density = 1500, height = 2, yield_stress = 6e3;        // kg/m^3, m, Pa
const double pull = density * 9.81 * std::sin(15. / 180 * numbers::PI); // Pa/m

HerschelBulkleyParameters mud(const double consistency, const double index)
{
  HerschelBulkleyParameters parameters;
  parameters.yield_stress    = yield_stress;
  parameters.consistency     = consistency;
  parameters.index           = index;
  parameters.tension_cut_off = 1e9; // the column has no pressure
  return parameters;
}


/// Closed form, m/s.
double exact(const HerschelBulkleyParameters &mud, const double z)
{
  const double power = 1 / mud.index + 1, sheared = height - yield_stress / pull;
  return std::pow(pull / mud.consistency, 1 / mud.index) *
         (std::pow(sheared, power) - std::pow(std::max(0., sheared - z), power)) / power;
}


/// The column from rest: velocities of the `n` layers' upper sides after `time`, in steps of half a shear wave.
std::vector<double> march(const HerschelBulkleyParameters &mud, const unsigned int n, const double time)
{
  constexpr unsigned int n_components = 4, n_internal = 4, stride = 2 * n_components + n_internal, shear = 3;
  const HenckyMaterial<2, Tresca> law{ Tresca(mud) };
  std::vector<double> points(n * stride), increment(4 * n, 0.), one(n, 1.), velocity(n + 1, 0.);
  for (unsigned int p = 0; p < n; ++p)
    {
      double *record = &points[p * stride], stress[n_components] = {};
      record[stride - 1] = yield_stress;
      law.initialise(stress, record, record + n_components, record + 2 * n_components);
    }
  const double size = height / n, step = 0.5 * size / std::sqrt(law.shear_modulus() / density);
  UpdateReport report;
  for (double t = 0; t < time; t += step)
    {
      for (unsigned int p = 0; p < n; ++p)
        {
          increment[p] = increment[3 * n + p] = 1;
          increment[n + p]                    = step * (velocity[p + 1] - velocity[p]) / size;
        }
      const MaterialMotion<2> motion{ increment.data(), one.data(), one.data(), one.data(), n, step };
      law.update({ n, stride, &points[0], &points[n_components], &points[2 * n_components] }, motion, report);
      for (unsigned int p = 0; p < n; ++p)
        {
          const bool is_top  = p + 1 == n;
          const double below = points[p * stride + n_components + shear];
          const double above = is_top ? 0. : points[(p + 1) * stride + n_components + shear];
          const double mass  = density * size * (is_top ? 0.5 : 1.);
          velocity[p + 1] += step * (pull / density + (above - below) / mass);
        }
    }
  velocity.erase(velocity.begin());
  return velocity;
}


void test(const double consistency, const double index)
{
  constexpr unsigned int n                   = 80;
  constexpr double time                      = 12; // s
  const HerschelBulkleyParameters parameters = mud(consistency, index);
  const std::vector<double> found            = march(parameters, n, time);
  const double plug                          = exact(parameters, height);
  double square = 0, sum = 0, sheared = 0;
  for (unsigned int p = 0; p < n; ++p)
    {
      const double value = exact(parameters, height * (p + 1) / n);
      square += (found[p] - value) * (found[p] - value);
      sum += value * value;
      sheared = found[p] < found[n - 1] - 1e-3 * plug ? height * (p + 1) / n : sheared;
    }
  expect(found[n - 1] / plug, 1, 1e-2, "velocity of the plug");
  expect(std::sqrt(square / sum), 0, 1e-2, "profile");
  if (index == 1) // a profile of a higher power ends less clearly
    expect(height - sheared, yield_stress / pull, 2. * height / n, "thickness of the plug");
  std::cout << "K = " << consistency << ", n = " << index << ": OK" << std::endl;
}


void run()
{
  expect(exact(mud(2e3, 1), height), 0.1716, 5e-5, "closed form, n = 1");
  expect(exact(mud(2e3, 0.5), height), 0.0925, 5e-5, "closed form, n = 0.5");
  expect(yield_stress / pull, 1.575, 5e-4, "closed form, plug");
  test(2e3, 1);
  test(2e3, 0.5);
  test(2e4, 1); // an explicit viscous force would need steps a thirtieth as long
}

const UnitTest registered("herschel_bulkley", run);
} // namespace test_herschel_bulkley


// Output:
// K = 2000, n = 1: OK
// K = 2000, n = 0.5: OK
// K = 20000, n = 1: OK
