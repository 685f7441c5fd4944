// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_batch_material_h
#define scree_material_batch_material_h

#include <scree/material/hencky_material.h>
#include <scree/simd/records.h>
#include <scree/tensor/elastic_strain.h>

#include <algorithm>
#include <array>

namespace scree
{
  /// A law in invariants (see law.h), several points at a time: all points elastically first, then those that have to
  /// return or need sub-steps, so that the batches of either are full. What batches do not serve is left to
  /// HenckyMaterial, point by point: increments that it refuses, strain far from a sphere in three dimensions, returns
  /// for which Newton's method fails. Which way a point goes, and what comes out, does not depend on its neighbours.
  template <int dim, typename Law>
  class BatchMaterial : public HenckyMaterial<dim, Law>
  {
  public:
    explicit BatchMaterial(const Law &law)
        : HenckyMaterial<dim, Law>(law)
        , law(law)
        , shear(law.shear_modulus())
        , largest_change(law.substep_strain())
    {
    }

    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override
    {
      UpdateReport own;
      for (unsigned int first = 0; first < points.n_points; first += block_size)
        update_block(first, std::min(points.n_points - first, block_size), points, motion, own);
      own.n_updates = points.n_points;
      report.add(own);
    }

  private:
    using Mask = simd::Mask<Batch>;

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
    };

    /// What one batch reads.
    struct Input
    {
      Batch left_cauchy_green[n_components];
      Batch increment[dim * dim], out_of_plane_stretch; // dF
      Batch volume_ratio, reference_volume;
      Batch internal_variables[n_internal + 1];
    };

    /// What it computes.
    struct State
    {
      Batch left_cauchy_green[n_components], stress[n_components], internal_variables[n_internal + 1];
      Batch dissipation; // per reference volume, J/m^3
      Mask is_separated;
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
                        List &returns,
                        List &in_substeps,
                        List &others,
                        UpdateReport &report) const;

    /// Of any points: with return and sub-steps. Lists those that batches do not serve.
    void update_with_return(const BatchIndices &indices,
                            const unsigned int n,
                            const MaterialPoints<dim> &points,
                            const MaterialMotion<dim> &motion,
                            List &others,
                            UpdateReport &report) const;

    /// One increment f of the points `active`; those that cannot follow leave `served`.
    void advance(const Batch *f,
                 const Batch &out_of_plane_stretch,
                 const Batch &volume_ratio,
                 const Mask &active,
                 Mask &served,
                 State &state,
                 UpdateReport &report) const;

    /// Raises the report's largest modulus and compression by the points `counted`.
    void report_largest(const ElasticStrain<dim, Batch> &strain,
                        const Batch &factor,
                        const Batch &mean_stress,
                        const Mask &counted,
                        UpdateReport &report) const;

    /// Cauchy stress of a mean Kirchhoff stress and a factor on the elastic deviator.
    void set_stress(const ElasticStrain<dim, Batch> &strain,
                    const Batch &factor,
                    const Batch &mean_stress,
                    const Batch &volume_ratio,
                    Batch *stress) const
    {
      const Batch inverse = 1. / volume_ratio, mean = mean_stress * inverse, slope = 2. * shear * factor * inverse;
      for (unsigned int c = 0; c < n_components; ++c)
        stress[c] = c < 3 ? mean + slope * strain.deviator[c] : slope * strain.deviator[c];
    }

    Batch largest_change_of(const Input &input) const
    {
      Batch largest = dim == 2 ? simd::abs<Batch>(input.out_of_plane_stretch - 1.) : simd::broadcast<Batch>(0.);
      for (unsigned int i = 0; i < dim * dim; ++i)
        largest = simd::max<Batch>(largest,
                                   simd::abs<Batch>(i % (dim + 1) == 0 ? input.increment[i] - 1. : input.increment[i]));
      return largest;
    }

    /// Reads points, of which `n` in a row count, or any points if n = 0.
    static Input read(const BatchIndices &indices,
                      const unsigned int n,
                      const MaterialPoints<dim> &points,
                      const MaterialMotion<dim> &motion)
    {
      Input input;
      RecordPointers<const double> b, internal;
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          const std::size_t offset = points.offset(indices[l]);
          b[l]                     = apart(points.left_cauchy_green + offset);
          internal[l]              = apart(points.internal_variables + offset);
        }
      simd::load_records<n_components>(b, input.left_cauchy_green);
      simd::load_records<n_internal>(internal, input.internal_variables);

      const auto list = [&](const double *numbers) {
        if (n == batch_size)
          return simd::load(numbers + indices[0]);
        Batch batch;
        for (unsigned int l = 0; l < batch_size; ++l)
          batch[l] = numbers[indices[l]];
        return batch;
      };
      for (unsigned int c = 0; c < dim * dim; ++c)
        input.increment[c] = list(motion.deformation_increment + c * motion.pitch);
      input.volume_ratio         = list(motion.volume_ratio);
      input.reference_volume     = list(motion.reference_volume);
      input.out_of_plane_stretch = dim == 2 ? list(motion.out_of_plane_stretch) : simd::broadcast<Batch>(1.);
      return input;
    }

    /// Writes `n` batches into the points' records, those of lanes whose bits are not set into nothing.
    template <unsigned int n>
    static void write(const Batch *batches,
                      const BatchIndices &indices,
                      const unsigned int bits,
                      const MaterialPoints<dim> &points,
                      double *of_record_0)
    {
      if constexpr (n > 0)
        {
          double nothing[n];
          RecordPointers<double> records;
          for (unsigned int l = 0; l < batch_size; ++l)
            records[l] = apart(bits >> l & 1 ? of_record_0 + points.offset(indices[l]) : nothing);
          simd::store_records<n>(batches, records);
        }
    }

    const Law law;
    const double shear;          // Pa
    const double largest_change; // of dF - I in one return map
  };


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::update_block(const unsigned int first,
                                             const unsigned int n_points,
                                             const MaterialPoints<dim> &points,
                                             const MaterialMotion<dim> &motion,
                                             UpdateReport &report) const
  {
    List returns, in_substeps, others;
    for_each_batch(n_points, [&](BatchIndices indices, const unsigned int n) {
      for (unsigned int &index : indices)
        index += first;
      update_elastic(indices, n, points, motion, returns, in_substeps, others, report);
    });
    for (const List *list : { &returns, &in_substeps })
      for_each_batch(list->size, [&](BatchIndices indices, const unsigned int n) {
        for (unsigned int &index : indices)
          index = list->points[index];
        update_with_return(indices, n, points, motion, others, report);
      });
    for (unsigned int i = 0; i < others.size; ++i)
      this->update_point(others.points[i], points, motion, report);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::update_elastic(const BatchIndices &indices,
                                               const unsigned int n,
                                               const MaterialPoints<dim> &points,
                                               const MaterialMotion<dim> &motion,
                                               List &returns,
                                               List &in_substeps,
                                               List &others,
                                               UpdateReport &report) const
  {
    const unsigned int used = (1u << n) - 1;
    const Input input       = read(indices, n, points, motion);
    // Written such that not-a-number is refused, too.
    const Mask is_possible = (determinant_of_rows<dim>(input.increment) > 0.) & (input.volume_ratio > 0.) &
                             (input.out_of_plane_stretch > 0.);
    const Batch change     = largest_change_of(input);
    const Mask in_one_step = change <= largest_change;
    Batch trial[n_components];
    trial_left_cauchy_green<dim>(input.increment, input.out_of_plane_stretch, input.left_cauchy_green, trial);
    const ElasticStrain<dim, Batch> strain(trial);
    const auto state = law.trial(strain.volume, strain.square, input.volume_ratio, input.internal_variables);

    const Mask is_served  = is_possible & in_one_step & strain.is_valid;
    const Mask is_elastic = is_served & law.is_admissible(state);
    // As many sub-steps as the other way would take; its message tells of more.
    const Mask is_cut = is_possible & !in_one_step & (change <= 1000. * largest_change);

    const unsigned int elastic = simd::bits_of(is_elastic) & used;
    returns.append(indices, simd::bits_of(is_served) & used & ~elastic);
    in_substeps.append(indices, simd::bits_of(is_cut) & used);
    others.append(indices, used & ~simd::bits_of(is_served | is_cut));
    if (elastic == 0)
      return;

    const Batch mean_stress = law.mean_stress(state), one = simd::broadcast<Batch>(1.);
    Batch stress[n_components];
    set_stress(strain, one, mean_stress, input.volume_ratio, stress);
    report_largest(strain, one, mean_stress, is_elastic, report);
    write<n_components>(trial, indices, elastic, points, points.left_cauchy_green);
    write<n_components>(stress, indices, elastic, points, points.stress);
    report.n_substeps += __builtin_popcount(elastic);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::update_with_return(const BatchIndices &indices,
                                                   const unsigned int n,
                                                   const MaterialPoints<dim> &points,
                                                   const MaterialMotion<dim> &motion,
                                                   List &others,
                                                   UpdateReport &report) const
  {
    const unsigned int used = (1u << n) - 1;
    const Input input       = read(indices, 0, points, motion);
    State state{};
    std::copy_n(input.left_cauchy_green, n_components, state.left_cauchy_green);
    std::copy_n(input.internal_variables, n_internal, state.internal_variables);

    // Parts of a straight path, F_k = I + k/n (dF - I) and f_k = F_k F_{k-1}^{-1}, as in HenckyMaterial.
    Batch n_substeps = largest_change_of(input) * (1. / largest_change), change[dim * dim];
    for (unsigned int l = 0; l < batch_size; ++l)
      n_substeps[l] = std::max(std::ceil(n_substeps[l]), 1.);
    const Batch part = 1. / n_substeps, stretch_change = part * (input.out_of_plane_stretch - 1.);
    for (unsigned int i = 0; i < dim * dim; ++i)
      change[i] = i % (dim + 1) == 0 ? input.increment[i] - 1. : input.increment[i];

    Mask served = n_substeps == n_substeps;
    for (unsigned int k = 0; simd::any(served & (k < n_substeps)); ++k)
      {
        Batch before[dim * dim], inverse[dim * dim], f[dim * dim];
        for (unsigned int i = 0; i < dim * dim; ++i)
          before[i] = (k * part) * change[i] + (i % (dim + 1) == 0 ? 1. : 0.);
        invert_rows<dim>(before, inverse);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              f[i * dim + j] = simd::broadcast<Batch>(i == j ? 1. : 0.);
              for (unsigned int m = 0; m < dim; ++m)
                f[i * dim + j] += part * change[i * dim + m] * inverse[m * dim + j];
            }
        advance(f,
                1. + stretch_change / (1. + k * stretch_change),
                input.volume_ratio,
                k < n_substeps,
                served,
                state,
                report);
      }

    const unsigned int stored = simd::bits_of(served) & used;
    others.append(indices, used & ~stored);
    write<n_components>(state.left_cauchy_green, indices, stored, points, points.left_cauchy_green);
    write<n_components>(state.stress, indices, stored, points, points.stress);
    write<n_internal>(state.internal_variables, indices, stored, points, points.internal_variables);
    report.n_separated += __builtin_popcount(simd::bits_of(state.is_separated) & stored);
    for (unsigned int l = 0; l < batch_size; ++l)
      if (stored >> l & 1)
        {
          report.plastic_dissipation += input.reference_volume[l] * state.dissipation[l];
          report.n_substeps += static_cast<unsigned int>(n_substeps[l]);
        }
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::advance(const Batch *f,
                                        const Batch &out_of_plane_stretch,
                                        const Batch &volume_ratio,
                                        const Mask &active,
                                        Mask &served,
                                        State &state,
                                        UpdateReport &report) const
  {
    Batch b[n_components], stress[n_components], internal[n_internal + 1];
    trial_left_cauchy_green<dim>(f, out_of_plane_stretch, state.left_cauchy_green, b);
    const ElasticStrain<dim, Batch> strain(b);
    const auto trial = law.trial(strain.volume, strain.square, volume_ratio, state.internal_variables);

    const Mask is_elastic = law.is_admissible(trial);
    served                = served & (strain.is_valid | !active);
    InvariantReturn<Batch> result{};
    std::copy_n(state.internal_variables, n_internal, internal);
    const Mask todo = served & active & !is_elastic, is_plastic = law.return_to_surface(trial, todo, internal, result);
    served = served & (is_plastic | !todo);

    const Batch factor = simd::select<Batch>(is_plastic, result.deviator_factor, simd::broadcast<Batch>(1.));
    const Batch mean   = simd::select<Batch>(is_plastic, result.mean_stress, law.mean_stress(trial));
    const Batch volume = simd::select<Batch>(is_plastic, result.volume_strain, strain.volume);
    set_stress(strain, factor, mean, volume_ratio, stress);
    report_largest(strain, factor, mean, served & active, report);
    state.dissipation +=
        simd::select<Batch>(is_plastic,
                            mean * (strain.volume - volume) + 2. * shear * factor * (1. - factor) * strain.square,
                            simd::broadcast<Batch>(0.));
    if (simd::any(is_plastic))
      {
        Batch returned[n_components];
        strain.left_cauchy_green(volume, factor, returned);
        for (unsigned int c = 0; c < n_components; ++c)
          b[c] = simd::select<Batch>(is_plastic, returned[c], b[c]);
      }
    for (unsigned int c = 0; c < n_components; ++c)
      {
        state.left_cauchy_green[c] = simd::select<Batch>(active, b[c], state.left_cauchy_green[c]);
        state.stress[c]            = simd::select<Batch>(active, stress[c], state.stress[c]);
      }
    for (unsigned int i = 0; i < n_internal; ++i)
      state.internal_variables[i] = simd::select<Batch>(is_plastic, internal[i], state.internal_variables[i]);
    state.is_separated = (active & is_plastic & result.is_separated) | (state.is_separated & !active);
  }


  template <int dim, typename Law>
  void BatchMaterial<dim, Law>::report_largest(const ElasticStrain<dim, Batch> &strain,
                                               const Batch &factor,
                                               const Batch &mean_stress,
                                               const Mask &counted,
                                               UpdateReport &report) const
  {
    const Batch zero    = simd::broadcast<Batch>(0.);
    const Batch modulus = simd::select<Batch>(counted, law.bulk_modulus_at(mean_stress), zero);
    if (simd::any(modulus > report.largest_bulk_modulus))
      report.largest_bulk_modulus = simd::largest_lane<Batch>(modulus);

    // No principal value of a deviator is beyond sqrt(2/3) of its size: the largest compression is rarely in a batch.
    const Batch slope   = 2. * shear * factor;
    const Batch size    = simd::sqrt<Batch>(2. / 3. * strain.square);
    const auto is_large = counted & (slope * size - mean_stress > report.largest_compression);
    if (!simd::any(is_large))
      return;
    const Batch compression    = -(mean_stress + slope * strain.least_deviator());
    report.largest_compression = std::max(report.largest_compression,
                                          simd::largest_lane<Batch>(simd::select<Batch>(is_large, compression, zero)));
  }
} // namespace scree

#endif
