// SPDX-License-Identifier: LGPL-2.1-or-later
// Averages of the strain that softens soil, own + 2 (mean - own): of fields whose mean is known.
#include "../soil.h"

#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/transfer/nonlocal_average.h>

namespace test_nonlocal_average
{
constexpr double cell_size = 0.25, length = 0.5; // m; box: 8 m wide, 6 m high (and deep)


MaterialParameters material()
{
  MaterialParameters parameters;
  parameters.law                 = "Mohr-Coulomb";
  MohrCoulombParameters &clay    = parameters.of<MohrCoulombParameters>();
  clay.cohesion                  = 1e3;
  clay.softening.strain          = 0.1;
  clay.softening.cohesion        = 0;
  clay.softening.nonlocal_length = length;
  return parameters;
}


template <int dim>
struct Soil
{
  explicit Soil(const std::string &region)
      : body("Soil",
             1e3,
             2e3,
             make_material<dim>(material()),
             PropertyLayout<dim>(3, false),
             grid.triangulation(),
             grid.mapping())
  {
    seed_region(body, grid, region, 2);
  }

  /// Sets the strain of all points to `field` of their place, and averages it.
  template <typename Field>
  void update(const Field &field)
  {
    for_each_point(body.points, [&](const auto &point) { own(point) = field(point.location); });
    average.update(body);
  }

  static double &own(const PointView<dim, double> &point)
  {
    return point.properties[PropertyLayout<dim>::internal_variables + 1];
  }

  static double averaged(const PointView<dim, double> &point)
  {
    return point.properties[PropertyLayout<dim>::internal_variables + 2];
  }

  /// The largest difference of the mean from `expected` of the place, where `condition` of it holds.
  template <typename Condition, typename Field>
  double largest_error(const Condition &condition, const Field &expected)
  {
    double largest = 0.;
    unsigned int n = 0;
    for_each_point(body.points, [&](const auto &point) {
      if (!condition(point.location))
        return;
      ++n;
      const double mean = (averaged(point) + own(point)) / 2.; // m = 2
      largest           = std::max(largest, std::abs(mean - expected(point.location)));
    });
    require(sum_of_ranks(n) > 20, "hardly any points were looked at");
    return max_of_ranks(largest);
  }

  BackgroundGrid<dim> grid{
    grid_box(0., dim == 2 ? std::vector<double>{ 8., 6. } : std::vector<double>{ 8., 6., 6. }, cell_size),
    MPI_COMM_WORLD
  };
  SoilBody<dim> body;
  NonlocalAverage<dim> average{ grid };
};


template <int dim>
void test()
{
  const std::string name = std::to_string(dim) + "D: ";
  const auto everywhere  = [](const Point<dim> &) { return true; };
  const auto inside      = [](const Point<dim> &x) { // beyond the passes from the faces
    bool is_inside = x[0] > 3. && x[0] < 5.;
    for (unsigned int d = 1; d < dim; ++d)
      is_inside = is_inside && x[d] > 2.8 && x[d] < 3.2;
    return is_inside;
  };
  Soil<dim> block("x < 8");
  const auto constant = [](const Point<dim> &) { return 0.7; };
  block.update(constant);
  expect(block.largest_error(everywhere, constant), 0, 1e-14, name + "error of a constant");

  const auto linear = [](const Point<dim> &x) { return 0.3 * x[0] - 0.2 * x[dim - 1]; };
  block.update(linear);
  expect(block.largest_error(inside, linear), 0, 1e-13, name + "error of a linear field");

  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      const auto square = [&](const Point<dim> &x) { return x[axis] * x[axis]; };
      block.update(square);
      const auto expected = [&](const Point<dim> &x) { return square(x) + length * length; };
      expect(block.largest_error(inside, expected) / (length * length), 0, 0.03, name + "error of the variance");
    }

  // An empty cell lies between the two.
  Soil<dim> halves("x < 4 || x > 4.25");
  const auto left = [](const Point<dim> &x) { return x[0] < 4.1 ? 1. : 0.; };
  halves.update(left);
  expect(halves.largest_error(everywhere, left), 0, 1e-14, name + "error beside a gap");
}


const UnitTest registered("nonlocal_average", [] {
  expect(NonlocalAverage<2>::n_passes(0.5), 0, 0, "passes for half a cell");
  expect(NonlocalAverage<2>::n_passes(1), 2, 0, "passes for one cell");
  expect(NonlocalAverage<2>::n_passes(2), 8, 0, "passes for two cells");
  test<2>();
  test<3>();
});
} // namespace test_nonlocal_average

// Runs with mpirun=1,2.
