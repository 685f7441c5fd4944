// SPDX-License-Identifier: LGPL-2.1-or-later
// The viscous force on the nodes, for every basis, of water that fills a part of the box with oblique edges: it is
// symmetric, takes energy, adds up to nothing with its moments, is 0 for rigid motion, dissipates mu V of unit shear,
// and no motion is slowed faster than largest_rate().
#include "../test.h"

#include <scree/seeding/seeding.h>
#include <scree/viscosity/viscous_step.h>

#include <functional>

namespace test_viscous_force
{
template <int dim>
using Velocity = std::function<Tensor<1, dim>(const Point<dim> &)>;

/// The nodes of the points of one phase, and the viscous force on them.
template <int dim>
struct Nodes
{
  const BackgroundGrid<dim> &grid;
  const ViscousForce<dim> &force;
  const WaterPhase<dim> &water;
  NodalField<dim> masses{ grid }, motion{ grid }, forces{ grid };

  Nodes(const BackgroundGrid<dim> &grid, const ViscousForce<dim> &force, const WaterPhase<dim> &water)
      : grid(grid)
      , force(force)
      , water(water)
  {
    masses.clear();
    for_each_point(water.points(), [&](const auto &point) {
      masses.activate_cell(point.cell);
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        masses[grid.nodes(point.cell)[i]][NodalField<dim>::mass] +=
            point.properties[water.layout.mass] *
            evaluate(grid, point.cell, point.reference_location, [&](const unsigned int node) {
              return node == grid.nodes(point.cell)[i];
            }).first;
    });
    masses.add_contributions();
  }

  void move(const Velocity<dim> &velocity)
  {
    for (const unsigned int node : masses.active_nodes())
      set_vector(motion[node], NodalField<dim>::velocity, velocity(grid.node_position(node)));
    find_forces();
  }

  void find_forces()
  {
    motion.update_ghosts();
    forces.clear();
    force.add(water, motion, forces);
    forces.add_contributions();
  }

  double power(const Velocity<dim> &velocity) const
  {
    double power = 0;
    for (const unsigned int node : masses.active_nodes())
      power += vector_of<dim>(forces[node], NodalField<dim>::force) * velocity(grid.node_position(node));
    return sum_of_ranks(power);
  }

  double size_of_forces() const
  {
    double size = 0;
    for (const unsigned int node : masses.active_nodes())
      size += vector_of<dim>(forces[node], NodalField<dim>::force).norm();
    return sum_of_ranks(size);
  }

  /// The largest eigenvalue of M^-1 K, from below, by powers of it.
  double largest_rate()
  {
    double rate = 0;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        double square          = 0;
        const auto velocity_of = [&](const unsigned int node) {
          const double mass = masses[node][NodalField<dim>::mass];
          return mass > 0. ? vector_of<dim>(forces[node], NodalField<dim>::force) / -mass : Tensor<1, dim>();
        };
        for (const unsigned int node : masses.active_nodes())
          square += masses[node][NodalField<dim>::mass] * velocity_of(node).norm_square();
        rate = std::sqrt(sum_of_ranks(square));
        for (const unsigned int node : masses.active_nodes())
          set_vector<dim>(motion[node], NodalField<dim>::velocity, velocity_of(node) / rate);
        find_forces();
      }
    return rate;
  }
};


template <int dim>
void examine(Nodes<dim> nodes, const double viscosity_times_volume, const double bound)
{
  const auto vector = [](const std::function<double(const Point<dim> &, unsigned int)> &component) {
    return [component](const Point<dim> &x) {
      return point_of<dim>([&](const unsigned int c) { return component(x, c); });
    };
  };
  const auto scattered = vector([](const Point<dim> &x, const unsigned int c) { return pattern<dim>(x * (1. + c)); });
  const auto smooth =
      vector([](const Point<dim> &x, const unsigned int c) { return c == 1 ? std::sin(5. * x[0] + x[1]) : 0.; });
  const auto shear = vector([](const Point<dim> &x, const unsigned int c) { return c == 0 ? x[1] : 0.; });
  const auto spin  = vector([](const Point<dim> &x, const unsigned int c) {
    return c == 0 ? 0.3 - x[1] : c == 1 ? x[0] : 2.;
  });

  nodes.move(scattered);
  const double size = nodes.size_of_forces();
  for (unsigned int axis = 0; axis < dim; ++axis)
    expect(nodes.power(vector([axis](const Point<dim> &, const unsigned int c) { return c == axis ? 1. : 0.; })) / size,
           0,
           1e-13,
           "Sum of the forces over their size");
  expect(nodes.power(spin) / size, 0, 1e-13, "Moment of the forces over their size");
  require(nodes.power(scattered) < 0., "Viscosity gives energy.");
  const double one_way = nodes.power(smooth);
  nodes.move(smooth);
  expect(nodes.power(scattered) / one_way, 1, 1e-11, "Power of one motion's force on another one over the reverse");
  nodes.move(spin);
  expect(nodes.size_of_forces() / size, 0, 1e-13, "Force on rigid motion");
  nodes.move(shear);
  expect(-nodes.power(shear) / viscosity_times_volume, 1, 1e-12, "Dissipation of unit shear over mu V");

  nodes.move(scattered);
  const double part = nodes.largest_rate() / max_of_ranks(bound);
  require(part > 0.05 && part <= 1., "The bound on the rate is wrong: " + Utilities::to_string(part));
}


template <int dim>
void test(const std::string &basis)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 0.6, 0.1, basis), MPI_COMM_WORLD);

  WaterParameters parameters;
  parameters.region          = "x + 0.7 * y < 0.5";
  parameters.points_per_cell = 3;
  parameters.viscosity       = 2.;
  WaterPhase<dim> water(1000., false, grid.triangulation(), grid.mapping());
  seed_water(water, parameters, {}, { grid.triangulation(), grid.cell_size() });

  double water_volume = 0;
  for_each_point(water.points(), [&](const auto &point) { water_volume += point.properties[water.layout.volume]; });

  const ViscousForce<dim> force(grid, parameters.viscosity);
  examine(Nodes<dim>(grid, force, water), parameters.viscosity * sum_of_ranks(water_volume), force.largest_rate(water));
}


const UnitTest registered("viscous_force", [] {
  for (const std::string basis : { "spline", "linear" })
    {
      test<2>(basis);
      test<3>(basis);
    }
});
} // namespace test_viscous_force

// Runs with mpirun=1,2.
