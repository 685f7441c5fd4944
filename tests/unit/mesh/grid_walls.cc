// SPDX-License-Identifier: LGPL-2.1-or-later
// Walls: what each does to the velocity of a node, of soil and of water; walls oblique to the axes and Coulomb's law; a
// gate.
#include "../test.h"

#include <scree/boundary/constraints.h>

namespace test_grid_walls
{
/// The velocity that the lower x face and the upper y face make of `velocity`.
Tensor<1, 2> after_wall(const std::string &wall, const Tensor<1, 2> &velocity, const std::uint8_t faces)
{
  const GridParameters box;
  BoundaryParameters parameters;
  parameters.texts["Left"] = parameters.texts["Top"] = wall;
  const BackgroundGrid<2> grid(box, MPI_COMM_WORLD);
  Tensor<1, 2> result = velocity;
  NodeConstraints<2> constraints;
  for (const auto &constraint : BoundaryConditions<2>(grid, parameters).constraints(faces))
    constraints.add(constraint);
  constraints.apply(result, constraints.soil_velocity);
  return result;
}

void test_nodes()
{
  const std::uint8_t inner = 0, left = 1 << 0, top = 1 << 3;
  const auto test =
      [](const std::string &wall, const Point<2> &velocity, const std::uint8_t faces, const Point<2> &expected) {
        expect((after_wall(wall, velocity, faces) - expected).norm(), 0, 1e-14, wall + ": error of the velocity");
      };
  for (const std::string wall : { "fixed", "free slip", "friction 45", "open" })
    test(wall, { -2, 3 }, inner, { -2, 3 });
  test("fixed", { -2, 3 }, left, { 0, 0 });
  test("free slip", { -2, 3 }, left, { 0, 3 });
  test("free slip", { -2, 3 }, top, { -2, 0 });
  test("free slip", { -2, 3 }, left | top, { 0, 0 });
  test("open", { -2, 3 }, left | top, { -2, 3 });
  // Coulomb, tan 45 = 1: the wall takes the normal 2 and so 2 of the tangential 3, or all if less is there, or none if
  // the soil lifts off.
  test("friction 45", { -2, 3 }, left, { 0, 1 });
  test("friction 45", { -2, -3 }, left, { 0, -1 });
  test("friction 45", { -2, 1 }, left, { 0, 0 });
  test("friction 45", { 2, 3 }, left, { 2, 3 });
  test("friction 45", { 3, 2 }, top, { 1, 0 });
  test("friction 45", { 3, -2 }, top, { 3, -2 });
}

/// Components that walls hold, pressures that they prescribe, and points that leave, for water and soil.
void test_water()
{
  const BackgroundGrid<3> grid(grid_box<3>(-0.2, 0.8), MPI_COMM_WORLD);
  WaterBoundaryParameters wet;
  wet.texts["Left"]  = "no slip";
  wet.texts["Right"] = "drained 3e3";
  wet.check(3);
  const BoundaryConditions<3> water(grid, wet);
  const std::uint8_t left = 1, right = 2, front = 4, top = 32;
  const auto held = [](const ConstrainedDirections<3> &directions) {
    unsigned int axes = 0;
    for (unsigned int a = 0; a < 3; ++a)
      if (directions.free_part(Point<3>::unit_vector(a)).norm() == 0)
        axes |= 1u << a;
    return axes;
  };
  require(held(water.held_directions(left)) == 7 && held(water.held_directions(front)) == 2 &&
              held(water.held_directions(right | front)) == 2 && held(water.held_directions(top)) == 0,
          "The water's walls hold the wrong components.");
  require((water.open_faces() & (top | left)) != 0 && (water.open_faces() & (left | front)) == 0 && water.is_open(1) &&
              !water.is_open(0),
          "The wrong walls are drained.");
  require(water.pressure(right, 0.) == 3000 && water.pressure(top, 0.) == 0 &&
              water.pressure(right | top, 0.) == 1500 && water.pressure(left, 0.) == 0,
          "The drained walls have a wrong pressure.");
  WaterBoundaryParameters with_level;
  with_level.texts["Right"] = "drained level 0.5 - 0.1*t";
  BoundaryConditions<3> falling(grid, with_level, 1e4);
  falling.set_time(2.);
  require(std::abs(falling.pressure(right, 0.1) - 2000.) < 1e-9 && falling.pressure(right, 0.4) == 0. &&
              falling.holds_pressure(1) && falling.has_pressure() && !falling.holds_pressure(5),
          "A wall with a level that falls has a wrong pressure.");
  require(water.face_crossed(Point<3>(0, 0, 0.9)) == std::make_pair(std::string("Top"), true) &&
              water.face_crossed(Point<3>(0, -0.3, 0.801)) == std::make_pair(std::string("Front"), false),
          "A point left through another face.");

  BoundaryParameters dry;
  dry.texts["Left"] = "fixed";
  dry.texts["Back"] = "friction 30";
  const BoundaryConditions<3> soil(grid, dry);
  const std::uint8_t back = 8;
  const auto of_faces     = [&](const std::uint8_t faces) {
    NodeConstraints<3> constraints;
    for (const auto &constraint : soil.constraints(faces))
      constraints.add(constraint);
    return constraints;
  };
  require(held(of_faces(left | back).soil_constraint) == 7 && held(of_faces(right | top).soil_constraint) == 1 &&
              held(of_faces(back | top).soil_constraint) == 0,
          "The soil's walls hold the wrong components.");
  const auto friction = soil.constraints(back | top);
  require(friction.size() == 1 && friction[0].type == NodeConstraint<3>::Type::unilateral &&
              (friction[0].normal == Tensor<1, 3>({ 0., -1., 0. })) && !of_faces(top).any(),
          "The wrong walls have friction.");
}

/// Coulomb's law; walls that are oblique to the axes; a gate that is closed and opened, and does not mind a new
/// partition.
void test_constraints()
{
  const Tensor<1, 2> needed({ 3., -4. });
  const auto slides = coulomb_friction(needed, 1.), sticks = coulomb_friction(needed, 6.);
  require(!slides.sticks && (slides.impulse - 0.2 * needed).norm() < 1e-14 && sticks.sticks &&
              sticks.impulse == needed && coulomb_friction(Tensor<1, 2>(), 0.).impulse.norm() == 0,
          "This is not Coulomb's law.");

  // What a wall along an axis does, turned.
  const double angle = 0.6, mu = 0.5;
  const Tensor<1, 2> normal({ -std::sin(angle), std::cos(angle) }), along({ std::cos(angle), std::sin(angle) });
  using Type            = NodeConstraint<2>::Type;
  const auto after_wall = [&](const Type type, Tensor<1, 2> velocity) {
    NodeConstraints<2> constraints;
    constraints.add({ normal, type, mu });
    constraints.apply(velocity, constraints.soil_velocity);
    return velocity;
  };
  const auto is = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b) { return (a - b).norm() < 1e-14; };
  require(is(after_wall(Type::fixed, 2. * normal + 3. * along), 3. * along) &&
              is(after_wall(Type::unilateral, 2. * normal + 3. * along), 2. * normal + 3. * along) &&
              is(after_wall(Type::unilateral, -2. * normal + 3. * along), 2. * along) &&
              is(after_wall(Type::unilateral, -2. * normal + 0.9 * along), Tensor<1, 2>()),
          "An oblique wall acts otherwise.");
  ConstrainedDirections<2> held;
  held.hold(normal);
  held.hold((normal + along) / std::sqrt(2.));
  require(held.free_part(needed).norm() < 1e-14, "Two walls leave something free in the plane.");

  BackgroundGrid<2> grid(GridParameters(), MPI_COMM_WORLD);
  const BoundaryConditions<2> walls(grid, BoundaryParameters());
  Constraints<2> constraints(grid, walls, nullptr);
  const auto n_held = [&] {
    unsigned int n = 0;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (const auto *at = constraints.at(node))
        n += at->soil_constraint.free_part(Tensor<1, 2>({ 1., 2. })).norm() == 0;
    return Utilities::MPI::sum(n, MPI_COMM_WORLD);
  };
  const unsigned int open = n_held();
  constraints.close_gate(std::make_unique<Region<2>>("gate", "x > 0.5"));
  const unsigned int closed = n_held();
  grid.change_cells(nullptr);
  grid.distribute_nodes();
  constraints.reinit();
  require(open == 12 && closed == 78 && closed == n_held(), "The gate does not hold.");
  constraints.open_gate();
  require(open == n_held(), "The gate does not open.");
}


const UnitTest registered("grid_walls", [] {
  test_nodes();
  test_water();
  test_constraints();
});
} // namespace test_grid_walls

// Runs with mpirun=1,2.
