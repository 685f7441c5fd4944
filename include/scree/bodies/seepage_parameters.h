// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_seepage_parameters_h
#define scree_bodies_seepage_parameters_h

#include <scree/bodies/water_parameters.h>

namespace scree
{
  /// What a body of soil does to water that flows through it, where it differs from what subsection Water says.
  struct SeepageParameters
  {
    double conductivity = 0; ///< m/s, at the initial porosity; 0: that of subsection Water

    /// Declares the entries in the body's subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations; `body` is the name of the subsection.
    /// @param water null in a dry scene
    void check(const std::string &body, const WaterParameters *water) const;

    /// The entries of subsection Water, with those of the body in their place.
    WaterParameters in_place_of(const WaterParameters &water) const;
  };
} // namespace scree

#endif
