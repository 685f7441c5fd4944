// SPDX-License-Identifier: LGPL-2.1-or-later

// Seeding of water: it has the volume of its region outside the soil and of the pores inside, also where the surfaces
// of water and soil cut the lattice; single-point water fills the pores of its soil; bodies without pores are refused.
#include "../soil.h"

#include <scree/input/input_error.h>


namespace test_points_water_seeding
{
/// Fills the box with water of its own points and compares its volume, m^3.
template <int dim>
void test(const std::string &name,
          const std::vector<double> &upper_corner,
          const std::string &region,
          const std::vector<SoilRegion> &soil,
          const double expected,
          const double tolerance)
{
  const BackgroundGrid<dim> grid(grid_box(0., upper_corner), MPI_COMM_WORLD);
  WaterParameters parameters;
  parameters.region           = region;
  parameters.density          = 1025;
  parameters.points_per_cell  = dim == 2 ? 4 : 2;
  parameters.initial_velocity = dim == 2 ? "x; -y" : "x; -y; 3*z";
  WaterPhase<dim> water(parameters.density, false, grid.triangulation(), grid.mapping());
  seed_water(water, parameters, soil, grid.triangulation(), grid.cell_size());

  const auto &layout = water.layout;
  double volume      = 0;
  unsigned int n     = 0;
  for_each_point(water.points(), [&](const auto &point) {
    ++n;
    const double *properties = point.properties;
    volume += properties[layout.volume];
    require(properties[layout.volume] > 0 &&
                std::abs(properties[layout.mass] / properties[layout.volume] / 1025. - 1.) < 1e-14,
            "A point's mass is not its volume times the density.");
    require(properties[layout.velocity] == point.location[0] && properties[layout.velocity + 1] == -point.location[1],
            "A point's velocity is not that of the entry.");
    require(properties[layout.pressure] == 0, "A point has a pressure.");
    for (unsigned int a = 0; a < dim; ++a)
      require(point.reference_location[a] >= 0. && point.reference_location[a] <= 1., "A point lies outside its cell.");
  });
  volume = Utilities::MPI::sum(volume, MPI_COMM_WORLD);
  require(std::abs(volume / expected - 1.) < tolerance,
          name + ": the volume is wrong by " + Utilities::to_string(volume / expected - 1.));
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
  seed_water(water, WaterParameters(), {}, grid.triangulation(), grid.cell_size());
  require(water.carrier() == &soil && &water.points() == &soil.points && water.layout.velocity == soil_slots &&
              water.layout.end == soil.layout.n_properties,
          "The water's slots are not behind those of the soil.");
  for_each_point(water.points(), [&](const auto &point) {
    const double *properties = point.properties;
    const double volume      = properties[water.layout.volume];
    require(std::abs(volume / (porosity * properties[soil.layout.volume]) - 1.) < 1e-13 &&
                std::abs(properties[water.layout.mass] / (1000. * volume) - 1.) < 1e-14,
            "The water does not fill the pores.");
    for (unsigned int a = 0; a < dim; ++a)
      require(properties[water.layout.velocity + a] == properties[soil.layout.velocity + a],
              "The water does not move with the soil.");
  });
}


/// The message, without its end, of what seeding refuses.
void test_refusal(const std::string &region, const double porosity)
{
  try
    {
      test<2>("refusal", { 1, 1 }, region, { { "Block", "y < 0.5", porosity, 2000 } }, 1, 1);
      throw ExcMessage("Water in " + region + " was not refused.");
    }
  catch (const EntryError &error)
    {
      const std::string message = error.what();
      std::cout << message.substr(0, message.find(". ")) << std::endl;
    }
}


void run()
{
  // Faces of cells: nothing to sample.
  test<2>("pool", { 2, 1.5 }, "y < 0.7", {}, 1.4, 1e-12);
  test<2>("column half submerged", { 2, 1.5 }, "y < 0.5", { { "Soil", "x < 1 && y < 1", 0.4, 1500 } }, 0.7, 1e-12);
  test<2>("as the soil",
          { 2, 1.5 },
          "same",
          { { "Sand", "x < 1 && y < 1", 0.4, 1500 }, { "Clay", "x > 1 && y < 0.5", 0.1, 2000 } },
          0.45,
          1e-12);
  test<3>("column", { 1, 0.5, 1 }, "z < 0.3", { { "Soil", "x < 0.5 && z < 0.5", 0.4, 1500 } }, 0.105, 1e-12);
  // Both surfaces cut cubes. 1e-3 as for soil.
  const double end = (0.83 - 0.3) / 0.37, soil = 0.3 * end + 0.37 * end * end / 2 + 0.83 * (1.7 - end);
  test<2>("beach",
          { 2, 1.5 },
          "y < 0.83 && x < 1.7",
          { { "Soil", "y < 0.3 + 0.37*x && y < 1", 0.4, 1500 } },
          0.83 * 1.7 - 0.6 * soil,
          1e-3);
  // Fewer points where the water fills little of a full cube: pores are no slivers.
  test<2>("narrow pores", { 1, 1 }, "same", { { "Soil", "y < 0.5", 0.01, 2500 } }, 0.005, 1e-12);
  test<3>("boulder",
          { 1, 1, 1 },
          "1",
          { { "Soil", "(x - 0.51)^2 + (y - 0.49)^2 + (z - 0.5)^2 < 0.4^2", 0.2, 2000 } },
          1 - 0.8 * numbers::PI * 0.256 / 3,
          1e-3);
  test_single_point<2>({ 1, 1 });
  test_single_point<3>({ 1, 0.2, 1 });

  test_refusal("y < 0.7", 0.);
  test_refusal("same", 0.);
  test_refusal("y > 1.5", 0.4);
  test<2>("above a body without pores", { 1, 1 }, "y > 0.5", { { "Block", "y < 0.5", 0, 2000 } }, 0.5, 1e-12);
}

const UnitTest registered("points_water_seeding", run);
} // namespace test_points_water_seeding


// Output of mpirun=1,2:
// 2D pool: 2240 points, volume OK
// 2D column half submerged: 1600 points, volume OK
// 2D as the soil: 2400 points, volume OK
// 3D column: 1200 points, volume OK
// 2D beach: 2244 points, volume OK
// 2D narrow pores: 800 points, volume OK
// 3D boulder: 8000 points, volume OK
// 2D single-point: OK
// 3D single-point: OK
// subsection Block, entry "Initial porosity" = 0: the body lies in the water and needs pores
// subsection Block, entry "Initial porosity" = 0: the body lies in the water and needs pores
// subsection Water, entry "Region" = y > 1.5: the region is empty inside the box of subsection Mesh
// 2D above a body without pores: 800 points, volume OK
