// SPDX-License-Identifier: LGPL-2.1-or-later

// Stress and pressure at the start: pressure is the weight of the water above, in the soil and outside; the soil's
// vertical stress is the weight above less the pressure, horizontal ones are K0 times that, shear is none. Below a
// level and an inclined surface, dry and with the water table above and inside the soil, in two layers, and with
// gravity along any axis.
#include "../soil.h"

#include <scree/initial/geostatic.h>

#include <functional>

namespace test_stress_at_start
{
constexpr double g = 9.81, K0 = 0.683, water_density = 1025, grain_density = 2650;

/// Where soil and water are, and what their stress and pressure, Pa, should be at a place.
template <int dim>
struct Scene
{
  std::string name, water_region; ///< "": dry
  std::vector<SoilRegion> soil;
  Tensor<1, dim> gravity; ///< m/s^2
  std::function<double(const Point<dim> &)> pressure, stress;
};

SoilRegion layer(const std::string &region, const double porosity)
{
  return { "Soil", region, porosity, grain_density * (1. - porosity) };
}

template <int dim>
void test(const Scene<dim> &scene)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1.), MPI_COMM_WORLD);
  const double spacing = grid.cell_size() / 4;
  // Columns are shared by points closer than a hundred thousandth of a cell; surfaces are found to 1e-9 of the height.
  const auto compare = [&](const double error, const double largest, const std::string &what) {
    expect(max_of_ranks(error) / max_of_ranks(largest), 0., 1e-5, scene.name + ": error of the " + what);
  };
  WaterParameters parameters;
  parameters.region          = scene.water_region;
  parameters.density         = water_density;
  parameters.points_per_cell = 2;
  const bool is_wet          = !scene.water_region.empty();
  double error = 0, largest = 0;
  if (is_wet)
    {
      WaterPhase<dim> water(water_density, false, grid.triangulation(), grid.mapping());
      seed_water(water, parameters, scene.soil, { grid.triangulation(), grid.cell_size() });
      Overburden<dim> water_above(grid, water_layers<dim>(parameters, scene.soil), scene.gravity, spacing);
      set_hydrostatic_pressure(water, water_above);
      for_each_point(water.points(), [&](const auto &point) {
        const double *properties = point.properties;
        const double expected    = scene.pressure(point.location);
        largest                  = std::max(largest, expected);
        error                    = std::max(error, std::abs(properties[water.layout.pressure] - expected));
        for (unsigned int a = 0; a < dim; ++a)
          expect(properties[water.layout.pressure_gradient + a],
                 water_density * scene.gravity[a],
                 1e-10,
                 "pressure gradient, which is the weight of the water");
      });
      compare(error, largest, "pressure");
    }

  Overburden<dim> soil_above(
      grid, effective_weight_layers<dim>(scene.soil, is_wet ? &parameters : nullptr), scene.gravity, spacing);
  error = largest = 0;
  for (const SoilRegion &body : scene.soil)
    {
      ElasticSoil<dim> soil(grid, body.region, 2, 1. - body.bulk_density / grain_density, grain_density);
      set_k0_stress(soil, soil_above, K0, "");
      for_each_point(soil.points, [&](const auto &point) {
        const double *stress  = point.properties + soil.layout.stress;
        const double expected = scene.stress(point.location);
        largest               = std::max(largest, expected);
        for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
          error = std::max(error, std::abs(stress[c] + (c == soil_above.axis ? 1. : c < 3 ? K0 : 0.) * expected));
      });
    }
  if (!scene.soil.empty())
    compare(error, largest, "stress");
}


const UnitTest registered("stress_at_start", [] {
  const double n = 0.4, water = g * water_density, dry = g * grain_density * (1 - n);
  const double lift = g * water_density * (1 - n), buoyant = dry - lift; // unit weights, N/m^3
  const double light = g * grain_density * 0.2;                          // of a porosity of 0.8
  const Tensor<1, 2> down({ 0, -g }), right({ g, 0 });

  test<2>({ "dry slope", "", { layer("if(x < 0.4, y < 0.8, y < 1 - 0.5*x)", n) }, down, {}, [&](const auto &x) {
             return dry * ((x[0] < 0.4 ? 0.8 : 1 - 0.5 * x[0]) - x[1]);
           } });
  test<3>({ "dry slope", "", { layer("z < 0.8 - 0.5*x", n) }, Tensor<1, 3>({ 0, 0, -g }), {}, [&](const auto &x) {
             return dry * (0.8 - 0.5 * x[0] - x[2]);
           } });
  // The lower layer's surface rises by a fifth; the upper one's is level. A layer thinner than a quarter of a cell may
  // be overlooked, so this one does not run out.
  test<2>({ "dry layers",
            "",
            { layer("y < 0.8 && y < 0.3 + 0.2*x", n), layer("y < 0.8 && y >= 0.3 + 0.2*x", 0.8) },
            down,
            {},
            [&](const auto &x) {
              const double interface = 0.3 + 0.2 * x[0];
              return dry * std::max(0., interface - x[1]) + light * (0.8 - std::max(x[1], interface));
            } });
  test<2>({ "pool", "y < 0.73", {}, down, [&](const auto &x) { return water * (0.73 - x[1]); }, {} });
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
});
} // namespace test_stress_at_start

// Runs with mpirun=1,2.
