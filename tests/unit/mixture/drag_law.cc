// SPDX-License-Identifier: LGPL-2.1-or-later
// Drag of grains: Ergun's gradient of the pressure at all speeds, the law of a given conductivity, a step of soil and
// water whose drag grows with the slip.
#include <scree/bodies/drag_law.h>
#include <scree/boundary/drag_block.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_drag_law
{
using namespace dealii;
using namespace scree;

/// Ergun 1952: gradient of the pressure, Pa/m, at a superficial velocity U, m/s.
double ergun(const double n, const double d, const double mu, const double rho, const double U)
{
  return 150. * mu * std::pow(1. - n, 2) / (std::pow(n, 3) * d * d) * U +
         1.75 * rho * (1. - n) / (std::pow(n, 3) * d) * U * U;
}

/// Water flows through grains of 3 mm; the steady gradient is drag over porosity.
void compare_with_ergun(const double n)
{
  WaterParameters water;
  water.density        = 998.;
  water.viscosity      = 1.3e-3;
  water.grain_diameter = 3e-3;
  const DragLaw law(water, 0.4);
  double error = 0;
  for (double U = 1e-8; U < 100.; U *= 2.)
    {
      const double gradient = (law.linear(n) + (1. - n) * law.inertial(n) * U) * U / n;
      error                 = std::max(error, std::abs(gradient / ergun(n, 3e-3, 1.3e-3, 998., U) - 1.));
    }
  std::cout << "n = " << n << ": gradient is Ergun's: " << (error < 1e-14 ? "yes" : "NO")
            << ", conductivity, cm/s: " << 100. * law.conductivity(n) << ", rho_w g/gradient of slow flow, cm/s: "
            << 100. * 998. * 9.81 / (ergun(n, 3e-3, 1.3e-3, 998., 1e-20) / 1e-20) << std::endl;
}

/// The slip of a step solves its equation, for any walls along the axes or along an angle that the slip has, too.
void solve_steps()
{
  RandomNumbers random;
  double error = 0;
  for (unsigned int trial = 0; trial < 10000; ++trial)
    {
      DragBlock<2> pair{ random.uniform(1e-3, 2.), random.uniform(1e-3, 2.), random.log_uniform(1e-9, 1e6), {}, {} };
      const double angle = random.uniform(0., 6.3), inertial = random.log_uniform(1e-9, 1e6);
      const Tensor<1, 2> across({ std::cos(angle), std::sin(angle) }), along({ -across[1], across[0] });
      if (trial % 3 == 1)
        pair.held_soil.hold_all();
      if (trial % 3 == 2)
        {
          pair.held_soil.hold(across);
          pair.held_water.hold(across);
        }
      SoilAndWater<2> r;
      r.soil               = random.uniform(-1., 1.) * along + random.uniform(-1., 1.) * across;
      r.water              = random.uniform(-1., 1.) * along + random.uniform(-1., 1.) * across;
      const double slip    = pair.slip_speed(r, inertial);
      DragBlock<2> dragged = pair;
      dragged.drag += inertial * slip;
      const SoilAndWater<2> v = dragged.solve(r);
      // Velocities, of which the slip is a difference, are known to 1e-16 of them.
      error = std::max(error,
                       std::abs((v.water - v.soil).norm() - slip) / (slip + 1e-3 * (v.water.norm() + v.soil.norm())));
    }
  std::cout << "10000 random pairs: slip of the step: " << (error < 1e-10 ? "yes" : "NO") << std::endl;

  // Alone with the square of the slip: w' = -a w^2, of which a step of any length keeps the sign.
  ConstrainedDirections<2> all;
  all.hold_all();
  const DragBlock<2> pair{ 1., 1., 0., all, {} };
  std::cout << "slip of 1 m/s after a step with a dt of 2 and of 6 s/m: "
            << pair.slip_speed({ Tensor<1, 2>(), Tensor<1, 2>({ 1., 0. }) }, 2.) << ' '
            << pair.slip_speed({ Tensor<1, 2>(), Tensor<1, 2>({ 0., -1. }) }, 6.) << std::endl;
}

void run()
{
  for (const double n : { 0.3, 0.4, 0.9 })
    compare_with_ergun(n);

  WaterParameters water;
  water.conductivity = 2e-2;
  std::cout << "constant: " << 100. * DragLaw(water, 0.4).conductivity(0.5) << " cm/s, inertial "
            << DragLaw(water, 0.4).inertial(0.4) << std::endl;
  water.conductivity_law = "Kozeny-Carman";
  std::cout << "Kozeny-Carman: " << 100. * DragLaw(water, 0.4).conductivity(0.4) << " cm/s at the start, "
            << 100. * DragLaw(water, 0.4).conductivity(0.5) << " cm/s looser" << std::endl;
  solve_steps();
}

const UnitTest registered("drag_law", run);
} // namespace test_drag_law


// Output:
// n = 0.3: gradient is Ergun's: yes, conductivity, cm/s: 2.48986, rho_w g/gradient of slow flow, cm/s: 2.48986
// n = 0.4: gradient is Ergun's: yes, conductivity, cm/s: 8.03313, rho_w g/gradient of slow flow, cm/s: 8.03313
// n = 0.9: gradient is Ergun's: yes, conductivity, cm/s: 3294.09, rho_w g/gradient of slow flow, cm/s: 3294.09
// constant: 2 cm/s, inertial 0
// Kozeny-Carman: 2 cm/s at the start, 5.625 cm/s looser
// 10000 random pairs: slip of the step: yes
// slip of 1 m/s after a step with a dt of 2 and of 6 s/m: 0.5 0.333333
