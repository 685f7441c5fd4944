// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_step_part_h
#define scree_scheme_step_part_h

#include <deal.II/base/timer.h>

#include <array>
#include <string>

namespace scree
{
  /// The parts of a step whose time is told.
  enum class StepPart
  {
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

  /// All of them, in the order in which they are told.
  constexpr std::array<StepPart, 12> step_parts{ { StepPart::points_to_grid,
                                                   StepPart::nodes,
                                                   StepPart::bed,
                                                   StepPart::contacts,
                                                   StepPart::pressure_system,
                                                   StepPart::pressure_solve,
                                                   StepPart::stress,
                                                   StepPart::water_points,
                                                   StepPart::sort,
                                                   StepPart::waiting,
                                                   StepPart::repartition,
                                                   StepPart::output } };

  /// What the user reads.
  std::string name_of(const StepPart part);

  /// Adds the time from its construction to its end to a part.
  class TimedPart
  {
  public:
    TimedPart(dealii::TimerOutput &timer, const StepPart part)
        : scope(timer, name_of(part))
    {
    }

  private:
    dealii::TimerOutput::Scope scope;
  };

  /// Wall time of a part on this rank since the timer's reset, s.
  double seconds_of(const dealii::TimerOutput &timer, const StepPart part);
} // namespace scree

#endif
