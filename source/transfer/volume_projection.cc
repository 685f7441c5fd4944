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

    /// Part of the slope that is kept of the volume change. Without it the change is too small at a surface, and soil
    /// that dilates flows too easily; all of it has patterns that the pore pressure does not see, and undrained soil
    /// gets stripes (doc/developer/development_log.md, "Projected F-bar").
    constexpr double slope_of_change = 0.15;

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
  void
  VolumeProjection<dim>::add(const SoilBody<dim> &body, const CellBlock<dim> &block, const BlockMotion<dim> &motion)
  {
    // The slots of cells lie one behind the other.
    const auto points = body.material_points(*block.begin);
    for_each_batch(block.n_points, [&](const BatchIndices &indices, const unsigned int) {
      const unsigned int p       = block.first + indices[0];
      const auto [square, trace] = elastic_square_under_stress(points, indices);
      const auto has_stress      = square > 0.;
      const Batch own = 0.5 * simd::log<Batch>(simd::select<Batch>(has_stress, square, simd::broadcast<Batch>(1.)));
      store(simd::select<Batch>(has_stress, own, simd::broadcast<Batch>(std::numeric_limits<double>::quiet_NaN())),
            &elastic_strain[p]);
      const Batch volume = simd::select<Batch>(has_stress, load(&motion.volume[p]), simd::broadcast<Batch>(0.));
      store(volume, &weight[p]);
      store(1. / 3. * trace * volume, &stress_volume[p]);
      Batch increment[dim * dim];
#pragma GCC unroll 9
      for (unsigned int c = 0; c < dim * dim; ++c)
        increment[c] = load(&motion.deformation_increment[c * motion.pitch + p]);
      store(shear_of<dim>(increment), &shear_of_step[p]);
    });
    block.for_each_cell([&](const CellPoints<dim> &cell, const unsigned int first) {
      compliance[first] = 1;
      if (own)
        {
          double volume = 0, pressure = 0;
          for (unsigned int p = first; p < first + cell.n_points; ++p)
            {
              volume += weight[p];
              pressure -= stress_volume[p];
            }
          const double bulk = body.material->initial_bulk_modulus(volume > 0 ? std::max(pressure / volume, 0.) : 0.);
          compliance[first] = 1. / body.material->wave_modulus(bulk);
        }
      add_cell(cell, first, motion, shared);
    });
  }


  template <int dim>
  void VolumeProjection<dim>::fit_changes(const CellBlock<dim> &cells, const BlockMotion<dim> &motion)
  {
    if (!own)
      return;
    own->clear();
    cells.for_each_cell(
        [&](const CellPoints<dim> &cell, const unsigned int first) { add_cell(cell, first, motion, *own); });
    fit(*own);
  }


  template <int dim>
  void VolumeProjection<dim>::add_cell(const CellPoints<dim> &cell,
                                       const unsigned int first,
                                       const BlockMotion<dim> &motion,
                                       Sums &sums)
  {
    std::array<VertexRow<dim>, n_sums> rows;
#pragma GCC unroll 16 // here and below, so that the rows are registers
    for (auto &row : rows)
      row = VertexRow<dim>{};
    for (unsigned int l = 0; l < cell.n_points; ++l)
      if (const unsigned int p = first + l; weight[p] > 0.)
        {
          const Point<dim> &x = cell.reference_location_of(l);
          std::array<VertexRow<dim>, n_terms> distance, terms; // the former from 1 on
          terms[0] = weight[p] * vertex_values(x);
#pragma GCC unroll 3
          for (unsigned int a = 0; a < dim; ++a)
            {
              distance[1 + a] = x[a] - on_faces<dim>(a, 0., 1.);
              terms[1 + a]    = terms[0] * distance[1 + a];
            }
#pragma GCC unroll 4
          for (unsigned int i = 0; i < n_terms; ++i)
            {
              rows[volume + i] += terms[i];
              rows[strain + i] += terms[i] * elastic_strain[p];
              rows[change + i] += terms[i] * (motion.volume_change[p] - 1.);
            }
          unsigned int k = n_terms;
#pragma GCC unroll 3
          for (unsigned int i = 1; i < n_terms; ++i)
#pragma GCC unroll 3
            for (unsigned int j = i; j < n_terms; ++j, ++k)
              rows[volume + k] += terms[i] * distance[j];
          rows[shear] += terms[0] * shear_of_step[p];
        }
    rows[plain_volume] = rows[volume];
    const double scale = compliance[first];
#pragma GCC unroll 16
    for (unsigned int k = volume; k < strain; ++k)
      rows[k] *= scale;
    rows[shear] *= scale;
    sums.activate_cell(cell.cell);
    const unsigned int *vertices = grid.vertices().nodes(cell.cell);
#pragma GCC unroll 4
    for (unsigned int k = 0; k < n_sums; k += 4)
      {
        simd::transpose_fours(&rows[k]);
#pragma GCC unroll 8
        for (unsigned int v = 0; v < n_vertices; ++v)
          add_row(load_row(reinterpret_cast<const double *>(&rows[k + v % 4]) + v / 4 * 4), sums[vertices[v]] + k);
      }
  }


  template <int dim>
  void VolumeProjection<dim>::fit(Sums &sums)
  {
    sums.add_contributions();
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    const auto &vertices     = sums.active_nodes();
    for_each_batch(vertices.size(), [&](const BatchIndices &indices, const unsigned int) {
      RecordPointers<double> records;
      Batch full; // volume of the box that a vertex sees, half of it at a face
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          const unsigned int vertex = vertices[indices[l]];
          records[l]                = apart(sums[vertex]);
          full[l]                   = cell_volume / (1u << __builtin_popcount(grid.vertices().faces(vertex)));
        }
      Batch sum[n_sums], result[n_fits];
      simd::load_records<n_sums>(as_constant(records), sum);
      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      const auto has_points = sum[volume] > 0.;
      const Batch scale     = 1. / simd::select<Batch>(has_points, sum[volume], one);
      const Batch lack      = simd::max<Batch>(1. - 2. / full * sum[plain_volume], zero);
      const Batch ridge     = least_variance + variance_of_few * lack * lack;

      Batch centre[dim], variance[dim * dim], inverse[dim * dim];
      for (unsigned int i = 0; i < dim; ++i)
        centre[i] = scale * sum[volume + 1 + i];
      for (unsigned int i = 0, k = n_terms; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j, ++k)
          variance[i * dim + j] = variance[j * dim + i] =
              scale * sum[volume + k] - centre[i] * centre[j] + (i == j ? ridge : zero);
      invert_rows<dim>(variance, inverse);

      const auto fit_linear = [&](const Batch *values, const Batch &factor, const double kept_slope, Batch *linear) {
        const Batch mean = scale * values[0];
        linear[0]        = factor * mean;
        for (unsigned int i = 0; i < dim; ++i)
          {
            Batch slope = zero;
            for (unsigned int j = 0; j < dim; ++j)
              slope += inverse[i * dim + j] * (scale * values[1 + j] - centre[j] * mean);
            linear[1 + i] = kept_slope * factor * slope;
            linear[0] -= linear[1 + i] * centre[i];
          }
      };
      result[relaxed] = 1. - simd::exp<Batch>(-relaxation * scale * sum[shear]);
      fit_linear(sum + change, one, slope_of_change, result + new_change);
      fit_linear(sum + strain, result[relaxed], 1., result + new_strain);
      simd::store_records<n_fits>(result, records);
    });
    sums.update_ghosts();
  }


  template <int dim>
  void VolumeProjection<dim>::apply(const CellPoints<dim> &cell, const unsigned int first, BlockMotion<dim> &motion)
  {
    const unsigned int *vertices = grid.vertices().nodes(cell.cell);
    const Sums &changes          = own ? *own : shared;
    const double modulus         = 1. / compliance[first];
    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const unsigned int p = first + indices[0];
      RecordPointers<const double> places;
      for (const unsigned int point : indices)
        cell.prefetch_after(point);
      for (unsigned int l = 0; l < batch_size; ++l)
        places[l] = apart(&cell.reference_location_of(indices[l])[0]);
      Batch x[dim];
      simd::load_records<dim>(places, x);

      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      const Batch strain_of_own = modulus * load(&elastic_strain[p]);
      const auto has_stress     = simd::first_lanes(n) & (strain_of_own == strain_of_own);
      Batch projected = simd::broadcast<Batch>(modulus), rest = zero;
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const double *of_change = &changes[vertices[v]][new_change], *of_strain = &shared[vertices[v]][relaxed];
          Batch psi = one, value = simd::broadcast<Batch>(of_change[0]),
                excess = of_strain[0] * strain_of_own - of_strain[1];
          for (unsigned int a = 0; a < dim; ++a)
            {
              const bool is_upper  = v >> a & 1;
              const Batch distance = is_upper ? x[a] - 1. : x[a];
              psi *= is_upper ? x[a] : 1. - x[a];
              value += of_change[1 + a] * distance;
              excess -= of_strain[2 + a] * distance;
            }
          projected += psi * value;
          rest += psi * excess;
        }
      const Batch change = simd::select<Batch>(simd::first_lanes(n), load(&motion.volume_change[p]), one);
      projected *= compliance[first];
      const Batch factor   = simd::exp<Batch>(simd::select<Batch>(has_stress, -compliance[first] * rest, zero));
      const Batch averaged = simd::select<Batch>(has_stress, projected * factor, change);
      work += simd::select<Batch>(has_stress, load(&stress_volume[p]) * (1. - projected / change), zero);
      const Batch scale = simd::cube_root<Batch>(averaged / change);
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
