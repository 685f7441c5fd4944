// SPDX-License-Identifier: LGPL-2.1-or-later
// An absorbing wall: the impedances of all its nodes are those of the soil, what is at rest stays at rest, and a
// dashpot takes what a node's mean velocity in the step makes of it, however long the step.
#include "../soil.h"

#include <scree/momentum/absorbing_walls.h>

namespace test_absorbing_walls
{
const UnitTest registered("absorbing_walls", [] {
  using Field              = NodalField<2>;
  constexpr double density = 1000., node_mass = 3.;
  SoilScene<2> scene(0., 1.);
  const Material<2> &law  = *scene.add_soil("1").material;
  BackgroundGrid<2> &grid = scene.grid;
  BoundaryParameters parameters;
  parameters.texts["Left"]  = "absorbing";
  parameters.texts["Right"] = "open";
  const BoundaryConditions<2> walls(grid, parameters);
  Constraints<2> constraints(grid, walls, nullptr);
  BodyForces<2> forcing(grid, { 0., 0. }, BodyForceParameters());
  forcing.set_start();
  AbsorbingWalls<2> absorbing(grid, constraints, forcing);
  require(constraints.absorbing_faces() == 1, "The left wall does not absorb.");

  NodalField<2> field(grid);
  const auto act = [&](const Tensor<1, 2> &velocity, const Tensor<1, 2> &force, const double time_step) {
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      {
        field[node][Field::mass] = node_mass;
        set_vector<2>(field[node], Field::momentum, node_mass * velocity);
        set_vector(field[node], Field::force, force);
      }
    Budget<2> balance;
    constraints.hold_all();
    absorbing.release();
    absorbing.add_forces(scene.bodies, field, time_step, balance);
    return balance;
  };

  const Tensor<1, 2> rest, stress({ 7., 0. }), velocity({ -2., 1. });
  act(rest, stress, 1e-3);
  FreeFieldNode<2> sum;
  for (const FreeFieldNode<2> &node : absorbing.free_field.nodes)
    {
      sum.area += node.area;
      sum.mass += node.mass;
      sum.pressure_wave += node.pressure_wave;
      sum.shear_wave += node.shear_wave;
    }
  const double along = law.initial_bulk_modulus(0.) + 4. / 3. * law.shear_modulus;
  expect(sum.area, 1., 1e-12, "area of the wall");
  expect(sum.mass / density, 1., 1e-12, "its mass per thickness over density");
  expect(sum.pressure_wave / std::sqrt(density * along), 1., 1e-6, "impedance of pressure waves over rho c_p");
  expect(sum.shear_wave / std::sqrt(density * law.shear_modulus), 1., 1e-6, "impedance of shear waves over rho c_s");

  for (const double time_step : { 1e-9, 1e-3, 10. })
    {
      double error_at_rest = 0., largest_power = -1e-12, lost = 0.;
      const auto on_wall = [&](const auto &look) {
        for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
          if (grid.node_faces(node) & 1 && constraints.at(node) == nullptr)
            look(vector_of<2>(field[node], Field::force));
      };
      act(rest, stress, time_step);
      on_wall([&](const Tensor<1, 2> &force) { error_at_rest += force.norm(); });
      expect(Utilities::MPI::max(error_at_rest, MPI_COMM_WORLD), 0., 1e-12, "force on nodes at rest, N");

      const Budget<2> balance = act(velocity, stress, time_step);
      on_wall([&](const Tensor<1, 2> &force) {
        const Tensor<1, 2> mean = velocity + 0.5 * time_step / node_mass * force;
        for (unsigned int a = 0; a < 2; ++a)
          largest_power = std::max(largest_power, force[a] * mean[a]);
        lost -= time_step * force * mean;
      });
      require(Utilities::MPI::max(largest_power, MPI_COMM_WORLD) < 0., "A dashpot gives energy.");
      expect(sum_of_ranks(balance.wall_dissipation) / sum_of_ranks(lost), 1., 1e-9, "energy that the wall takes");
    }
});
} // namespace test_absorbing_walls

// Runs with mpirun=1,2.
