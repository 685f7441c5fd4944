// SPDX-License-Identifier: LGPL-2.1-or-later
// What unit tests share: registration by name, checks, numbers that look random, grids.
#ifndef scree_tests_unit_test_h
#define scree_tests_unit_test_h

#include <scree/mesh/background_grid.h>
#include <scree/particles/point_set.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace dealii;
using namespace scree;

/// A test of its folder's program, which runs it when called with its name: `const UnitTest registered("name", run);`.
/// MPI has been initialised. A test throws if something is wrong; what it prints on the first rank is compared with its
/// expected output.
class UnitTest
{
public:
  UnitTest(const std::string &name, void (*run)());
};


inline void require(const bool holds, const std::string &what)
{
  AssertThrow(holds, ExcMessage(what));
}


/// Throws unless `value` is what was expected; not-a-number never is.
inline void expect(const double value, const double expected, const double tolerance, const std::string &what)
{
  require(std::abs(value - expected) <= tolerance,
          what + " is " + Utilities::to_string(value) + " instead of " + Utilities::to_string(expected));
}


inline void expect_text(const std::string &value, const std::string &expected, const std::string &what)
{
  require(value == expected, what + " is\n" + value + "\ninstead of\n" + expected);
}


/// Throws unless `action` throws an exception whose text contains `text`.
template <typename Action>
void expect_refusal(const Action &action, const std::string &text, const std::string &what)
{
  std::string message = "no exception";
  try
    {
      action();
    }
  catch (const std::exception &error)
    {
      message = error.what();
    }
  require(message.find(text) != std::string::npos, what + " gives \"" + message + "\", without \"" + text + '"');
}


/// Sum over all ranks.
template <typename Value>
Value sum_of_ranks(const Value &value)
{
  return Utilities::MPI::sum(value, MPI_COMM_WORLD);
}

inline double max_of_ranks(const double value)
{
  return Utilities::MPI::max(value, MPI_COMM_WORLD);
}


/// The place whose coordinate along axis `a` is `coordinate(a)`.
template <int dim, typename Coordinate>
Point<dim> point_of(const Coordinate &coordinate)
{
  Point<dim> result;
  for (unsigned int a = 0; a < dim; ++a)
    result[a] = coordinate(a);
  return result;
}


/// The same numbers on every platform, which the distributions of the standard library do not promise.
class RandomNumbers
{
public:
  double uniform(const double low, const double high)
  {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }

  double log_uniform(const double low, const double high)
  {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

  /// Components from `low` to `high`.
  template <int dim>
  Point<dim> point(const double low, const double high)
  {
    return point_of<dim>([&](const unsigned int) { return uniform(low, high); });
  }

private:
  std::mt19937_64 engine{ 20240607 };
};


/// A number from -1 to 1 that depends on the place only, and so is the same on all ranks.
template <int dim>
double pattern(const Point<dim> &x)
{
  double phase = 1.;
  for (unsigned int a = 0; a < dim; ++a)
    phase = 17. * std::sin(phase + 7. * x[a] * (a + 1));
  return std::sin(phase);
}


/// The vector whose components begin at `first` among the values of a node or the properties of a point.
template <int dim>
Tensor<1, dim> vector_of(const double *values, const unsigned int first)
{
  Tensor<1, dim> result;
  std::copy(values + first, values + first + dim, result.begin_raw());
  return result;
}

template <int dim>
void set_vector(double *values, const unsigned int first, const Tensor<1, dim> &vector)
{
  std::copy(vector.begin_raw(), vector.end_raw(), values + first);
}


/// Sum of `coefficient(node)` times the shape functions at a place of a cell, and its gradient.
template <int dim, typename Coefficient>
std::pair<double, Tensor<1, dim>>
evaluate(const BackgroundGrid<dim> &grid, const unsigned int cell, const Point<dim> &x, const Coefficient &coefficient)
{
  const auto sum = [&](const auto &basis) {
    const unsigned int n = grid.n_nodes_1d();
    std::pair<double, Tensor<1, dim>> result(0., Tensor<1, dim>());
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      {
        const double c        = coefficient(grid.nodes(cell)[i]);
        double product        = c;
        Tensor<1, dim> slopes = point_of<dim>([&](const unsigned int) { return c / grid.cell_size(); });
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
  };
  return grid.n_nodes_1d() == 2 ? sum(CellBasis<dim, 2>(x, grid.open_knots(cell)))
                                : sum(CellBasis<dim, 3>(x, grid.open_knots(cell)));
}


/// Adds a point, m, on the rank that has its cell.
template <int dim>
void add_point(PointSet<dim> &points,
               const BackgroundGrid<dim> &grid,
               const Point<dim> &x,
               const std::vector<double> &properties)
{
  for (const auto &cell : grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned() && cell->bounding_box().point_inside(x))
      points.add(cell, x, 0, properties);
  points.finish_adding();
}


/// A box from `lower` on all axes to the corner `upper`, m.
inline GridParameters grid_box(const double lower,
                               const std::vector<double> &upper,
                               const double cell_size   = 0.1,
                               const std::string &basis = "spline")
{
  GridParameters parameters;
  parameters.lower_corner.assign(upper.size(), lower);
  parameters.upper_corner = upper;
  parameters.cell_size    = cell_size;
  parameters.basis        = basis;
  return parameters;
}

/// The same with the coordinate `upper` on each axis.
template <int dim>
GridParameters
grid_box(const double lower, const double upper, const double cell_size = 0.1, const std::string &basis = "spline")
{
  return grid_box(lower, std::vector<double>(dim, upper), cell_size, basis);
}

#endif
