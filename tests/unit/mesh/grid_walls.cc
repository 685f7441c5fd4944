// SPDX-License-Identifier: LGPL-2.1-or-later

// Walls: what each does to the velocity of a node, of soil and of water; walls oblique to the axes and Coulomb's law; a
// gate; a block that slides on friction; points that leave.

#include <scree/materials/laws/linear_elastic.h>
#include <scree/boundary/constraints.h>
#include <scree/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>

#include "../grid_box.h"
#include "../unit_test.h"

namespace test_grid_walls
{
using namespace dealii;
using namespace scree;

/// The velocity that the lower x face and the upper y face make of `velocity`.
Tensor<1, 2> after_wall(const std::string &wall, const Tensor<1, 2> &velocity, const std::uint8_t faces)
{
  const GridParameters box;
  BoundaryParameters parameters;
  parameters.left = parameters.top = wall;
  const BackgroundGrid<2> grid(box, MPI_COMM_WORLD);
  Tensor<1, 2> result = velocity;
  NodeConstraints<2> constraints;
  for (const auto &constraint : BoundaryConditions<2>(grid, parameters).constraints(faces))
    constraints.add(constraint);
  constraints.apply(result, constraints.soil_velocity);
  return result;
}

void expect(const std::string &wall,
            const Tensor<1, 2> &velocity,
            const std::uint8_t faces,
            const Tensor<1, 2> &expected)
{
  const Tensor<1, 2> result = after_wall(wall, velocity, faces);
  AssertThrow((result - expected).norm() < 1e-14,
              ExcMessage(wall + ": " + Utilities::to_string(result[0]) + ", " + Utilities::to_string(result[1])));
}

void test_nodes()
{
  const auto v             = [](const double x, const double y) { return Tensor<1, 2>({ x, y }); };
  const std::uint8_t inner = 0, left = 1 << 0, top = 1 << 3;
  for (const std::string wall : { "fixed", "free slip", "friction 45", "open" })
    expect(wall, v(-2, 3), inner, v(-2, 3));
  expect("fixed", v(-2, 3), left, v(0, 0));
  expect("free slip", v(-2, 3), left, v(0, 3));
  expect("free slip", v(-2, 3), top, v(-2, 0));
  expect("free slip", v(-2, 3), left | top, v(0, 0));
  expect("open", v(-2, 3), left | top, v(-2, 3));
  // Coulomb, tan 45 = 1: the wall takes the normal 2 and so 2 of the tangential 3, or all if less is there, or none if
  // the soil lifts off.
  expect("friction 45", v(-2, 3), left, v(0, 1));
  expect("friction 45", v(-2, -3), left, v(0, -1));
  expect("friction 45", v(-2, 1), left, v(0, 0));
  expect("friction 45", v(2, 3), left, v(2, 3));
  expect("friction 45", v(3, 2), top, v(1, 0));
  expect("friction 45", v(3, -2), top, v(3, -2));
  std::cout << "nodes: OK" << std::endl;
}

/// Components that walls hold, pressures that they prescribe, and points that leave, for water and soil.
void test_water()
{
  const BackgroundGrid<3> grid(grid_box<3>(-0.2, 0.8), MPI_COMM_WORLD);
  WaterBoundaryParameters wet;
  wet.left  = "no slip";
  wet.right = "drained 3e3";
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
  AssertThrow(held(water.held_directions(left)) == 7 && held(water.held_directions(front)) == 2 &&
                  held(water.held_directions(right | front)) == 2 && held(water.held_directions(top)) == 0,
              ExcMessage("The water's walls hold the wrong components."));
  AssertThrow((water.open_faces() & (top | left)) != 0 && (water.open_faces() & (left | front)) == 0 &&
                  water.is_open(1) && !water.is_open(0),
              ExcMessage("The wrong walls are drained."));
  AssertThrow(water.pressure(right) == 3000 && water.pressure(top) == 0 && water.pressure(right | top) == 1500 &&
                  water.pressure(left) == 0,
              ExcMessage("The drained walls have a wrong pressure."));
  AssertThrow(water.face_crossed(Point<3>(0, 0, 0.9)) == std::make_pair(std::string("Top"), true) &&
                  water.face_crossed(Point<3>(0, -0.3, 0.801)) == std::make_pair(std::string("Front"), false),
              ExcMessage("A point left through another face."));

  BoundaryParameters dry;
  dry.left = "fixed";
  dry.back = "friction 30";
  const BoundaryConditions<3> soil(grid, dry);
  const std::uint8_t back = 8;
  const auto of_faces     = [&](const std::uint8_t faces) {
    NodeConstraints<3> constraints;
    for (const auto &constraint : soil.constraints(faces))
      constraints.add(constraint);
    return constraints;
  };
  AssertThrow(held(of_faces(left | back).soil_constraint) == 7 && held(of_faces(right | top).soil_constraint) == 1 &&
                  held(of_faces(back | top).soil_constraint) == 0,
              ExcMessage("The soil's walls hold the wrong components."));
  const auto friction = soil.constraints(back | top);
  AssertThrow(friction.size() == 1 && friction[0].type == NodeConstraint<3>::Type::unilateral &&
                  (friction[0].normal == Tensor<1, 3>({ 0., -1., 0. })) && !of_faces(top).any(),
              ExcMessage("The wrong walls have friction."));
  std::cout << "water: OK" << std::endl;
}

/// Coulomb's law; walls that are oblique to the axes; a gate that is closed and opened, and does not mind a new
/// partition.
void test_constraints()
{
  const Tensor<1, 2> needed({ 3., -4. });
  const auto slides = coulomb_friction(needed, 1.), sticks = coulomb_friction(needed, 6.);
  AssertThrow(!slides.sticks && (slides.impulse - 0.2 * needed).norm() < 1e-14 && sticks.sticks &&
                  sticks.impulse == needed && coulomb_friction(Tensor<1, 2>(), 0.).impulse.norm() == 0,
              ExcMessage("This is not Coulomb's law."));

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
  AssertThrow(is(after_wall(Type::fixed, 2. * normal + 3. * along), 3. * along) &&
                  is(after_wall(Type::unilateral, 2. * normal + 3. * along), 2. * normal + 3. * along) &&
                  is(after_wall(Type::unilateral, -2. * normal + 3. * along), 2. * along) &&
                  is(after_wall(Type::unilateral, -2. * normal + 0.9 * along), Tensor<1, 2>()),
              ExcMessage("An oblique wall acts otherwise."));
  ConstrainedDirections<2> held;
  held.hold(normal);
  held.hold((normal + along) / std::sqrt(2.));
  AssertThrow(held.free_part(needed).norm() < 1e-14, ExcMessage("Two walls leave something free in the plane."));

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
  grid.triangulation().repartition();
  grid.distribute_nodes();
  constraints.reinit();
  AssertThrow(closed == n_held() && closed > open + 50, ExcMessage("The gate does not hold."));
  constraints.open_gate();
  AssertThrow(open == n_held(), ExcMessage("The gate does not open."));
  std::cout << "constraints: OK, " << open << " nodes held, " << closed << " with a gate" << std::endl;
}

/// A block of elastic soil, 0.4 m x 0.2 m, on the bottom of a wide box.
void set_block(Parameters &parameters)
{
  parameters.output_directory                               = "results";
  parameters.output.graphics                                = "none";
  parameters.output.screen                                  = "nothing";
  parameters.end_time                                       = 0.2;
  parameters.transfer.method                                = "FLIP";
  parameters.transfer.pic_rate                              = 0;
  parameters.stabilisation.f_bar                            = "none";
  parameters.grid.upper_corner                              = { 2., 0.5 };
  auto &body                                                = parameters.bodies[0];
  body.material.law                                         = "linear elastic";
  body.material.of<LinearElasticParameters>().young_modulus = 1e6;
  body.material.of<LinearElasticParameters>().poisson_ratio = 0.;
  body.seeding.points_per_cell                              = 4;
  body.seeding.grain_density                                = 2000;
  body.seeding.region                                       = "x > 0.3 && x < 0.7 && y < 0.2";
}

/// The rows of the statistics, by column.
std::vector<std::map<std::string, double>> rows()
{
  std::ifstream in("results/statistics");
  std::vector<std::string> columns;
  std::vector<std::map<std::string, double>> result;
  for (std::string line; std::getline(in, line);)
    if (line[0] == '#')
      columns.push_back(line.substr(line.find(": ") + 2));
    else
      {
        std::istringstream numbers(line);
        result.emplace_back();
        for (const auto &column : columns)
          numbers >> result.back()[column];
      }
  return result;
}

/// By how much a column falls below what it was in a row before.
double largest_fall(const std::string &column)
{
  double largest = 0., top = -std::numeric_limits<double>::infinity();
  for (auto &row : rows())
    {
      top     = std::max(top, row[column]);
      largest = std::max(largest, top - row[column]);
    }
  return largest;
}

/// A block slides on a wall with friction, and is slowed down by the coefficient times gravity.
void test_friction()
{
  Parameters parameters;
  set_block(parameters);
  parameters.boundaries.bottom                  = "friction 20";
  parameters.bodies[0].seeding.initial_velocity = "3; 0";
  parameters.bodies[0].initial_state.type       = "K0";
  parameters.bodies[0].initial_state.k0         = "0";
  Simulation<2>(parameters, Start::fresh, MPI_COMM_WORLD).run();
  MPI_Barrier(MPI_COMM_WORLD);

  auto row                  = rows().back();
  const double deceleration = (3. - row["Momentum x (N s)"] / row["Mass (kg)"]) / parameters.end_time;
  const double expected     = std::tan(20. * numbers::PI / 180.) * 9.81;
  // 2 %: the block is elastic and bounces a little.
  AssertThrow(std::abs(deceleration / expected - 1.) < 0.02,
              ExcMessage("The block slows down by " + Utilities::to_string(deceleration) + " instead of " +
                         Utilities::to_string(expected) + " m/s^2"));
  // What the block loses, the wall takes.
  const double work = row["Wall dissipation (J)"], lost = 0.5 * row["Mass (kg)"] * 9. - row["Kinetic energy (J)"];
  AssertThrow(std::abs(work / lost - 1.) < 0.02,
              ExcMessage("The wall takes " + Utilities::to_string(work) + " J of " + Utilities::to_string(lost)));
  AssertThrow(row["Momentum residual (N s)"] < 1e-12 * row["Mass (kg)"], ExcMessage("Momentum does not balance."));
  std::cout << "friction: OK, " << deceleration / expected << ", wall takes " << work / lost << std::endl;
}

/// A block flies through an open wall: what has left is counted, nothing else is missing.
void test_open()
{
  Parameters parameters;
  set_block(parameters);
  parameters.boundaries.left                    = "open";
  parameters.gravity                            = { 0., 0. };
  parameters.boundaries.bottom                  = "free slip";
  parameters.bodies[0].seeding.initial_velocity = "-2.5; 0";
  Simulation<2> simulation(parameters, Start::fresh, MPI_COMM_WORLD);
  simulation.run();
  MPI_Barrier(MPI_COMM_WORLD);

  auto row         = rows().back();
  const double all = 2000 * 0.4 * 0.2, n_all = 16 * 8;
  AssertThrow(row["Points lost"] > 0 && row["Points"] > 0, ExcMessage("Half the block should have left."));
  AssertThrow(row["Points"] + row["Points lost"] == n_all, ExcMessage("Points vanish."));
  AssertThrow(std::abs(row["Mass (kg)"] + row["Mass lost (kg)"] - all) < 1e-11 * all, ExcMessage("Mass vanishes."));
  AssertThrow(row["Momentum residual (N s)"] < 1e-12 * all * 2.5, ExcMessage("Momentum does not balance."));
  std::cout << "open: OK, " << row["Points lost"] << " points left" << std::endl;
}

/// Through a closed wall no point may leave: a block that runs into a fixed wall rebounds. The wall takes what it stops
/// at the nodes, and not what the block's stress brings there for a while.
void test_fixed()
{
  Parameters parameters;
  set_block(parameters);
  parameters.boundaries.left                    = "fixed";
  parameters.gravity                            = { 0., 0. };
  parameters.boundaries.bottom                  = "free slip";
  parameters.bodies[0].seeding.initial_velocity = "-2.5; 0";
  parameters.output.statistics_interval         = 0.001;
  Simulation<2>(parameters, Start::fresh, MPI_COMM_WORLD).run();
  MPI_Barrier(MPI_COMM_WORLD);

  auto row = rows().back();
  AssertThrow(row["Points lost"] == 0 && row["Points"] == 128, ExcMessage("A point went through a wall."));
  // The elastic block rebounds, on the wall that gave it at least its momentum.
  const double restitution = row["Momentum x (N s)"] / row["Mass (kg)"] / 2.5;
  AssertThrow(restitution > 0 && restitution < 1, ExcMessage("The block does not rebound."));
  AssertThrow(row["Momentum residual (N s)"] < 1e-12 * row["Mass (kg)"] * 2.5,
              ExcMessage("Momentum does not balance."));
  const double brought = row["Mass (kg)"] * 0.5 * 6.25;
  AssertThrow(row["Wall dissipation (J)"] > 0 && row["Wall dissipation (J)"] < 0.1 * brought,
              ExcMessage("A wall at rest took " + Utilities::to_string(row["Wall dissipation (J)"]) + " J"));
  AssertThrow(largest_fall("Wall dissipation (J)") < 1e-12 * brought, ExcMessage("A wall at rest gives energy."));
  const double made = largest_fall("Numerical dissipation (J)") / brought;
  AssertThrow(made < 2e-3, ExcMessage("The block gains " + Utilities::to_string(made) + " of its energy."));
  std::cout << "fixed: OK, rebound " << restitution << std::endl;
}


void run()
{
  test_nodes();
  test_water();
  test_constraints();
  test_friction();
  test_open();
  test_fixed();
}

const UnitTest registered("grid_walls", run);
} // namespace test_grid_walls


// Output of mpirun=1,2:
// nodes: OK
// water: OK
// constraints: OK, 12 nodes held, 78 with a gate
// friction: OK, 0.99999, wall takes 0.999404
// open: OK, 64 points left
// fixed: OK, rebound 0.855096
