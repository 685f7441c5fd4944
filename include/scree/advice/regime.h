// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_regime_h
#define scree_advice_regime_h

#include <scree/advice/groups.h>
#include <scree/bodies/water_parameters.h>

#include <string>

namespace scree
{
  /// Which model a scene needs.
  enum class Regime
  {
    dry,        ///< there is no water
    free_water, ///< there is no soil
    drained, ///< excess pressure leaves as fast as it comes: soil on its own, with the hydrostatic pressure's buoyancy
    undrained, ///< water stays where it is in the soil: soil and water move as one
    coupled    ///< neither
  };

  /// Where the simpler models are within 5 % of soil and water, measured: doc/studies/pages/drained_or_coupled.md (columns that
  /// collapse in air and under water and that are loaded, until 4 sqrt(H/g)).
  namespace thresholds
  {
    /// Drainage time over motion time, of loads (0.54 to 0.7). In a collapse the drained model differs by 20 to 34 % in
    /// air and by 23 % or more under water, whatever the conductivity.
    constexpr double drained_below = 0.54;

    /// Drainage time over motion time, in all scenes (a collapse in air: 38 to 414, under water: 100, loads: 256 to
    /// 296).
    constexpr double undrained_above = 414.;

    /// T_v at the end, beyond which pressure leaves: that of the study's runs at the limit.
    constexpr double consolidates_above = 4. / undrained_above;
  } // namespace thresholds

  /// Finds the simplest model that is within 5 % in this scene, by the thresholds.
  Regime regime_of(const SceneNumbers &scene);

  /// Name of a regime as the report writes it.
  std::string name_of(const Regime regime);

  /// The numbers behind regime_of(), as a sentence.
  std::string reason_for(const Regime regime, const SceneNumbers &scene);

  /// Whose points should carry the water, and why.
  struct PointSetChoice
  {
    PointSets sets;     ///< recommended formulation
    std::string reason; ///< why, as a sentence
  };

  /// Recommends a formulation for a scene and its regime.
  PointSetChoice point_sets_for(const Regime regime, const SceneNumbers &scene);
} // namespace scree

#endif
