// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_step_report_h
#define scree_step_step_report_h

#include <scree/materials/material.h>
#include <scree/step/budget.h>

#include <deal.II/base/timer.h>

namespace scree
{
  /// The parts of a step whose time is reported.
  enum class TimerSection
  {
    nonlocal, ///< averages over space
    points_to_grid,
    nodes,
    bed,      ///< contact with it
    contacts, ///< of bodies
    pressure_system,
    pressure_solve,
    stress, ///< grid to soil points, and their law
    water_points,
    sort,
    waiting, ///< for the slowest rank
    repartition,
    output
  };

  /// What the user reads.
  std::string name_of(const TimerSection part);

  /// All parts, in the order in which they are reported.
  std::vector<TimerSection> step_parts();

  /// Adds the time from its construction to its end to a part.
  class TimedPart
  {
  public:
    /// Starts the timing of `part`.
    TimedPart(dealii::TimerOutput &timer, const TimerSection part)
        : scope(timer, name_of(part))
    {
    }

  private:
    dealii::TimerOutput::Scope scope;
  };

  /// Wall time of a part on this rank since the timer's reset, s.
  double seconds_of(const dealii::TimerOutput &timer, const TimerSection part);

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
