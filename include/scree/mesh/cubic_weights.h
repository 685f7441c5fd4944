// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_cubic_weights_h
#define scree_mesh_cubic_weights_h

#include <scree/geometry/open_part.h>

#include <deal.II/base/quadrature.h>
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

    /// Adds a simplex of the unit cell.
    void add(const Simplex<dim> &simplex);

    /// The Gauss points along an axis.
    static const Along &points();
  };
} // namespace scree

#endif
