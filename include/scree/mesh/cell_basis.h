// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_cell_basis_h
#define scree_mesh_cell_basis_h

#include <scree/geometry/open_part.h>
#include <scree/simd/batch.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <numeric>

namespace scree
{
  /// Calls `visit(place, part)` for the points of a rule on a simplex with `corners`; parts add up to 1.
  template <int dim, int dim_of_simplex, typename Visit>
  void visit_rule(const dealii::Quadrature<dim_of_simplex> &rule,
                  const std::array<dealii::Point<dim>, dim_of_simplex + 1> &corners,
                  const Visit &visit)
  {
    const double whole = std::accumulate(rule.get_weights().begin(), rule.get_weights().end(), 0.);
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        dealii::Point<dim> place = corners[0];
        for (unsigned int a = 0; a < dim_of_simplex; ++a)
          place += rule.point(q)[a] * (corners[a + 1] - corners[0]);
        visit(place, rule.weight(q) / whole);
      }
  }


  /// Integrals over a part of the unit cell: weights of the Gauss points of the whole cell, four an axis, that
  /// integrate cubics along all axes as far as a rule on the part's simplices does. Some weights are negative.
  template <int dim>
  class CubicWeights
  {
  public:
    static constexpr unsigned int n_1d     = 4;                                 ///< Gauss points along an axis
    static constexpr unsigned int n_points = dealii::Utilities::pow(n_1d, dim); ///< of a cell, first axis fastest
    static constexpr unsigned int n_hats   = 1 << dim;                          ///< linear functions of a cell

    using Along = std::array<double, n_1d>; ///< a number a Gauss point along an axis

    std::array<double, n_points> weights{}; ///< over the volume of the cell
    std::array<double, n_hats> hats{};      ///< integrals of the linear functions, over the volume of the cell
    double fraction = 0.;                   ///< of the volume

    CubicWeights() = default;

    /// Integrates over simplices of the unit cell.
    explicit CubicWeights(const std::vector<Simplex<dim>> &simplices);

    /// The Gauss points along an axis.
    static const Along &points()
    {
      static const Along result = [] {
        const dealii::QGauss<1> rule(n_1d);
        Along points;
        for (unsigned int q = 0; q < n_1d; ++q)
          points[q] = rule.point(q)[0];
        return points;
      }();
      return result;
    }
  };

  /// The walls of the box that a cell touches, where the splines have open knots: bit 2 a for the lower face of axis a,
  /// bit 2 a + 1 for the upper one. Inside, splines are C1 across the face.
  using OpenKnots = std::uint8_t;

  /// The one-dimensional shape functions along each axis at a point of a cell, and the nodes they belong to.
  ///
  /// With n = 3 these are quadratic B-splines: B are the Bernstein polynomials of the cell, l and r are 1 at an open
  /// knot and 1/2 inside, N_0 = l B_0, N_1 = (1 - l) B_0 + B_1 + (1 - r) B_2, N_2 = r B_2. With n = 2 they
  /// are the linear functions. All are non-negative and sum to one. The lexicographic tensor products (first axis
  /// fastest) are the n^dim shape functions of the cell.
  ///
  /// @tparam Number double, or Batch for as many points
  template <int dim, int n, typename Number = double>
  struct CellBasis
  {
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim); ///< nodes that act on a cell

    std::array<std::array<Number, n>, dim> value;      ///< shape functions by axis and node
    std::array<std::array<Number, n>, dim> derivative; ///< per cell width

    /// @param x place in the cell: a Point, or an array of `dim` batches
    template <typename Place>
    CellBasis(const Place &x, const OpenKnots open)
    {
      for (unsigned int a = 0; a < dim; ++a)
        {
          const Number s = x[a], t = 1. - s;
          if constexpr (n == 2)
            {
              value[a]      = { { t, s } };
              derivative[a] = { { simd::broadcast<Number>(-1.), simd::broadcast<Number>(1.) } };
            }
          else
            {
              const double l = lower(open, a), r = upper(open, a);
              value[a][0]      = l * t * t;
              value[a][2]      = r * s * s;
              value[a][1]      = 1. - value[a][0] - value[a][2];
              derivative[a][0] = -2. * l * t;
              derivative[a][2] = 2. * r * s;
              derivative[a][1] = -derivative[a][0] - derivative[a][2];
            }
        }
    }

    /// Positions of the n nodes of axis `a` (Greville abscissae, at which the splines have linear precision), in cell
    /// widths from the cell's lower corner.
    static std::array<double, n> node_positions(const OpenKnots open, const unsigned int a)
    {
      if constexpr (n == 2)
        {
          (void)open;
          (void)a;
          return { { 0., 1. } };
        }
      else
        return { { lower(open, a) - 1., 0.5, 2. - upper(open, a) } };
    }

    /// sum N_i (x_i - x)^2 along axis `a`, cell widths squared: the inertia of the nodes about a place. With splines
    /// 1/4, but less in the cell at a wall, and 0 on the wall; with linear functions x (1 - x).
    /// @param x place along the axis, at most a cell away from the cell
    static Number second_moment(const Number &x, const OpenKnots open, const unsigned int a)
    {
      if constexpr (n == 2)
        {
          (void)open;
          (void)a;
          const Number in_cell = 1. - simd::abs<Number>(1. - simd::abs<Number>(x));
          return in_cell * (1. - in_cell);
        }
      else if ((open >> (2 * a) & 3) == 0)
        return simd::broadcast<Number>(0.25);
      else
        {
          // x_i^2 is a product of two knots and the square of half their distance, and sum N_i times the products x^2.
          const Number s = simd::max<Number>(x, simd::broadcast<Number>(0.)),
                       t = simd::max<Number>(1. - x, simd::broadcast<Number>(0.));
          return 0.25 - (0.5 * lower(open, a) - 0.25) * t * t - (0.5 * upper(open, a) - 0.25) * s * s;
        }
    }

  private:
    static double lower(const OpenKnots open, const unsigned int a)
    {
      return (open >> (2 * a)) & 1 ? 1. : 0.5;
    }
    static double upper(const OpenKnots open, const unsigned int a)
    {
      return (open >> (2 * a + 1)) & 1 ? 1. : 0.5;
    }
  };
} // namespace scree

#endif
