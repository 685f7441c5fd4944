// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_seeding_unit_weights_h
#define scree_seeding_unit_weights_h

#include <optional>
#include <string>

namespace scree
{
  /// Unit weights of a soil, and what else its subsection says of grains and pores.
  struct UnitWeights
  {
    double dry             = 0,     ///< N/m^3; 0: not given
        saturated          = 0;     ///< N/m^3; 0: not given
    double grain_density   = 0;     ///< kg/m^3, of the entry or its default
    bool has_grain_density = false; ///< whether the file has the entry
    std::optional<double> porosity; ///< of the entry or of the law
  };

  /// Density of the grains, kg/m^3, and volume of pores over total volume.
  struct GrainsAndPores
  {
    double grain_density, ///< kg/m^3
        porosity;         ///< -
  };

  /// The grains and pores that have these unit weights: dry (1 - n) rho_s g, saturated (1 - n) rho_s g + n rho_w g.
  /// Throws EntryError if there are none, or if they contradict another entry of the body.
  /// @param body name of the subsection
  /// @param gravity m/s^2
  /// @param water_density kg/m^3
  GrainsAndPores
  grains_and_pores(const std::string &body, const UnitWeights &given, const double gravity, const double water_density);
} // namespace scree

#endif
