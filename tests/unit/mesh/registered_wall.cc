// SPDX-License-Identifier: LGPL-2.1-or-later
// A wall type of one file: registered here, entries may have it with numbers in its range, and it acts on the nodes.
#include "../test.h"

#include <scree/boundary/constraints.h>

namespace test_registered_wall
{
/// Soil that touches it does not move along it, but may lift off; unlike `fixed`, it does not hold soil back.
const RegisterWallType registered("Boundaries",
                                  { "rough",
                                    "PERCENT of a friction of 45 degrees (0 to below 200)",
                                    [](const double percent) {
                                      return Wall{ Wall::Holds::normal, true, percent / 100. };
                                    },
                                    0.,
                                    200. });


void run()
{
  const BackgroundGrid<2> grid(GridParameters(), MPI_COMM_WORLD);
  BoundaryParameters parameters;
  const std::uint8_t left  = 1 << 0;
  parameters.texts["Left"] = "rough 50";
  const BoundaryConditions<2> walls(grid, parameters);
  NodeConstraints<2> node;
  for (const auto &constraint : walls.constraints(left))
    node.add(constraint);
  const auto after_wall = [&](Tensor<1, 2> velocity) {
    node.apply(velocity, node.soil_velocity);
    return velocity;
  };
  expect((after_wall(Point<2>(-2, 3)) - Point<2>(0, 2)).norm(), 0., 1e-14, "error of the velocity, pressed");
  expect((after_wall(Point<2>(2, 3)) - Point<2>(2, 3)).norm(), 0., 0., "error of the velocity, lifted off");
  require(walls.closed_faces() & left, "Points may leave.");
  require(walls.bearing_faces(left).of_axis == std::array<unsigned int, 2>({ { 0, 0 } }), "It takes no impulses.");

  for (const std::string wrong : { "rough", "rough 200", "rough -1", "rougher 1", "rough one" })
    {
      parameters.texts["Left"] = wrong;
      expect_refusal([&] { parameters.check(2); }, "| rough PERCENT", "wall " + wrong);
    }
}

const UnitTest registered_test("registered_wall", run);
} // namespace test_registered_wall
