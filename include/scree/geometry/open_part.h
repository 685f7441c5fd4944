// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_open_part_h
#define scree_geometry_open_part_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace scree
{
  /// A corner of a simplex, and on which side of a surface it is: positive in the open, 0 on the surface.
  template <int dim>
  struct SimplexCorner
  {
    dealii::Point<dim> place; ///< m
    double side;              ///< signed distance, or proportional to it
  };

  /// A triangle (2D) or tetrahedron.
  template <int dim>
  using Simplex = std::array<SimplexCorner<dim>, dim + 1>;

  /// The simplices that a cube consists of (@source{kuhn1960}): those of cubes that share a face meet there. All sides
  /// are 0.
  template <int dim>
  std::vector<Simplex<dim>> simplices_of_cube(const dealii::Point<dim> &lower, const double width);

  /// What spans a simplex from its first corner.
  template <int dim>
  dealii::Tensor<2, dim> edges_of(const Simplex<dim> &simplex)
  {
    dealii::Tensor<2, dim> edges;
    for (unsigned int a = 0; a < dim; ++a)
      edges[a] = simplex[a + 1].place - simplex[0].place;
    return edges;
  }

  /// Volume of a simplex, m^dim.
  template <int dim>
  double volume_of(const Simplex<dim> &simplex)
  {
    return std::abs(determinant(edges_of(simplex))) / (dim == 2 ? 2. : 6.);
  }

  /// A line (2D) or triangle.
  template <int dim>
  using SimplexFace = std::array<SimplexCorner<dim>, dim>;

  /// Normal of a face, as long as it or its area.
  template <int dim>
  dealii::Tensor<1, dim> area_of(const SimplexFace<dim> &face)
  {
    if constexpr (dim == 2)
      return dealii::cross_product_2d(face[1].place - face[0].place);
    else
      return 0.5 * dealii::cross_product_3d(face[1].place - face[0].place, face[2].place - face[0].place);
  }

  /// Keeps of simplices, or of faces of such, what is in the open, cut at the surface: simplices without a negative
  /// side. A simplex is halved at an edge with corners on either side until there is none; with a surface that is plane
  /// in it the result is exact.
  ///
  /// @param crossing (inside, outside): the place, m, where the surface cuts the edge between two corners
  template <int dim, std::size_t n_corners, typename Crossing>
  std::vector<std::array<SimplexCorner<dim>, n_corners>>
  open_part(std::vector<std::array<SimplexCorner<dim>, n_corners>> simplices, const Crossing &crossing)
  {
    std::vector<std::array<SimplexCorner<dim>, n_corners>> open;
    while (!simplices.empty())
      {
        const auto simplex = simplices.back();
        simplices.pop_back();
        unsigned int inside = 0, outside = 0; // the corner farthest from the surface on either side
        for (unsigned int i = 1; i < n_corners; ++i)
          {
            if (simplex[i].side > simplex[inside].side)
              inside = i;
            if (simplex[i].side < simplex[outside].side)
              outside = i;
          }
        if (simplex[inside].side <= 0.)
          continue;
        if (simplex[outside].side >= 0.)
          {
            open.push_back(simplex);
            continue;
          }
        const SimplexCorner<dim> cut{ crossing(simplex[inside], simplex[outside]), 0. };
        for (const unsigned int replaced : { inside, outside })
          {
            simplices.push_back(simplex);
            simplices.back()[replaced] = cut;
          }
      }
    return open;
  }

  /// Where a surface whose distance is linear between two corners cuts the edge between them, m.
  template <int dim>
  dealii::Point<dim> linear_crossing(const SimplexCorner<dim> &inside, const SimplexCorner<dim> &outside)
  {
    return inside.place + inside.side / (inside.side - outside.side) * (outside.place - inside.place);
  }

  /// Volume, m^dim, and centroid, m, of simplices; the centroid of nothing is the origin.
  template <int dim>
  std::pair<double, dealii::Point<dim>> volume_and_centroid(const std::vector<Simplex<dim>> &simplices)
  {
    double sum = 0.;
    dealii::Tensor<1, dim> moment;
    for (const Simplex<dim> &simplex : simplices)
      {
        const double volume = volume_of(simplex);
        sum += volume;
        for (const SimplexCorner<dim> &corner : simplex)
          moment += volume / (dim + 1) * corner.place;
      }
    return { sum, dealii::Point<dim>(sum > 0. ? moment / sum : moment) };
  }
} // namespace scree

#endif
