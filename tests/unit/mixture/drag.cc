// SPDX-License-Identifier: LGPL-2.1-or-later
// Drag of grains, of a given conductivity (Ergun's: scenes/packed_bed). Soil and water at a node, tied by drag: the
// equations hold for any drag and any walls, momentum is kept, the limits are right; a step whose drag grows with the
// slip.
#include "../test.h"

#include <scree/bodies/phases.h>
#include <scree/boundary/drag_block.h>

namespace test_drag
{
/// The slip of a step solves its equation, for any walls along the axes or along an angle that the slip has, too.
void solve_steps()
{
  RandomNumbers random;
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
      const SoilAndWater<2> r{ random.uniform(-1., 1.) * along + random.uniform(-1., 1.) * across,
                               random.uniform(-1., 1.) * along + random.uniform(-1., 1.) * across };
      const double slip    = pair.slip_speed(r, inertial);
      DragBlock<2> dragged = pair;
      dragged.drag += inertial * slip;
      const SoilAndWater<2> v = dragged.solve(r);
      // Velocities, of which the slip is a difference, are known to 1e-16 of them.
      expect((v.water - v.soil).norm(),
             slip,
             1e-10 * (slip + 1e-3 * (v.water.norm() + v.soil.norm())),
             "slip of a random step");
    }

  // Alone with the square of the slip: w' = -a w^2, of which a step of any length keeps the sign.
  ConstrainedDirections<2> all;
  all.hold_all();
  const DragBlock<2> pair{ 1., 1., 0., all, {} };
  const auto slip_from = [&](const Tensor<1, 2> &water, const double step) {
    return pair.slip_speed({ Tensor<1, 2>(), water }, step);
  };
  expect(slip_from(Tensor<1, 2>({ 1., 0. }), 2.), 0.5, 1e-14, "slip of 1 m/s after 2 s/m");
  expect(slip_from(Tensor<1, 2>({ 0., -1. }), 6.), 1. / 3., 1e-14, "slip of 1 m/s after 6 s/m");
}

/// Holds the axes, turned by an angle, whose bit is set.
void hold(const unsigned int axes, const double angle, ConstrainedDirections<2> &held)
{
  for (unsigned int a = 0; a < 2; ++a)
    if ((axes >> a) & 1)
      held.hold(a == 0 ? Tensor<1, 2>({ std::cos(angle), std::sin(angle) })
                       : Tensor<1, 2>({ -std::sin(angle), std::cos(angle) }));
}

void solve_pairs()
{
  RandomNumbers random;
  for (unsigned int trial = 0; trial < 10000; ++trial)
    {
      const double drag = random.log_uniform(1e-12, 1e12);
      // Walls along the axes, and every other time along axes that are turned.
      const double angle = trial % 32 < 16 ? 0. : random.uniform(0., 6.3);
      DragBlock<2> pair{ random.uniform(1e-6, 2.), random.uniform(1e-6, 2.), drag, {}, {} };
      hold(trial % 4, angle, pair.held_soil);
      hold((trial / 4) % 4, angle, pair.held_water);
      const SoilAndWater<2> r{ random.point<2>(-1., 1.), random.point<2>(-1., 1.) };
      const SoilAndWater<2> v = pair.solve(r), walls = pair.reactions(r, v);
      expect(pair.held_soil.held_part(v.soil).norm(), 0., 1e-9, "motion of soil into walls");
      expect(pair.held_water.held_part(v.water).norm(), 0., 1e-9, "motion of water into walls");
      for (unsigned int c = 0; c < 2; ++c)
        {
          const double v_s = v.soil[c], v_w = v.water[c], wall_s = walls.soil[c], wall_w = walls.water[c];
          // Relative to what is subtracted: with much drag both velocities are nearly one.
          const double scale =
              1. + drag * (angle == 0. ? std::abs(v_s) + std::abs(v_w) : v.soil.norm() + v.water.norm());
          expect(pair.soil_mass * v_s + drag * (v_s - v_w), r.soil[c] + wall_s, 1e-12 * scale, "equation of soil");
          expect(pair.water_mass * v_w + drag * (v_w - v_s), r.water[c] + wall_w, 1e-12 * scale, "equation of water");
          expect(pair.soil_mass * v_s + pair.water_mass * v_w,
                 r.soil[c] + r.water[c] + wall_s + wall_w,
                 1e-12 * (scale + std::abs(wall_s) + std::abs(wall_w)),
                 "momentum");
        }
    }

  SoilAndWater<2> r;
  r.soil[0]          = 3.;
  r.water[0]         = -1.;
  const auto no_wall = ConstrainedDirections<2>();
  const auto compare = [](const DragBlock<2> &pair, const SoilAndWater<2> &r, const double soil, const double water) {
    const SoilAndWater<2> v = pair.solve(r);
    expect(v.soil[0], soil, 1e-14, "velocity of soil");
    expect(v.water[0], water, 1e-14, "velocity of water");
  };
  compare({ 2., 1., 0., no_wall, no_wall }, r, 1.5, -1.);             // no drag
  compare({ 2., 1., 1e300, no_wall, no_wall }, r, 2. / 3., 2. / 3.);  // endless drag
  compare({ 2., 0., 0., no_wall, no_wall }, { r.soil, {} }, 1.5, 0.); // soil alone
  ConstrainedDirections<2> wall;
  hold(1, 0., wall);
  compare({ 2., 1., 3., wall, no_wall }, r, 0., -0.25); // soil fixed along x
}

const UnitTest registered("drag", [] {
  WaterParameters water;
  water.conductivity = 2e-2;
  expect(DragLaw(water, 0.4).conductivity(0.5), 2e-2, 1e-16, "constant conductivity");
  expect(DragLaw(water, 0.4).inertial(0.4), 0., 0., "its drag with the square of the slip");
  water.conductivity_law = "Kozeny-Carman";
  expect(DragLaw(water, 0.4).conductivity(0.4), 2e-2, 1e-16, "Kozeny-Carman at the start");
  expect(DragLaw(water, 0.4).conductivity(0.5), 5.625e-2, 1e-15, "Kozeny-Carman, looser");
  solve_steps();
  solve_pairs();
});
} // namespace test_drag
