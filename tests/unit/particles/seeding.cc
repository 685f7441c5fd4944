// SPDX-License-Identifier: LGPL-2.1-or-later
// Seeding: a body has the mass of its region, within 0.1 % where its surface is oblique to the lattice and exactly
// where it is not; no point has less than a quarter of a cube's volume; all points lie where their cell says. Water has
// the volume of its region outside the soil and of the pores inside, also where the surfaces of both cut the lattice;
// single-point water fills the pores of its soil; bodies without pores are refused. Grains and pores follow from each
// pair of unit weights, and contradictions are refused. 1 and 2 ranks make the same points.
#include "../soil.h"

#include <scree/input/input_error.h>

namespace test_seeding
{
template <int dim>
void expect_in_cell(const Point<dim> &reference)
{
  for (unsigned int a = 0; a < dim; ++a)
    require(reference[a] >= 0. && reference[a] <= 1., "A point lies outside its cell.");
}


template <int dim>
struct Body
{
  std::string region;
  double volume; ///< m^3
  unsigned int n_points;
};

/// Fills the bodies: each has its mass, and all together theirs within `tolerance`.
template <int dim>
void test_soil(const std::vector<double> &upper_corner, const std::vector<Body<dim>> &bodies, const double tolerance)
{
  const BackgroundGrid<dim> grid(grid_box(0., upper_corner), MPI_COMM_WORLD);
  constexpr double density           = 1000;
  const unsigned int points_per_cell = dim == 2 ? 4 : 2;
  double all_mass = 0, all_volume = 0;
  for (const Body<dim> &shape : bodies)
    {
      const ElasticSoil<dim> soil(grid, shape.region, points_per_cell, 0., density);
      const double cube = std::pow(grid.cell_size() / points_per_cell, dim); // m^3
      double mass       = 0;
      unsigned int n    = 0;
      for_each_point(soil.points, [&](const auto &point) {
        ++n;
        const double own = point.properties[soil.layout.mass], volume = point.properties[soil.layout.volume];
        mass += own;
        expect(own / volume / density, 1., 1e-14, "mass of a point over its volume and the density");
        require(volume > 0.2499 * cube, "A sliver stands by itself.");
        expect_in_cell(point.reference_location);
        for (unsigned int a = 0; a < dim; ++a)
          require(point.location[a] > 0. && point.location[a] < upper_corner[a], "A point lies outside the box.");
      });
      require(n == soil.points.handler().n_locally_owned_particles(), "cells() misses points.");
      mass = sum_of_ranks(mass);
      expect(mass / (density * shape.volume), 1., tolerance, "mass of '" + shape.region + "' over that of its volume");
      expect(sum_of_ranks(n), shape.n_points, 0., "number of points of '" + shape.region + "'");
      all_mass += mass;
      all_volume += shape.volume;
    }
  expect(all_mass / (density * all_volume), 1., tolerance, "mass of all bodies over that of their volumes");
}


/// Fills the box with water of its own points and compares its volume, m^3.
template <int dim>
void test_water(const std::vector<double> &upper_corner,
                const std::string &region,
                const std::vector<SoilRegion> &soil,
                const double expected,
                const unsigned int n_points,
                const double tolerance)
{
  const BackgroundGrid<dim> grid(grid_box(0., upper_corner), MPI_COMM_WORLD);
  WaterParameters parameters;
  parameters.region           = region;
  parameters.density          = 1025;
  parameters.points_per_cell  = dim == 2 ? 4 : 2;
  parameters.initial_velocity = dim == 2 ? "x; -y" : "x; -y; 3*z";
  WaterPhase<dim> water(parameters.density, false, grid.triangulation(), grid.mapping());
  seed_water(water, parameters, soil, { grid.triangulation(), grid.cell_size() });

  const auto &layout = water.layout;
  double volume      = 0;
  unsigned int n     = 0;
  for_each_point(water.points(), [&](const auto &point) {
    ++n;
    const double *properties = point.properties;
    volume += properties[layout.volume];
    expect(properties[layout.mass] / properties[layout.volume] / 1025., 1., 1e-14, "mass of a point");
    require(properties[layout.velocity] == point.location[0] && properties[layout.velocity + 1] == -point.location[1],
            "A point's velocity is not that of the entry.");
    expect(properties[layout.pressure], 0., 0., "pressure of a point");
    expect_in_cell(point.reference_location);
  });
  expect(sum_of_ranks(volume) / expected, 1., tolerance, "volume of water in '" + region + "' over that expected");
  expect(sum_of_ranks(n), n_points, 0., "number of points in '" + region + "'");
}


/// Water on the points of a slope.
template <int dim>
void test_single_point(const std::vector<double> &upper_corner)
{
  const BackgroundGrid<dim> grid(grid_box(0., upper_corner), MPI_COMM_WORLD);
  constexpr double porosity = 0.37;
  const bool is_affine      = true;
  const auto n_further      = WaterLayout<dim>(0, is_affine).n_properties();
  const auto soil_slots     = PropertyLayout<dim>(0, is_affine).n_properties;
  ElasticSoil<dim> soil(grid,
                        dim == 2 ? "y < 0.6 - 0.3*x" : "z < 0.6 - 0.3*x",
                        2,
                        porosity,
                        2650.,
                        PropertyLayout<dim>(0, is_affine, n_further),
                        dim == 2 ? "x; -y" : "x; -y; 3*z");
  WaterPhase<dim> water(1000., is_affine, soil);
  seed_water(water, WaterParameters(), {}, { grid.triangulation(), grid.cell_size() });
  require(water.carrier() == &soil && &water.points() == &soil.points && water.layout.velocity == soil_slots &&
              water.layout.end == soil.layout.n_properties,
          "The water's slots are not behind those of the soil.");
  for_each_point(water.points(), [&](const auto &point) {
    const double *properties = point.properties;
    const double volume      = properties[water.layout.volume];
    expect(volume / (porosity * properties[soil.layout.volume]), 1., 1e-13, "volume of water over that of pores");
    expect(properties[water.layout.mass] / (1000. * volume), 1., 1e-14, "mass of water over density times volume");
    require(vector_of<dim>(properties, water.layout.velocity) == vector_of<dim>(properties, soil.layout.velocity),
            "The water does not move with the soil.");
  });
}


void test_unit_weights()
{
  constexpr double g = 9.81, rho_w = 1000, rho_s = 2650, n = 0.4;
  constexpr double dry = (1 - n) * rho_s * g, saturated = dry + n * rho_w * g;
  for (const UnitWeights &given : { UnitWeights{ dry, saturated, 2500, false, {} },
                                    { dry, saturated, rho_s, true, n },
                                    { dry, 0, 2500, false, n },
                                    { dry, 0, rho_s, true, {} },
                                    { 0, saturated, 2500, false, n },
                                    { 0, saturated, rho_s, true, {} } })
    {
      const GrainsAndPores found = grains_and_pores("Soil", given, g, rho_w);
      expect(found.grain_density / rho_s, 1., 1e-12, "density of grains");
      expect(found.porosity, n, 1e-12, "porosity");
    }
  const auto refuse = [](const UnitWeights &given, const std::string &text) {
    expect_refusal([&] { grains_and_pores("Soil", given, g, rho_w); }, text, "a pair of unit weights");
  };
  refuse({ dry, saturated, 2500, false, 0.3 }, "contradicts");  // another porosity
  refuse({ dry, saturated, 2600, true, {} }, "contradicts");    // another grain density
  refuse({ saturated, dry, 2500, false, {} }, "porosity of -"); // exchanged
  refuse({ 0, saturated / 1e3, 2500, false, {} }, "1e3 N/m^3"); // kN/m^3
}


const UnitTest registered("seeding", [] {
  const double pi = numbers::PI;

  // Faces of cells: nothing to sample.
  test_soil<2>({ 2, 1.5 }, { { "x < 1 && y < 1", 1, 1600 } }, 1e-12);
  test_soil<3>({ 1, 0.5, 1 }, { { "x < 0.5 && z < 0.5", 0.125, 1000 } }, 1e-12);
  // Oblique or round: 1e-3 is what a run's energies and run-out may bear.
  test_soil<2>({ 5, 2.5 }, { { "if(x < 2, y < 2, y < 4 - x)", 6, 9640 } }, 1e-3);
  test_soil<2>({ 1.5, 1.5 }, { { "(x - 0.71)^2 + (y - 0.73)^2 < 0.5^2", pi / 4, 1284 } }, 1e-3);
  const std::string ball = "(x - 0.51)^2 + (y - 0.49)^2 + (z - 0.5)^2 < 0.4^2";
  test_soil<3>({ 1, 1, 1 }, { { ball, pi * 0.256 / 3, 2340 } }, 1e-3);
  // Two bodies share the cubes on their common face; what one leaves out the other must take.
  test_soil<2>({ 2, 1.5 },
               { { "y < 1 && y < 0.3 + 0.37 * x", 2 * 0.3 + 0.37 * 2 - std::pow(2 - 0.7 / 0.37, 2) * 0.37 / 2, 2159 },
                 { "y < 1 && y >= 0.3 + 0.37 * x", 0.7 * 0.7 / 0.37 / 2, 1078 } },
               1e-3);

  const SoilRegion column{ "Soil", "x < 1 && y < 1", 0.4, 1500 };
  test_water<2>({ 2, 1.5 }, "y < 0.7", {}, 1.4, 2240, 1e-12);
  test_water<2>({ 2, 1.5 }, "y < 0.5", { column }, 0.7, 1600, 1e-12);
  test_water<2>({ 2, 1.5 }, "same", { column, { "Clay", "x > 1 && y < 0.5", 0.1, 2000 } }, 0.45, 2400, 1e-12);
  test_water<3>({ 1, 0.5, 1 }, "z < 0.3", { { "Soil", "x < 0.5 && z < 0.5", 0.4, 1500 } }, 0.105, 1200, 1e-12);
  // Both surfaces cut cubes. 1e-3 as for soil.
  const double end = (0.83 - 0.3) / 0.37, soil = 0.3 * end + 0.37 * end * end / 2 + 0.83 * (1.7 - end);
  const SoilRegion beach{ "Soil", "y < 0.3 + 0.37*x && y < 1", 0.4, 1500 };
  test_water<2>({ 2, 1.5 }, "y < 0.83 && x < 1.7", { beach }, 0.83 * 1.7 - 0.6 * soil, 2244, 1e-3);
  // Fewer points where the water fills little of a full cube: pores are no slivers.
  test_water<2>({ 1, 1 }, "same", { { "Soil", "y < 0.5", 0.01, 2500 } }, 0.005, 800, 1e-12);
  test_water<3>({ 1, 1, 1 }, "1", { { "Soil", ball, 0.2, 2000 } }, 1 - 0.8 * pi * 0.256 / 3, 8000, 1e-3);
  test_single_point<2>({ 1, 1 });
  test_single_point<3>({ 1, 0.2, 1 });

  const auto refuse = [](const std::string &region, const double porosity, const std::string &text) {
    expect_refusal(
        [&] {
          test_water<2>({ 1, 1 }, region, { { "Block", "y < 0.5", porosity, 2000 } }, 1, 1, 1);
        },
        text,
        "water in '" + region + "'");
  };
  const std::string pores =
      "subsection Block, entry \"Initial porosity\" = 0: the body lies in the water and needs pores";
  refuse("y < 0.7", 0., pores);
  refuse("same", 0., pores);
  refuse("y > 1.5", 0.4, "entry \"Region\" = y > 1.5: the region is empty inside the box of subsection Mesh");
  test_water<2>({ 1, 1 }, "y > 0.5", { { "Block", "y < 0.5", 0, 2000 } }, 0.5, 800, 1e-12);

  test_unit_weights();
});
} // namespace test_seeding

// Runs with mpirun=1,2.
