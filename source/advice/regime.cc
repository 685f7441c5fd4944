// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/regime.h>
#include <scree/io/check_result.h>

#include <map>

namespace scree
{
  Regime regime_of(const SceneNumbers &scene)
  {
    if (!scene.has_water)
      return Regime::dry;
    if (!scene.has_soil)
      return Regime::free_water;
    const Groups groups = groups_of(scene);
    // Water outside, and that of soil that flows, moves on its own.
    if (groups.drainage < thresholds::drained_below && scene.is_elastic && scene.water_fills_soil)
      return Regime::drained;
    if (groups.drainage > thresholds::undrained_above && groups.time_factor < thresholds::consolidates_above)
      return Regime::undrained;
    return Regime::coupled;
  }


  std::string name_of(const Regime regime)
  {
    static const std::map<Regime, std::string> names{ { Regime::dry, "dry" },
                                                      { Regime::free_water, "water alone" },
                                                      { Regime::drained, "drained" },
                                                      { Regime::undrained, "undrained" },
                                                      { Regime::coupled, "coupled" } };
    return names.at(regime);
  }


  std::string reason_for(const Regime regime, const SceneNumbers &scene)
  {
    const Groups groups     = groups_of(scene);
    const std::string ratio = "drainage time over motion time is " + short_text(groups.drainage);
    switch (regime)
      {
      case Regime::dry:
        return "the case has no water";
      case Regime::free_water:
        return "the case has no soil that moves";
      case Regime::drained:
        return ratio + ", below " + short_text(thresholds::drained_below) +
               ": soil alone serves, of the saturated density and under water with its buoyant weight";
      case Regime::undrained:
        return ratio + ", above " + short_text(thresholds::undrained_above) + ", and T_v at the end " +
               short_text(groups.time_factor) + ", below " + short_text(thresholds::consolidates_above) +
               ": water hardly moves through the soil";
      default:
        if (groups.drainage > thresholds::undrained_above)
          return ratio + ", above " + short_text(thresholds::undrained_above) + ", but T_v at the end is " +
                 short_text(groups.time_factor) + ": pressure leaves during the run";
        if (groups.drainage < thresholds::drained_below)
          return ratio + ", below " + short_text(thresholds::drained_below) + ", but its water must move, too";
        return ratio + ", between " + short_text(thresholds::drained_below) + " and " +
               short_text(thresholds::undrained_above);
      }
  }


  PointSetChoice point_sets_for(const Regime regime, const SceneNumbers &scene)
  {
    constexpr double small_strain = 0.01;
    if (!scene.has_soil || !scene.water_fills_soil)
      return { PointSets::double_point, "there is water that is not in the soil's pores, or soil without" };
    if (scene.is_elastic && groups_of(scene).own_strain < small_strain)
      return { PointSets::single_point, "small motion: both agree, and single has half the points" };
    if (regime == Regime::undrained)
      return { PointSets::single_point, "water stays with its soil, whose points can carry it" };
    return { PointSets::double_point, "water leaves its soil; single-point water would not be conserved" };
  }
} // namespace scree
