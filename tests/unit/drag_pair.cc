// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil and water at a node, tied by drag: the equations hold for any drag and any walls, momentum is kept, the limits
// are right.
#include <scree/scheme/drag_pair.h>

#include <cmath>
#include <iostream>

#include "random_numbers.h"

using namespace dealii;
using namespace scree;

int main()
{
  RandomNumbers random;
  double residual = 0, momentum = 0;
  for (unsigned int trial = 0; trial < 10000; ++trial)
    {
      const double drag = random.log_uniform(1e-12, 1e12);
      const DragPair<2> pair{ random.uniform(1e-6, 2.), random.uniform(1e-6, 2.), drag, trial % 4, (trial / 4) % 4 };
      Tensor<1, 2> r_s, r_w, v_s, v_w;
      for (unsigned int c = 0; c < 2; ++c)
        {
          r_s[c] = random.uniform(-1., 1.);
          r_w[c] = random.uniform(-1., 1.);
        }
      pair.solve(r_s, r_w, v_s, v_w);
      const Tensor<1, 2> wall_s = pair.soil_reaction(r_s, v_w), wall_w = pair.water_reaction(r_w, v_s);
      for (unsigned int c = 0; c < 2; ++c)
        {
          // Relative to what is subtracted: with much drag both velocities are nearly one.
          const double scale = 1. + drag * (std::abs(v_s[c]) + std::abs(v_w[c]));
          const double soil  = pair.soil_mass * v_s[c] + drag * (v_s[c] - v_w[c]) - r_s[c] - wall_s[c];
          const double water = pair.water_mass * v_w[c] + drag * (v_w[c] - v_s[c]) - r_w[c] - wall_w[c];
          residual           = std::max({ residual, std::abs(soil) / scale, std::abs(water) / scale });
          momentum           = std::max(
              momentum,
              std::abs(pair.soil_mass * v_s[c] + pair.water_mass * v_w[c] - r_s[c] - r_w[c] - wall_s[c] - wall_w[c]) /
                  (scale + std::abs(wall_s[c]) + std::abs(wall_w[c])));
        }
    }
  std::cout << "10000 random pairs: equations hold: " << (residual < 1e-12 ? "yes" : "NO")
            << ", momentum is kept: " << (momentum < 1e-12 ? "yes" : "NO") << std::endl;

  Tensor<1, 2> r_s, r_w, v_s, v_w;
  r_s[0] = 3.;
  r_w[0] = -1.;
  DragPair<2>{ 2., 1., 0., 0, 0 }.solve(r_s, r_w, v_s, v_w);
  std::cout << "no drag: " << v_s[0] << ' ' << v_w[0] << std::endl;
  DragPair<2>{ 2., 1., 1e300, 0, 0 }.solve(r_s, r_w, v_s, v_w);
  std::cout << "endless drag: " << 3. * v_s[0] << ' ' << 3. * v_w[0] << std::endl;
  DragPair<2>{ 2., 0., 0., 0, 0 }.solve(r_s, Tensor<1, 2>(), v_s, v_w);
  std::cout << "soil alone: " << v_s[0] << ' ' << v_w[0] << std::endl;
  DragPair<2>{ 2., 1., 3., 1, 0 }.solve(r_s, r_w, v_s, v_w);
  std::cout << "soil fixed along x: " << v_s[0] << ' ' << v_w[0] << std::endl;
}
