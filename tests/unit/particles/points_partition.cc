// SPDX-License-Identifier: LGPL-2.1-or-later

// Points on one rank are shared out evenly before the first step. After points of one half of the box have left, the
// ranks' shares are even again once their surplus outweighs a repartition, and no earlier.
#include "../test.h"

#include <scree/mesh/partition.h>

namespace test_points_partition
{
template <int dim>
void test()
{
  BackgroundGrid<dim> grid(grid_box<dim>(0., 1., dim == 2 ? 1. / 32 : 1. / 16), MPI_COMM_WORLD);
  const auto &mesh = grid.triangulation();
  PointSet<dim> points(grid.triangulation(), grid.mapping(), 1);
  unsigned int id = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int p = 0; p < 2; ++p, ++id)
        points.handler().insert_particle(cell->center(), Point<dim>(), id, cell);
  points.handler().update_cached_numbers();
  points.sort();

  Partition<dim> partition(grid, { &points });
  const auto is_even = [&] {
    const auto of_ranks = Utilities::MPI::min_max_avg(double(points.n_points()), MPI_COMM_WORLD);
    return of_ranks.max < 1.02 * of_ranks.avg; // An empty cell counts as a hundredth of a point.
  };
  // Steps until a repartition pays.
  const auto step_until_worth = [&] {
    unsigned int n_steps = 1;
    while (!partition.is_worth_changing() && n_steps < 10000)
      ++n_steps;
    return n_steps;
  };

  require(partition.is_worth_changing(), "All points are on one rank.");
  partition.repartition();
  require(is_even(), "Before the first step points are shared out evenly.");
  require(step_until_worth() == 10000, "Nothing is worth changing where all is even.");
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[dim - 1] < 0.5)
      while (points.handler().n_particles_in_cell(cell) > 0)
        points.handler().remove_particle(points.handler().particles_in_cell(cell).begin());
  points.handler().update_cached_numbers();
  points.sort();
  const auto n_points = points.handler().n_global_particles();
  require(!is_even(), "One rank has lost its points.");
  // On the mean of the ranks there are as many cells as points, which count as 50 and 25 updates of a point; so many
  // points are beyond the mean, and after 50 steps, with looks at each 50th, have not yet outweighed that.
  expect(step_until_worth(), 100, 0, "steps until a repartition pays");
  partition.repartition();
  require(is_even(), "Afterwards points are shared out evenly.");
  expect(points.handler().n_global_particles(), n_points, 0, "number of points");
  require(partition.n_repartitions() == 1, "The first time does not count.");
}


const UnitTest registered("points_partition", [] {
  test<2>();
  test<3>();
});
} // namespace test_points_partition

// Runs with mpirun=2.
