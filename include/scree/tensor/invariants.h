// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_invariants_h
#define scree_tensor_invariants_h

#include <scree/tensor/components.h>

#include <cmath>

namespace scree
{
  /// Mean effective stress p' = -tr(sigma)/3, Pa, compression positive, of n_symmetric_components<dim> stress
  /// components, Pa, tension positive.
  inline double mean_effective_stress(const double *stress)
  {
    return -(stress[0] + stress[1] + stress[2]) / 3.;
  }


  /// Deviatoric stress q = sqrt(3/2 s:s), Pa, with s = dev(sigma), of n_symmetric_components<dim> stress components,
  /// Pa.
  template <int dim>
  inline double deviatoric_stress(const double *stress)
  {
    const double pressure = mean_effective_stress(stress);
    double sum            = 0;
    for (unsigned int c = 0; c < 3; ++c)
      sum += (stress[c] + pressure) * (stress[c] + pressure);
    for (unsigned int c = 3; c < n_symmetric_components<dim>; ++c)
      sum += 2. * stress[c] * stress[c];
    return std::sqrt(1.5 * sum);
  }


  /// Stress ratio q/p', -, of n_symmetric_components<dim> stress components; 0 unless p' is positive.
  template <int dim>
  inline double stress_ratio(const double *stress)
  {
    const double pressure = mean_effective_stress(stress);
    return pressure > 0 ? deviatoric_stress<dim>(stress) / pressure : 0.;
  }


  /// The stress of a K0 state, Pa, tension positive: compressed by `vertical` along `axis` and by `k0` times that
  /// sideways. Writes the three normal components.
  inline void set_k0_components(const double vertical, const double k0, const unsigned int axis, double *stress)
  {
    for (unsigned int a = 0; a < 3; ++a)
      stress[a] = (a == axis ? 1. : k0) * -vertical;
  }
} // namespace scree

#endif
