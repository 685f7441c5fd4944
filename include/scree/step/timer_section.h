// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_timer_section_h
#define scree_step_timer_section_h

#include <deal.II/base/timer.h>

#include <array>
#include <string>

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

  /// All of them, in the order in which they are reported.
  constexpr std::array<TimerSection, 13> step_parts{ { TimerSection::nonlocal,
                                                       TimerSection::points_to_grid,
                                                       TimerSection::nodes,
                                                       TimerSection::bed,
                                                       TimerSection::contacts,
                                                       TimerSection::pressure_system,
                                                       TimerSection::pressure_solve,
                                                       TimerSection::stress,
                                                       TimerSection::water_points,
                                                       TimerSection::sort,
                                                       TimerSection::waiting,
                                                       TimerSection::repartition,
                                                       TimerSection::output } };

  /// What the user reads.
  std::string name_of(const TimerSection part);

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
} // namespace scree

#endif
