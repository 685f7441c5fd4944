// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/open_part.h>

#include <algorithm>
#include <numeric>

namespace scree
{
  using namespace dealii;

  template <int dim>
  std::vector<Simplex<dim>> simplices_of_cube(const Point<dim> &lower, const double width)
  {
    // One for each order in which a way along the edges from the lower to the upper corner takes the axes.
    std::array<unsigned int, dim> axes;
    std::iota(axes.begin(), axes.end(), 0);
    std::vector<Simplex<dim>> simplices;
    do
      {
        Simplex<dim> simplex;
        simplex[0] = { lower, 0. };
        for (unsigned int a = 0; a < dim; ++a)
          {
            simplex[a + 1] = simplex[a];
            simplex[a + 1].place[axes[a]] += width;
          }
        simplices.push_back(simplex);
      }
    while (std::next_permutation(axes.begin(), axes.end()));
    return simplices;
  }

  template decltype(simplices_of_cube<2>) simplices_of_cube<2>;
  template decltype(simplices_of_cube<3>) simplices_of_cube<3>;
} // namespace scree
