// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_triangle_h
#define scree_geometry_triangle_h

#include <deal.II/base/point.h>

#include <array>

namespace scree
{
  /// The corners of a triangle in space, m.
  using Triangle = std::array<dealii::Point<3>, 3>;

  /// A place of a triangle, and which part of it holds the place.
  struct PlaceOfTriangle
  {
    dealii::Point<3> place; ///< m
    unsigned int part;      ///< 0: the inside; 1 + i: the edge from corner i to the next one; 4 + i: corner i
  };

  /// The place of a triangle that is nearest to `x` (@source{ericson2005}, section 5.1.5).
  PlaceOfTriangle nearest_place(const dealii::Point<3> &x, const Triangle &corners);

  /// Normal of a triangle, twice as long as its area, m^2; corners are counter-clockwise seen from where it points.
  dealii::Tensor<1, 3> across(const Triangle &corners);
} // namespace scree

#endif
