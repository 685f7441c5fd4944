// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/tensor/matrix.h>
#include <scree/transfer/volume_projection.h>

#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using simd::load;
    using simd::store;

    /// k: shear of 1 % relaxes the elastic volume strain by the factor 1/e.
    constexpr double relaxation = 100.;

    /// Squares of cells added to the variance of the points' places, which is 1/6 where points fill the cells: always,
    /// and where points fill none of what a vertex sees, so that a few points set no slope.
    constexpr double least_variance = 0.002, variance_of_few = 0.2;

    /// sqrt(2) |dev E| with E = (dF^T dF - 1)/2, which is 0 for rotations.
    template <int dim>
    Batch shear_of(const Batch *increment)
    {
      Batch trace = simd::broadcast<Batch>(0.), square = trace;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            Batch product = increment[i] * increment[j];
            for (unsigned int m = 1; m < dim; ++m)
              product += increment[m * dim + i] * increment[m * dim + j];
            if (i == j)
              {
                product -= 1.;
                trace += product;
                square += product * product;
              }
            else
              square += 2. * product * product;
          }
      const Batch twice = 0.5 * (square - trace * trace * (1. / 3.));
      return simd::sqrt<Batch>(simd::max<Batch>(twice, simd::broadcast<Batch>(0.)));
    }
  } // namespace


  template <int dim>
  void VolumeProjection<dim>::add(const SoilBody<dim> &body,
                                  const CellPoints<dim> &cell,
                                  const unsigned int first,
                                  const BlockMotion<dim> &motion)
  {
    const auto points              = body.material_points(cell);
    VertexRow<dim> of_cell[n_sums] = {};
    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const unsigned int p  = first + indices[0];
      const Batch ratio     = elastic_ratio_under_stress(points, indices);
      const auto has_stress = ratio > 0.;
      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      const Batch own    = simd::log<Batch>(simd::select<Batch>(has_stress, ratio, one));
      const Batch weight = simd::select<Batch>(has_stress, load(&motion.volume[p]), zero);
      store(simd::select<Batch>(has_stress, own, simd::broadcast<Batch>(std::numeric_limits<double>::quiet_NaN())),
            &elastic_strain[p]);
      Batch increment[dim * dim];
      for (unsigned int c = 0; c < dim * dim; ++c)
        increment[c] = load(&motion.deformation_increment[c * motion.pitch + p]);
      const Batch own_change = load(&motion.volume_change[p]), own_shear = shear_of<dim>(increment);

      for (unsigned int l = 0; l < n; ++l)
        {
          const Point<dim> &x = cell.reference_location_of(indices[l]);
          std::array<VertexRow<dim>, dim> distance;
          for (unsigned int a = 0; a < dim; ++a)
            distance[a] = on_faces<dim>(a, x[a], x[a] - 1.);
          std::array<VertexRow<dim>, n_terms> weights;
          weights[0] = weight[l] * vertex_values(x);
          for (unsigned int a = 0; a < dim; ++a)
            weights[1 + a] = weights[0] * distance[a];
          for (unsigned int i = 0; i < n_terms; ++i)
            {
              of_cell[volume + i] += weights[i];
              of_cell[strain + i] += weights[i] * own[l];
            }
          for (unsigned int i = 0, k = n_terms; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j, ++k)
              of_cell[volume + k] += weights[1 + i] * distance[j];
          of_cell[change] += weights[0] * own_change[l];
          of_cell[shear] += weights[0] * own_shear[l];
        }
    });
    sums.activate_cell(cell.cell);
    const unsigned int *vertices = grid.vertices().nodes(cell.cell);
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        double *sum = sums[vertices[v]];
        for (unsigned int k = 0; k < n_sums; ++k)
          sum[k] += of_cell[k][v];
      }
  }


  template <int dim>
  void VolumeProjection<dim>::fit()
  {
    sums.add_contributions();
    const double full    = Utilities::fixed_power<dim>(grid.cell_size());
    const auto &vertices = sums.active_nodes();
    for_each_batch(vertices.size(), [&](const BatchIndices &indices, const unsigned int) {
      RecordPointers<double> records;
      for (unsigned int l = 0; l < batch_size; ++l)
        records[l] = apart(sums[vertices[indices[l]]]);
      Batch sum[n_sums], result[n_fits];
      simd::load_records<n_sums>(as_constant(records), sum);
      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      const auto has_points = sum[volume] > 0.;
      const Batch scale     = 1. / simd::select<Batch>(has_points, sum[volume], one);
      const Batch lack      = simd::max<Batch>(1. - 2. / full * sum[volume], zero);
      const Batch ridge     = least_variance + variance_of_few * lack * lack;

      const Batch mean = scale * sum[strain];
      Batch centre[dim], variance[dim * dim], covariance[dim], inverse[dim * dim];
      for (unsigned int i = 0; i < dim; ++i)
        {
          centre[i]     = scale * sum[volume + 1 + i];
          covariance[i] = scale * sum[strain + 1 + i] - centre[i] * mean;
        }
      for (unsigned int i = 0, k = n_terms; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j, ++k)
          variance[i * dim + j] = variance[j * dim + i] =
              scale * sum[volume + k] - centre[i] * centre[j] + (i == j ? ridge : zero);
      invert_rows<dim>(variance, inverse);

      const Batch part    = 1. - simd::exp<Batch>(-relaxation * scale * sum[shear]);
      result[mean_change] = simd::select<Batch>(has_points, scale * sum[change], one);
      result[relaxed]     = part;
      result[linear]      = mean;
      for (unsigned int i = 0; i < dim; ++i)
        {
          Batch slope = inverse[i * dim] * covariance[0];
          for (unsigned int j = 1; j < dim; ++j)
            slope += inverse[i * dim + j] * covariance[j];
          result[linear] -= slope * centre[i];
          result[linear + 1 + i] = part * slope;
        }
      result[linear] *= part;
      simd::store_records<n_fits>(result, records);
    });
    sums.update_ghosts();
  }


  template <int dim>
  void
  VolumeProjection<dim>::apply(const CellPoints<dim> &cell, const unsigned int first, BlockMotion<dim> &motion) const
  {
    const unsigned int *vertices = grid.vertices().nodes(cell.cell);
    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const unsigned int p = first + indices[0];
      RecordPointers<const double> places;
      for (unsigned int l = 0; l < batch_size; ++l)
        places[l] = apart(&cell.reference_location_of(indices[l])[0]);
      Batch x[dim];
      simd::load_records<dim>(places, x);

      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      const Batch own       = load(&elastic_strain[p]);
      const auto has_stress = simd::first_lanes(n) & (own == own);
      Batch projected = zero, rest = zero;
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const double *fits = sums[vertices[v]];
          Batch psi = one, excess = fits[relaxed] * own - fits[linear];
          for (unsigned int a = 0; a < dim; ++a)
            {
              const bool is_upper = v >> a & 1;
              psi *= is_upper ? x[a] : 1. - x[a];
              excess -= fits[linear + 1 + a] * (is_upper ? x[a] - 1. : x[a]);
            }
          projected += psi * fits[mean_change];
          rest += psi * excess;
        }
      const Batch change   = simd::select<Batch>(simd::first_lanes(n), load(&motion.volume_change[p]), one);
      const Batch factor   = simd::exp<Batch>(simd::select<Batch>(has_stress, -rest, zero));
      const Batch averaged = simd::select<Batch>(has_stress, projected * factor, change);
      const Batch scale    = simd::cube_root<Batch>(averaged / change);
      for (unsigned int c = 0; c < dim * dim; ++c)
        {
          double *component = &motion.deformation_increment[c * motion.pitch + p];
          store(scale * load(component), component);
        }
      store(scale, &motion.out_of_plane_stretch[p]);
      double *changes = &motion.volume_change[p];
      store(simd::select<Batch>(simd::first_lanes(n), averaged, load(changes)), changes);
    });
  }

  template class VolumeProjection<2>;
  template class VolumeProjection<3>;
} // namespace scree
