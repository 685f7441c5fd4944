// SPDX-License-Identifier: LGPL-2.1-or-later

// The background grid's shape functions, on one rank and on two: constants and linear fields are reproduced to
// rounding, a random field has no jump across a face (splines: nor has its gradient), nodes are as many as the tensor
// product of the one-dimensional bases has, and those on a wall say so.

#include <scree/mesh/background_grid.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <map>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_grid_basis
{
using namespace dealii;
using namespace scree;

/// How far a position is from the lower corner, in half cells: nodes and face points sit at whole numbers.
template <int dim>
std::array<long, dim> half_cells(const BackgroundGrid<dim> &grid, const Point<dim> &x)
{
  std::array<long, dim> result;
  for (unsigned int a = 0; a < dim; ++a)
    result[a] = std::lround(2. * (x[a] - grid.lower_corner()[a]) / grid.cell_size());
  return result;
}

/// A number in (-1, 1) that knows nothing of its neighbours' and is the same on all ranks.
template <int dim>
double random_value(const BackgroundGrid<dim> &grid, const unsigned int node)
{
  std::uint64_t bits = 0;
  for (const long i : half_cells(grid, grid.node_position(node)))
    {
      bits = (bits + i + 1) * 0x9e3779b97f4a7c15;
      bits ^= bits >> 29;
    }
  return 2. * static_cast<double>(bits >> 11) * 0x1p-53 - 1.;
}

/// Sum of `coefficient(node)` times the shape functions at a place of a cell, and its gradient.
template <int dim, int n, typename Coefficient>
std::pair<double, Tensor<1, dim>>
evaluate(const BackgroundGrid<dim> &grid, const unsigned int cell, const Point<dim> &x, const Coefficient &coefficient)
{
  const CellBasis<dim, n> basis(x, grid.open_knots(cell));
  std::pair<double, Tensor<1, dim>> result(0., Tensor<1, dim>());
  for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; ++i)
    {
      const double c = coefficient(grid.nodes(cell)[i]);
      double product = c;
      Tensor<1, dim> slopes;
      for (unsigned int a = 0; a < dim; ++a)
        slopes[a] = c / grid.cell_size();
      for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
        {
          product *= basis.value[a][rest % n];
          for (unsigned int b = 0; b < dim; ++b)
            slopes[b] *= a == b ? basis.derivative[a][rest % n] : basis.value[a][rest % n];
        }
      result.first += product;
      result.second += slopes;
    }
  return result;
}

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
          Point<dim> x, place;
          for (unsigned int a = 0; a < dim; ++a)
            {
              x[a]     = random.uniform(0, 1);
              place[a] = cell->vertex(0)[a] + grid.cell_size() * x[a];
            }
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
                    return random_value(grid, node);
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
      AssertThrow(sides.size() == 2, ExcMessage("A face has " + std::to_string(sides.size()) + " sides."));
      result.first = std::max(result.first, std::abs(sides[0][0] - sides[1][0]));
      for (unsigned int a = 1; a <= dim; ++a)
        result.second = std::max(result.second, std::abs(sides[0][a] - sides[1][a]));
    }
  return result;
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
          AssertThrow(on_wall == ((grid.node_faces(node) >> face) & 1), ExcMessage("A node's walls are wrong."));
          if (on_wall && node < grid.n_owned_nodes())
            ++n;
        }
      for (unsigned int a = 0; a < dim; ++a)
        expected *= a == axis ? 1 : nodes_along[a];
      AssertThrow(Utilities::MPI::sum(n, grid.communicator()) == expected,
                  ExcMessage("A wall has the wrong number of nodes."));
    }
}

template <int dim, int n>
void test(const std::string &basis, const std::array<unsigned int, dim> &cells)
{
  GridParameters parameters;
  parameters.basis     = basis;
  parameters.cell_size = 0.3;
  parameters.lower_corner.assign(dim, -0.7);
  parameters.upper_corner.clear();
  std::array<unsigned int, dim> nodes_along;
  unsigned int expected = 1;
  for (unsigned int a = 0; a < dim; ++a)
    {
      parameters.upper_corner.push_back(-0.7 + 0.3 * cells[a]);
      nodes_along[a] = cells[a] + (basis == "spline" ? 2 : 1);
      expected *= nodes_along[a];
    }
  parameters.check(dim);
  const BackgroundGrid<dim> grid(parameters, MPI_COMM_WORLD);

  // A node acts on a cell exactly if it is one of its n^dim; all have one owner.
  AssertThrow(Utilities::MPI::sum(grid.n_owned_nodes(), MPI_COMM_WORLD) == expected,
              ExcMessage("The grid has the wrong number of nodes."));
  check_walls<dim>(grid, nodes_along);

  // Sums of 3^dim products of numbers of size 1: rounding stays below 100 units in the last place.
  const double error = linear_error<dim, n>(grid);
  AssertThrow(error < 3e-14, ExcMessage("Linear fields are not exact: " + Utilities::to_string(error)));
  // A random field's gradient is of size 1 per cell.
  const auto [value_jump, gradient_jump] = jumps<dim, n>(grid);
  AssertThrow(value_jump < 1e-13, ExcMessage("The field jumps by " + Utilities::to_string(value_jump)));
  if (basis == "spline")
    AssertThrow(gradient_jump < 1e-10, ExcMessage("The gradient jumps by " + Utilities::to_string(gradient_jump)));

  std::cout << dim << "D " << basis;
  for (const unsigned int along : cells)
    std::cout << ' ' << along;
  std::cout << " cells: " << expected << " nodes; linear exact, continuous: OK; ";
  if (basis == "spline")
    std::cout << "C1: OK" << std::endl;
  else
    std::cout << "the gradient jumps by " << gradient_jump << std::endl;
}


void run()
{
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
}

const UnitTest registered("grid_basis", run);
} // namespace test_grid_basis


// Output of mpirun=1,2:
// 2D spline 8 4 cells: 60 nodes; linear exact, continuous: OK; C1: OK
// 2D linear 8 4 cells: 45 nodes; linear exact, continuous: OK; the gradient jumps by 2.63261
// 2D spline 7 3 cells: 45 nodes; linear exact, continuous: OK; C1: OK
// 2D linear 7 3 cells: 32 nodes; linear exact, continuous: OK; the gradient jumps by 2.16604
// 2D spline 6 10 cells: 96 nodes; linear exact, continuous: OK; C1: OK
// 2D linear 6 10 cells: 77 nodes; linear exact, continuous: OK; the gradient jumps by 2.1315
// 2D spline 5 1 cells: 21 nodes; linear exact, continuous: OK; C1: OK
// 2D linear 5 1 cells: 12 nodes; linear exact, continuous: OK; the gradient jumps by 1.9589
// 3D spline 4 4 2 cells: 144 nodes; linear exact, continuous: OK; C1: OK
// 3D linear 4 4 2 cells: 75 nodes; linear exact, continuous: OK; the gradient jumps by 2.21754
// 3D spline 3 5 2 cells: 140 nodes; linear exact, continuous: OK; C1: OK
// 3D linear 3 5 2 cells: 72 nodes; linear exact, continuous: OK; the gradient jumps by 2.21754
// 3D spline 6 1 4 cells: 144 nodes; linear exact, continuous: OK; C1: OK
// 3D linear 6 1 4 cells: 70 nodes; linear exact, continuous: OK; the gradient jumps by 1.82
