// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_batch_material_h
#define scree_materials_batch_material_h

#include <scree/materials/batch_records.h>
#include <scree/materials/batch_substeps.h>
#include <scree/materials/hencky_material.h>
#include <scree/simd/lane_rows.h>

#include <algorithm>
#include <array>

namespace scree
{
  /// A law in invariants (see law.h), several points at a time: all points elastically first, then those that have to
  /// return, from their trial states, and those that need sub-steps, so that the batches of either are full. What
  /// batches do not serve is left to HenckyMaterial, point by point: increments that it refuses, strain far from a
  /// sphere in three dimensions, returns for which Newton's method fails. Which way a point goes, and what comes out,
  /// does not depend on its neighbours.
  template <int dim, typename Law>
  class BatchMaterial : public HenckyMaterial<dim, Law>
  {
  public:
    /// Copies the law.
    explicit BatchMaterial(const Law &law)
        : HenckyMaterial<dim, Law>(law)
        , law(law)
        , response(law)
        , largest_change(law.substep_strain())
    {
    }

    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override
    {
      UpdateReport own;
      own.largest_bulk_modulus = report.largest_bulk_modulus; // so that few batches have larger ones
      own.largest_compression  = report.largest_compression;
      for (unsigned int first = 0; first < points.n_points; first += block_size)
        update_block(first, std::min(points.n_points - first, block_size), points, motion, own);
      own.n_updates = points.n_points;
      report.add(own);
    }

  private:
    using Mask       = simd::Mask<Batch>;
    using Records    = BatchRecords<dim, Law::n_internal_variables>;
    using Input      = typename Records::Input;
    using Return     = BatchReturn<dim, Law>;
    using TrialState = typename Return::TrialState;
    using Answer     = typename Return::Answer;

    static constexpr unsigned int n_components = n_symmetric_components<dim>;
    static constexpr unsigned int n_internal   = Law::n_internal_variables;
    static constexpr unsigned int block_size   = 128;

    /// Numbers of points.
    struct List
    {
      unsigned int size = 0;
      std::array<unsigned int, block_size> points;

      /// The points whose bits are set.
      void append(const BatchIndices &indices, unsigned int bits)
      {
        for (; bits != 0; bits &= bits - 1)
          points[size++] = indices[__builtin_ctz(bits)];
      }

      /// The points at these places in the list.
      BatchIndices named(BatchIndices places) const
      {
        for (unsigned int &place : places)
          place = points[place];
        return places;
      }
    };

    /// Points that have to return.
    struct Returns
    {
      List points;
      LaneRows<TrialState, block_size> states;
    };

    void update_block(const unsigned int first,
                      const unsigned int n_points,
                      const MaterialPoints<dim> &points,
                      const MaterialMotion<dim> &motion,
                      UpdateReport &report) const;

    /// Of points in a row: stores the elastic ones and lists the others.
    void update_elastic(const BatchIndices &indices,
                        const unsigned int n,
                        const MaterialPoints<dim> &points,
                        const MaterialMotion<dim> &motion,
                        Returns &returns,
                        List &in_substeps,
                        List &others,
                        UpdateReport &report) const;

    /// Stores what a return made of `n` points. Lists those that it does not serve.
    void store_returned(const BatchIndices &indices,
                        const unsigned int n,
                        const TrialState &state,
                        const Answer &answer,
                        const MaterialPoints<dim> &points,
                        List &others,
                        UpdateReport &report) const;

    /// The same after sub-steps.
    void store_advanced(const BatchIndices &indices,
                        const unsigned int n,
                        const BatchSubsteps<dim, Law> &path,
                        const Batch &reference_volume,
                        const MaterialPoints<dim> &points,
                        List &others,
                        UpdateReport &report) const;

    const Law law;
    const Return response;
    const double largest_change; // of dF - I in one return map
  };


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::update_block(const unsigned int first,
                                             const unsigned int n_points,
                                             const MaterialPoints<dim> &points,
                                             const MaterialMotion<dim> &motion,
                                             UpdateReport &report) const
  {
    Returns returns;
    List in_substeps, others;
    for_each_batch(n_points, [&](BatchIndices indices, const unsigned int n) {
      for (unsigned int &index : indices)
        index += first;
      update_elastic(indices, n, points, motion, returns, in_substeps, others, report);
    });
    for_each_pair(returns.points.size, [&](const BatchIndices(&places)[2], const unsigned int(&n)[2]) {
      TrialState states[2] = { returns.states.read(places[0][0]), returns.states.read(places[1][0]) };
      const Mask todo[2]   = { simd::first_lanes(n[0]), simd::first_lanes(n[1]) };
      Answer answers[2];
      response.respond(states, todo, answers);
      for (unsigned int h = 0; h < 2; ++h)
        store_returned(returns.points.named(places[h]), n[h], states[h], answers[h], points, others, report);
    });
    for_each_pair(in_substeps.size, [&](const BatchIndices(&places)[2], const unsigned int(&n)[2]) {
      const BatchIndices indices[2]     = { in_substeps.named(places[0]), in_substeps.named(places[1]) };
      const Input inputs[2]             = { Records::read(indices[0], 0, points, motion),
                                            Records::read(indices[1], 0, points, motion) };
      BatchSubsteps<dim, Law> halves[2] = { { law, response, inputs[0], largest_change },
                                            { law, response, inputs[1], largest_change } };
      BatchSubsteps<dim, Law>::advance(halves, report);
      for (unsigned int h = 0; h < 2; ++h)
        store_advanced(indices[h], n[h], halves[h], inputs[h].reference_volume, points, others, report);
    });
    for (unsigned int i = 0; i < others.size; ++i)
      this->update_point(others.points[i], points, motion, report);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::update_elastic(const BatchIndices &indices,
                                               const unsigned int n,
                                               const MaterialPoints<dim> &points,
                                               const MaterialMotion<dim> &motion,
                                               Returns &returns,
                                               List &in_substeps,
                                               List &others,
                                               UpdateReport &report) const
  {
    const unsigned int used = (1u << n) - 1;
    const Input input       = Records::read(indices, n, points, motion);
    const Mask is_possible  = Records::is_possible(input);
    const Batch change      = Records::largest_change_of(input);
    const Mask in_one_step  = change <= largest_change;
    Batch trial[n_components];
    trial_left_cauchy_green<dim>(input.increment, input.out_of_plane_stretch, input.left_cauchy_green, trial);
    const typename Return::Strain strain(trial);
    const auto state = law.trial(strain.volume, strain.square, input.volume_ratio, input.internal_variables);

    const Mask is_served  = is_possible & in_one_step & strain.is_valid;
    const Mask is_elastic = is_served & law.is_admissible(state);
    // As many sub-steps as the other way would take; its message covers more.
    const Mask is_cut = is_possible & !in_one_step & (change <= 1000. * largest_change);

    const unsigned int elastic = simd::bits_of(is_elastic) & used;
    const unsigned int plastic = simd::bits_of(is_served) & used & ~elastic;
    if (!Law::is_elastic && plastic != 0) // for the compiler: what may be kept is written to memory
      {
        TrialState kept{ strain, state, input.volume_ratio, input.reference_volume, {} };
        std::copy_n(input.internal_variables, n_internal, kept.internal_variables);
        returns.points.append(indices, plastic);
        returns.states.append(kept, plastic);
      }
    in_substeps.append(indices, simd::bits_of(is_cut) & used);
    others.append(indices, used & ~simd::bits_of(is_served | is_cut));
    if (elastic == 0)
      return;

    const Batch mean_stress = law.mean_stress(state), one = simd::broadcast<Batch>(1.);
    Batch stress[n_components];
    response.set_stress(strain, one, mean_stress, input.volume_ratio, stress);
    response.report_largest(strain, one, mean_stress, is_elastic, report);
    Records::template write<n_components>(trial, indices, elastic, points, points.left_cauchy_green);
    Records::template write<n_components>(stress, indices, elastic, points, points.stress);
    report.n_substeps += __builtin_popcount(elastic);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::store_returned(const BatchIndices &indices,
                                               const unsigned int n,
                                               const TrialState &state,
                                               const Answer &answer,
                                               const MaterialPoints<dim> &points,
                                               List &others,
                                               UpdateReport &report) const
  {
    const unsigned int used = (1u << n) - 1, stored = simd::bits_of(answer.is_plastic) & used;
    others.append(indices, used & ~stored);
    if (stored == 0)
      return;

    Batch b[n_components], stress[n_components];
    response.set_stress(state.strain, answer.deviator_factor, answer.mean_stress, state.volume_ratio, stress);
    state.strain.left_cauchy_green(answer.volume_strain, answer.deviator_factor, b);
    Records::template write<n_components>(b, indices, stored, points, points.left_cauchy_green);
    Records::template write<n_components>(stress, indices, stored, points, points.stress);
    Records::template write<n_internal>(state.internal_variables, indices, stored, points, points.internal_variables);

    response.report_largest(state.strain, answer.deviator_factor, answer.mean_stress, answer.is_plastic, report);
    report.n_separated += __builtin_popcount(simd::bits_of(answer.is_separated) & stored);
    report.n_substeps += __builtin_popcount(stored);
    report.plastic_dissipation += simd::sum_of_lanes<Batch>(state.reference_volume * answer.dissipation);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::store_advanced(const BatchIndices &indices,
                                               const unsigned int n,
                                               const BatchSubsteps<dim, Law> &path,
                                               const Batch &reference_volume,
                                               const MaterialPoints<dim> &points,
                                               List &others,
                                               UpdateReport &report) const
  {
    const unsigned int used = (1u << n) - 1, stored = simd::bits_of(path.is_served) & used;
    others.append(indices, used & ~stored);
    Records::template write<n_components>(path.left_cauchy_green, indices, stored, points, points.left_cauchy_green);
    Records::template write<n_components>(path.stress, indices, stored, points, points.stress);
    Records::template write<n_internal>(path.internal_variables, indices, stored, points, points.internal_variables);
    report.n_separated += __builtin_popcount(simd::bits_of(path.is_separated) & stored);
    for (unsigned int l = 0; l < batch_size; ++l)
      if (stored >> l & 1)
        {
          report.plastic_dissipation += reference_volume[l] * path.dissipation[l];
          report.n_substeps += static_cast<unsigned int>(path.parts.n[l]);
        }
  }
} // namespace scree

#endif
