// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_recommendation_h
#define scree_advice_recommendation_h

#include <scree/advice/scene_numbers.h>
#include <scree/bodies/water_parameters.h>
#include <scree/mesh/background_grid.h>
#include <scree/schemes/time_step.h>

#include <algorithm>
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

  /// Where the simpler models are within 5 % of soil and water, measured: doc/studies/pages/drained_or_coupled.md
  /// (columns that collapse in air and under water and that are loaded, until 4 sqrt(H/g)).
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

  /// A measured law of convergence: relative error = factor (h/H)^order, down to the resolution that carries motion and
  /// the smallest error that was measured. Of the run-out it is the largest error that was measured.
  struct ErrorLaw
  {
    std::string measure;     ///< what the error is of
    double factor;           ///< relative error at h = H
    double order;            ///< order of convergence
    std::string range  = ""; ///< errors that were measured, and against what
    std::string gap    = ""; ///< why the law does not decide this scene's error; empty: it does
    std::string remedy = ""; ///< why finer cells make it worse, and what to do; empty: they help

    static constexpr double smallest = 2e-4; ///< smallest relative error that was measured

    /// Relative error at H/h cells over the height.
    double error(const double cells_over_height) const
    {
      return std::max(smallest, factor * std::pow(cells_over_height, -order));
    }

    /// H/h for a relative error: the inverse of error().
    double cells_over_height(const double error) const
    {
      return std::pow(factor / error, 1. / order);
    }
  };

  /// The law of a scene's kind: run-out of plastic soil, elastic soil under a constant load, free water that falls. The
  /// run-out of undrained soil, and of soil with water on a base that holds it, has not converged. Other scenes have
  /// lengths of their own. Where there is no law, `gap` says why.
  ErrorLaw error_law_of(const SceneNumbers &scene);

  /// Largest cell size, m, that divides the box and gives at least `cells` (and ten, which the motion needs) over
  /// `height`, m.
  double cell_size_for(const GridParameters &grid, const double height, const double cells);

  /// The entries of subsection Time step that serve a scene, by measurement: the rest stays as it is.
  TimeStepParameters time_step_for(const SceneNumbers &scene, TimeStepParameters present);
} // namespace scree

#endif
