// SPDX-License-Identifier: LGPL-2.1-or-later

// Sorting points: places in cells, cells, ranks and memory come out as deal.II's own sort leaves them, to the last
// digit, whether points stay in their cells, change cells and ranks, or leave the mesh; and while all stay, nothing
// moves in memory.

#include "random_numbers.h"

#include <scree/points/point_set.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/grid_generator.h>

#include <iostream>
#include <sstream>

using namespace dealii;
using namespace scree;

template <int dim>
void test(std::ostream &out)
{
  parallel::distributed::Triangulation<dim> mesh(MPI_COMM_WORLD);
  GridGenerator::hyper_cube(mesh, 0., 0.8);
  mesh.refine_global(3);
  const MappingCartesian<dim> mapping;
  PointSet<dim> points(mesh, mapping, 1), peer(mesh, mapping, 1);

  const auto sort_by_deal_ii = [&] {
    peer.handler().sort_particles_into_subdomains_and_cells();
    peer.update_cells();
  };

  unsigned int id = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    {
      if (cell->is_locally_owned() && cell->center()[1] < 0.5)
        for (unsigned int p = 0; p < 3; ++p)
          {
            Point<dim> reference;
            for (unsigned int a = 0; a < dim; ++a)
              reference[a] = 0.2 + 0.3 * p;
            const Point<dim> x = mapping.transform_unit_to_real_cell(cell, reference);
            std::vector<double> number{ 1. * id };
            for (PointSet<dim> *set : { &points, &peer })
              set->handler().insert_particle(x, reference, id, cell, number);
          }
      id += 3;
    }
  points.handler().update_cached_numbers();
  peer.handler().update_cached_numbers();
  points.sort();
  sort_by_deal_ii();

  RandomNumbers random;
  const auto shake = [&](const double most) {
    for (unsigned int c = 0; c < points.cells().size(); ++c)
      for (unsigned int p = 0; p < points.cells()[c].n_points; ++p)
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double step = random.uniform(-most, most);
            points.cells()[c].location[p][a] += step;
            peer.cells()[c].location[p][a] += step;
          }
  };

  unsigned int n_differences = 0, n_steps_in_place = 0;
  const auto compare = [&] {
    n_differences += points.cells().size() != peer.cells().size();
    for (unsigned int c = 0; c < std::min(points.cells().size(), peer.cells().size()); ++c)
      {
        const CellPoints<dim> &one = points.cells()[c], &other = peer.cells()[c];
        if (one.cell != other.cell || one.n_points != other.n_points)
          {
            ++n_differences;
            continue;
          }
        for (unsigned int p = 0; p < one.n_points; ++p)
          n_differences += !(one.location[p] == other.location[p]) +
                           !(one.reference_location[p] == other.reference_location[p]) +
                           (one.properties[p] != other.properties[p]);
      }
    n_differences += points.lost().size() != peer.lost().size();
  };
  const auto place_in_memory = [&] { return points.cells().empty() ? nullptr : points.cells().front().location; };

  const auto walk = [&](const unsigned int n_steps, const double most) {
    n_steps_in_place = 0;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        shake(most);
        const auto before = place_in_memory();
        points.sort();
        sort_by_deal_ii();
        n_steps_in_place += place_in_memory() == before; // deal.II's sort writes to new memory
        compare();
      }
    out << Utilities::MPI::sum(n_differences, MPI_COMM_WORLD) << " differences, in place "
        << Utilities::MPI::min(n_steps_in_place, MPI_COMM_WORLD) << " of " << n_steps << " steps, "
        << points.handler().n_global_particles() << " points, "
        << Utilities::MPI::sum(points.lost().size(), MPI_COMM_WORLD) << " lost" << std::endl;
  };

  out << dim << "D" << std::endl;
  out << "stay in their cells: ";
  walk(10, 0.001);
  out << "change cells and ranks: ";
  walk(10, 0.01);
  out << "leave the mesh, too: ";
  walk(10, 0.04);

  // Points that were taken out and put back lie in memory as they came: nothing may be left as it is.
  points.handler().prepare_for_coarsening_and_refinement();
  peer.handler().prepare_for_coarsening_and_refinement();
  mesh.repartition();
  points.handler().unpack_after_coarsening_and_refinement();
  peer.handler().unpack_after_coarsening_and_refinement();
  points.sort();
  sort_by_deal_ii();
  compare();
  out << "after sharing out cells anew: ";
  walk(10, 0.01);
}

int main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ostringstream silent;
  std::ostream &out = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : silent;
  test<2>(out);
  test<3>(out);
}
