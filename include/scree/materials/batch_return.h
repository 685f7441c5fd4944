// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_batch_return_h
#define scree_materials_batch_return_h

#include <scree/materials/law.h>
#include <scree/simd/pair.h>
#include <scree/tensor/elastic_strain.h>

#include <algorithm>

namespace scree
{
  /// The response of a law in invariants (see law.h) to the trial strain of batches.
  template <int dim, typename Law>
  class BatchReturn
  {
  public:
    using Mask   = simd::Mask<Batch>;                   ///< mask of a batch of points
    using Strain = ElasticStrain<dim, Batch>;           ///< elastic strain of a batch
    using Trial  = typename Law::template Trial<Batch>; ///< trial state of a batch, see law.h

    static constexpr unsigned int n_components = n_symmetric_components<dim>; ///< components of a symmetric tensor
    static constexpr unsigned int n_internal   = Law::n_internal_variables;   ///< internal variables of a point

    /// What a return starts from.
    struct TrialState
    {
      Strain strain;                            ///< trial elastic strain
      Trial trial;                              ///< trial state of the law
      Batch volume_ratio,                       ///< J at the end of the step
          reference_volume;                     ///< V_0, m^3
      Batch internal_variables[n_internal + 1]; ///< before the return, and then after it
    };

    /// What the law makes of it.
    struct Answer
    {
      Batch volume_strain, ///< elastic volume strain
          deviator_factor, ///< elastic deviatoric strain over the trial one
          mean_stress;     ///< mean Kirchhoff stress, Pa
      Batch dissipation;   ///< per reference volume, J/m^3
      Mask is_plastic,     ///< whether the point was returned
          is_separated;    ///< whether grains are apart: no stress, the gap is kept as strain
    };

    /// Copies the law.
    explicit BatchReturn(const Law &law)
        : law(law)
        , shear(law.shear_modulus())
    {
    }

    /// Returns the points `todo` of two batches, with their internal variables, if it can (`is_plastic`); of the others
    /// the trial strain stands. Two, because the steps of Newton's method wait for each other.
    void respond(TrialState (&states)[2], const Mask (&todo)[2], Answer (&answers)[2]) const;

    /// Cauchy stress of a mean Kirchhoff stress and a factor on the elastic deviator.
    void set_stress(const Strain &strain,
                    const Batch &factor,
                    const Batch &mean_stress,
                    const Batch &volume_ratio,
                    Batch *stress) const
    {
      const Batch inverse = 1. / volume_ratio, mean = mean_stress * inverse, slope = 2. * shear * factor * inverse;
      for (unsigned int c = 0; c < n_components; ++c)
        stress[c] = c < 3 ? mean + slope * strain.deviator[c] : slope * strain.deviator[c];
    }

    /// Raises the report's largest modulus and compression by the points `counted`.
    void report_largest(const Strain &strain,
                        const Batch &factor,
                        const Batch &mean_stress,
                        const Mask &counted,
                        UpdateReport &report) const;

  private:
    const Law law;
    const double shear; // Pa
  };


  template <int dim, typename Law>
  void BatchReturn<dim, Law>::respond(TrialState (&states)[2], const Mask (&todo)[2], Answer (&answers)[2]) const
  {
    const auto trial = simd::join<typename Law::template Trial<BatchPair>>(states[0].trial, states[1].trial);
    BatchPair internal[n_internal + 1];
    for (unsigned int i = 0; i < n_internal; ++i)
      internal[i] = { states[0].internal_variables[i], states[1].internal_variables[i] };
    InvariantReturn<BatchPair> returned{};
    const simd::PairMask is_plastic = law.return_to_surface(trial, { todo[0], todo[1] }, internal, returned);

    InvariantReturn<Batch> results[2];
    simd::split(returned, results[0], results[1]);
    for (unsigned int h = 0; h < 2; ++h)
      {
        const Strain &strain                = states[h].strain;
        const InvariantReturn<Batch> &found = results[h];
        const Mask plastic                  = h == 0 ? is_plastic.first : is_plastic.second;
        const Batch factor = simd::select<Batch>(plastic, found.deviator_factor, simd::broadcast<Batch>(1.));
        const Batch mean   = simd::select<Batch>(plastic, found.mean_stress, law.mean_stress(states[h].trial));
        const Batch volume = simd::select<Batch>(plastic, found.volume_strain, strain.volume);
        for (unsigned int i = 0; i < n_internal; ++i)
          states[h].internal_variables[i] = simd::select<Batch>(
              plastic, h == 0 ? internal[i].first : internal[i].second, states[h].internal_variables[i]);
        const Batch lost = mean * (strain.volume - volume) + 2. * shear * factor * (1. - factor) * strain.square;
        answers[h]       = { volume,  factor,
                             mean,    simd::select<Batch>(plastic, lost, simd::broadcast<Batch>(0.)),
                             plastic, plastic & found.is_separated };
      }
  }


  template <int dim, typename Law>
  void BatchReturn<dim, Law>::report_largest(const Strain &strain,
                                             const Batch &factor,
                                             const Batch &mean_stress,
                                             const Mask &counted,
                                             UpdateReport &report) const
  {
    const Batch zero    = simd::broadcast<Batch>(0.);
    const Batch modulus = simd::select<Batch>(counted, law.bulk_modulus_at(mean_stress), zero);
    if (simd::any(modulus > report.largest_bulk_modulus))
      report.largest_bulk_modulus = simd::largest_lane<Batch>(modulus);

    // The largest compression is rarely in a batch.
    const Batch slope   = 2. * shear * factor;
    const Mask is_large = counted & (-(mean_stress + slope * strain.bound_of_deviator()) > report.largest_compression);
    if (!simd::any(is_large))
      return;
    const Batch compression    = -(mean_stress + slope * strain.least_deviator());
    report.largest_compression = std::max(report.largest_compression,
                                          simd::largest_lane<Batch>(simd::select<Batch>(is_large, compression, zero)));
  }
} // namespace scree

#endif
