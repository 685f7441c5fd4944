// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/cell_basis.h>

#include <deal.II/base/quadrature_lib.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void CubicWeights<dim>::add(const Simplex<dim> &simplex)
  {
    static const QWitherdenVincentSimplex<dim> rule(dim == 2 ? 4 : 5); // cubics along all axes: degree 6, 9
    static const Along scales = [] { // products of the cubics' factors without x: 1 at their own Gauss point
      Along result;
      for (unsigned int i = 0; i < n_1d; ++i)
        {
          result[i] = 1.;
          for (unsigned int j = 0; j < n_1d; ++j)
            if (j != i)
              result[i] /= points()[i] - points()[j];
        }
      return result;
    }();
    const auto cubics = [&](const double x) { // Lagrange's, through the Gauss points
      Along values = scales;
      for (unsigned int i = 0; i < n_1d; ++i)
        for (unsigned int j = 0; j < n_1d; ++j)
          if (j != i)
            values[i] *= x - points()[j];
      return values;
    };
    std::array<Point<dim>, dim + 1> corners;
    for (unsigned int i = 0; i <= dim; ++i)
      corners[i] = simplex[i].place;
    const double volume = volume_of(simplex);
    fraction += volume;
    visit_rule<dim>(rule, corners, [&](const Point<dim> &x, const double part) {
      std::array<Along, dim> along;
      for (unsigned int a = 0; a < dim; ++a)
        along[a] = cubics(x[a]);
      for (unsigned int r = 0; r < n_points / n_1d; ++r)
        {
          double of_row = part * volume * along[1][r % n_1d];
          if constexpr (dim == 3)
            of_row *= along[2][r / n_1d];
          for (unsigned int i = 0; i < n_1d; ++i)
            weights[r * n_1d + i] += of_row * along[0][i];
        }
      for (unsigned int v = 0; v < n_hats; ++v)
        {
          double hat = part * volume;
          for (unsigned int a = 0; a < dim; ++a)
            hat *= v >> a & 1 ? x[a] : 1. - x[a];
          hats[v] += hat;
        }
    });
  }

  template class CubicWeights<2>;
  template class CubicWeights<3>;
} // namespace scree
