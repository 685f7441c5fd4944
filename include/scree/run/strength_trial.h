// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_strength_trial_h
#define scree_run_strength_trial_h

#include <scree/io/run_folder.h>
#include <scree/model/scene.h>
#include <scree/run/step_control.h>

#include <deque>
#include <functional>

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
    explicit TrialJudge(const TrialBounds &bounds);

    /// Takes the state at a time, s, later than the last one.
    /// @param displacement m
    /// @param speed m/s
    TrialEnd look(const double time, const double displacement, const double speed);

  private:
    struct Look
    {
      double time, speed;
    };

    const TrialBounds bounds;
    std::deque<Look> last; // of the last time scale
  };

  /// A trial of the strength.
  struct Trial
  {
    TrialEnd end;             ///< how it ended
    double displacement;      ///< that 1 % of the soil's mass exceeds, m
    double time;              ///< s
    unsigned long long steps; ///< number of time steps
  };

  /// The bounds for a scene.
  /// @param displacement of soil that fails, over its height
  template <int dim>
  TrialBounds bounds_of_trial(const Scene<dim> &scene, const SafetyParameters &safety, const double displacement);

  /// Moves the soil with damping and the pore pressure held until it rests or fails, or the run is asked to stop, and
  /// logs how that went; then all is at rest.
  /// Displacements count from Scene::mark_start(). Collective.
  /// @param displacement of soil that fails, over its height
  /// @param scheme that `advance` steps with
  /// @param advance moves all by a step, s
  template <int dim>
  Trial try_strength(const Parameters &parameters,
                     const double displacement,
                     Scene<dim> &scene,
                     Scheme<dim> &scheme,
                     StepControl<dim> &control,
                     RunFolder &folder,
                     const std::function<void(double)> &advance);
} // namespace scree

#endif
