// SPDX-License-Identifier: LGPL-2.1-or-later

// Which cells of saturated soil are beside a gap, along every axis: across one cell without soil, or from one partly
// full cell to the next; not two cells away, not across less than a cell from a full one, not at a free surface, and
// not where a body is no deeper than a cell; linear functions, which do not reach across a cell, know the second kind
// alone; the same on 1 and 2 ranks.

#include "../elastic_soil.h"
#include "../expect.h"

#include <scree/seeding/water_seeding.h>
#include <scree/pressure/soil_gaps.h>
#include <scree/transfer/water_transfer.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <string>

#include "../unit_test.h"

namespace test_soil_gaps
{
using namespace dealii;
using namespace scree;

/// Cells beside a gap in a box that is 1 m long along an axis and .3 m wide, with cells of .1 m.
/// @param region of soil and water; `s` stands for the coordinate along the axis
template <int dim>
unsigned int n_beside(const std::string &basis, const unsigned int axis, std::string region)
{
  for (std::size_t at = 0; (at = region.find('s', at)) != std::string::npos;)
    region[at] = "xyz"[axis];
  GridParameters grid_parameters;
  grid_parameters.basis = basis;
  grid_parameters.lower_corner.assign(dim, 0.);
  grid_parameters.upper_corner.assign(dim, 0.3);
  grid_parameters.upper_corner[axis] = 1.;
  grid_parameters.cell_size          = 0.1;
  const BackgroundGrid<dim> grid(grid_parameters, MPI_COMM_WORLD);
  NodeNumbering<dim> corners(Basis::linear);
  corners.distribute(grid.fine_cells());

  constexpr unsigned int n_points = 4; // of the soil in a cell along each axis
  constexpr double porosity       = 0.4;
  ElasticSoil<dim> soil(grid, region, n_points, porosity);
  WaterParameters water_parameters;
  water_parameters.region = region;
  WaterPhase<dim> water(1000., false, grid.triangulation(), grid.mapping());
  seed_water(
      water, water_parameters, { { "Soil", region, porosity, soil.density } }, grid.triangulation(), grid.cell_size());

  soil.drag.emplace(water_parameters, porosity);
  TransferParameters flip;
  flip.method = "FLIP"; // The points have no room for a gradient.
  const WaterTransfer<dim> transfer(grid, flip, water_parameters, 1.);
  Mixture<dim> mixture(grid, n_points);
  PoreField<dim> pores(grid);
  NodalField<dim> field(grid), excess(grid);
  transfer.soil_to_grid(soil, mixture);
  transfer.to_grid(water, mixture, field, excess, pores);
  mixture.finish();

  WaterBoundaryParameters wall_parameters;
  wall_parameters.top = "impermeable";
  const WaterBoundaryConditions<dim> walls(grid, wall_parameters);
  FreeSurface<dim> surface(grid, corners, walls, Tensor<1, dim>(), nullptr);
  VertexVector pressure(corners.partitioner());
  surface.locate(mixture, pressure);
  SoilGaps<dim> gaps(grid, corners, surface);
  unsigned int n = 0;
  for (unsigned int time = 0; time < 2; ++time) // again: as the first time
    {
      gaps.find(mixture);
      n = 0;
      for (unsigned int record = 0; record < mixture.cells().size(); ++record)
        n += gaps.is_beside(record);
    }
  return Utilities::MPI::sum(n, MPI_COMM_WORLD);
}


template <int dim>
void test(const std::string &basis)
{
  const unsigned int row                             = dim == 2 ? 3 : 9; // cells across the box
  const bool reaches                                 = basis != "linear";
  const std::pair<std::string, unsigned int> cases[] = {
    { "s < 0.3 || (s > 0.4 && s < 0.7)", reaches ? 2 * row : 0 },    // full, empty, full
    { "s < 0.3 || (s > 0.45 && s < 0.75)", reaches ? 2 * row : 0 },  // full, empty, half full
    { "s < 0.35 || (s > 0.55 && s < 0.75)", reaches ? 2 * row : 0 }, // half full, empty, half full
    { "s < 0.35 || (s > 0.45 && s < 0.75)", 2 * row },               // half full, half full
    { "s < 0.3 || (s > 0.5 && s < 0.8)", 0 },                        // two empty cells
    { "s < 0.3 || (s > 0.35 && s < 0.65)", 0 },                      // full, half full
    { "s < 0.65", 0 },                                               // a free surface
    { "s < 0.3 || (s > 0.4 && s < 0.45)", 0 },                       // a layer of half a cell
  };
  for (unsigned int axis = 0; axis < dim; ++axis)
    for (const auto &[region, expected] : cases)
      {
        const unsigned int n = n_beside<dim>(basis, axis, region);
        expect(n, expected, 0., basis + ", axis " + std::to_string(axis) + ", " + region);
        if (axis == 0 && Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cout << dim << "D, " << basis << ", " << region << ": " << n << std::endl;
      }
}


void run()
{
  test<2>("spline");
  test<3>("spline");
  test<2>("linear");
}

const UnitTest registered("soil_gaps", run);
} // namespace test_soil_gaps
