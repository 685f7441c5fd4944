// SPDX-License-Identifier: LGPL-2.1-or-later
// The measures of the statistics on fields made by hand.
#include "../soil.h"

#include <scree/postprocess/measures.h>
#include <scree/tensor/invariants.h>

namespace test_output_measures
{
template <int dim>
struct Scene : SoilScene<dim>
{
  using SoilScene<dim>::grid;
  using SoilScene<dim>::bodies;
  using SoilScene<dim>::water;

  explicit Scene(const std::vector<std::string> &regions)
      : SoilScene<dim>(-0.3, 0.9)
  {
    for (const auto &region : regions)
      this->add_soil(region);
  }

  /// Water with 2^dim points in each cell whose middle is in the region; it fills `part` of these cells.
  void add_water(const std::string &region, const double part)
  {
    const Region<dim> where("water", region);
    if (water.empty())
      water.emplace_back(1000., false, grid.triangulation(), grid.mapping());
    auto &set                = water.back();
    constexpr unsigned int n = 1 << dim;
    std::vector<double> properties(set.points().stride(), 0.);
    properties[set.layout.volume] = part * std::pow(grid.cell_size(), dim) / n;
    properties[set.layout.mass]   = set.density * properties[set.layout.volume];
    types::particle_index id      = 0; // of one rank only: nobody asks
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && where.contains(cell->center()))
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto reference = point_of<dim>([i](const unsigned int a) { return (i >> a) & 1 ? 0.75 : 0.25; });
            set.points().add(cell, cell->vertex(0) + grid.cell_size() * reference, id++, properties);
          }
    set.points().finish_adding();
  }

  /// Gives the water points the pressure of their place.
  template <typename Pressure>
  void set_water_pressure(const Pressure &pressure)
  {
    for (auto &one : water)
      for_each_point(one.points(),
                     [&](const auto &point) { point.properties[one.layout.pressure] = pressure(point.location); });
  }

  /// Gives the points the pressure of their place, and shear and stress deviators that must not matter.
  template <typename Pressure>
  void set_pressure(const Pressure &pressure)
  {
    for (auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        double *stress = point.properties + body.layout.stress;
        const double P = pressure(point.location);
        for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
          stress[c] = c < 3 ? -P + (c == 0 ? 300. : -150.) : 70.;
      });
  }
};

/// 0 and 2 in turns of points or cells of this width.
template <int dim>
auto turns(const double width)
{
  return [width](const Point<dim> &x) {
    long sum = 0;
    for (unsigned int a = 0; a < dim; ++a)
      sum += std::lround((x[a] + 0.3) / width - 0.5);
    return sum % 2 ? 2. : 0.;
  };
}

/// The fraction f of a block's mass lies below its lower face plus f times its length, to within half a point's width;
/// where the mass adds up to the fraction exactly at a point, that point is the percentile, whatever the rounding.
template <int dim>
void test_percentiles()
{
  const Scene<dim> scene({ "x > 0.1 && x < 0.5 && y < 0.3", "x > 0.5 && x < 0.8 && y < 0.3" });
  constexpr double half_width = 0.025;
  const std::vector<double> fractions{ 0.005, 0.33, 0.5, 0.9, 0.99, 1. };
  const auto percentiles = mass_percentiles(scene.bodies, scene.grid, fractions);
  for (unsigned int i = 0; i < fractions.size(); ++i)
    {
      expect(percentiles[i], 0.1 + 0.7 * fractions[i], half_width + 1e-9, "percentile");
      // The percentile is the place of a point: points are in the middle of their lattice, 0.05 m wide.
      const double lattice = (percentiles[i] - 0.1 - half_width) / 0.05;
      expect(lattice, std::round(lattice), 1e-6, "place of a percentile on the lattice of points");
    }

  const Scene<dim> block({ "x > 0 && x < 0.5 && y < 0.3 && x + y > -2" });
  for (unsigned int tenths = 1; tenths < 10; ++tenths)
    expect(mass_percentiles(block.bodies, block.grid, { 0.1 * tenths })[0], 0.05 * tenths - 0.025, 1e-9, "tie");
}

template <int dim>
void test_oscillation()
{
  // An oblique surface: linear fits next to it see half-filled cells.
  Scene<dim> scene({ "y < 0.5 - 0.6 * x", "y > 0.5 - 0.6 * x && y < 0.8 - 0.6 * x" });
  scene.set_pressure(
      [](const Point<dim> &x) { return 5000 - 3000 * x[0] + 2000 * x[1] + (dim == 3 ? 1500 * x[dim - 1] : 0.); });
  expect(stress_oscillation(scene.bodies, scene.grid), 0, 1e-10, "oscillation of a linear pressure");

  // Neighbouring points of a full block take turns: the fit is 1, the residual 1, and so is the mean.
  Scene<dim> block({ "x > -0.1 && y < 0.5" });
  block.set_pressure(turns<dim>(0.05));
  expect(stress_oscillation(block.bodies, block.grid), 1, 1e-6, "oscillation of turns of points");
  // Neighbouring cells take turns: of 3^dim cells one more has the sign of the one in the middle.
  block.set_pressure(turns<dim>(0.1));
  expect(stress_oscillation(block.bodies, block.grid), dim == 2 ? 1.04492 : 0.985881, 1e-5, "of turns of cells");
  block.set_pressure([](const Point<dim> &) { return 0.; });
  expect(stress_oscillation(block.bodies, block.grid), 0, 0, "oscillation of soil without stress");
}

/// Soil in 0 < x < 0.4, which is all grains, and water that reaches from its middle to x = 0.6.
template <int dim>
void test_water()
{
  Scene<dim> scene({ "x > 0 && x < 0.4 && y < 0.3" });
  WaterMeasures dry = measure_water(scene.bodies, scene.water, scene.grid);
  expect(dry.mass + dry.largest_pressure + dry.volume_error, 0., 0., "water of a dry scene");

  scene.add_water("x > 0.2 && x < 0.6 && y < 0.3", 0.8);
  scene.set_water_pressure([](const Point<dim> &x) { return 1000. * (x[0] - x[1]); });
  const WaterMeasures wet = measure_water(scene.bodies, scene.water, scene.grid);
  const double column     = 0.6 * std::pow(1.2, dim - 2); // m, times a width in x: a volume
  expect(wet.n_points, std::pow(2., dim) * 0.4 * column / std::pow(0.1, dim), 1e-6, "number of water points");
  expect(wet.mass, 800. * 0.4 * column, 1e-8, "water mass");
  expect(wet.mass_outside_soil, 800. * 0.2 * column, 1e-8, "water outside soil");
  expect(wet.smallest_pressure, 1000. * (0.225 - 0.275), 1e-8, "smallest p");
  expect(wet.largest_pressure, 1000. * (0.575 + 0.275), 1e-8, "largest p");
  expect(wet.tip, 0.575, 1e-12, "tip of the water");
  // Two columns of cells hold all grains and 0.8 of water.
  const double error = 0.8 * 0.2 / (0.4 + 0.8 * 0.4);
  expect(wet.volume_error, error, 1e-10, "volume error");
  expect(mass_percentiles(scene.water, scene.grid, { 0.5 })[0], 0.375, 1e-9, "middle of the water");

  // The second time the free cells overflow, too.
  scene.add_water("x > 0.2 && x < 0.6 && y < 0.3", 1.2);
  expect(measure_water(scene.bodies, scene.water, scene.grid).volume_error,
         (2. * 0.2 + 1. * 0.2) / (0.4 + 2. * 0.4),
         1e-10,
         "volume error of doubly filled cells");
}

/// Of p as of P; without soil.
template <int dim>
void test_pressure_oscillation()
{
  Scene<dim> scene({});
  expect(pressure_oscillation(scene.water, scene.grid), 0., 0., "oscillation of no water");
  scene.add_water("x > -0.1 && y < 0.5", 1.);
  scene.set_water_pressure([](const Point<dim> &x) { return 5000 - 3000 * x[0] + 2000 * x[1]; });
  expect(pressure_oscillation(scene.water, scene.grid), 0., 1e-10, "oscillation of a linear p");

  scene.set_water_pressure(turns<dim>(0.05));
  expect(pressure_oscillation(scene.water, scene.grid), 1., 1e-10, "oscillation of a checkerboard");
  expect(stress_oscillation(scene.bodies, scene.grid), 0., 0., "oscillation of no soil");
  expect(mass_percentiles(scene.bodies, scene.grid, { 0.9 })[0], -0.3, 1e-9, "front of no soil");
}

/// Soil at 2 m/s that carries water at 3 m/s, single-point.
template <int dim>
void test_carried_water()
{
  Scene<dim> scene({ "x > 0 && x < 0.4 && y < 0.3" });
  SoilBody<dim> &soil          = scene.add_wet_soil("x > 0.5 && x < 0.8 && y < 0.3", 0.5);
  const WaterPhase<dim> &water = scene.water.back();
  for_each_point(soil.points, [&](const auto &point) {
    double *properties                        = point.properties;
    properties[soil.layout.velocity]          = 2.;
    properties[water.layout.velocity]         = 3.;
    properties[soil.layout.left_cauchy_green] = 1.1;
  });
  const WaterMeasures wet = measure_water(scene.bodies, scene.water, scene.grid);
  const double volume     = 0.3 * 0.6 * std::pow(1.2, dim - 2);
  expect(wet.mass, 500. * volume, 1e-8, "mass of carried water");
  expect(wet.mass_outside_soil, 0., 0., "carried water outside soil");
  expect(wet.volume_error, 0., 1e-12, "volume error of full pores");

  const PointSums<dim> sums(scene.bodies, scene.water, Tensor<1, dim>(), scene.grid);
  expect(sums.momentum[0], (1000. * 2. + 500. * 3.) * volume, 1e-8, "momentum of soil and water");
  expect(sums.kinetic, 0.5 * (1000. * 4. + 500. * 9.) * volume, 1e-8, "kinetic energy of soil and water");
  expect(sums.largest_porosity, 0.5, 1e-12, "porosity");
}


template <int dim>
void test()
{
  test_percentiles<dim>();
  test_oscillation<dim>();
  test_water<dim>();
  test_pressure_oscillation<dim>();
  test_carried_water<dim>();
}


const UnitTest registered("output_measures", [] {
  test<2>();
  test<3>();
});
} // namespace test_output_measures

// Runs with mpirun=1,2.
