// SPDX-License-Identifier: LGPL-2.1-or-later
// Values at places, columns above the ground and the front, of fields made by hand.
#include "../soil.h"

#include <scree/postprocess/measures.h>
#include <scree/postprocess/probes.h>

namespace test_output_probes
{
/// A block of soil in a box from -0.3 m to 0.9 m with cells of 0.1 m, full of water.
template <int dim>
struct Block : SoilScene<dim>
{
  explicit Block(const std::string &region)
      : SoilScene<dim>(-0.3, 0.9)
  {
    SoilBody<dim> &soil = this->add_wet_soil(region, 0.5, 3);
    const auto &layout  = this->water.back().layout;
    for_each_point(soil.points, [&](const auto &point) {
      double *properties                     = point.properties;
      properties[layout.pressure]            = linear(point.location);
      properties[soil.layout.velocity]       = 2. * linear(point.location);
      properties[soil.layout.stress + 1]     = -3. * linear(point.location);
      properties[layout.velocity + dim - 1u] = 7.;
    });
  }

  static double linear(const Point<dim> &x)
  {
    double value = 1.;
    for (unsigned int a = 0; a < dim; ++a)
      value += (a + 1.) * x[a];
    return value;
  }
};

template <int dim>
Point<dim> place(const double x, const double y)
{
  return point_of<dim>([&](const unsigned int a) { return a == 0 ? x : y; });
}

/// A linear field is found to rounding inside, at a wall, in a corner and a little above the surface.
template <int dim>
void test_places()
{
  const Block<dim> block("x < 0.5 && y < 0.3");
  const std::vector<Point<dim>> places{ place<dim>(0.123, 0.1), place<dim>(0.2, -0.3), place<dim>(-0.3, -0.3),
                                        place<dim>(0.1, 0.3),   place<dim>(0.7, 0.1),  place<dim>(0.1, 0.4) };
  const PlaceValues<dim> values(block.grid, places);
  const auto soil = values.of_soil(block.bodies), water = values.of_water(block.water);
  const auto names = PlaceValues<dim>::names_of_soil();
  AssertDimension(names.size(), soil[0].size());
  for (unsigned int i = 0; i < 4; ++i)
    {
      const double f = Block<dim>::linear(places[i]);
      expect(soil[i][0], 2. * f, 1e-10, names[0]);
      expect(soil[i][1], 0., 1e-10, names[1]);
      expect(soil[i][dim + 1], -3. * f, 1e-10, names[dim + 1]);
      expect(soil[i][names.size() - 2], f, 1e-10, names[names.size() - 2]);
      expect(soil[i].back(), 0.5, 1e-10, names.back());
      expect(water[i][0], f, 1e-10, "p");
      expect(water[i].back(), 7., 1e-10, "velocity of the water");
    }
  for (unsigned int i = 4; i < 6; ++i)
    require(std::isnan(soil[i][0]) && std::isnan(water[i].back()), "There is no material.");
}


/// A block of 0.6 m on the ground at -0.3 m, which ends at x = 0.5 m.
template <int dim>
void test_columns()
{
  const Block<dim> block("x < 0.5 && " + std::string(dim == 2 ? "y" : "z") + " < 0.3");
  std::vector<std::vector<double>> places{ { 0.123 }, { -0.3 }, { 0.8 } };
  if (dim == 3)
    for (auto &one : places)
      one.push_back(0.37);
  for (const auto &lumps : { point_volumes(block.bodies), point_volumes(block.bodies, block.water, block.grid) })
    {
      const auto columns = ground_columns(lumps, places, block.grid);
      for (unsigned int i = 0; i < 2; ++i)
        {
          expect(columns[i].height, 0.3, 1e-9, "height");
          expect(columns[i].thickness, 0.6, 1e-9, "thickness");
        }
      expect(columns[2].thickness, 0., 0., "thickness beside the block");
      require(std::isnan(columns[2].height), "There is no surface.");

      const auto [rear, front] = rear_and_front(lumps, 0.3, block.grid);
      expect(rear, -0.3, 1e-12, "rear");
      expect(front, 0.5, 1e-9, "front: half the thickness between the last column's centre and the next one's");
      require(std::isnan(rear_and_front(lumps, 0.7, block.grid).second), "It is nowhere as thick.");
    }
}


/// A wedge from 0.6 m at x = -0.3 m to nothing at x = 0.9 m: thickness, height and front follow its slope.
void test_wedge()
{
  const Block<2> block("y < -0.3 + 0.5 * (0.9 - x)");
  const auto lumps  = point_volumes(block.bodies);
  const auto column = ground_columns(lumps, { { 0.3 } }, block.grid)[0];
  expect(column.thickness, 0.3, 0.005, "thickness");
  expect(column.height, 0., 0.025, "height");
  expect(rear_and_front(lumps, 0.2, block.grid).second, 0.5, 0.01, "front");
}


const UnitTest registered("output_probes", [] {
  test_places<2>();
  test_places<3>();
  test_columns<2>();
  test_columns<3>();
  test_wedge();
});
} // namespace test_output_probes

// Runs with mpirun=1,2.
