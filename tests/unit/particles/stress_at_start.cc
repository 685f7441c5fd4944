// SPDX-License-Identifier: LGPL-2.1-or-later
// Stress and pressure at the start: pressure is the weight of the water above, in the soil and outside; the soil's
// vertical stress is the weight above less the pressure, horizontal ones are K0 times that, shear is none. Below a
// level and an inclined surface, dry and with the water table above and inside the soil, in two layers, and with
// gravity along any axis.
#include "../soil.h"

#include <scree/initial/geostatic.h>

#include <deal.II/base/function_parser.h>

#include <map>

namespace test_stress_at_start
{
constexpr double g = 9.81, K0 = 0.683, water_density = 1025, grain_density = 2650, n = 0.4;

/// Unit weights, N/m^3: of water; of soil of porosity n, dry and what water takes of it; of dry soil of porosity 0.8;
/// of soil of porosity 0.2 under water.
const std::map<std::string, double> weights{ { "water", { water_density * g } },
                                             { "dry", { (1 - n) * grain_density * g } },
                                             { "lift", { (1 - n) * water_density * g } },
                                             { "light", { 0.2 * grain_density * g } },
                                             { "dense", { 0.8 * (grain_density - water_density) * g } } };

SoilRegion layer(const std::string &region, const double porosity)
{
  return { "Soil", region, porosity, grain_density * (1. - porosity) };
}

/// Where soil and water are ("": none), and what their pressure and stress, Pa, should be at a place.
template <int dim>
void test(const std::string &name,
          const std::string &water_region,
          const std::vector<SoilRegion> &layers,
          const Tensor<1, dim> &gravity,
          const std::string &pressure_at,
          const std::string &stress_at)
{
  FunctionParser<dim> pressure, stress_of_place;
  const std::string axes = FunctionParser<dim>::default_variable_names();
  pressure.initialize(axes, pressure_at, weights);
  stress_of_place.initialize(axes, stress_at, weights);
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1.), MPI_COMM_WORLD);
  const double spacing = grid.cell_size() / 4;
  // Columns are shared by points closer than a hundred thousandth of a cell; surfaces are found to 1e-9 of the height.
  const auto compare = [&](const double error, const double largest, const std::string &what) {
    expect(max_of_ranks(error) / max_of_ranks(largest), 0., 1e-5, name + ": error of the " + what);
  };
  WaterParameters parameters;
  parameters.region          = water_region;
  parameters.density         = water_density;
  parameters.points_per_cell = 2;
  const bool is_wet          = !water_region.empty();
  double error = 0, largest = 0;
  if (is_wet)
    {
      WaterPhase<dim> water(water_density, false, grid.triangulation(), grid.mapping());
      seed_water(water, parameters, layers, { grid.triangulation(), grid.cell_size() });
      Overburden<dim> water_above(grid, water_layers<dim>(parameters, layers), gravity, spacing);
      set_hydrostatic_pressure(water, water_above);
      for_each_point(water.points(), [&](const auto &point) {
        const double *properties = point.properties;
        const double expected    = pressure.value(point.location);
        largest                  = std::max(largest, expected);
        error                    = std::max(error, std::abs(properties[water.layout.pressure] - expected));
        for (unsigned int a = 0; a < dim; ++a)
          expect(properties[water.layout.pressure_gradient + a],
                 water_density * gravity[a],
                 1e-10,
                 "pressure gradient, which is the weight of the water");
      });
      compare(error, largest, "pressure");
    }

  Overburden<dim> soil_above(
      grid, effective_weight_layers<dim>(layers, is_wet ? &parameters : nullptr), gravity, spacing);
  error = largest = 0;
  for (const SoilRegion &body : layers)
    {
      ElasticSoil<dim> soil(grid, body.region, 2, 1. - body.bulk_density / grain_density, grain_density);
      set_k0_stress(soil, soil_above, K0, "");
      for_each_point(soil.points, [&](const auto &point) {
        const double *stress  = point.properties + soil.layout.stress;
        const double expected = stress_of_place.value(point.location);
        largest               = std::max(largest, expected);
        for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
          error = std::max(error, std::abs(stress[c] + (c == soil_above.axis ? 1. : c < 3 ? K0 : 0.) * expected));
      });
    }
  if (!layers.empty())
    compare(error, largest, "stress");
}


const UnitTest registered("stress_at_start", [] {
  const Tensor<1, 2> down({ 0, -g }), right({ g, 0 });
  const Tensor<1, 3> down_3d({ 0, 0, -g });
  const std::string top = "if(x < 0.4, 0.8, 1 - 0.5*x)", incline = "(0.3 + 0.2*x)", slope = "(0.3 + 0.4*x)";
  test("dry slope", "", { layer("if(x < 0.4, y < 0.8, y < 1 - 0.5*x)", n) }, down, "0", "dry*(" + top + " - y)");
  test("dry slope", "", { layer("z < 0.8 - 0.5*x", n) }, down_3d, "0", "dry*(0.8 - 0.5*x - z)");
  // The lower layer's surface rises by a fifth; the upper one's is level. A layer thinner than a quarter of a cell may
  // be overlooked, so this one does not run out.
  test("dry layers",
       "",
       { layer("y < 0.8 && y < 0.3 + 0.2*x", n), layer("y < 0.8 && y >= 0.3 + 0.2*x", 0.8) },
       down,
       "0",
       "dry*max(0, " + incline + " - y) + light*(0.8 - max(y, " + incline + "))");
  test("pool", "y < 0.73", {}, down, "water*(0.73 - y)", "0");
  const std::string buoyant = "(dry - lift)*(" + slope;
  test("submerged incline", "y < 0.9", { layer("y < 0.3 + 0.4*x", n) }, down, "water*(0.9 - y)", buoyant + " - y)");
  test("water table inside",
       "y < 0.47",
       { layer("y < 0.8", n) },
       down,
       "water*(0.47 - y)",
       "dry*(0.8 - y) - lift*max(0, 0.47 - y)");
  test("saturated layers",
       "same",
       { layer("y < 0.4", n), layer("y >= 0.4 && y < 0.8", 0.2) },
       down,
       "water*(0.8 - y)",
       "(dry - lift)*max(0, 0.4 - y) + dense*(0.8 - max(0.4, y))");
  test("gravity to the right", "x > 0.2", { layer("x > 0.5", n) }, right, "water*(x - 0.2)", "(dry - lift)*(x - 0.5)");
  test("submerged", "z < 0.9", { layer("z < 0.3 + 0.4*x", n) }, down_3d, "water*(0.9 - z)", buoyant + " - z)");
});
} // namespace test_stress_at_start

// Runs with mpirun=1,2.
