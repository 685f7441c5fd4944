// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_step_report_h
#define scree_step_step_report_h

#include <scree/materials/material.h>
#include <scree/step/budget.h>

#include <cmath>

namespace scree
{
  /// Speeds that limit the next step.
  struct Speeds
  {
    double wave   = 0; ///< largest of pressure waves in the soil, m/s
    double points = 0; ///< largest of a point of soil or water, m/s; not a number if any point's is not

    /// Takes in the speed of a pressure wave, m/s.
    void include_wave(const double speed)
    {
      wave = speed > wave ? speed : wave;
    }

    /// Takes in the speed of a point, m/s.
    void include_point(const double speed)
    {
      if (!(speed <= points) && !std::isnan(points))
        points = speed;
    }
  };

  /// What a step did, on this rank.
  template <int dim>
  struct StepReport
  {
    Budget<dim> balance;   ///< momentum and energy at the nodes
    UpdateReport material; ///< what the stress updates reported
    Speeds speeds;         ///< of the points at the end of the step
    double n_updates = 0;  ///< points of soil and water that moved
  };
} // namespace scree

#endif
