// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_batch_substeps_h
#define scree_materials_batch_substeps_h

#include <scree/materials/batch_records.h>
#include <scree/materials/batch_return.h>
#include <scree/materials/increment_parts.h>

#include <algorithm>

namespace scree
{
  /// A batch on its way through the parts of a straight path, F_k = I + k/n (dF - I) and f_k = F_k F_{k-1}^{-1}, as in
  /// HenckyMaterial.
  template <int dim, typename Law>
  class BatchSubsteps
  {
  public:
    using Mask       = simd::Mask<Batch>;                                            ///< mask of a batch of points
    using Return     = BatchReturn<dim, Law>;                                        ///< return map of the law
    using TrialState = typename Return::TrialState;                                  ///< start of a return map
    using Answer     = typename Return::Answer;                                      ///< result of a return map
    using Input      = typename BatchRecords<dim, Law::n_internal_variables>::Input; ///< state and motion over the step

    static constexpr unsigned int n_components = n_symmetric_components<dim>; ///< components of a symmetric tensor
    static constexpr unsigned int n_internal   = Law::n_internal_variables;   ///< internal variables of a point

    /// @param largest_change of dF - I in one part
    BatchSubsteps(const Law &law, const Return &answers, const Input &input, const double largest_change);

    /// The parts of two batches.
    static void advance(BatchSubsteps (&halves)[2], UpdateReport &report);

    const IncrementParts<dim> parts; ///< one return map each

    // The state in the end.
    Batch left_cauchy_green[n_components],  ///< elastic b_e
        stress[n_components],               ///< Cauchy stress, Pa
        internal_variables[n_internal + 1]; ///< in the order of the law
    Batch dissipation;                      ///< per reference volume, J/m^3
    Mask is_separated;                      ///< whether grains are apart: no stress, the gap is kept as strain
    Mask is_served;                         ///< the others could not follow, their states are of no use

  private:
    /// The trial state of part `k`, and which points have to return from it.
    Mask prepare(const unsigned int k, TrialState &trial);

    /// Takes what the law makes of it.
    void finish(const TrialState &trial, const Answer &answer, UpdateReport &report);

    const Law &law;
    const Return &returns;
    Batch volume_ratio, reference_volume;
    Batch trial_left_cauchy_green[n_components];
    Mask is_active, has_to_return; // in this part
  };


  template <int dim, typename Law>
  BatchSubsteps<dim, Law>::BatchSubsteps(const Law &law,
                                         const Return &returns,
                                         const Input &input,
                                         const double largest_change)
      : parts(input, BatchRecords<dim, n_internal>::largest_change_of(input) * (1. / largest_change))
      , dissipation(simd::broadcast<Batch>(0.))
      , is_separated{}
      , law(law)
      , returns(returns)
      , volume_ratio(input.volume_ratio)
      , reference_volume(input.reference_volume)
  {
    std::copy_n(input.left_cauchy_green, n_components, left_cauchy_green);
    std::copy_n(input.internal_variables, n_internal, internal_variables);
    std::fill_n(stress, n_components, simd::broadcast<Batch>(0.));

    is_served = parts.n == parts.n;
  }


  template <int dim, typename Law>
  void BatchSubsteps<dim, Law>::advance(BatchSubsteps (&halves)[2], UpdateReport &report)
  {
    const auto goes_on = [](const BatchSubsteps &half, const unsigned int k) {
      return simd::any(half.is_served & (k < half.parts.n));
    };
    for (unsigned int k = 0; goes_on(halves[0], k) || goes_on(halves[1], k); ++k)
      {
        TrialState trials[2];
        Answer answers[2];
        const Mask todo[2] = { halves[0].prepare(k, trials[0]), halves[1].prepare(k, trials[1]) };
        halves[0].returns.respond(trials, todo, answers);
        for (unsigned int h = 0; h < 2; ++h)
          halves[h].finish(trials[h], answers[h], report);
      }
  }


  template <int dim, typename Law>
  simd::Mask<Batch> BatchSubsteps<dim, Law>::prepare(const unsigned int k, TrialState &trial)
  {
    parts.trial(k, left_cauchy_green, trial_left_cauchy_green);
    trial.strain           = typename Return::Strain(trial_left_cauchy_green);
    trial.trial            = law.trial(trial.strain.volume, trial.strain.square, volume_ratio, internal_variables);
    trial.volume_ratio     = volume_ratio;
    trial.reference_volume = reference_volume;
    std::copy_n(internal_variables, n_internal, trial.internal_variables);

    is_active     = k < parts.n;
    is_served     = is_served & (trial.strain.is_valid | !is_active);
    has_to_return = is_served & is_active & !law.is_admissible(trial.trial);
    return has_to_return;
  }


  template <int dim, typename Law>
  void BatchSubsteps<dim, Law>::finish(const TrialState &trial, const Answer &answer, UpdateReport &report)
  {
    is_served = is_served & (answer.is_plastic | !has_to_return);
    returns.report_largest(trial.strain, answer.deviator_factor, answer.mean_stress, is_served & is_active, report);
    Batch b[n_components], now[n_components];
    returns.set_stress(trial.strain, answer.deviator_factor, answer.mean_stress, volume_ratio, now);
    std::copy_n(trial_left_cauchy_green, n_components, b);
    if (simd::any(answer.is_plastic))
      {
        Batch returned[n_components];
        trial.strain.left_cauchy_green(answer.volume_strain, answer.deviator_factor, returned);
        for (unsigned int c = 0; c < n_components; ++c)
          b[c] = simd::select<Batch>(answer.is_plastic, returned[c], b[c]);
      }
    for (unsigned int c = 0; c < n_components; ++c)
      {
        left_cauchy_green[c] = simd::select<Batch>(is_active, b[c], left_cauchy_green[c]);
        stress[c]            = simd::select<Batch>(is_active, now[c], stress[c]);
      }
    std::copy_n(trial.internal_variables, n_internal, internal_variables);
    dissipation += answer.dissipation;
    is_separated = (is_active & answer.is_separated) | (is_separated & !is_active);
  }
} // namespace scree

#endif
