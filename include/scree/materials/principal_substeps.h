// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_principal_substeps_h
#define scree_materials_principal_substeps_h

#include <scree/materials/batch_records.h>
#include <scree/materials/increment_parts.h>
#include <scree/materials/law.h>
#include <scree/tensor/hencky.h>

#include <algorithm>

namespace scree
{
  /// A batch of a law in principal values on its way through the parts of a straight path, F_k = I + k/n (dF - I) and
  /// f_k = F_k F_{k-1}^{-1}, as in HenckyMaterial.
  template <int dim, typename Law>
  class PrincipalSubsteps
  {
  public:
    static_assert(DependsOnVolume<Law>() && !HasInertialFriction<Law>(), "This path knows no rate.");

    using Mask    = simd::Mask<Batch>;                            ///< mask of a batch of points
    using Records = BatchRecords<dim, Law::n_internal_variables>; ///< state and motion of points
    using Input   = typename Records::Input;                      ///< of a batch

    static constexpr unsigned int n_components = n_symmetric_components<dim>; ///< components of a symmetric tensor
    static constexpr unsigned int n_internal   = Law::n_internal_variables;   ///< internal variables of a point

    /// The points `todo` from their states in `input`.
    /// @param largest_change of dF - I in one part
    /// @param report counts the returns that the law made point by point
    PrincipalSubsteps(const Law &law,
                      const Input &input,
                      const Mask &todo,
                      const double largest_change,
                      UpdateReport &report)
        : parts(
              input,
              simd::select<Batch>(todo, Records::largest_change_of(input) / largest_change, simd::broadcast<Batch>(1.)))
        , is_served(todo)
        , law(law)
        , volume_ratio(input.volume_ratio)
    {
      const Batch zero = simd::broadcast<Batch>(0.);
      std::copy_n(input.left_cauchy_green, n_components, left_cauchy_green);
      std::copy_n(input.internal_variables, n_internal, internal_variables);
      std::fill_n(stress, n_components, zero);
      dissipation = largest_bulk_modulus = largest_compression = zero;
      is_separated                                             = todo & !todo;
      for (unsigned int k = 0; simd::any(is_served & (k < parts.n)); ++k)
        advance(k, report);
    }

    const IncrementParts<dim> parts; ///< one return map each

    // The state in the end.
    Batch left_cauchy_green[n_components],  ///< elastic b_e
        stress[n_components],               ///< Cauchy stress, Pa
        internal_variables[n_internal + 1]; ///< in the order of the law
    Batch dissipation,                      ///< per reference volume, J/m^3
        largest_bulk_modulus,               ///< of all parts, Pa
        largest_compression;                ///< of all parts, Pa
    Mask is_separated,                      ///< whether grains are apart
        is_served;                          ///< the others could not follow, their states are of no use

  private:
    /// Part `k`.
    void advance(const unsigned int k, UpdateReport &report)
    {
      Batch trial[n_components], variables[n_internal + 1];
      parts.trial(k, left_cauchy_green, trial);
      const PrincipalFrame<dim, Batch> frame(trial);
      const PrincipalNumbers<Batch> trial_strain = log_strain(frame.values());
      PrincipalNumbers<Batch> strain             = trial_strain, kirchhoff_stress;
      std::copy_n(internal_variables, n_internal, variables);
      VolumeResponse<Batch> response = law.respond(strain, volume_ratio, variables, kirchhoff_stress);
      const Batch sum                = trial_strain[0] + trial_strain[1] + trial_strain[2];
      const Mask is_finite           = simd::abs<Batch>(sum) <= std::numeric_limits<double>::max();
      const Mask is_active           = k < parts.n;
      is_served                      = is_served & (is_finite | !is_active);
      if (const unsigned int left = simd::bits_of(is_served & is_active & response.is_left); left != 0)
        return_alone(left, trial_strain, response, strain, variables, kirchhoff_stress, report);
      take(frame, response, is_active, trial, trial_strain, strain, variables, kirchhoff_stress);
    }

    /// The lanes `left` by the law's return map for one point.
    __attribute__((noinline)) void return_alone(unsigned int left,
                                                const PrincipalNumbers<Batch> &trial_strain,
                                                VolumeResponse<Batch> &response,
                                                PrincipalNumbers<Batch> &strain,
                                                Batch *variables,
                                                PrincipalNumbers<Batch> &kirchhoff_stress,
                                                UpdateReport &report) const
    {
      for (; left != 0; left &= left - 1)
        {
          const unsigned int l = __builtin_ctz(left);
          PrincipalValues alone{ { trial_strain[0][l], trial_strain[1][l], trial_strain[2][l] } }, stress_of_it;
          double variables_of_it[n_internal + 1];
          for (unsigned int i = 0; i < n_internal; ++i)
            variables_of_it[i] = internal_variables[i][l];
          UpdateReport own;
          const Response found = law.return_map(alone, variables_of_it, volume_ratio[l], stress_of_it, own);
          for (unsigned int i = 0; i < 3; ++i)
            {
              strain[i][l]           = alone[i];
              kirchhoff_stress[i][l] = stress_of_it[i];
            }
          for (unsigned int i = 0; i < n_internal; ++i)
            variables[i][l] = variables_of_it[i];
          response.is_plastic[l]   = found == Response::plastic ? -1 : 0;
          response.is_separated[l] = own.n_separated > 0 ? -1 : 0;
          response.bulk_modulus[l] = own.largest_bulk_modulus;
          own.n_separated          = 0; // counts once, by the state in the end
          report.add(own);
        }
    }

    /// What the law made of the points `is_active`.
    void take(const PrincipalFrame<dim, Batch> &frame,
              const VolumeResponse<Batch> &response,
              const Mask &is_active,
              const Batch *trial,
              const PrincipalNumbers<Batch> &trial_strain,
              const PrincipalNumbers<Batch> &strain,
              const Batch *variables,
              const PrincipalNumbers<Batch> &kirchhoff_stress)
    {
      Batch returned[n_components], now[n_components];
      const Batch inverse = 1. / volume_ratio;
      left_cauchy_green_of(frame, strain, returned);
      frame.compose({ { inverse * kirchhoff_stress[0], inverse * kirchhoff_stress[1], inverse * kirchhoff_stress[2] } },
                    now);
      for (unsigned int c = 0; c < n_components; ++c)
        {
          const Batch b        = simd::select<Batch>(response.is_plastic, returned[c], trial[c]);
          left_cauchy_green[c] = simd::select<Batch>(is_active, b, left_cauchy_green[c]);
          stress[c]            = simd::select<Batch>(is_active, now[c], stress[c]);
        }
      for (unsigned int i = 0; i < n_internal; ++i)
        internal_variables[i] = simd::select<Batch>(is_active, variables[i], internal_variables[i]);

      Batch lost = simd::broadcast<Batch>(0.), compression = largest_compression;
      for (unsigned int i = 0; i < 3; ++i)
        {
          lost += kirchhoff_stress[i] * (trial_strain[i] - strain[i]);
          compression = simd::max<Batch>(-kirchhoff_stress[i], compression);
        }
      const Batch modulus  = simd::max<Batch>(response.bulk_modulus, largest_bulk_modulus);
      dissipation          = simd::select<Batch>(is_active & response.is_plastic, dissipation + lost, dissipation);
      largest_compression  = simd::select<Batch>(is_active, compression, largest_compression);
      largest_bulk_modulus = simd::select<Batch>(is_active, modulus, largest_bulk_modulus);
      is_separated         = (is_active & response.is_separated) | (is_separated & !is_active);
    }

    const Law &law;
    Batch volume_ratio; // J
  };
} // namespace scree

#endif
