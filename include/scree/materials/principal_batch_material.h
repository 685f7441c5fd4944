// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_principal_batch_material_h
#define scree_materials_principal_batch_material_h

#include <scree/materials/batch_records.h>
#include <scree/materials/hencky_material.h>
#include <scree/materials/principal_substeps.h>

#include <utility>

namespace scree
{
  /// A law in principal values (see law.h), several points at a time, elastic ones and others in one pass: a return
  /// that is a few linear equations costs less than to gather the points that need it. Increments that HenckyMaterial
  /// refuses are left to it, so that its messages name them. Those beyond the law's sub-step strain are gathered to
  /// full batches where the law depends on the volume, else left to it, too.
  template <int dim, typename Law>
  class PrincipalBatchMaterial : public HenckyMaterial<dim, Law>
  {
  public:
    /// Copies the law.
    explicit PrincipalBatchMaterial(const Law &law)
        : HenckyMaterial<dim, Law>(law)
        , law(law)
        , largest_change(law.substep_strain())
    {
    }

    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override
    {
      UpdateReport own;
      own.largest_bulk_modulus = report.largest_bulk_modulus; // so that few batches have larger ones
      own.largest_compression  = report.largest_compression;
      Gathered in_substeps;
      for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
        update_batch(indices, n, points, motion, in_substeps, own);
      });
      if constexpr (DependsOnVolume<Law>())
        update_in_substeps(in_substeps, points, motion, own);
      own.n_updates            = points.n_points;
      own.largest_bulk_modulus = std::max(own.largest_bulk_modulus, law.bulk_modulus(0));
      report.add(own);
    }

  private:
    using Mask    = simd::Mask<Batch>;
    using Records = BatchRecords<dim, Law::n_internal_variables>;

    static constexpr unsigned int n_components = n_symmetric_components<dim>;

    /// Points that wait until they fill a batch.
    struct Gathered
    {
      unsigned int size = 0;
      BatchIndices points{};
    };

    void update_batch(const BatchIndices &indices,
                      const unsigned int n,
                      const MaterialPoints<dim> &points,
                      const MaterialMotion<dim> &motion,
                      Gathered &in_substeps,
                      UpdateReport &report) const
    {
      typename Records::Input input = Records::read(indices, n, points, motion);
      Batch b[n_components], stress[n_components];
      trial_left_cauchy_green<dim>(input.increment, input.out_of_plane_stretch, input.left_cauchy_green, b);
      const PrincipalFrame<dim, Batch> frame(b);
      const PrincipalNumbers<Batch> trial_strain = log_strain(frame.values());

      const Mask is_finite =
          simd::abs<Batch>(trial_strain[0] + trial_strain[1] + trial_strain[2]) <= std::numeric_limits<double>::max();
      const Mask is_possible = Records::is_possible(input);
      const Batch change     = Records::largest_change_of(input);
      Mask is_served         = is_possible & is_finite & (change <= largest_change);

      PrincipalNumbers<Batch> strain = trial_strain, kirchhoff_stress;
      Batch before[Law::n_internal_variables + 1];
      std::copy_n(input.internal_variables, Law::n_internal_variables, before);
      const auto response     = respond(motion.time_step, strain, input, kirchhoff_stress, is_served, report);
      const unsigned int used = (1u << n) - 1, served = simd::bits_of(is_served) & used;
      const unsigned int plastic = simd::bits_of(response.is_plastic) & served;
      if (plastic != 0)
        {
          if constexpr (HasInertialFriction<Law>())
            if (law.inertial_friction.is_active())
              keep_part(trial_strain, before, response, motion, strain, input.internal_variables, kirchhoff_stress);
          Batch returned[n_components], dissipation = simd::broadcast<Batch>(0.);
          left_cauchy_green_of(frame, strain, returned);
          for (unsigned int c = 0; c < n_components; ++c)
            b[c] = simd::select<Batch>(response.is_plastic, returned[c], b[c]);
          for (unsigned int i = 0; i < 3; ++i)
            dissipation += kirchhoff_stress[i] * (trial_strain[i] - strain[i]);
          Records::template write<Law::n_internal_variables>(
              input.internal_variables, indices, plastic, points, points.internal_variables);
          report.plastic_dissipation +=
              simd::sum_of_lanes<Batch>(simd::select<Batch>(response.is_plastic & is_served & simd::first_lanes(n),
                                                            input.reference_volume * dissipation,
                                                            simd::broadcast<Batch>(0.)));
          const auto count = [&](const Mask &mask) { return __builtin_popcount(simd::bits_of(mask) & served); };
          report.n_vertices += count(response.is_vertex);
          report.n_separated += count(response.is_separated);
          report.n_unresolved += count(response.is_unresolved);
        }
      report.n_substeps += __builtin_popcount(served);
      report_largest_compression(kirchhoff_stress, is_served, report);

      const Batch inverse = 1. / input.volume_ratio;
      for (Batch &value : kirchhoff_stress)
        value *= inverse;
      frame.compose(kirchhoff_stress, stress);
      Records::template write<n_components>(b, indices, served, points, points.left_cauchy_green);
      Records::template write<n_components>(stress, indices, served, points, points.stress);

      // As many sub-steps as the other way would take; its message covers more.
      const Mask is_cut = is_possible & (change > largest_change) & (change <= 1000. * largest_change);
      update_others(indices, used & ~served, simd::bits_of(is_cut), points, motion, in_substeps, report);
    }

    /// Gathers the `others` whose bits are set in `cut`, and updates the rest point by point.
    void update_others(const BatchIndices &indices,
                       unsigned int others,
                       const unsigned int cut,
                       const MaterialPoints<dim> &points,
                       const MaterialMotion<dim> &motion,
                       Gathered &in_substeps,
                       UpdateReport &report) const
    {
      for (; others != 0; others &= others - 1)
        {
          const unsigned int lane = __builtin_ctz(others);
          if constexpr (DependsOnVolume<Law>())
            if (cut >> lane & 1)
              {
                in_substeps.points[in_substeps.size++] = indices[lane];
                if (in_substeps.size == batch_size)
                  update_in_substeps(in_substeps, points, motion, report);
                continue;
              }
          this->update_point(indices[lane], points, motion, report);
        }
    }

    /// The points that were gathered; none are left.
    void update_in_substeps(Gathered &gathered,
                            const MaterialPoints<dim> &points,
                            const MaterialMotion<dim> &motion,
                            UpdateReport &report) const
    {
      const unsigned int n = std::exchange(gathered.size, 0u);
      if (n == 0)
        return;
      BatchIndices indices = gathered.points;
      for (unsigned int l = n; l < batch_size; ++l)
        indices[l] = indices[0];
      const typename Records::Input input = Records::read(indices, 0, points, motion);
      const PrincipalSubsteps<dim, Law> path(law, input, simd::first_lanes(n), largest_change, report);

      const unsigned int used = (1u << n) - 1, served = simd::bits_of(path.is_served) & used;
      Records::template write<n_components>(path.left_cauchy_green, indices, served, points, points.left_cauchy_green);
      Records::template write<n_components>(path.stress, indices, served, points, points.stress);
      Records::template write<Law::n_internal_variables>(
          path.internal_variables, indices, served, points, points.internal_variables);
      report.n_separated += __builtin_popcount(simd::bits_of(path.is_separated) & served);
      for (unsigned int l = 0; l < n; ++l)
        if (served >> l & 1)
          {
            report.plastic_dissipation += input.reference_volume[l] * path.dissipation[l];
            report.n_substeps += static_cast<unsigned int>(path.parts.n[l]);
            report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, path.largest_bulk_modulus[l]);
            report.largest_compression  = std::max(report.largest_compression, path.largest_compression[l]);
          }
        else
          this->update_point(indices[l], points, motion, report);
    }

    /// The law's response; points that it leaves are no longer served.
    PrincipalResponse<Batch> respond(const double time_step,
                                     PrincipalNumbers<Batch> &strain,
                                     typename Records::Input &input,
                                     PrincipalNumbers<Batch> &stress,
                                     Mask &is_served,
                                     UpdateReport &report) const
    {
      if constexpr (DependsOnVolume<Law>())
        {
          const VolumeResponse<Batch> response =
              law.respond(strain, input.volume_ratio, input.internal_variables, stress);
          is_served           = is_served & !response.is_left;
          const Mask is_large = is_served & (response.bulk_modulus > report.largest_bulk_modulus);
          if (simd::any(is_large))
            report.largest_bulk_modulus = simd::largest_lane<Batch>(
                simd::select<Batch>(is_large, response.bulk_modulus, simd::broadcast<Batch>(0.)));
          return response;
        }
      else if constexpr (HasRateOfStrength<Law>())
        return law.respond(time_step, strain, input.internal_variables, stress);
      else
        return law.respond(strain, input.internal_variables, stress);
    }

    /// As HenckyMaterial::keep_part(), of the points that yield.
    void keep_part(const PrincipalNumbers<Batch> &trial,
                   const Batch *internal_variables_before,
                   const PrincipalResponse<Batch> &response,
                   const MaterialMotion<dim> &motion,
                   PrincipalNumbers<Batch> &strain,
                   Batch *internal_variables,
                   PrincipalNumbers<Batch> &stress) const
    {
      PrincipalNumbers<Batch> change;
      Batch volume = simd::broadcast<Batch>(0.), square = simd::broadcast<Batch>(0.);
      for (unsigned int i = 0; i < 3; ++i)
        {
          change[i] = trial[i] - strain[i];
          volume += change[i];
        }
      for (const Batch &value : change)
        square += (value - volume * (1. / 3.)) * (value - volume * (1. / 3.));
      Batch part = law.inertial_friction.template kept_part<Batch>(simd::sqrt<Batch>(2. * square),
                                                                   law.shear_modulus(),
                                                                   law.template friction_pressure<Batch>(stress),
                                                                   motion.grain_density,
                                                                   simd::broadcast<Batch>(motion.time_step));
      part       = simd::select<Batch>(response.is_plastic, part, simd::broadcast<Batch>(0.));
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] += part * change[i];
      for (unsigned int i = 0; i < Law::n_internal_variables; ++i)
        internal_variables[i] += part * (internal_variables_before[i] - internal_variables[i]);
      const PrincipalNumbers<Batch> kept = law.template stress_of<Batch>(strain);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i] = simd::select<Batch>(part > 0., kept[i], stress[i]);
    }

    static void
    report_largest_compression(const PrincipalNumbers<Batch> &stress, const Mask &counted, UpdateReport &report)
    {
      const Batch smallest = simd::min<Batch>(stress[0], simd::min<Batch>(stress[1], stress[2]));
      const Mask is_larger = counted & (-smallest > report.largest_compression);
      if (simd::any(is_larger))
        report.largest_compression =
            simd::largest_lane<Batch>(simd::select<Batch>(is_larger, -smallest, simd::broadcast<Batch>(0.)));
    }

    const Law law;
    const double largest_change; // of dF - I in one return map
  };
} // namespace scree

#endif
