// SPDX-License-Identifier: LGPL-2.1-or-later

// Handing points over: places in cells, cells and ranks come out as deal.II's own sort leaves them, to the last digit,
// whether points stay in their cells, change cells and ranks, or leave the mesh; cells are in order; and while few
// change cells, nothing moves in memory.

#include "random_numbers.h"

#include <scree/points/point_set.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/grid_generator.h>

#include <iostream>
#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

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
            std::vector<double> number{ 0. }; // one for each point, whatever its rank
            for (unsigned int a = 0; a < dim; ++a)
              number[0] = 10 * number[0] + x[a];
            for (PointSet<dim> *set : { &points, &peer })
              set->handler().insert_particle(x, reference, id + p, cell, number);
          }
      id += 3;
    }
  points.handler().update_cached_numbers();
  peer.handler().update_cached_numbers();
  points.sort();
  peer.sort();

  RandomNumbers random;
  // Both sets list their points in an order of their own: by number, they move alike.
  const auto shake = [&](const double most) {
    std::map<double, Tensor<1, dim>> steps;
    for_each_point(points, [&](const auto &point) {
      for (unsigned int a = 0; a < dim; ++a)
        steps[*point.properties][a] = random.uniform(-most, most);
      point.location += steps[*point.properties];
    });
    for_each_point(peer, [&](const auto &point) { point.location += steps.at(*point.properties); });
  };

  /// Cell, location and place of each point, by its number.
  using Contents         = std::map<double, std::tuple<unsigned int, Point<dim>, Point<dim>>>;
  const auto contents_of = [](const PointSet<dim> &set) {
    Contents contents;
    for_each_point(set, [&](const auto &point) {
      contents[*point.properties] = { point.cell, point.location, point.reference_location };
    });
    return contents;
  };
  unsigned int n_differences = 0, n_steps_in_place = 0;
  const auto compare = [&] {
    const Contents one = contents_of(points), other = contents_of(peer);
    n_differences += one.size() != other.size() || points.n_points() != one.size() ||
                     points.handler().n_locally_owned_particles() != one.size() ||
                     points.lost().size() != peer.lost().size();
    for (const auto &[number, content] : one)
      n_differences += other.count(number) == 0 || other.at(number) != content;
    for (unsigned int c = 0; c < std::min(points.cells().size(), peer.cells().size()); ++c)
      n_differences += points.cells()[c].cell != peer.cells()[c].cell;
  };
  const auto place_in_memory = [&] { return points.cells().empty() ? nullptr : points.cells().front().locations; };

  const auto walk = [&](const unsigned int n_steps, const double most) {
    n_steps_in_place = 0;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        shake(most);
        const auto before = place_in_memory();
        points.hand_over();
        peer.sort();
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

  // Points that were taken out and put back lie in memory as they came.
  points.handler().prepare_for_coarsening_and_refinement();
  peer.handler().prepare_for_coarsening_and_refinement();
  mesh.repartition();
  points.handler().unpack_after_coarsening_and_refinement();
  peer.handler().unpack_after_coarsening_and_refinement();
  points.sort();
  peer.sort();
  compare();
  out << "after a repartition: ";
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
