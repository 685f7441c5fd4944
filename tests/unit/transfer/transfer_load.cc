// SPDX-License-Identifier: LGPL-2.1-or-later

// Surface load: the markers have the patch's area, also where it ends inside a cell; the nodes get its force and
// moment; markers move with the nodes' velocity and stay in the box, and the work is that of the force at the nodes. A
// uniform stress is in balance with the load wherever the soil's face lies in its cell. On one rank and on two.

#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/momentum/load_transfer.h>
#include <scree/transfer/transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "../grid_box.h"
#include "../unit_test.h"

namespace test_transfer_load
{
using namespace dealii;
using namespace scree;

/// A load of `traction` on the patch; `force` and `area` are what it should add up to.
template <int dim>
void test(const std::string &basis,
          const std::vector<double> &lower_corner,
          const std::vector<double> &upper_corner,
          const std::string &traction,
          const double area,
          const Tensor<1, dim> &force)
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
  sum_of_areas = Utilities::MPI::sum(sum_of_areas, MPI_COMM_WORLD);
  AssertThrow(std::abs(sum_of_areas / area - 1.) < 1e-12, ExcMessage("The patch has a wrong area."));

  const double time = 2, step = 0.01;
  NodalField<dim> field(grid);
  field.clear();
  LoadTransfer<dim> transfer(grid, load);
  transfer.find_areas({}); // Without soil the markers' shape functions hand the force on.
  const Tensor<1, dim> sum = Utilities::MPI::sum(transfer.add_to(field, time), MPI_COMM_WORLD);
  field.add_contributions();
  AssertThrow((sum - force).norm() < 1e-12 * force.norm(), ExcMessage("The force is wrong."));

  // A linear field of velocity, which the nodes carry exactly: the power is that of the markers' places. Nodes of equal
  // mass lead a marker as its shape functions do.
  const auto velocity = [](const Point<dim> &x) {
    Tensor<1, dim> v;
    for (unsigned int c = 0; c < dim; ++c)
      v[c] = 0.3 + 0.1 * c + 0.7 * x[0] - 0.2 * x[dim - 1];
    return v;
  };
  Tensor<1, dim> nodal_sum;
  double nodal_work = 0;
  for (const unsigned int node : field.active_nodes())
    {
      double *values = field[node];
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double v = velocity(grid.node_position(node))[c];
          nodal_sum[c] += values[NodalField<dim>::force + c];
          nodal_work += 0.75 * step * values[NodalField<dim>::force + c] * v;
          values[NodalField<dim>::velocity + c]        = v;
          values[NodalField<dim>::velocity_change + c] = 0.5 * v;
        }
      values[NodalField<dim>::mass] = 1;
    }
  nodal_sum = Utilities::MPI::sum(nodal_sum, MPI_COMM_WORLD);
  AssertThrow((nodal_sum - force).norm() < 1e-12 * force.norm(), ExcMessage("The nodes miss a part of the force."));
  field.update_ghosts();

  std::vector<Point<dim>> before;
  for_each_point(load.points(), [&](const auto &marker) { before.push_back(marker.location); });
  double work = transfer.move(field, time, step);
  auto from   = before.begin();
  for_each_point(load.points(), [&](const auto &marker) {
    Point<dim> expected = *from + step * velocity(*from);
    ++from;
    for (unsigned int a = 0; a < dim; ++a)
      expected[a] = std::clamp(expected[a], grid.lower_corner()[a], grid.upper_corner()[a]);
    AssertThrow((marker.location - expected).norm() < 1e-14, ExcMessage("A marker does not move with the soil."));
  });
  work       = Utilities::MPI::sum(work, MPI_COMM_WORLD);
  nodal_work = Utilities::MPI::sum(nodal_work, MPI_COMM_WORLD);
  AssertThrow(std::abs(work / nodal_work - 1.) < 1e-12, ExcMessage("The work is not that of the nodes."));
  const auto n_before = load.points().handler().n_global_particles();
  load.points().hand_over();
  AssertThrow(load.points().handler().n_global_particles() == n_before, ExcMessage("Markers are lost."));
  std::cout << dim << "D " << basis << ": " << n_before << " markers, OK" << std::endl;
}


void run()
{
  for (const std::string basis : { "spline", "linear" })
    {
      test<2>(basis, { 0., 0.5 }, { 0.63, 0.5 }, "100; -50*t", 0.63, Tensor<1, 2>({ 63., -63. }));
      // On the lower face of the box, and at a height inside a cell.
      test<2>(basis, { -0.2, -0.2 }, { -0.2, 0.8 }, "1; 2*t", 1., Tensor<1, 2>({ 1., 4. }));
      test<2>(basis, { 0.11, 0.47 }, { 0.12, 0.47 }, "0; -3", 0.01, Tensor<1, 2>({ 0., -0.03 }));
    }
  test<3>("spline", { 0., -0.2, 0.8 }, { 0.55, 0.8, 0.8 }, "x; 1; t", 0.55, Tensor<1, 3>({ 0.15125, 0.55, 1.1 }));
}

const UnitTest registered("transfer_load", run);
} // namespace test_transfer_load


// Output of mpirun=1,2:
// 2D spline: 26 markers, OK
// 2D spline: 40 markers, OK
// 2D spline: 1 markers, OK
// 2D linear: 26 markers, OK
// 2D linear: 40 markers, OK
// 2D linear: 1 markers, OK
// 3D spline: 880 markers, OK
