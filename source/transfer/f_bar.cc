// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/f_bar.h>

#include <scree/simd/records.h>
#include <scree/tensor/matrix.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using simd::load;
    using simd::store;

    /// Reads b_e of points of the cell; returns where the records are.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline RecordPointers<double>
    read_left_cauchy_green(const MaterialPoints<dim> &points, const BatchIndices &indices, Batch *b)
    {
      RecordPointers<double> records;
      for (unsigned int l = 0; l < batch_size; ++l)
        records[l] = apart(points.left_cauchy_green + points.offset(indices[l]));
      simd::load_records<n_symmetric_components<dim>>(as_constant(records), b);
      return records;
    }


    /// Gives all points the cell's J_e = sum V / sum (V/J_e), with J_e^2 = det b_e.
    template <int dim>
    void average_elastic_volume_ratio(const double *volumes, const MaterialPoints<dim> &points)
    {
      if (points.n_points == 1)
        return;
      const Batch zero = simd::broadcast<Batch>(0.);
      Batch unloaded = zero, volume = zero, b[n_symmetric_components<dim>];
      for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
        read_left_cauchy_green(points, indices, b);
        const Batch own = simd::select<Batch>(simd::first_lanes(n), load(volumes + indices[0]), zero);
        unloaded += own / simd::sqrt<Batch>(determinant_of_components<dim>(b));
        volume += own;
      });
      const double ratio       = simd::sum_of_lanes(volume) / simd::sum_of_lanes(unloaded);
      const double determinant = ratio * ratio; // of b_e; b scales by the cube root of its change
      for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int) {
        const auto records = read_left_cauchy_green(points, indices, b);
        const Batch scale  = simd::cube_root<Batch>(determinant / determinant_of_components<dim>(b));
        for (Batch &component : b)
          component *= scale;
        simd::store_records<n_symmetric_components<dim>>(b, records);
      });
    }


    template <int dim>
    void average_volume_change(const FBar kind,
                               const unsigned int first,
                               const unsigned int n_points,
                               const double volume_factor,
                               BlockMotion<dim> &motion)
    {
      double *volumes = &motion.volume[first], *changes = &motion.volume_change[first];
      const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
      Batch weighted = zero, volume = zero;
      for_each_batch(n_points, [&](const BatchIndices &indices, const unsigned int n) {
        const auto used = simd::first_lanes(n);
        const Batch own = simd::select<Batch>(used, load(volumes + indices[0]), zero);
        weighted += own * simd::select<Batch>(used, load(changes + indices[0]), one);
        volume += own;
      });
      const double mean = volume_factor * simd::sum_of_lanes(weighted) / simd::sum_of_lanes(volume);
      for_each_batch(n_points, [&](const BatchIndices &indices, const unsigned int n) {
        const unsigned int p = indices[0];
        const Batch change   = simd::select<Batch>(simd::first_lanes(n), load(changes + p), mean * one);
        const Batch scale    = simd::cube_root<Batch>(mean / change);
        for (unsigned int c = 0; c < dim * dim; ++c)
          {
            double *component = &motion.deformation_increment[c * motion.pitch + first + p];
            store(scale * load(component), component);
          }
        store(scale, &motion.out_of_plane_stretch[first + p]);
        store(kind == FBar::modified ? mean * one : volume_factor * change, changes + p);
      });
    }
  } // namespace


  template <int dim>
  void apply_f_bar(const FBar kind,
                   const unsigned int first,
                   const MaterialPoints<dim> &points,
                   const double volume_factor,
                   BlockMotion<dim> &motion)
  {
    if (kind == FBar::none)
      return;
    if (kind == FBar::modified)
      average_elastic_volume_ratio(&motion.volume[first], points);
    average_volume_change(kind, first, points.n_points, volume_factor, motion);
  }

  template void apply_f_bar(const FBar, const unsigned int, const MaterialPoints<2> &, const double, BlockMotion<2> &);
  template void apply_f_bar(const FBar, const unsigned int, const MaterialPoints<3> &, const double, BlockMotion<3> &);
} // namespace scree
