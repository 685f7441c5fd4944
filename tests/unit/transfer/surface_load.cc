// SPDX-License-Identifier: LGPL-2.1-or-later
// Surface load: the markers have the patch's area, also where it ends inside a cell; the nodes get its force; markers
// move with the nodes' velocity and stay in the box, and the work is that of the force at the nodes. (That load and
// stress are in balance wherever the face lies in its cell, scenes/surface_load tells.)
#include "../soil.h"

#include <scree/momentum/surface_load.h>

namespace test_surface_load
{
/// A load of `traction` on the patch; `force` and `area` are what it should add up to.
template <int dim>
void test_patch(const std::string &basis,
                const std::vector<double> &lower_corner,
                const std::vector<double> &upper_corner,
                const std::string &traction,
                const double area,
                const Tensor<1, dim> &force,
                const unsigned int n_markers)
{
  const GridParameters box = grid_box<dim>(-0.2, 0.8, 0.1, basis);
  const BackgroundGrid<dim> grid(box, MPI_COMM_WORLD);
  SurfaceLoadParameters parameters;
  parameters.lower_corner = lower_corner;
  parameters.upper_corner = upper_corner;
  parameters.traction     = traction;
  parameters.check(box, dim);
  SurfaceLoad<dim> load(grid, parameters, 4);

  double sum_of_areas = 0;
  for_each_point(load.points(), [&](const auto &marker) { sum_of_areas += marker.properties[SurfaceLoad<dim>::area]; });
  expect(sum_of_ranks(sum_of_areas) / area, 1., 1e-12, "area of the patch");
  expect(load.points().handler().n_global_particles(), n_markers, 0., "number of markers");

  const double time = 2, step = 0.01;
  NodalField<dim> field(grid);
  field.clear();
  load.find_areas({}); // Without soil the markers' shape functions hand the force on.
  const Tensor<1, dim> sum = sum_of_ranks(load.add_to(field, time));
  field.add_contributions();
  expect((sum - force).norm() / force.norm(), 0., 1e-12, "error of the force");

  // A linear field of velocity, which the nodes carry exactly: the power is that of the markers' places. Nodes of equal
  // mass lead a marker as its shape functions do.
  const auto velocity = [](const Point<dim> &x) -> Tensor<1, dim> {
    return point_of<dim>([&](const unsigned int c) { return 0.3 + 0.1 * c + 0.7 * x[0] - 0.2 * x[dim - 1]; });
  };
  Tensor<1, dim> nodal_sum;
  double nodal_work = 0;
  for (const unsigned int node : field.active_nodes())
    {
      const auto v = velocity(grid.node_position(node)), of_node = vector_of<dim>(field[node], NodalField<dim>::force);
      nodal_sum += of_node;
      nodal_work += 0.75 * step * of_node * v;
      set_vector(field[node], NodalField<dim>::velocity, v);
      set_vector<dim>(field[node], NodalField<dim>::velocity_change, 0.5 * v);
      field[node][NodalField<dim>::mass] = 1;
    }
  expect((sum_of_ranks(nodal_sum) - force).norm() / force.norm(), 0., 1e-12, "error of the force at the nodes");
  field.update_ghosts();

  std::vector<Point<dim>> before;
  for_each_point(load.points(), [&](const auto &marker) { before.push_back(marker.location); });
  const double work = load.move(field, time, step);
  auto from         = before.begin();
  for_each_point(load.points(), [&](const auto &marker) {
    Point<dim> expected = *from + step * velocity(*from);
    ++from;
    for (unsigned int a = 0; a < dim; ++a)
      expected[a] = std::clamp(expected[a], grid.lower_corner()[a], grid.upper_corner()[a]);
    expect(marker.location.distance(expected), 0., 1e-14, "error of a marker's place");
  });
  expect(sum_of_ranks(work) / sum_of_ranks(nodal_work), 1., 1e-12, "work over that of the nodes");
  load.points().hand_over();
  expect(load.points().handler().n_global_particles(), n_markers, 0., "number of markers after their motion");
}


const UnitTest registered("surface_load", [] {
  for (const std::string basis : { "spline", "linear" })
    {
      test_patch<2>(basis, { 0., 0.5 }, { 0.63, 0.5 }, "100; -50*t", 0.63, Tensor<1, 2>({ 63., -63. }), 26);
      // On the lower face of the box, and at a height inside a cell.
      test_patch<2>(basis, { -0.2, -0.2 }, { -0.2, 0.8 }, "1; 2*t", 1., Tensor<1, 2>({ 1., 4. }), 40);
      test_patch<2>(basis, { 0.11, 0.47 }, { 0.12, 0.47 }, "0; -3", 0.01, Tensor<1, 2>({ 0., -0.03 }), 1);
    }
  const Tensor<1, 3> force({ 0.15125, 0.55, 1.1 });
  test_patch<3>("spline", { 0., -0.2, 0.8 }, { 0.55, 0.8, 0.8 }, "x; 1; t", 0.55, force, 880);
});
} // namespace test_surface_load

// Runs with mpirun=1,2.
