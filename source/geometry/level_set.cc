// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/level_set.h>

namespace scree
{
  using namespace dealii;

  template class JoinedSurface<2>;
  template class JoinedSurface<3>;


  PlaceOfTriangle nearest_place(const Point<3> &x, const Triangle &corners)
  {
    const auto &[a, b, c] = corners;
    const Tensor<1, 3> ab = b - a, ac = c - a;
    const Tensor<1, 3> from_a = x - a, from_b = x - b, from_c = x - c;
    // Along the two edges at the first corner, from each corner.
    const double ab_a = ab * from_a, ac_a = ac * from_a;
    const double ab_b = ab * from_b, ac_b = ac * from_b;
    const double ab_c = ab * from_c, ac_c = ac * from_c;
    if (ab_a <= 0. && ac_a <= 0.)
      return { a, 4 };
    if (ab_b >= 0. && ac_b <= ab_b)
      return { b, 5 };
    if (ac_c >= 0. && ab_c <= ac_c)
      return { c, 6 };
    // Barycentric coordinates, not yet divided by their sum.
    const double of_a = ab_b * ac_c - ab_c * ac_b, of_b = ab_c * ac_a - ab_a * ac_c, of_c = ab_a * ac_b - ab_b * ac_a;
    if (of_c <= 0. && ab_a >= 0. && ab_b <= 0.)
      return { a + ab_a / (ab_a - ab_b) * ab, 1 };
    if (of_b <= 0. && ac_a >= 0. && ac_c <= 0.)
      return { a + ac_a / (ac_a - ac_c) * ac, 3 };
    if (const double to_c = ac_b - ab_b, to_b = ab_c - ac_c; of_a <= 0. && to_c >= 0. && to_b >= 0.)
      return { b + to_c / (to_c + to_b) * (c - b), 2 };
    const double sum = of_a + of_b + of_c;
    return { a + of_b / sum * ab + of_c / sum * ac, 0 };
  }


  Tensor<1, 3> across(const Triangle &corners)
  {
    return cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
  }
} // namespace scree
