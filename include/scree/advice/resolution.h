// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_resolution_h
#define scree_advice_resolution_h

#include <scree/advice/scene_numbers.h>
#include <scree/mesh/background_grid.h>
#include <scree/schemes/time_step.h>

#include <algorithm>
#include <string>

namespace scree
{
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
