// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_relaxation_h
#define scree_run_relaxation_h

#include <scree/run/step_control.h>

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

  /// Damped motion under gravity before the release, until the soil rests, a time is over, or the run is asked to stop.
  /// Displacements count from its start. All functions are collective.
  template <int dim>
  class Relaxation
  {
  public:
    /// All but `advance` are kept by reference.
    /// @param scheme that `advance` steps with
    /// @param advance moves all by a step, s
    Relaxation(const Parameters &parameters,
               Scene<dim> &scene,
               Scheme<dim> &scheme,
               StepControl<dim> &control,
               RunFolder &folder,
               const std::function<void(double)> &advance)
        : parameters(parameters)
        , scene(scene)
        , scheme(scheme)
        , control(control)
        , folder(folder)
        , advance(advance)
        , communicator(scene.grid.communicator())
        , gravity(scene.forcing.gravity().norm())
    {
      scene.mark_start();
    }

    /// With kinetic damping, behind a gate if there is one, as subsection Settling says; logs how it went.
    /// @return checks of the settled state; none if the run was asked to stop
    std::vector<CheckResult> settle();

    /// With viscous damping and the pore pressure held; records how it went.
    /// @param displacement of soil that fails, over the height of the slope
    Trial try_strength(const double displacement);

  private:
    /// Steps until `is_over`, which is asked every few steps and at the end. All is at rest and free then, unless the
    /// run was asked to stop.
    /// @param is_over of the clock and the length of the step before, s
    /// @return the clock
    TimeStepper relax(const double maximum_time,
                      const unsigned int steps_between_looks,
                      const std::function<bool(const TimeStepper &, double)> &is_over);

    std::vector<CheckResult> checks_of_settling(const double unbalanced_force);

    /// The displacement that 1 % of the mass exceeds, m.
    double displacement() const;

    const Parameters &parameters;
    Scene<dim> &scene;
    Scheme<dim> &scheme;
    StepControl<dim> &control;
    RunFolder &folder;
    const std::function<void(double)> advance;
    const MPI_Comm communicator;
    const double gravity; // m/s^2
  };
} // namespace scree

#endif
