// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_nor_sand_h
#define scree_material_nor_sand_h

#include <scree/material/law.h>

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// Entries of subsection "Nor-Sand". Defaults: Xie, Navas & Lopez-Querol 2024, Table 1, dense.
  struct NorSandParameters
  {
    double shear_modulus                  = 4e6;
    double swelling_index                 = 0.002;
    double compression_index              = 0.012;
    double critical_state_specific_volume = 1.88;
    double reference_pressure             = 1;
    double critical_stress_ratio          = 0.7097;
    double yield_constant                 = 0.3;
    double potential_constant             = 0.3;
    double hardening_coefficient          = 300;
    double dilatancy_multiplier           = -4.5;
    double initial_specific_volume        = 1.629;
    double initial_overconsolidation      = 1;
    double minimum_pressure               = 1;
    double substep_strain                 = 1e-3;

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws dealii::ExcMessage naming the entry if a combination is impossible.
    void check(const std::string &subsection) const;
  };
} // namespace scree

#endif
