// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil and water at a node, tied by drag: the equations hold for any drag and any walls, momentum is kept, the limits
// are right.
#include <scree/boundary/drag_block.h>

#include <cmath>
#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_drag_pair
{
using namespace dealii;
using namespace scree;

/// Holds the axes, turned by an angle, whose bit is set.
void hold(const unsigned int axes, const double angle, ConstrainedDirections<2> &held)
{
  for (unsigned int a = 0; a < 2; ++a)
    if ((axes >> a) & 1)
      held.hold(a == 0 ? Tensor<1, 2>({ std::cos(angle), std::sin(angle) })
                       : Tensor<1, 2>({ -std::sin(angle), std::cos(angle) }));
}

void run()
{
  RandomNumbers random;
  double residual = 0, momentum = 0, slip = 0;
  for (unsigned int trial = 0; trial < 10000; ++trial)
    {
      const double drag = random.log_uniform(1e-12, 1e12);
      // Walls along the axes, and every other time along axes that are turned.
      const double angle = trial % 32 < 16 ? 0. : random.uniform(0., 6.3);
      DragBlock<2> pair{ random.uniform(1e-6, 2.), random.uniform(1e-6, 2.), drag, {}, {} };
      hold(trial % 4, angle, pair.held_soil);
      hold((trial / 4) % 4, angle, pair.held_water);
      SoilAndWater<2> r;
      for (unsigned int c = 0; c < 2; ++c)
        {
          r.soil[c]  = random.uniform(-1., 1.);
          r.water[c] = random.uniform(-1., 1.);
        }
      const SoilAndWater<2> v = pair.solve(r), walls = pair.reactions(r, v);
      const Tensor<1, 2> &r_s = r.soil, &r_w = r.water, &v_s = v.soil, &v_w = v.water;
      const Tensor<1, 2> &wall_s = walls.soil, &wall_w = walls.water;
      slip = std::max({ slip, pair.held_soil.held_part(v_s).norm(), pair.held_water.held_part(v_w).norm() });
      for (unsigned int c = 0; c < 2; ++c)
        {
          // Relative to what is subtracted: with much drag both velocities are nearly one.
          const double scale =
              1. + drag * (angle == 0. ? std::abs(v_s[c]) + std::abs(v_w[c]) : v_s.norm() + v_w.norm());
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
            << ", momentum is kept: " << (momentum < 1e-12 ? "yes" : "NO")
            << ", nothing moves into walls: " << (slip < 1e-9 ? "yes" : "NO") << std::endl;

  SoilAndWater<2> r;
  r.soil[0]          = 3.;
  r.water[0]         = -1.;
  const auto no_wall = ConstrainedDirections<2>();
  SoilAndWater<2> v  = DragBlock<2>{ 2., 1., 0., no_wall, no_wall }.solve(r);
  std::cout << "no drag: " << v.soil[0] << ' ' << v.water[0] << std::endl;
  v = DragBlock<2>{ 2., 1., 1e300, no_wall, no_wall }.solve(r);
  std::cout << "endless drag: " << 3. * v.soil[0] << ' ' << 3. * v.water[0] << std::endl;
  v = DragBlock<2>{ 2., 0., 0., no_wall, no_wall }.solve({ r.soil, Tensor<1, 2>() });
  std::cout << "soil alone: " << v.soil[0] << ' ' << v.water[0] << std::endl;
  ConstrainedDirections<2> wall;
  hold(1, 0., wall);
  v = DragBlock<2>{ 2., 1., 3., wall, no_wall }.solve(r);
  std::cout << "soil fixed along x: " << v.soil[0] << ' ' << v.water[0] << std::endl;
}

const UnitTest registered("drag_pair", run);
} // namespace test_drag_pair


// Output:
// 10000 random pairs: equations hold: yes, momentum is kept: yes, nothing moves into walls: yes
// no drag: 1.5 -1
// endless drag: 2 2
// soil alone: 1.5 0
// soil fixed along x: 0 -0.25
