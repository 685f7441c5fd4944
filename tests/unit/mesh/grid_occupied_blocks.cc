// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks in which points are put, in boxes that are too large to look at each cell closely: none of those that a close
// look at all cells around the regions finds is missed, of a ball with a tail thinner than a cell and of a thin layer.
#include "../test.h"

#include <scree/mesh/fine_cells.h>
#include <scree/particles/region.h>

namespace test_grid_occupied_blocks
{
template <int dim>
void test(const std::string &name, const std::string &expression, const int n_cells, const unsigned int n_blocks)
{
  constexpr unsigned int n = 2; // points per cell along an axis
  const Region<dim> region(name, expression);
  CellsOfBox<dim> box{ Point<dim>(), 1., {} };
  box.n.fill(n_cells);
  std::uint64_t n_close = 0, n_places = 0;
  const auto in_cell = [&](const Point<dim> &corner) {
    ++n_close;
    for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
      {
        Point<dim> cube = corner;
        for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
          cube[a] += double(rest % n) / n;
        if (region.touches_cube(cube, 1. / n))
          return true;
      }
    return false;
  };
  const auto at_place = [&](const Point<dim> &, const Point<dim> &x) {
    ++n_places;
    return region.contains(x);
  };
  const unsigned int places_of_cell = Utilities::fixed_power<dim>(n) * Region<dim>::n_places_of_cube;
  const Blocks found                = occupied_blocks<dim>(box, { in_cell, at_place, places_of_cell }, MPI_COMM_WORLD);
  const double close                = sum_of_ranks(double(n_close));
  const double places               = sum_of_ranks(double(n_places));

  Blocks wanted; // The regions lie in the first 40 cells of each axis.
  for (int i = 0; i < Utilities::pow(20, dim); ++i)
    {
      CellPlace<dim> block;
      for (int a = 0, rest = i; a < dim; ++a, rest /= 20)
        block[a] = rest % 20;
      bool is_occupied = false;
      for (unsigned int v = 0; v < (1 << dim) && !is_occupied; ++v)
        is_occupied = in_cell(point_of<dim>([&](const unsigned int a) { return 2 * block[a] + (v >> a & 1); }));
      if (is_occupied)
        wanted.push_back(curve_number<dim>(block));
    }
  make_unique(wanted);
  const std::string what = std::to_string(dim) + "D, " + name + ": ";
  expect(wanted.size(), n_blocks, 0, what + "number of blocks");
  require(found == wanted, what + "blocks are missing, or there are more");
  require(places < 2.1e7, what + "too many places");
  require(close < 0.02 * box.n_cells(), what + "too many close looks");
}

const UnitTest registered("grid_occupied_blocks", [] {
  const std::string tail = " || (x > 12 && x < 38 && abs(y-12.1) < 0.13";
  test<2>("ball with a tail", "(x-12)^2 + (y-12)^2 < 16" + tail + ")", 1500, 38);
  test<2>("layer", "y > 7.3 && y < 7.6 && x < 36", 1500, 18);
  test<3>("ball with a tail", "(x-12)^2 + (y-12)^2 + (z-12)^2 < 16" + tail + " && abs(z-12.1) < 0.13)", 150, 108);
  test<3>("layer", "z > 7.3 && z < 7.6 && x < 36 && y < 30", 150, 270);
});
} // namespace test_grid_occupied_blocks

// Runs with mpirun=1,2.
