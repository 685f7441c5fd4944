// SPDX-License-Identifier: LGPL-2.1-or-later
// Viscosity of suspensions against the laws as published, and how much of the soil is one.
#include <scree/bodies/suspension.h>

#include <cmath>
#include <iostream>

#include "../expect.h"

#include "../unit_test.h"

namespace test_suspension
{
using namespace scree;

void run()
{
  SuspensionParameters parameters;
  const double mu = 2e-3; // Pa s
  std::cout << "none: " << Suspension(parameters, mu).any() << ' ' << Suspension(parameters, mu).viscosity(0.3) / mu
            << std::endl;

  parameters.law = "Einstein";
  std::cout << "Einstein, 2 %: " << Suspension(parameters, mu).viscosity(0.02) / mu << std::endl;

  parameters.law             = "Krieger-Dougherty";
  parameters.densest_packing = 0.6;
  const Suspension dense(parameters, mu);
  expect(dense.viscosity(0.3) / mu, std::pow(2., 1.5), 1e-14, "Krieger and Dougherty, half of the densest packing");
  expect((dense.viscosity(1e-5) / mu - 1.) / 2.5e-5, 1., 1e-4, "Krieger and Dougherty's dilute limit over Einstein's");
  expect(dense.viscosity(0.593999) / mu, 1000., 2., "Krieger and Dougherty, just below 0.99 of the densest packing");
  for (const double grains : { 0.594, 0.6, 0.7 })
    expect(dense.viscosity(grains) / mu, 1000., 1e-9, "Krieger and Dougherty, held");

  parameters.contact_pressure = 50.;
  const Suspension suspension(parameters, mu);
  for (const double pressure : { -10., 0., 25., 50., 1e5 })
    std::cout << "part at " << pressure << " Pa: " << suspension.suspended_part(pressure) << std::endl;

  parameters.contact_pressure = 0.;
  std::cout << "without stress only: " << Suspension(parameters, mu).suspended_part(0.) << ' '
            << Suspension(parameters, mu).suspended_part(1e-9) << std::endl;
}

const UnitTest registered("suspension", run);
} // namespace test_suspension
