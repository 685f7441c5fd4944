// SPDX-License-Identifier: LGPL-2.1-or-later

// Points on one rank are shared out evenly before the first step. After points of one half of the box have left, the
// ranks' shares are even again once their surplus outweighs a repartition, and no earlier.
#include "../test.h"

#include <scree/particles/partition.h>

#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/grid_generator.h>

namespace test_points_partition
{
template <int dim>
void test()
{
  parallel::distributed::Triangulation<dim> mesh(
      MPI_COMM_WORLD, Triangulation<dim>::none, parallel::distributed::Triangulation<dim>::no_automatic_repartitioning);
  GridGenerator::hyper_cube(mesh);
  mesh.refine_global(dim == 2 ? 5 : 4);
  const MappingCartesian<dim> mapping;
  PointSet<dim> points(mesh, mapping, 1);
  unsigned int id = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int p = 0; p < 2; ++p, ++id)
        points.handler().insert_particle(cell->center(), Point<dim>(), id, cell);
  points.handler().update_cached_numbers();
  points.sort();

  Partition<dim> partition(mesh, { &points });
  const auto is_even = [&] {
    const auto of_ranks = Utilities::MPI::min_max_avg(double(points.n_points()), MPI_COMM_WORLD);
    return of_ranks.max < 1.06 * of_ranks.avg; // An empty cell counts as a tenth of a point.
  };
  unsigned int n_fits    = 0;
  const auto repartition = [&] { partition.repartition([&] { ++n_fits; }); };
  // Steps until a repartition pays.
  const auto step_until_worth = [&] {
    unsigned int n_steps = 1;
    while (!partition.is_worth_changing() && n_steps < 10000)
      ++n_steps;
    return n_steps;
  };

  require(partition.is_worth_changing(), "All points are on one rank.");
  repartition();
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
  // On the mean of the ranks there are as many cells as points, which count as 75 and 25 updates of a point; so many
  // points are beyond the mean, and after 100 steps, with looks at each 50th, have not yet outweighed that.
  expect(step_until_worth(), 150, 0, "steps until a repartition pays");
  repartition();
  require(is_even(), "Afterwards points are shared out evenly.");
  expect(points.handler().n_global_particles(), n_points, 0, "number of points");
  require(n_fits == 2 && partition.n_repartitions() == 1, "It is fitted twice and changed once.");
}


const UnitTest registered("points_partition", [] {
  test<2>();
  test<3>();
});
} // namespace test_points_partition

// Runs with mpirun=2.
