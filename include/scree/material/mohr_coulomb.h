// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_mohr_coulomb_h
#define scree_material_mohr_coulomb_h

#include <scree/material/law.h>

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// Entries of subsection "Mohr-Coulomb"; angles in degrees.
  struct MohrCoulombParameters
  {
    double young_modulus   = 1e6;
    double poisson_ratio   = 0.3;
    double friction_angle  = 30;
    double dilation_angle  = 0;
    double cohesion        = 0;
    double tension_cut_off = 0;

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws dealii::ExcMessage naming the entry if a combination is impossible.
    void check(const std::string &subsection) const;
  };
} // namespace scree

#endif
