// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of the lower half of a box cost nine times those of the upper: the ranks' shares of points are even at first,
// those of cost after a repartition by measured cost. A measurement that was interrupted spoils nothing.
#include "../test.h"

#include <scree/particles/partition.h>

#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/grid_generator.h>

namespace test_points_partition
{
template <int dim>
double true_cost(const typename Triangulation<dim>::cell_iterator &cell)
{
  return cell->center()[dim - 1] < 0.5 ? 9e-6 : 1e-6; // s
}


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
  const auto cost_of_rank = [&](const auto &cost_of) {
    double cost = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        cost += points.handler().n_particles_in_cell(cell) * cost_of(cell);
    return cost;
  };
  const auto is_even = [&](const auto &cost_of) {
    const auto of_ranks = Utilities::MPI::min_max_avg(cost_of_rank(cost_of), MPI_COMM_WORLD);
    return of_ranks.max < 1.02 * of_ranks.avg;
  };
  const auto one         = [](const auto &) { return 1.; };
  const auto n_points    = points.handler().n_global_particles();
  unsigned int n_fits    = 0;
  const auto repartition = [&] { partition.repartition([&] { ++n_fits; }); };

  require(partition.is_worth_changing(), "All points are on one rank.");
  repartition();
  require(is_even(one) && !is_even(true_cost<dim>), "Before the first step points are shared out evenly.");
  for (unsigned int step = 0; step < 50; ++step)
    {
      partition.begin_step();
      partition.add(Work::to_points, 10. * cost_of_rank(true_cost<dim>));
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned() && step % 10 == 0)
          points.costs().add(cell->active_cell_index(), step == 30 ? 1. : true_cost<dim>(cell));
    }
  require(partition.is_worth_changing() && partition.imbalance() > 1.2, "Rank 0 works nine times as long.");
  repartition();
  require(!is_even(one) && is_even(true_cost<dim>), "Afterwards cost is shared out evenly.");
  expect(points.handler().n_global_particles(), n_points, 0, "number of points");
  require(n_fits == 2 && partition.n_repartitions() == 1, "It is fitted twice and changed once.");
}


const UnitTest registered("points_partition", [] {
  test<2>();
  test<3>();
});
} // namespace test_points_partition

// Runs with mpirun=2.
