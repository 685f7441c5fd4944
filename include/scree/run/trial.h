// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_trial_h
#define scree_run_trial_h

#include <algorithm>
#include <limits>

namespace scree
{
  /// How a trial of the strength ends.
  enum class TrialEnd
  {
    undecided, ///< also where the run was asked to stop
    rests,
    fails
  };

  /// What the judgement of a trial goes by.
  struct TrialBounds
  {
    double time_scale;   ///< sqrt(height of the soil/gravity), s
    double speed;        ///< below which soil is at rest, m/s
    double displacement; ///< of soil that fails, m
    double maximum_time; ///< s
  };

  /// Judges from displacement and speed over time whether soil rests or fails.
  ///
  /// It fails where its displacement is beyond the bound, or where it does not rest in time. It rests once it has been
  /// slower than the bound of speed for a time scale.
  class TrialJudge
  {
  public:
    /// Keeps a copy of the bounds.
    explicit TrialJudge(const TrialBounds &bounds)
        : bounds(bounds)
    {
    }

    /// Takes the state at a time, s, later than the last one.
    /// @param displacement m
    /// @param speed m/s
    TrialEnd look(const double time, const double displacement, const double speed)
    {
      if (displacement > bounds.displacement)
        return TrialEnd::fails;
      slow_since = speed < bounds.speed ? std::min(slow_since, time) : std::numeric_limits<double>::infinity();
      if (slow_since <= time - bounds.time_scale)
        return TrialEnd::rests;
      return time >= bounds.maximum_time ? TrialEnd::fails : TrialEnd::undecided;
    }

  private:
    const TrialBounds bounds;
    double slow_since = std::numeric_limits<double>::infinity(); // s; infinite: the last look was at a fast state
  };

  /// A trial of the strength.
  struct Trial
  {
    TrialEnd end             = TrialEnd::undecided; ///< how it ended
    double displacement      = 0.;                  ///< that 1 % of the soil's mass exceeds, m
    double time              = 0.;                  ///< s
    unsigned long long steps = 0;                   ///< number of time steps
  };
} // namespace scree

#endif
