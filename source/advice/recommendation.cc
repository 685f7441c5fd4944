// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/recommendation.h>
#include <scree/advice/scene_numbers.h>
#include <scree/io/progress.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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


  namespace
  {
    /// Of which scenes a law of convergence is, the first that applies.
    struct LawOfScenes
    {
      bool (*applies)(const SceneNumbers &scene);
      ErrorLaw law;
    };

    // Measured: doc/studies/pages/run_out.md (dry, against the extrapolated front),
    // saturated_slopes.md (against the run with H/h = 40); doc/verification/saturated_slopes.md: undrained heap in
    // total stress, Terzaghi's column at T_v = .1 with 20 cells, order 1.9 to 2.25, the dam break's tip at h = .1 and
    // .05 m.
    const LawOfScenes laws[] = {
      { [](const SceneNumbers &scene) { return !scene.has_soil; },
        { "of the water's tip",
          0.5,
          1.,
          "1.1 to 3.0 % at H/h = 20, against H/h = 80; the tip is then 12 % ahead of Martin & Moyce's experiment" } },
      { [](const SceneNumbers &scene) { return scene.is_elastic; },
        { "of stress and pressure", 0.33, 2., "0.03 to 0.08 % of the load at H/h = 20, Terzaghi's column" } },
      { [](const SceneNumbers &scene) { return !scene.falls(); },
        { "of the run-out", 3.8, 1., "", "its law is that of soil that falls and runs out" } },
      { [](const SceneNumbers &scene) { return scene.has_water && regime_of(scene) == Regime::undrained; },
        { "of the run-out",
          3.8,
          1.,
          "-5.5 % at H/h = 10 to +18.5 % at H/h = 80, undrained heap against total stress",
          "the front of undrained soil has not converged",
          "its error grows with finer cells. Compare three cell sizes, and report their range" } },
      { [](const SceneNumbers &scene) { return scene.has_water && scene.sticks; },
        { "of the run-out",
          3.8,
          1.,
          "13 to 24 % at H/h = 20, saturated loose slope on a fixed base against H/h = 40",
          "fronts of saturated slopes on such a base have not converged" } },
      { [](const SceneNumbers &scene) { return scene.has_water; },
        { "of the run-out",
          2.4,
          1.,
          "12 and 5 % of the way of the front of 90 % of the mass at H/h = 20 and 40 with TPIC, saturated loose slope "
          "on "
          "a base with friction, against the extrapolated front; extrapolated fronts of TPIC, FLIP and AFLIP differ by "
          "12 %; the front of 99 % has no limit" } },
      { [](const SceneNumbers &scene) {
         constexpr double least_grain= 0.005; // of the height; smaller ones hardly slow the flow
         return scene.grain_diameter > least_grain * scene.height;
       },
        { "of the run-out",
          1.2,
          1.,
          "2 to 10 % of the way of the front at H/h = 48 to 12, columns with inertial friction, d/H = 0.011, against "
          "the "
          "extrapolated front" } },
      { [](const SceneNumbers &scene) { return scene.sticks; },
        { "of the run-out",
          3.8,
          1.,
          "10 to 19 % of the way of the front at H/h = 20 on a base that holds the soil, against the extrapolated "
          "front",
          "",
          "the front then runs ahead of experiments, by 20 to 40 % of its way. Set Grain diameter, or give the base "
          "the "
          "friction of the soil" } },
      { [](const SceneNumbers &) { return true; },
        { "of the run-out",
          1.6,
          1.,
          "4 to 8 % of the way of the front of 90 % of the mass at H/h = 20 on a base with friction, against the "
          "extrapolated front; the front of 99 % up to 14 % from H/h = 28 to 40" } }
    };

    /// Why the law of elastic soil, measured where a constant load drains, does not decide; empty: it does.
    std::string gap_of_elastic_law(const SceneNumbers &scene)
    {
      constexpr double least_time_factor = 0.1;
      if (scene.has_changing_forces)
        return "its law is that of a constant load, and here a load changes with time, or there is a body force";
      if (!scene.has_water)
        return "its law is that of a load that drains, and there is no water";
      if (!scene.water_fills_soil)
        return "its law is that of saturated soil alone, and there is other water or soil without";
      if (groups_of(scene).time_factor < least_time_factor)
        return "its law begins at T_v = 0.1, after the end of this run";
      return "";
    }
  } // namespace


  ErrorLaw error_law_of(const SceneNumbers &scene)
  {
    ErrorLaw law =
        std::find_if(std::begin(laws), std::end(laws), [&](const auto &of) { return of.applies(scene); })->law;
    if (!scene.has_soil && !scene.falls())
      law.gap = "its law is that of water that falls and runs";
    else if (scene.has_soil && scene.is_elastic)
      law.gap = gap_of_elastic_law(scene);
    return law;
  }


  double cell_size_for(const GridParameters &grid, const double height, const double cells)
  {
    constexpr double fewest_cells = 10.;
    const double largest          = height / std::max(fewest_cells, cells);
    std::vector<double> lengths;
    for (unsigned int a = 0; a < grid.lower_corner.size(); ++a)
      lengths.push_back(grid.upper_corner[a] - grid.lower_corner[a]);
    const double shortest = *std::min_element(lengths.begin(), lengths.end());
    // The cell size at hand divides the box: at worst a whole part of it does.
    const double present = grid.cell_size;
    const unsigned int n = std::lround(shortest / present);
    for (unsigned int i = std::max(1., std::ceil(shortest / largest * (1. - 1e-9)));
         i <= n * std::ceil(present / largest);
         ++i)
      {
        const double size = shortest / i;
        if (std::all_of(lengths.begin(), lengths.end(), [&](const double length) {
              return std::abs(length / size - std::round(length / size)) < 1e-6;
            }))
          return size;
      }
    return present / std::ceil(present / largest);
  }


  TimeStepParameters time_step_for(const SceneNumbers &scene, TimeStepParameters present)
  {
    // Measured, doc/developer/development_log.md: Terzaghi's error is the same at Courant numbers 0.1 and 0.9; the dam
    // breaks ran with 0.04 s/m.
    constexpr double free_water_step_over_cell = 0.04; // s/m
    present.courant = scene.is_elastic && scene.has_water && scene.water_fills_soil ? "0.9" : "auto";
    present.choose(scene.has_water, scene.courant_of_transfer, scene.gravity, scene.cell_size);
    if (!scene.has_soil)
      present.maximum_time_step = free_water_step_over_cell * scene.cell_size;
    return present;
  }
} // namespace scree
