// SPDX-License-Identifier: LGPL-2.1-or-later
// What rigid ground leaves open of the cells: volume, moments of third degree, hat functions and the ground's own area
// and normal, of planes at any angle and place to rounding, of a circle and a sphere to second order; ground on cells'
// faces.
#include "../test.h"

#include <scree/geometry/bed_parameters.h>
#include <scree/mesh/cut_cells.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <numeric>

namespace test_bed_cells
{
/// A half space.
template <int dim>
struct Plane : LevelSet<dim>
{
  Point<dim> origin;
  Tensor<1, dim> normal;

  bool is_open(const Point<dim> &x) const override
  {
    return (x - origin) * normal > 0.;
  }
  SurfaceView<dim> view(const Point<dim> &x, const double) const override
  {
    return { (x - origin) * normal, normal };
  }
};


/// The corner of a cell with this active cell index.
template <int dim>
Point<dim> lower_corner(const BackgroundGrid<dim> &grid, const unsigned int cell)
{
  const auto &cells = grid.fine_cells();
  return cells.box().corner(cells.cells()[cells.of_index(cell)].place);
}


/// Integral of x^p (x along all axes, over the cell's width) over the open part of the box, by cells.
template <int dim>
double
moment(const BackgroundGrid<dim> &grid, const CutCells<dim> &cells, const LevelSet<dim> &ground, const unsigned int p)
{
  const QGauss<dim> whole(4); // also the places of the weights of cut cells
  const double width = grid.cell_size(), volume = Utilities::fixed_power<dim>(width);
  double sum = 0;
  for (const auto &cell : grid.fine_cells().cells())
    {
      const CutCell<dim> *cut = cells.find(cell.index);
      const Point<dim> lower  = lower_corner(grid, cell.index);
      if (cut == nullptr && !ground.is_open(point_of<dim>([&](const unsigned int a) { return lower[a] + width / 2; })))
        continue;
      for (unsigned int q = 0; q < whole.size(); ++q)
        {
          double value = volume * (cut ? cut->weights[q] : whole.weight(q));
          for (unsigned int a = 0; a < dim; ++a)
            value *= std::pow(lower[a] + width * whole.point(q)[a], p);
          sum += value;
        }
    }
  return sum;
}


template <typename Numbers>
double sum(const Numbers &numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.);
}


/// Volume and centroid of the part of the box beyond a plane, without cells.
template <int dim>
std::pair<double, Point<dim>> exact(const Plane<dim> &plane)
{
  auto simplices = simplices_of_cube(Point<dim>(), 1.);
  for (auto &simplex : simplices)
    for (auto &corner : simplex)
      corner.side = plane.view(corner.place, 1.).distance;
  return volume_and_centroid(open_part(std::move(simplices), linear_crossing<dim>));
}


template <int dim>
void test_planes()
{
  RandomNumbers random;
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1., dim == 2 ? 0.1 : 0.25), MPI_COMM_WORLD);
  const double width = grid.cell_size();
  for (unsigned int k = 0; k < (dim == 2 ? 40 : 10); ++k)
    {
      Plane<dim> plane;
      plane.origin = random.point<dim>(0.2, 0.8);
      plane.normal = random.point<dim>(-1., 1.);
      if (k < 2 * dim) // along the cells, on their faces and not
        {
          plane.normal        = Tensor<1, dim>();
          plane.normal[k / 2] = k % 2 ? 1. : -1.;
          plane.origin[k / 2] = k % 2 ? 0.5 : 0.5 + 0.3 * width;
        }
      plane.normal /= plane.normal.norm();
      const DiscreteLevelSet<dim> surface(grid, plane);
      const RigidBoundary<dim> ground({ { &surface } });
      const CutCells<dim> cells(grid, ground);
      expect(moment(grid, cells, plane, 0), exact(plane).first, 1e-11, "volume beyond a plane");
      double area = 0;
      for (const CutCell<dim> &cut : cells.cells())
        {
          expect(sum(cut.open_hats), cut.open_fraction, 1e-12, "sum of the hat functions in the open");
          expect(sum(cut.weights), cut.open_fraction, 1e-12, "sum of the weights");
        }
      for (const CutFacet<dim> &segment : cells.segments())
        {
          area += segment.area;
          expect(sum(segment.vertex_weights), 1., 1e-12, "sum of the hat functions on the ground");
          expect(sum(segment.shapes), 1., 1e-12, "sum of the shape functions on the ground");
          expect((segment.normal + plane.normal).norm(), 0., 1e-10, "normal");
          // Hats and shapes are exact for what is linear: the ground's mean distance is 0.
          double by_hats = 0, by_shapes = 0;
          for (unsigned int v = 0; v < CutCell<dim>::n_vertices; ++v)
            by_hats += segment.vertex_weights[v] *
                       plane
                           .view(lower_corner(grid, segment.cell) +
                                     width * Tensor<1, dim>(GeometryInfo<dim>::unit_cell_vertex(v)),
                                 1.)
                           .distance;
          for (unsigned int i = 0; i < segment.shapes.size(); ++i)
            by_shapes += segment.shapes[i] * plane.view(grid.node_position(grid.nodes(segment.cell)[i]), 1.).distance;
          expect(by_hats, 0., 1e-12, "distance of the ground by hat functions");
          expect(by_shapes, 0., 1e-12, "distance of the ground by shape functions");
        }
      // The divergence theorem: what the box's open faces lack is the ground's. Area of the plane by a step across it.
      Plane<dim> behind     = plane;
      constexpr double step = 1e-4;
      Plane<dim> ahead      = plane;
      behind.origin -= step * plane.normal;
      ahead.origin += step * plane.normal;
      expect(area, (exact(behind).first - exact(ahead).first) / (2 * step), 1e-7, "area of a plane");
      // x y (z) is of first degree an axis; x^3 y^3 (z^3) of third: against a grid of other cells.
      const BackgroundGrid<dim> other(grid_box<dim>(0., 1., 0.5), MPI_COMM_WORLD);
      const DiscreteLevelSet<dim> other_surface(other, plane);
      const RigidBoundary<dim> other_ground({ { &other_surface } });
      const CutCells<dim> other_cells(other, other_ground);
      expect(moment(grid, cells, plane, 1), moment(other, other_cells, plane, 1), 1e-11, "moment of first degree");
      expect(moment(grid, cells, plane, 3), moment(other, other_cells, plane, 3), 1e-11, "moment of third degree");
    }
}


template <int dim>
void test_ball()
{
  const auto error = [](const double cell_size) {
    const BackgroundGrid<dim> grid(grid_box<dim>(0., 1., cell_size), MPI_COMM_WORLD);
    const ExpressionSurface<dim> ball("",
                                      dim == 2 ? "sqrt((x - 0.52)^2 + (y - 0.49)^2) - 0.35"
                                               : "sqrt((x - 0.52)^2 + (y - 0.49)^2 + (z - 0.5)^2) - 0.35",
                                      cell_size);
    const DiscreteLevelSet<dim> surface(grid, ball);
    const RigidBoundary<dim> ground({ { &surface } });
    const CutCells<dim> cells(grid, ground);
    const double volume = 1. - moment(grid, cells, ball, 0),
                 exact  = dim == 2 ? numbers::PI * 0.35 * 0.35 : 4. / 3. * numbers::PI * 0.35 * 0.35 * 0.35;
    double area         = 0;
    for (const CutFacet<dim> &segment : cells.segments())
      area += segment.area;
    const double exact_area = dim == 2 ? 2 * numbers::PI * 0.35 : 4 * numbers::PI * 0.35 * 0.35;
    return std::max(std::abs(volume / exact - 1.), std::abs(area / exact_area - 1.));
  };
  const double coarse = error(0.1), fine = error(0.05);
  expect(fine, 0., 0.05 * 0.05 / (0.35 * 0.35), "error of a ball's volume and area");
  expect(std::log2(coarse / fine), 2., 0.4, "order of a ball's volume and area");
}


const UnitTest registered("bed_cells", [] {
  test_planes<2>();
  test_planes<3>();
  test_ball<2>();
  test_ball<3>();
});
} // namespace test_bed_cells
