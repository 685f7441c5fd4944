// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/f_bar.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using simd::load;
    using simd::store;
  } // namespace


  template <int dim>
  void
  apply_f_bar(const FBar kind, const unsigned int first, const MaterialPoints<dim> &points, BlockMotion<dim> &motion)
  {
    if (kind == FBar::none)
      return;
    const bool is_modified = kind == FBar::modified;
    double *volumes = &motion.volume[first], *changes = &motion.volume_change[first];
    double *ratios   = &motion.elastic_ratio[first];
    const Batch zero = simd::broadcast<Batch>(0.), one = simd::broadcast<Batch>(1.);
    Batch volume = zero, unloaded = zero;
    for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const Batch ratio = is_modified ? simd::sqrt<Batch>(elastic_square_under_stress(points, indices).first) : one;
      const auto is_averaged = simd::first_lanes(n) & (ratio > 0.);
      const Batch own        = load(volumes + indices[0]);
      volume += simd::select<Batch>(is_averaged, own * load(changes + indices[0]), zero);
      unloaded += simd::select<Batch>(is_averaged, own / ratio, zero);
      store(ratio, ratios + indices[0]);
    });
    const double mean = simd::sum_of_lanes(volume) / simd::sum_of_lanes(unloaded);
    for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const unsigned int p   = indices[0];
      const Batch ratio      = load(ratios + p);
      const auto is_averaged = simd::first_lanes(n) & (ratio > 0.);
      const Batch change     = simd::select<Batch>(simd::first_lanes(n), load(changes + p), one);
      const Batch averaged   = simd::select<Batch>(is_averaged, mean / ratio, change);
      const Batch scale      = simd::cube_root<Batch>(averaged / change);
      for (unsigned int c = 0; c < dim * dim; ++c)
        {
          double *component = &motion.deformation_increment[c * motion.pitch + first + p];
          store(scale * load(component), component);
        }
      store(scale, &motion.out_of_plane_stretch[first + p]);
      if (is_modified)
        store(averaged, changes + p);
    });
  }

  template decltype(apply_f_bar<2>) apply_f_bar<2>;
  template decltype(apply_f_bar<3>) apply_f_bar<3>;
} // namespace scree
