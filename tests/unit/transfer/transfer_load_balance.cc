// SPDX-License-Identifier: LGPL-2.1-or-later

// A uniform stress is in balance with the load on its face, wherever that face lies in its cell: at every node that
// takes load the forces of stress and load differ by less than 3 % of the load's part, light nodes included. (With the
// markers' shape functions a node that soil just reaches is pushed by several times what its soil bears.) The load
// arrives whole. On one rank and on two.

#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/momentum/load_transfer.h>
#include <scree/transfer/transfer.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <map>

#include "../grid_box.h"
#include "../unit_test.h"

namespace test_transfer_load_balance
{
using namespace dealii;
using namespace scree;

/// @param above how far the face lies over a face between cells, in cells
template <int dim>
void test(const std::string &basis, const double above)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 0.8, 0.1, basis), MPI_COMM_WORLD);

  MaterialParameters material;
  material.law = "linear elastic";
  SeedingParameters seeding;
  seeding.region = dim == 2 ? "y < 0.5" : "z < 0.5";
  std::list<SoilBody<dim>> bodies;
  SoilBody<dim> &body = bodies.emplace_back("Soil",
                                            1000.,
                                            1000.,
                                            make_material<dim>(material),
                                            PropertyLayout<dim>(0, false),
                                            grid.triangulation(),
                                            grid.mapping());
  seed(body, seeding, { grid.triangulation(), grid.cell_size() });
  SurfaceLoadParameters parameters;
  parameters.lower_corner.assign(dim, 0.);
  parameters.upper_corner.assign(dim, 0.8);
  parameters.lower_corner[dim - 1] = parameters.upper_corner[dim - 1] = 0.5;
  parameters.traction                                                 = dim == 2 ? "0; -1e3" : "0; 0; -1e3";
  SurfaceLoad<dim> load(grid, parameters, 4);

  const double shift = above * grid.cell_size();
  for_each_point(body.points, [&](const auto &point) {
    point.properties[body.layout.stress + dim - 1] = -1e3;
    point.location[dim - 1] += shift;
  });
  for_each_point(load.points(), [&](const auto &marker) { marker.location[dim - 1] += shift; });
  body.points.hand_over();
  load.points().hand_over();

  constexpr unsigned int force = NodalField<dim>::force + dim - 1;
  LoadTransfer<dim> load_transfer(grid, load);
  load_transfer.find_areas(bodies);
  NodalField<dim> of_load(grid), of_stress(grid);
  of_load.clear();
  load_transfer.add_to(of_load, 0.);
  of_load.add_contributions();
  of_stress.clear();
  TransferParameters flip;
  flip.method = "FLIP"; // The points have no room for a gradient.
  Transfer<dim>(grid, flip, StabilisationParameters()).to_grid(body, of_stress);
  of_stress.add_contributions();

  double sum = 0, worst = 0;
  for (const unsigned int node : of_load.active_nodes())
    {
      const double part = of_load[node][force];
      sum += part;
      if (part < -1e-8) // Less is rounding. What deeper nodes lack of balance is the scatter of points, load or not.
        worst = std::max(worst, std::abs((part + of_stress[node][force]) / part));
    }
  sum               = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  worst             = Utilities::MPI::max(worst, MPI_COMM_WORLD);
  const double area = std::pow(0.8, dim - 1);
  AssertThrow(std::abs(sum / (-1e3 * area) - 1.) < 1e-12, ExcMessage("A part of the load is lost."));
  std::cout << dim << "D " << basis << ", face at " << above
            << " of a cell: " << (worst < 0.03 ? "in balance" : "NOT in balance: " + Utilities::to_string(worst))
            << std::endl;
}


void run()
{
  for (const double above : { 0., 0.01, 0.1, 0.2, 0.3, 0.5, 0.8, 0.99 })
    test<2>("spline", above);
  for (const double above : { 0., 0.01, 0.5 })
    test<3>("spline", above);
}

const UnitTest registered("transfer_load_balance", run);
} // namespace test_transfer_load_balance


// Output of mpirun=1,2:
// 2D spline, face at 0 of a cell: in balance
// 2D spline, face at 0.01 of a cell: in balance
// 2D spline, face at 0.1 of a cell: in balance
// 2D spline, face at 0.2 of a cell: in balance
// 2D spline, face at 0.3 of a cell: in balance
// 2D spline, face at 0.5 of a cell: in balance
// 2D spline, face at 0.8 of a cell: in balance
// 2D spline, face at 0.99 of a cell: in balance
// 3D spline, face at 0 of a cell: in balance
// 3D spline, face at 0.01 of a cell: in balance
// 3D spline, face at 0.5 of a cell: in balance
