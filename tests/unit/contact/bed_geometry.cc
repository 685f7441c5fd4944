// SPDX-License-Identifier: LGPL-2.1-or-later
// Distances and normals of rigid ground: of a profile and of a raster of heights against the nearest of many places on
// it, of an expression that is no distance against the closed form; where the ground is missing; and as the mesh
// samples an arc, at rest (moved: scenes/obstacle_moving_tank); from places one by one and in batches, of ground in
// parts, too.
#include "../test.h"

#include <scree/geometry/bed_parameters.h>
#include <scree/mesh/discrete_level_set.h>

#include <array>

namespace test_bed_geometry
{
/// A view must tell the distance to the nearest of some places within `spacing`, its side, and a unit normal
/// that leads back to the ground.
template <int dim>
void compare(const LevelSet<dim> &ground,
             const Point<dim> &x,
             const std::vector<Point<dim>> &places,
             const double spacing,
             const std::string &what)
{
  constexpr double reach = 2.;
  double nearest         = std::numeric_limits<double>::infinity();
  for (const Point<dim> &place : places)
    nearest = std::min(nearest, place.distance(x));
  const SurfaceView<dim> view = ground.view(x, reach);
  const double distance       = std::abs(view.distance);
  require(distance <= nearest * (1. + 1e-12) && distance >= nearest - spacing, what + ": distance");
  require((view.distance > 0.) == ground.is_open(x), what + ": side");
  expect(view.normal.norm(), 1., 1e-12, what + ": length of the normal");
  expect(ground.view(x - view.distance * view.normal, reach).distance, 0., 1e-12, what + ": distance of the foot");
}


void test_profile()
{
  RandomNumbers random;
  const std::vector<Point<2>> corners{
    { 0., 1. }, { 0.4, 0.2 }, { 0.5, 0.9 }, { 0.9, 0.9 }, { 1.3, 0.1 }, { 3., 0.4 }
  };
  const Profile profile(corners);
  constexpr unsigned int n = 2000; // places a segment
  std::vector<Point<2>> places;
  for (unsigned int s = 0; s + 1 < corners.size(); ++s)
    for (unsigned int i = 0; i <= n; ++i)
      places.push_back(corners[s] + i / double(n) * (corners[s + 1] - corners[s]));
  for (unsigned int k = 0; k < 500; ++k)
    compare<2>(profile, Point<2>(random.uniform(0., 3.), random.uniform(0., 1.5)), places, 2. / n, "profile");
  const SurfaceView<2> at_bend = profile.view(Point<2>(0.9, 1.), 2.);
  expect(at_bend.distance, 0.1, 1e-14, "profile: over a bend");
  expect(profile.view(Point<2>(0.7, 0.9), 2.).normal[1], 1., 1e-14, "profile: normal on the ground");
  expect(profile.view(Point<2>(2., 5.), 0.3).distance, 0.3, 0., "profile: out of reach");
}


void test_raster()
{
  RandomNumbers random;
  Raster raster;
  raster.n_columns = 6;
  raster.n_rows    = 5;
  raster.x         = -0.2;
  raster.y         = 0.1;
  raster.spacing   = 0.4;
  for (unsigned int i = 0; i < raster.n_columns * raster.n_rows; ++i)
    raster.values.push_back(random.uniform(0., 0.5));
  constexpr unsigned int n = 40; // places a triangle and axis
  std::vector<Point<3>> places;
  const auto node = [&](const unsigned int i, const unsigned int j) {
    return Point<3>(raster.x + i * raster.spacing, raster.y + j * raster.spacing, raster(i, j));
  };
  for (unsigned int j = 0; j + 1 < raster.n_rows; ++j)
    for (unsigned int i = 0; i + 1 < raster.n_columns; ++i)
      for (const bool is_lower : { true, false })
        for (unsigned int s = 0; s <= n; ++s)
          for (unsigned int t = 0; s + t <= n; ++t)
            {
              const Point<3> corner = is_lower ? node(i, j) : node(i + 1, j + 1);
              places.push_back(corner + s / double(n) * (node(i + 1, j) - corner) +
                               t / double(n) * (node(i, j + 1) - corner));
            }
  const HeightSurface ground(raster);
  for (unsigned int k = 0; k < 200; ++k)
    compare<3>(ground,
               Point<3>(random.uniform(raster.x, raster.last_x()),
                        random.uniform(raster.y, raster.last_y()),
                        random.uniform(0., 1.)),
               places,
               0.02,
               "raster");
  raster.values[8] = std::numeric_limits<double>::quiet_NaN();
  const HeightSurface with_hole(raster);
  const Point<3> at_hole(raster.x + 2.1 * raster.spacing, raster.y + 1.1 * raster.spacing, -10.);
  require(with_hole.is_open(at_hole) && !ground.is_open(at_hole), "raster: missing height");
  // The ground ends at the hole in vertical walls: on both sides of the one at the fourth column.
  for (const double column : { 2.8, 3.1 })
    {
      const SurfaceView<3> wall =
          with_hole.view({ raster.x + column * raster.spacing, raster.y + 1.1 * raster.spacing, -10. }, 2.);
      expect(wall.distance, (3. - column) * raster.spacing, 1e-12, "raster: distance of a rim");
      expect(wall.normal[0], -1., 1e-12, "raster: normal of a rim");
    }
  const auto tells_of_holes = [](const HeightSurface &surface) {
    return surface.remark().find("are missing") != std::string::npos;
  };
  require(tells_of_holes(with_hole) && !tells_of_holes(ground), "raster: remark");
}


void test_expression()
{
  RandomNumbers random;
  const ExpressionSurface<2> circle("", "7*(x^2 + y^2 - 0.25)", 0.05);
  const ExpressionSurface<3> sphere("", "exp(0.25 - x^2 - y^2 - z^2) - 1", 0.05);
  double error = 0;
  for (unsigned int k = 0; k < 200; ++k)
    {
      const double radius = random.uniform(0.35, 0.65), angle = random.uniform(0., 2. * numbers::PI),
                   height = random.uniform(-1., 1.);
      const Point<2> direction(std::cos(angle), std::sin(angle));
      const double across = std::sqrt(1. - height * height);
      const Point<3> direction_3d(across * direction[0], across * direction[1], height);
      const SurfaceView<2> of_circle = circle.view(Point<2>(radius * direction), 0.3);
      const SurfaceView<3> of_sphere = sphere.view(Point<3>(radius * direction_3d), 0.3);
      error                          = std::max({ error,
                                                  std::abs(of_circle.distance - (radius - 0.5)),
                                                  (of_circle.normal - direction).norm(),
                                                  std::abs(of_sphere.distance - (0.5 - radius)),
                                                  (of_sphere.normal + direction_3d).norm() });
    }
  expect(error, 0., 1e-8, "error of circle and sphere");
}


template <int dim>
void test_samples()
{
  const auto centre = point_of<dim>([](const unsigned int a) { return a + 1 == dim ? 2.3 : 0.8; });
  const auto errors = [&](const double cell_size) {
    const BackgroundGrid<dim> grid(grid_box<dim>(0., 1.6, cell_size), MPI_COMM_WORLD);
    const ExpressionSurface<dim> bowl("",
                                      dim == 2 ? "2 - sqrt((x - 0.8)^2 + (y - 2.3)^2)"
                                               : "2 - sqrt((x - 0.8)^2 + (y - 0.8)^2 + (z - 2.3)^2)",
                                      cell_size);
    const DiscreteLevelSet<dim> sampled(grid, bowl);
    RandomNumbers random;
    double largest = 0, off = 0;
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      if (sampled.is_near(cell->active_cell_index()))
        {
          const Point<dim> place      = random.point<dim>(0., 1.);
          const Tensor<1, dim> way    = centre - (cell->vertex(0) + cell_size * Tensor<1, dim>(place));
          const SurfaceView<dim> view = sampled.view(cell->active_cell_index(), place);
          largest                     = std::max(largest, std::abs(view.distance - (2. - way.norm())));
          off                         = std::max(off, (view.normal - way / way.norm()).norm());
          require(view.distance >= sampled.least_distance(cell->active_cell_index()), "least distance");
        }
    return std::make_pair(largest, off);
  };
  const auto coarse = errors(0.1), fine = errors(0.05);
  // (dim - 1) h^2/(8 R) of a function with curvature 1/R along the surface.
  expect(coarse.first, 0., 0.01 * (dim - 1) / 16. * 1.3, "error of the distance to an arc");
  require(coarse.first / fine.first > 3. && coarse.second / fine.second > 3., "samples: order");
}


/// Distances in batches are those of the nearest part, in the cells of the places and beside them.
template <int dim>
void test_batches()
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1.), MPI_COMM_WORLD);
  const ExpressionSurface<dim> plane("", dim == 2 ? "0.6*x + 0.8*y - 0.4" : "0.6*x + 0.8*z - 0.4", 0.1),
      wall("", "0.7 - x", 0.1);
  const DiscreteLevelSet<dim> at_rest(grid, plane);
  DiscreteLevelSet<dim> moving(grid, wall, SurfaceMotion::rigid);
  const Tensor<1, dim> displacement = -0.033 * Point<dim>::unit_vector(0);
  moving.move_to(displacement);
  const RigidBoundary<dim> ground({ { &at_rest }, { &moving, &displacement } });
  RandomNumbers random;
  unsigned int n_near = 0;
  for (unsigned int cell = 0; cell < grid.triangulation().n_active_cells(); ++cell)
    {
      if (std::isinf(ground.least_distance(cell)))
        continue;
      ++n_near;
      std::array<Batch, dim> places;
      std::array<Point<dim>, batch_size> same;
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          same[l] = random.point<dim>(-0.2, 1.2);
          for (unsigned int a = 0; a < dim; ++a)
            places[a][l] = same[l][a];
        }
      const Batch distances = ground.distances(cell, places);
      for (unsigned int l = 0; l < batch_size; ++l)
        expect(distances[l], ground.view(cell, same[l]).distance, 1e-14, "distance in a batch");
    }
  require(n_near > 0, "batches: no cell is near");
}


const UnitTest registered("bed_geometry", [] {
  test_profile();
  test_raster();
  test_expression();
  test_samples<2>();
  test_samples<3>();
  test_batches<2>();
  test_batches<3>();
});
} // namespace test_bed_geometry
