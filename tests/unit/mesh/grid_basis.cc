// SPDX-License-Identifier: LGPL-2.1-or-later

// The background grid's shape functions: constants and linear fields are reproduced to rounding, a random field has no
// jump across a face (splines: nor has its gradient), nodes are as many as the tensor product of the one-dimensional
// bases has, and those on a wall say so.
#include "../test.h"

#include <map>

namespace test_grid_basis
{
/// Largest error of constants and of linear fields at random places of all cells.
template <int dim, int n>
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
          const auto one = evaluate<dim, n>(grid, cell->active_cell_index(), x, [](const unsigned int) { return 1.; });
          error          = std::max({ error, std::abs(one.first - 1.), grid.cell_size() * one.second.norm() });
          for (unsigned int a = 0; a < dim; ++a)
            {
              auto linear = evaluate<dim, n>(grid, cell->active_cell_index(), x, [&](const unsigned int node) {
                return grid.node_position(node)[a];
              });
              linear.second[a] -= 1.;
              error = std::max({ error, std::abs(linear.first - place[a]), linear.second.norm() });
            }
        }
  return Utilities::MPI::max(error, grid.communicator());
}

/// Largest jumps of a random field and of its gradient (times the cell size) across the faces of the mesh; the two
/// sides of a face meet on rank 0, because they may lie on two ranks. Throws unless each interior face has two sides.
template <int dim, int n>
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
                  evaluate<dim, n>(grid, cell->active_cell_index(), x, [&](const unsigned int node) {
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

/// Throws unless the nodes that lie on a wall are those that say so, and each wall has as many as it should.
template <int dim>
void check_walls(const BackgroundGrid<dim> &grid, const std::array<unsigned int, dim> &nodes_along)
{
  for (unsigned int face = 0; face < 2 * dim; ++face)
    {
      const unsigned int axis = face / 2;
      const double wall       = face % 2 ? grid.upper_corner()[axis] : grid.lower_corner()[axis];
      unsigned int n = 0, expected = 1;
      const unsigned int n_ghosts = grid.numbering().partitioner()->n_ghost_indices();
      for (unsigned int node = 0; node < grid.n_owned_nodes() + n_ghosts; ++node)
        {
          const bool on_wall = std::abs(grid.node_position(node)[axis] - wall) < 1e-6 * grid.cell_size();
          require(on_wall == ((grid.node_faces(node) >> face) & 1), "A node's walls are wrong.");
          if (on_wall && node < grid.n_owned_nodes())
            ++n;
        }
      for (unsigned int a = 0; a < dim; ++a)
        expected *= a == axis ? 1 : nodes_along[a];
      require(Utilities::MPI::sum(n, grid.communicator()) == expected, "A wall has the wrong number of nodes.");
    }
}

template <int dim, int n>
void test(const std::string &basis, const std::array<unsigned int, dim> &cells)
{
  std::vector<double> upper;
  std::array<unsigned int, dim> nodes_along;
  unsigned int expected = 1;
  for (unsigned int a = 0; a < dim; ++a)
    {
      upper.push_back(-0.7 + 0.3 * cells[a]);
      nodes_along[a] = cells[a] + (basis == "spline" ? 2 : 1);
      expected *= nodes_along[a];
    }
  const GridParameters parameters = grid_box(-0.7, upper, 0.3, basis);
  parameters.check(dim);
  const BackgroundGrid<dim> grid(parameters, MPI_COMM_WORLD);

  // A node acts on a cell exactly if it is one of its n^dim; all have one owner.
  require(Utilities::MPI::sum(grid.n_owned_nodes(), MPI_COMM_WORLD) == expected,
          "The grid has the wrong number of nodes.");
  check_walls<dim>(grid, nodes_along);

  // Sums of 3^dim products of numbers of size 1: rounding stays below 100 units in the last place.
  expect(linear_error<dim, n>(grid), 0, 3e-14, "error of linear fields");
  // A random field's gradient is of size 1 per cell.
  const auto [value_jump, gradient_jump] = jumps<dim, n>(grid);
  expect(value_jump, 0, 1e-13, "jump of the field");
  require(basis == "spline" ? gradient_jump < 1e-10 : gradient_jump > 0.1,
          "The gradient of a " + basis + " field jumps.");
}


const UnitTest registered("grid_basis", [] {
  for (const auto &cells : { std::array<unsigned int, 2>{ { 8, 4 } }, { { 7, 3 } }, { { 6, 10 } }, { { 5, 1 } } })
    {
      test<2, 3>("spline", cells);
      test<2, 2>("linear", cells);
    }
  for (const auto &cells : { std::array<unsigned int, 3>{ { 4, 4, 2 } }, { { 3, 5, 2 } }, { { 6, 1, 4 } } })
    {
      test<3, 3>("spline", cells);
      test<3, 2>("linear", cells);
    }
});
} // namespace test_grid_basis

// Runs with mpirun=1,2.
