// SPDX-License-Identifier: LGPL-2.1-or-later
// A pressure that is linear in space goes from points of water with its gradient to the vertices of their cells
// exactly.
#include "../test.h"

#include <scree/seeding/seeding.h>
#include <scree/transfer/water_transfer.h>

namespace test_water_pressure
{
template <int dim>
void test()
{
  constexpr double h = 0.25;
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 1., h), MPI_COMM_WORLD);
  WaterParameters parameters;
  parameters.region          = "y < 0.6";
  parameters.points_per_cell = 3;
  WaterPhase<dim> phase(1000., false, grid.triangulation(), grid.mapping());
  seed_water(phase, parameters, {}, { grid.triangulation(), h });
  const Tensor<1, dim> gradient = Tensor<1, dim>(point_of<dim>([](const unsigned int a) { return 700. - 3000. * a; }));
  const auto pressure           = [&](const Point<dim> &x) { return 5000. + gradient * x; };
  for_each_point(phase.points(), [&](const auto &point) {
    point.properties[phase.layout.pressure] = pressure(point.location);
    for (unsigned int a = 0; a < dim; ++a)
      point.properties[phase.layout.pressure_gradient + a] = gradient[a];
  });
  TransferParameters flip;
  flip.method = "FLIP"; // The points have no room for a velocity gradient.
  Mixture<dim> mixture(grid, 2);
  NodalField<dim> soil(grid);
  WetNodes<dim> nodes(grid, soil);
  WaterTransfer<dim>(grid, flip, parameters).to_grid(phase, mixture, nodes);
  unsigned int n_cells = 0;
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    for (const MixtureCell<dim> &sums : mixture.cells())
      if (cell->is_locally_owned() && sums.cell == cell->active_cell_index())
        {
          ++n_cells;
          for (unsigned int v = 0; v < sums.n_vertices; ++v)
            expect(
                sums.pressure_at_vertex[v] / sums.water_at_vertex[v], pressure(cell->vertex(v)), 1e-8, "pressure, Pa");
        }
  require(sum_of_ranks(n_cells) == (dim == 2 ? 12 : 48), "cells with water");
}

const UnitTest registered("water_pressure", [] {
  test<2>();
  test<3>();
});
} // namespace test_water_pressure
