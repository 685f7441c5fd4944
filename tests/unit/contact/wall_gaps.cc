// SPDX-License-Identifier: LGPL-2.1-or-later
// Walls of a wet scene and what falls on them: which walls act where a point has reached one, two or no wall; that they
// act on what is slow; the speed at which a gap closes within a step; a full cell has no gap; a gate holds whatever is
// near; afterwards all walls act again; points just outside come back, through closed faces only.
#include "../test.h"

#include <scree/seeding/seeding.h>
#include <scree/contact/cut_cells/move_inside.h>
#include <scree/boundary/wall_gaps.h>
#include <scree/transfer/water_transfer.h>

namespace test_wall_gaps
{
/// A box of 8 x 8 cells, 1 m wide, all of whose walls are fixed, with 2 points a cell along each axis: a point reaches
/// .3 cells.
struct Box
{
  static constexpr double h = 0.125, reach = 0.3 * h;

  Box()
  {
    forcing.set_start();
    gaps.add({ &soil, &water });
  }

  static BoundaryParameters boundaries()
  {
    BoundaryParameters result;
    for (auto &[face, wall] : result.texts)
      wall = face == "Front" || face == "Back" ? wall : "fixed";
    return result;
  }

  /// A point, m, whichever rank has its cell; all nodes around it move at `velocity`, m/s, with 3 kg of soil and 1 kg
  /// of water. A force accelerates the soil, m/s^2.
  void add(const Point<2> &x, const Tensor<1, 2> &velocity, const Tensor<1, 2> &acceleration = {})
  {
    add_point(points, grid, x, { 0. });
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      {
        soil[node][NodalField<2>::mass]  = 3.;
        water[node][NodalField<2>::mass] = 1.;
        set_vector<2>(soil[node], NodalField<2>::momentum, 3. * velocity);
        set_vector(water[node], NodalField<2>::momentum, velocity);
        set_vector<2>(soil[node], NodalField<2>::force, 3. * acceleration);
      }
  }

  /// @param mixture whose cells are looked at, too; may be null
  void release(const double time_step, const Mixture<2> *mixture = nullptr)
  {
    gaps.clear();
    gaps.add(points, h / 2);
    if (mixture)
      gaps.add(*mixture);
    gaps.release(forcing, time_step);
  }

  /// Nodes of all ranks that walls hold, and the sum of their velocities towards walls.
  std::pair<unsigned int, Tensor<1, 2>> held() const
  {
    unsigned int n = 0;
    Tensor<1, 2> sum;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      {
        n += constraints.at(node) != nullptr;
        sum += gaps.closing_velocity(node);
      }
    return { sum_of_ranks(n), sum_of_ranks(sum) };
  }

  BackgroundGrid<2> grid{ grid_box<2>(0., 1., h), MPI_COMM_WORLD };
  const BoundaryConditions<2> walls{ grid, boundaries() }, water_walls{ grid, WaterBoundaryParameters() };
  Constraints<2> constraints{ grid, walls, &water_walls };
  WallGaps<2> gaps{ grid, constraints };
  PointSet<2> points{ grid.triangulation(), grid.mapping(), 1 };
  NodalField<2> soil{ grid }, water{ grid };
  BodyForces<2> forcing{ grid, { 0., -10. }, BodyForceParameters() };
};

const UnitTest registered("wall_gaps", [] {
  constexpr double h = Box::h, dt = 1e-3, fall = 10. * dt;
  const Tensor<1, 2> rest;
  const unsigned int n_all = 36; // nodes on walls

  // Cells without points tell of no gap: their walls are far from the nodes.
  const auto test = [&](const std::string &what,
                        const Point<2> &x,
                        const Tensor<1, 2> &velocity,
                        const unsigned int n_held,
                        const Tensor<1, 2> &closing,
                        const Tensor<1, 2> &acceleration = {}) {
    Box box;
    box.add(x, velocity, acceleration);
    box.release(dt);
    const auto [n, sum] = box.held();
    expect(n, n_held, 0., what + ": held nodes");
    expect((sum - closing).norm(), 0., 1e-10, what + ": error of the closing velocities");
    box.gaps.clear();
    expect(box.held().first, n_all, 0., what + ": held nodes afterwards");
  };
  const double middle = 3.5 * h;
  const Tensor<1, 2> down({ 0., -2. }), down_left({ -2., -2. });
  test("at rest", Point<2>(middle, middle), rest, n_all, rest);
  test("as after a fall through less than an eighth of a cell", Point<2>(middle, middle), 0.25 * down, n_all, rest);
  test("through more", Point<2>(middle, middle), 0.3 * down, n_all - 8, rest);
  test("a point falls", Point<2>(middle, middle), down, n_all - 8, rest);
  test("a point falls, not far above the bottom", Point<2>(middle, 0.9 * h), down, n_all - 8, rest);
  test("a point that has reached the bottom", Point<2>(middle, 0.25 * h), down, n_all - 8 + 3, rest);
  test("a force drives it there", Point<2>(middle, 0.25 * h), rest, n_all - 8 + 3, rest, 4. / (3. * dt) * down);
  test("a point flies into a corner", Point<2>(middle, middle), down_left, 19, rest);
  test("a point in the corner", Point<2>(0.2 * h, 0.2 * h), down_left, 19 + 5, rest);
  test("a point on the bottom beside a wall", Point<2>(0.9 * h, 0.2 * h), down_left, 19 + 3, rest);
  // One that would come through its gap of .1 cells within the step is let as far as that.
  const double gap = 0.1 * h, limit = gap / dt;
  const auto velocity = [&](const double of_limit) { return Tensor<1, 2>({ 0., of_limit * limit + fall }); };
  const Tensor<1, 2> sum({ 0., 3. * limit });
  test("it closes its gap", Point<2>(middle, Box::reach + gap), velocity(-1.01), n_all - 8 + 3, -sum);
  test("it does not", Point<2>(middle, Box::reach + gap), velocity(-0.99), n_all - 8, rest);
  test("it closes its gap at the top", Point<2>(middle, 1. - Box::reach - gap), velocity(1.01), n_all - 8 + 3, sum);

  // Water below it, whose points are not looked at: cells that are full of it have no gap.
  const auto test_fill = [&](const std::string &region, const unsigned int n_held) {
    Box box;
    WaterParameters parameters;
    parameters.region          = region;
    parameters.points_per_cell = 20;
    WaterPhase<2> phase(1000., false, box.grid.triangulation(), box.grid.mapping());
    seed_water(phase, parameters, {}, { box.grid.triangulation(), h });
    TransferParameters flip;
    flip.method = "FLIP"; // The points have no room for a gradient.
    const WaterTransfer<2> transfer(box.grid, flip, parameters);
    Mixture<2> mixture(box.grid, 2);
    NodalField<2> soil(box.grid);
    WetNodes<2> nodes(box.grid, soil);
    transfer.to_grid(phase, mixture, nodes);
    box.add({ middle, middle }, down);
    box.release(dt, &mixture);
    expect(box.held().first, n_held, 0., region + ": held nodes");
  };
  test_fill("y < " + std::to_string(0.85 * h), n_all - 8);
  test_fill("y < " + std::to_string(0.95 * h), n_all);
  // The two full cells hold four of these nodes.
  test_fill("x > " + std::to_string(3 * h) + " && x < " + std::to_string(5 * h) + " && y < " + std::to_string(0.95 * h),
            n_all - 8 + 4);

  Box gated;
  gated.constraints.close_gate(std::make_unique<Region<2>>("gate", "y < 0.01"));
  gated.add({ middle, middle }, down);
  gated.release(dt);
  expect(gated.held().first, n_all, 0., "nodes that a gate and walls hold");

  // By default the top is drained. A point of water half a cell wide, 2 kg, on its way out.
  const double size = 0.5 * h, least = 0.05 * size;
  const auto test_hold = [&](const std::string &what,
                             const Point<2> &place,
                             const Point<2> &end,
                             const Tensor<1, 2> &velocity,
                             const Tensor<1, 2> &impulse) {
    Box box;
    WaterPhase<2> phase(1000., false, box.grid.triangulation(), box.grid.mapping());
    add_point(phase.points(), box.grid, { middle, 0.5 * h }, std::vector<double>(phase.layout.n_properties(), 0.));
    Budget<2> balance;
    const double scaling = 3.;
    double error = 0, loss = 0;
    for_each_point(phase.points(), [&](const auto &point) {
      point.location                        = place;
      point.properties[phase.layout.mass]   = 2.;
      point.properties[phase.layout.volume] = size * size;
      set_vector(point.properties, phase.layout.velocity, velocity);
    });
    keep_off_walls(box.grid, box.water_walls.closed_faces(), scaling, phase, balance);
    for_each_point(phase.points(), [&](const auto &point) {
      const auto left = vector_of<2>(point.properties, phase.layout.velocity);
      error           = point.location.distance(end) + (2. * (left - velocity) - impulse).norm();
      loss            = velocity.norm_square() - left.norm_square();
    });
    expect(Utilities::MPI::max(error, MPI_COMM_WORLD), 0., 1e-12, what + ": error of place and velocity");
    balance.wall_impulse = Utilities::MPI::sum(balance.wall_impulse, MPI_COMM_WORLD);
    expect((balance.wall_impulse - scaling * impulse).norm(), 0., 1e-12, what + ": error of the impulse");
    expect(Utilities::MPI::sum(balance.wall_dissipation - scaling * loss, MPI_COMM_WORLD),
           0.,
           1e-12,
           what + ": energy lost");
  };
  const double out = 0.09 * h, far_out = 0.11 * h;
  const Tensor<1, 2> falls({ 0.5, -3. }), rises({ 0.5, 3. }), none;
  test_hold("below the bottom", { middle, -out }, { middle, least }, falls, Tensor<1, 2>({ 0., 6. }));
  test_hold("on the bottom", { middle, 0.1 * least }, { middle, least }, falls, Tensor<1, 2>({ 0., 6. }));
  test_hold("on the bottom, upwards", { middle, 0.1 * least }, { middle, least }, rises, none);
  test_hold("far below the bottom", { middle, -far_out }, { middle, -far_out }, falls, none);
  test_hold("above the bottom", { middle, 1.01 * least }, { middle, 1.01 * least }, falls, none);
});
} // namespace test_wall_gaps

// Runs with mpirun=1,2.
