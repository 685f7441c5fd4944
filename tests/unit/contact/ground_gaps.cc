// SPDX-License-Identifier: LGPL-2.1-or-later
// Oblique ground in a wet scene and a point in each of its cells: how fast what is at a facet may approach it in a
// step, by the distance of the point from the facet; that slow motion and touching points may not; in cells without a
// point a cell's width counts.
#include "../test.h"

#include <scree/boundary/ground_gaps.h>
#include <scree/geometry/bed_parameters.h>
#include <scree/mesh/cut_cells.h>

namespace test_ground_gaps
{
template <int dim>
void test(const std::string &ground_expression, const unsigned int n_facets)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1., 0.25), MPI_COMM_WORLD);
  const ExpressionSurface<dim> surface("", ground_expression, grid.cell_size());
  const DiscreteLevelSet<dim> samples(grid, surface);
  const RigidBoundary<dim> ground({ { &samples } });
  const CutCells<dim> cut_cells(grid, ground);
  const auto &facets   = cut_cells.segments();
  const double gravity = 10., h = grid.cell_size(), spacing = 0.2 * h, time_step = 1e-3;
  const double slow = std::sqrt(2. * 0.125 * gravity * h); // after a fall through an eighth of a cell
  GroundGaps<dim> gaps(grid, &cut_cells, gravity);

  gaps.clear();
  for (unsigned int f = 0; f < facets.size(); ++f)
    expect(gaps.approach_of_material(f, 2. * slow, time_step), h / time_step, 1e-9, "approach without a point");

  unsigned int n_far = 0, n_touching = 0;
  for (const double distance : { 0.1 * h, 0.2 * h })
    {
      PointSet<dim> points(grid.triangulation(), grid.mapping(), dim);
      std::vector<double> of_facets(facets.size(), -1.); // m; less than 0: the place is in another cell
      for (unsigned int f = 0; f < facets.size(); ++f)
        {
          const Point<dim> x = facets[f].middle - distance * facets[f].normal;
          for (const auto &cell : grid.triangulation().active_cell_iterators())
            if (cell->active_cell_index() == facets[f].cell && cell->bounding_box().point_inside(x))
              {
                points.add(cell, x, 0, std::vector<double>(dim, 0.));
                of_facets[f] = distance;
              }
        }
      points.finish_adding();
      gaps.clear();
      gaps.add(points, 0, spacing);
      for (unsigned int f = 0; f < facets.size(); ++f)
        {
          const double gap     = of_facets[f] < 0. ? h : of_facets[f] - 0.6 * spacing; // of one ground in a cell
          const double allowed = gaps.approach_of_material(f, 1.01 * slow, time_step);
          expect(allowed, gap > 0. ? gap / time_step : 0., 1e-6, "allowed approach");
          expect(gaps.approach_of_material(f, 0.99 * slow, time_step), 0., 0., "allowed approach of what is slow");
          n_far += of_facets[f] > 0. && gap > 0.;
          n_touching += gap <= 0.;
        }
    }
  expect(sum_of_ranks(facets.size()), n_facets, 0., "number of facets");
  require(sum_of_ranks(n_far) > n_facets / 2 && sum_of_ranks(n_touching) > n_facets / 2, "hardly any points");
}


const UnitTest registered("ground_gaps", [] {
  test<2>("0.8*y - 0.6*x - 0.05", 6);
  test<3>("0.7*z - 0.6*x - 0.38*y - 0.05", 29);
});
} // namespace test_ground_gaps

// Runs with mpirun=1,2.
