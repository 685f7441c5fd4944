// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/cell_basis.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A rule on the reference simplex, a batch of points at a time; the lanes left over have no weight.
    template <int dim>
    struct RuleBatches
    {
      struct Points
      {
        std::array<Batch, dim> place{};
        Batch weight{};
      };
      std::vector<Points> points;

      explicit RuleBatches(const Quadrature<dim> &rule)
          : points((rule.size() + batch_size - 1) / batch_size)
      {
        const double whole = std::accumulate(rule.get_weights().begin(), rule.get_weights().end(), 0.);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Points &of_batch = points[q / batch_size];
            for (unsigned int a = 0; a < dim; ++a)
              of_batch.place[a][q % batch_size] = rule.point(q)[a];
            of_batch.weight[q % batch_size] = rule.weight(q) / whole;
          }
      }
    };
  } // namespace


  template <int dim>
  CubicWeights<dim>::CubicWeights(const std::vector<Simplex<dim>> &simplices)
  {
    static_assert(n_1d == 4);
    // Cubics along all axes: degree 6, 9.
    static const RuleBatches<dim> rule(QWitherdenVincentSimplex<dim>(dim == 2 ? 4 : 5));
    const Along &p            = points();
    static const Along scales = [&] { // products of the cubics' factors without x: 1 at their own Gauss point
      Along result;
      for (unsigned int i = 0; i < n_1d; ++i)
        {
          result[i] = 1.;
          for (unsigned int j = 0; j < n_1d; ++j)
            if (j != i)
              result[i] /= p[i] - p[j];
        }
      return result;
    }();
    std::array<Batch, n_points> sums{};
    for (const Simplex<dim> &simplex : simplices)
      {
        const double volume        = volume_of(simplex);
        const Tensor<2, dim> edges = edges_of(simplex);
        fraction += volume;
        for (const auto &of_rule : rule.points)
          {
            std::array<std::array<Batch, n_1d>, dim> along; // Lagrange's cubics through the Gauss points, unscaled
            for (unsigned int a = 0; a < dim; ++a)
              {
                Batch x = of_rule.place[0] * edges[0][a] + simplex[0].place[a];
                for (unsigned int e = 1; e < dim; ++e)
                  x += of_rule.place[e] * edges[e][a];
                const Batch to[]   = { x - p[0], x - p[1], x - p[2], x - p[3] };
                const Batch to_low = to[0] * to[1], to_high = to[2] * to[3];
                along[a] = { { to[1] * to_high, to[0] * to_high, to_low * to[3], to_low * to[2] } };
              }
            const Batch part = of_rule.weight * volume;
            for (unsigned int r = 0; r < n_points / n_1d; ++r)
              {
                Batch of_row = part * along[1][r % n_1d];
                if constexpr (dim == 3)
                  of_row *= along[2][r / n_1d];
                for (unsigned int i = 0; i < n_1d; ++i)
                  sums[r * n_1d + i] += of_row * along[0][i];
              }
          }
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          weights[q] += sums[q][lane];
        Point<dim> x;
        for (unsigned int a = 0, rest = q; a < dim; ++a, rest /= n_1d)
          {
            weights[q] *= scales[rest % n_1d];
            x[a] = p[rest % n_1d];
          }
        for (unsigned int v = 0; v < n_hats; ++v)
          hats[v] += weights[q] * GeometryInfo<dim>::d_linear_shape_function(x, v);
      }
  }

  template class CubicWeights<2>;
  template class CubicWeights<3>;
} // namespace scree
