// SPDX-License-Identifier: LGPL-2.1-or-later
// Fine cells around two cubes in boxes of several sizes, none a multiple of the coarse cells: as many cells and nodes
// in each, whose linear functions are exact; and the same after the cubes have moved away and come back.
#include "../test.h"

namespace test_grid_fine_cells
{
constexpr double width = 0.125;

/// One cube at the lower corner of the box, one in it, 4 cells wide.
template <int dim>
bool is_in_cubes(const Point<dim> &corner, const double place)
{
  const auto is_in = [&](const double lower) {
    bool inside = true;
    for (unsigned int a = 0; a < dim; ++a)
      inside = inside && corner[a] > lower - 0.5 * width && corner[a] < lower + 3.5 * width;
    return inside;
  };
  return is_in(-1.) || is_in(place);
}

template <int dim>
Blocks blocks_of_cubes(const BackgroundGrid<dim> &grid, const double place)
{
  Blocks blocks;
  for (const double lower : { -1., place })
    for (unsigned int i = 0; i < unsigned(Utilities::pow(4, dim)); ++i)
      {
        const auto x = point_of<dim>([&](const unsigned int a) { return lower + ((i >> 2 * a) % 4 + 0.5) * width; });
        blocks.push_back(grid.block_at(x));
      }
  make_unique(blocks);
  return blocks;
}

/// Largest error at the cells' middles of the function x + 2 y (+ 3 z) from its values at the nodes.
template <int dim>
double linear_error(const BackgroundGrid<dim> &grid)
{
  const auto value  = [](const Point<dim> &x) { return x[0] + 2. * x[1] + 3. * x[dim - 1]; };
  const auto middle = point_of<dim>([](const unsigned int) { return 0.5; });
  double error      = 0;
  for (const auto &cell : grid.fine_cells().cells())
    if (grid.fine_cells().is_owned(cell))
      {
        const double sum   = evaluate<dim>(grid, cell.index, middle, [&](const unsigned int node) {
                             return value(grid.node_position(node));
                           }).first;
        const Point<dim> x = grid.fine_cells().box().corner(cell.place) + width * (middle - Point<dim>());
        error              = std::max(error, std::abs(sum - value(x)));
      }
  return max_of_ranks(error);
}

struct Counts
{
  unsigned int inner, at_edge, blocks, nodes, nodes_at_walls;
};

template <int dim>
void compare(const BackgroundGrid<dim> &grid, const Counts &expected)
{
  unsigned int n_at_walls = 0, n_uses[4] = {};
  for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
    n_at_walls += grid.node_faces(node) != 0;
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      ++n_uses[cell->user_index()];
  expect(sum_of_ranks(n_uses[0]), expected.inner, 0, "inner cells");
  expect(sum_of_ranks(n_uses[1]), expected.at_edge, 0, "cells at the edge");
  expect(sum_of_ranks(grid.fine_blocks().size()), expected.blocks, 0, "blocks");
  require(sum_of_ranks(n_uses[2] + n_uses[3]) < 6000, "too many other cells");
  expect(linear_error(grid), 0, 1e-12, "error of linear functions");
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1) // ranks have nodes beyond the edge of their own
    {
      expect(grid.n_owned_nodes(), expected.nodes, 0, "nodes");
      expect(n_at_walls, expected.nodes_at_walls, 0, "nodes at walls");
    }
}

template <int dim>
void test(const double size, const Counts &inside, const Counts &at_far_corner)
{
  const double place = 1.25;
  BackgroundGrid<dim> grid(grid_box<dim>(-1., size - 1., width),
                           { [&](const Point<dim> &corner) { return is_in_cubes(corner, place); }, nullptr, 1 },
                           MPI_COMM_WORLD);
  compare(grid, inside);
  for (const double next : { size - 1. - 4 * width, place })
    {
      const Blocks blocks = grid.with_surroundings(blocks_of_cubes(grid, next));
      grid.change_cells(&blocks);
      grid.distribute_nodes();
      compare(grid, next == place ? inside : at_far_corner);
    }
}

const UnitTest registered("grid_fine_cells", [] {
  for (const double size : { 18.875, 37.625 })
    test<2>(size, { 61, 39, 25, 164, 15 }, { 61, 24, 25, 145, 32 });
  for (const double size : { 4.125, 8.875 })
    test<3>(size, { 341, 387, 91, 1512, 169 }, { 341, 218, 91, 1241, 386 });
});
} // namespace test_grid_fine_cells

// Runs with mpirun=1,2.
