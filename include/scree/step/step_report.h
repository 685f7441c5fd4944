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

  /// Their names in the log.
  constexpr const char *names_of_parts[] = { "non-local strain",
                                             "points to grid",
                                             "nodes",
                                             "contact with the bed",
                                             "contact between bodies",
                                             "pressure: system",
                                             "pressure: solve",
                                             "grid to points, stress",
                                             "grid to water points",
                                             "sort into cells and ranks",
                                             "waiting for other ranks",
                                             "repartition",
                                             "output" };

  /// What the user reads.
  inline std::string name_of(const TimerSection part)
  {
    return names_of_parts[static_cast<unsigned int>(part)];
  }

  /// All parts, in the order in which they are reported.
  inline std::vector<TimerSection> step_parts()
  {
    std::vector<TimerSection> parts;
    for (unsigned int part = 0; part < std::size(names_of_parts); ++part)
      parts.push_back(static_cast<TimerSection>(part));
    return parts;
  }

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
  inline double seconds_of(const dealii::TimerOutput &timer, const TimerSection part)
  {
    const auto seconds = timer.get_summary_data(dealii::TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }

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
