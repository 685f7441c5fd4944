// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_regime_h
#define scree_advice_regime_h

#include <scree/advice/groups.h>
#include <scree/points/water_parameters.h>

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

  /// Where the cheaper models begin to serve. First principles: of a load's excess pressure a fraction 0.8 exp(-pi^2/4)
  /// = 7 % is left one drainage time after it (Terzaghi 1943), and a fraction 2 sqrt(T_v) / sqrt(pi) of the
  /// consolidation has happened at a small time factor T_v.
  namespace thresholds
  {
    constexpr double drained_below      = 0.03;  ///< drainage time over motion time
    constexpr double undrained_above    = 30.;   ///< drainage time over motion time, and
    constexpr double consolidates_above = 0.003; ///< T_v at the end time (6 % consolidation): beyond it, not undrained
  }                                              // namespace thresholds

  Regime regime_of(const Scene &scene);

  std::string name_of(const Regime regime);

  /// The numbers behind regime_of(), as a sentence.
  std::string reason_for(const Regime regime, const Scene &scene);

  /// Whose points should carry the water, and why.
  struct PointSetChoice
  {
    PointSets sets;
    std::string reason;
  };
  PointSetChoice point_sets_for(const Regime regime, const Scene &scene);
} // namespace scree

#endif
