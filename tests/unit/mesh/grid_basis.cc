// SPDX-License-Identifier: LGPL-2.1-or-later
// The background grid's shape functions: constants and linear fields are reproduced to rounding, and second moments are
// those of the closed form, which leaves one set of three values an axis and none that jumps; derivatives are
// differences of the values; nodes are as many as the tensor product of the one-dimensional bases has.
#include "../test.h"

namespace test_grid_basis
{
template <int dim>
void test(const std::string &basis, const std::array<unsigned int, dim> &cells)
{
  std::vector<double> upper;
  unsigned int expected = 1;
  for (unsigned int a = 0; a < dim; ++a)
    {
      upper.push_back(-0.7 + 0.3 * cells[a]);
      expected *= cells[a] + (basis == "spline" ? 2 : 1);
    }
  const GridParameters parameters = grid_box(-0.7, upper, 0.3, basis);
  parameters.check(dim);
  const BackgroundGrid<dim> grid(parameters, MPI_COMM_WORLD);
  const double h = grid.cell_size();

  // A node acts on a cell exactly if it is one of its n^dim; all have one owner.
  expect(sum_of_ranks(grid.n_owned_nodes()), expected, 0, "number of nodes");

  RandomNumbers random;
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    for (unsigned int sample = 0; sample < 20 && cell->is_locally_owned(); ++sample)
      {
        const unsigned int index = cell->active_cell_index();
        const OpenKnots open     = grid.open_knots(index);
        const Point<dim> x =
            sample < 2 ? point_of<dim>([&](const unsigned int) { return double(sample); }) : random.point<dim>(0, 1);
        const Point<dim> place = cell->vertex(0) + h * Tensor<1, dim>(x);
        const auto field       = [&](const Point<dim> &at, const auto &coefficient) {
          return evaluate<dim>(grid, index, at, coefficient);
        };
        // Sums of 3^dim products of numbers of size 1: rounding stays below 100 units in the last place.
        const auto one = field(x, [](const unsigned int) { return 1.; });
        expect(one.first, 1, 3e-14, "sum of the shape functions");
        expect(h * one.second.norm(), 0, 3e-14, "sum of their gradients");
        for (unsigned int a = 0; a < dim; ++a)
          {
            const auto node_place = [&](const unsigned int node) { return grid.node_position(node)[a]; };
            const auto linear     = field(x, node_place);
            expect(linear.first, place[a], 3e-14, "linear field");
            expect((linear.second - Point<dim>::unit_vector(a)).norm(), 0, 3e-14, "error of its gradient");
            double sum = 0;
            visit_nodes(grid, index, x, [&](const unsigned int node, const double value) {
              sum += value * std::pow((node_place(node) - place[a]) / h, 2);
            });
            const double moment =
                with_nodes_1d(grid, [&](auto n) { return CellBasis<dim, n>::second_moment(x[a], open, a); });
            expect(moment, sum, 3e-14, "second moment in cell widths");
            if (sample < 2 && (open >> (2 * a + sample) & 1))
              expect(moment, 0, 1e-14, "second moment on walls");
            // The values are polynomials of second degree an axis: central differences are exact.
            const auto scattered      = [&](const unsigned int node) { return pattern(grid.node_position(node)); };
            const Tensor<1, dim> step = 0.25 * Point<dim>::unit_vector(a);
            const double difference   = field(x + step, scattered).first - field(x - step, scattered).first;
            if (x[a] > 0.25 && x[a] < 0.75)
              expect(h * field(x, scattered).second[a], 2 * difference, 1e-12, "derivative");
          }
      }
}


const UnitTest registered("grid_basis", [] {
  for (const std::string basis : { "spline", "linear" })
    {
      for (const auto &cells : { std::array<unsigned int, 2>{ { 8, 4 } }, { { 7, 3 } }, { { 6, 10 } }, { { 5, 1 } } })
        test<2>(basis, cells);
      for (const auto &cells : { std::array<unsigned int, 3>{ { 4, 4, 2 } }, { { 3, 5, 2 } }, { { 6, 1, 4 } } })
        test<3>(basis, cells);
    }
});
} // namespace test_grid_basis

// Runs with mpirun=1,2.
