// SPDX-License-Identifier: LGPL-2.1-or-later
// Handing points over: cells and ranks come out as deal.II's own sort leaves them, and places as those of its mapping,
// whether points stay in their cells, change cells and ranks, fly through several cells or leave the mesh; cells are in
// order; the own lists are those of the handler, point by point; while few change cells, nothing moves in memory; and
// neither deal.II's sort nor lifting the points off the mesh changes the order of points in a cell.
#include "../test.h"

#include <scree/particles/point_set.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/grid_generator.h>

#include <map>
#include <tuple>

namespace test_points_sort
{
template <int dim>
void test()
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
            const auto reference = point_of<dim>([&](const unsigned int) { return 0.2 + 0.3 * p; });
            const Point<dim> x   = mapping.transform_unit_to_real_cell(cell, reference);
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
    for (const auto &point : points.handler())
      {
        const Point<dim> place =
            mapping.transform_real_to_unit_cell(point.get_surrounding_cell(), point.get_location());
        n_differences += (place - point.get_reference_location()).norm() > 4 * std::numeric_limits<double>::epsilon();
      }
    for (unsigned int c = 0; c < std::min(points.cells().size(), peer.cells().size()); ++c)
      n_differences += points.cells()[c].cell != peer.cells()[c].cell;
  };
  // What the set lists of a cell is what the handler lists, in the same order.
  unsigned int n_cells_of_one_point = 0, n_cells_emptied = 0;
  std::vector<unsigned int> n_points_before(mesh.n_active_cells(), 0);
  const auto compare_lists = [&] {
    std::vector<unsigned int> n_points_of(mesh.n_active_cells(), 0);
    std::vector<const CellPoints<dim> *> of_cell(mesh.n_active_cells(), nullptr);
    for (const CellPoints<dim> &cell : points.cells())
      of_cell[cell.cell] = &cell;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int index = cell->active_cell_index(), n = points.handler().n_particles_in_cell(cell);
          n_points_of[index] = n;
          n_cells_of_one_point += n == 1;
          n_cells_emptied += n == 0 && n_points_before[index] > 0;
          n_differences += (of_cell[index] == nullptr ? 0 : of_cell[index]->n_points) != n;
          if (of_cell[index] == nullptr || of_cell[index]->n_points != n)
            continue;
          const std::vector<types::particle_index> ids = points.ids(of_cell[index] - points.cells().data());
          unsigned int p                               = 0;
          for (const auto &point : points.handler().particles_in_cell(cell))
            {
              n_differences += of_cell[index]->slots[p] != point.get_local_index() || ids[p] != point.get_id();
              ++p;
            }
        }
    n_points_before = n_points_of;
  };
  // The points' numbers, cell by cell.
  const auto order = [&] {
    std::vector<double> numbers;
    for_each_point(points, [&](const auto &point) { numbers.push_back(*point.properties); });
    return numbers;
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
        compare_lists();
        if (step % 3 == 2)
          {
            const std::vector<double> order_before = order();
            points.sort();
            n_differences += order() != order_before;
            points.lift();
            n_differences += points.n_points();
            points.put_down();
            n_differences += order() != order_before;
            compare_lists();
          }
      }
    expect(sum_of_ranks(n_differences), 0, 0, "differences after steps of up to " + std::to_string(most) + " m");
  };

  const unsigned int n_points = points.handler().n_global_particles();
  walk(10, 0.001); // They stay in their cells, ...
  require(n_steps_in_place == 10, "Records moved for nothing.");
  expect(points.handler().n_global_particles(), n_points, 0, "points that do not leave");
  walk(10, 0.01); // change cells and ranks,
  walk(10, 0.04); // leave the mesh, too,
  walk(3, 0.25);  // fly through several cells.
  require(sum_of_ranks(points.lost().size()) > n_points / 2, "Hardly any points left the mesh.");

  // Points that were taken out and put back lie in memory as they came.
  for (PointSet<dim> *set : { &points, &peer })
    set->handler().prepare_for_coarsening_and_refinement();
  mesh.repartition();
  for (PointSet<dim> *set : { &points, &peer })
    {
      set->handler().unpack_after_coarsening_and_refinement();
      set->sort();
    }
  compare();
  n_points_before.assign(mesh.n_active_cells(), 0);
  walk(10, 0.01);
  // The walks must reach what they are for.
  require(sum_of_ranks(n_cells_of_one_point) > 0 && sum_of_ranks(n_cells_emptied) > 0 &&
              points.handler().n_global_particles() > 0,
          "No cell of one point, or none that emptied");
}

const UnitTest registered("points_sort", [] {
  test<2>();
  test<3>();
});
} // namespace test_points_sort

// Runs with mpirun=1,2,3.
