// SPDX-License-Identifier: LGPL-2.1-or-later

// Start of a wet scene: pressure is the weight of the water above, in the soil and outside; the soil's vertical stress
// is the weight above less the pressure. Below a level and an inclined bed, with the water table above and inside the
// soil, in two layers, and with gravity along any axis.
#include "../soil.h"

#include <scree/initial/geostatic.h>

#include <functional>


namespace test_points_water_start
{
constexpr double g = 9.81, K0 = 0.683, water_density = 1025, grain_density = 2650;

/// Where soil and water are, and what their stress and pressure, Pa, should be at a place.
template <int dim>
struct Scene
{
  std::string name, water_region;
  std::vector<SoilRegion> soil;
  Tensor<1, dim> gravity; // m/s^2
  std::function<double(const Point<dim> &)> pressure, stress;
};

SoilRegion layer(const std::string &region, const double porosity)
{
  return { "Soil", region, porosity, grain_density * (1. - porosity) };
}

template <int dim>
void compare(const std::string &name, const double error, const double largest)
{
  const double relative = Utilities::MPI::max(error, MPI_COMM_WORLD) / Utilities::MPI::max(largest, MPI_COMM_WORLD);
  // Columns are shared by points closer than a hundred thousandth of a cell; surfaces are found to 1e-9 of the height.
  require(relative < 1e-5, name + " is wrong by " + Utilities::to_string(relative));
}

template <int dim>
void test(const Scene<dim> &scene)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1.), MPI_COMM_WORLD);
  WaterParameters parameters;
  parameters.region          = scene.water_region;
  parameters.density         = water_density;
  parameters.points_per_cell = 2;
  const double spacing       = grid.cell_size() / 4;

  WaterPhase<dim> water(water_density, false, grid.triangulation(), grid.mapping());
  seed_water(water, parameters, scene.soil, grid.triangulation(), grid.cell_size());
  Overburden<dim> water_above(grid, water_layers<dim>(parameters, scene.soil), scene.gravity, spacing);
  set_hydrostatic_pressure(water, water_above);
  double error = 0, largest = 0;
  for_each_point(water.points(), [&](const auto &point) {
    const double *properties = point.properties;
    const double expected    = scene.pressure(point.location);
    largest                  = std::max(largest, expected);
    error                    = std::max(error, std::abs(properties[water.layout.pressure] - expected));
    for (unsigned int a = 0; a < dim; ++a)
      require(std::abs(properties[water.layout.pressure_gradient + a] - water_density * scene.gravity[a]) < 1e-10,
              "The pressure gradient is not the weight of the water.");
  });
  compare<dim>(scene.name + ": the pressure", error, largest);
  std::cout << dim << "D " << scene.name << ": pressure OK, up to " << Utilities::MPI::max(largest, MPI_COMM_WORLD)
            << " Pa";

  Overburden<dim> soil_above(grid, effective_weight_layers<dim>(scene.soil, &parameters), scene.gravity, spacing);
  error = largest = 0;
  for (const SoilRegion &body : scene.soil)
    {
      ElasticSoil<dim> soil(grid, body.region, 2, 1. - body.bulk_density / grain_density, grain_density);
      set_k0_stress(soil, soil_above, K0, "");
      for_each_point(soil.points, [&](const auto &point) {
        const double *stress  = point.properties + soil.layout.stress;
        const double expected = scene.stress(point.location);
        largest               = std::max(largest, expected);
        for (unsigned int a = 0; a < 3; ++a)
          error = std::max(error, std::abs(stress[a] + (a == soil_above.vertical_axis() ? 1. : K0) * expected));
      });
    }
  if (!scene.soil.empty())
    compare<dim>(scene.name + ": the stress", error, largest);
  std::cout << "; stress OK, up to " << Utilities::MPI::max(largest, MPI_COMM_WORLD) << " Pa" << std::endl;
}


void run()
{
  const double n = 0.4, water = g * water_density, dry = g * grain_density * (1 - n);
  const double lift = g * water_density * (1 - n), buoyant = dry - lift; // unit weights, N/m^3
  const Tensor<1, 2> down({ 0, -g }), right({ g, 0 });

  test<2>({ "pool", "y < 0.73", {}, down, [&](const auto &x) { return water * (0.73 - x[1]); }, {} });
  test<2>({ "submerged",
            "y < 0.9",
            { layer("y < 0.5", n) },
            down,
            [&](const auto &x) { return water * (0.9 - x[1]); },
            [&](const auto &x) { return buoyant * (0.5 - x[1]); } });
  test<2>({ "submerged incline",
            "y < 0.9",
            { layer("y < 0.3 + 0.4*x", n) },
            down,
            [&](const auto &x) { return water * (0.9 - x[1]); },
            [&](const auto &x) { return buoyant * (0.3 + 0.4 * x[0] - x[1]); } });
  test<2>({ "water table inside",
            "y < 0.47",
            { layer("y < 0.8", n) },
            down,
            [&](const auto &x) { return water * (0.47 - x[1]); },
            [&](const auto &x) { return dry * (0.8 - x[1]) - lift * std::max(0., 0.47 - x[1]); } });
  const double other = g * (grain_density - water_density) * 0.8; // buoyant unit weight at a porosity of 0.2
  test<2>({ "saturated layers",
            "same",
            { layer("y < 0.4", n), layer("y >= 0.4 && y < 0.8", 0.2) },
            down,
            [&](const auto &x) { return water * (0.8 - x[1]); },
            [&](const auto &x) { return buoyant * std::max(0., 0.4 - x[1]) + other * (0.8 - std::max(0.4, x[1])); } });
  test<2>({ "gravity to the right",
            "x > 0.2",
            { layer("x > 0.5", n) },
            right,
            [&](const auto &x) { return water * (x[0] - 0.2); },
            [&](const auto &x) { return buoyant * (x[0] - 0.5); } });
  test<3>({ "submerged",
            "z < 0.9",
            { layer("z < 0.3 + 0.4*x", n) },
            Tensor<1, 3>({ 0, 0, -g }),
            [&](const auto &x) { return water * (0.9 - x[2]); },
            [&](const auto &x) { return buoyant * (0.3 + 0.4 * x[0] - x[2]); } });
}

const UnitTest registered("points_water_start", run);
} // namespace test_points_water_start


// Output of mpirun=1,2:
// 2D pool: pressure OK, up to 7088.95 Pa; stress OK, up to 0 Pa
// 2D submerged: pressure OK, up to 8798.34 Pa; stress OK, up to 4543.26 Pa
// 2D submerged incline: pressure OK, up to 8798.34 Pa; stress OK, up to 6360.56 Pa
// 2D water table inside: pressure OK, up to 4474.59 Pa; stress OK, up to 9403.62 Pa
// 2D saturated layers: pressure OK, up to 7792.82 Pa; stress OK, up to 8687.98 Pa
// 2D gravity to the right: pressure OK, up to 7792.82 Pa; stress OK, up to 4543.26 Pa
// 3D submerged: pressure OK, up to 8798.34 Pa; stress OK, up to 6360.56 Pa
