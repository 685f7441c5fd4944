// SPDX-License-Identifier: LGPL-2.1-or-later
// The background grid's shape functions: constants and linear fields are reproduced to rounding, a random field has no
// jump across a face (splines: nor has its gradient), nodes are as many as the tensor product of the one-dimensional
// bases has, and their inertia about a place is that of a sum over them.
#include "../test.h"

#include <map>

namespace test_grid_basis
{
/// Largest error of constants and of linear fields at random places of all cells.
template <int dim>
double linear_error(const BackgroundGrid<dim> &grid)
{
  RandomNumbers random;
  double error = 0;
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int sample = 0; sample < 20; ++sample)
        {
          const Point<dim> x     = random.point<dim>(0, 1);
          const Point<dim> place = cell->vertex(0) + grid.cell_size() * Tensor<1, dim>(x);
          const auto one = evaluate<dim>(grid, cell->active_cell_index(), x, [](const unsigned int) { return 1.; });
          error          = std::max({ error, std::abs(one.first - 1.), grid.cell_size() * one.second.norm() });
          for (unsigned int a = 0; a < dim; ++a)
            {
              auto linear = evaluate<dim>(grid, cell->active_cell_index(), x, [&](const unsigned int node) {
                return grid.node_position(node)[a];
              });
              linear.second[a] -= 1.;
              error = std::max({ error, std::abs(linear.first - place[a]), linear.second.norm() });
            }
        }
  return Utilities::MPI::max(error, grid.communicator());
}

/// Largest error of the second moments at random places of all cells and at their corners, cell widths squared, and the
/// largest moment across a wall on it.
template <int dim>
std::pair<double, double> moment_errors(const BackgroundGrid<dim> &grid)
{
  RandomNumbers random;
  std::pair<double, double> errors(0., 0.);
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int sample = 0; sample < 20; ++sample)
        {
          const OpenKnots open = grid.open_knots(cell->active_cell_index());
          const Point<dim> x =
              sample < 2 ? point_of<dim>([&](const unsigned int) { return double(sample); }) : random.point<dim>(0, 1);
          const Point<dim> place = cell->vertex(0) + grid.cell_size() * Tensor<1, dim>(x);
          for (unsigned int a = 0; a < dim; ++a)
            {
              double sum = 0.;
              visit_nodes(grid, cell->active_cell_index(), x, [&](const unsigned int node, const double value) {
                sum += value * std::pow((grid.node_position(node)[a] - place[a]) / grid.cell_size(), 2);
              });
              const double moment =
                  with_nodes_1d(grid, [&](auto n) { return CellBasis<dim, n>::second_moment(x[a], open, a); });
              errors.first = std::max(errors.first, std::abs(moment - sum));
              if (sample < 2 && (open >> (2 * a + sample) & 1))
                errors.second = std::max(errors.second, std::abs(moment));
            }
        }
  return { max_of_ranks(errors.first), max_of_ranks(errors.second) };
}

/// Largest jumps of a random field and of its gradient (times the cell size) across the faces of the mesh; the two
/// sides of a face meet on rank 0, because they may lie on two ranks. Throws unless each interior face has two sides.
template <int dim>
std::pair<double, double> jumps(const BackgroundGrid<dim> &grid)
{
  using Trace = std::vector<double>;
  std::vector<std::pair<std::array<long, dim>, Trace>> traces;
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int face : cell->face_indices())
        if (!cell->at_boundary(face))
          for (unsigned int corner = 0; corner < (1 << (dim - 1)); ++corner)
            {
              // Off the middle, and where no other face of the mesh has a point: at 0.3 or 0.7 along the face.
              Point<dim> x;
              std::array<long, dim> key;
              for (unsigned int a = 0, k = 0; a < dim; ++a)
                x[a] = a == face / 2 ? face % 2 : ((corner >> k++) & 1 ? 0.7 : 0.3);
              for (unsigned int a = 0; a < dim; ++a)
                key[a] = std::lround(10. * ((cell->vertex(0)[a] - grid.lower_corner()[a]) / grid.cell_size() + x[a]));
              const auto [value, gradient] =
                  evaluate<dim>(grid, cell->active_cell_index(), x, [&](const unsigned int node) {
                    return pattern(grid.node_position(node));
                  });
              Trace trace{ value };
              for (unsigned int a = 0; a < dim; ++a)
                trace.push_back(grid.cell_size() * gradient[a]);
              traces.emplace_back(key, trace);
            }

  std::map<std::array<long, dim>, std::vector<Trace>> faces;
  for (const auto &of_rank : Utilities::MPI::gather(grid.communicator(), traces))
    for (const auto &[key, trace] : of_rank)
      faces[key].push_back(trace);
  std::pair<double, double> result(0., 0.);
  for (const auto &[key, sides] : faces)
    {
      require(sides.size() == 2, "A face has " + std::to_string(sides.size()) + " sides.");
      result.first = std::max(result.first, std::abs(sides[0][0] - sides[1][0]));
      for (unsigned int a = 1; a <= dim; ++a)
        result.second = std::max(result.second, std::abs(sides[0][a] - sides[1][a]));
    }
  return { max_of_ranks(result.first), max_of_ranks(result.second) };
}

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

  // A node acts on a cell exactly if it is one of its n^dim; all have one owner.
  require(Utilities::MPI::sum(grid.n_owned_nodes(), MPI_COMM_WORLD) == expected,
          "The grid has the wrong number of nodes.");

  // Sums of 3^dim products of numbers of size 1: rounding stays below 100 units in the last place.
  expect(linear_error(grid), 0, 3e-14, "error of linear fields");
  const auto [moment_error, moment_on_walls] = moment_errors(grid);
  expect(moment_error, 0, 3e-14, "error of second moments");
  expect(moment_on_walls, 0, 1e-14, "second moment on walls");
  // A random field's gradient is of size 1 per cell.
  const auto [value_jump, gradient_jump] = jumps(grid);
  expect(value_jump, 0, 1e-13, "jump of the field");
  require(basis == "spline" ? gradient_jump < 1e-10 : gradient_jump > 0.1,
          "The gradient of a " + basis + " field jumps.");
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
