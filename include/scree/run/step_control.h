// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_step_control_h
#define scree_run_step_control_h

#include <scree/io/stop_requests.h>
#include <scree/model/scene.h>

namespace scree
{
  /// What the ranks agree on between two steps: the speeds that limit the next one, and whether to stop. Watches that
  /// the motion stays stable.
  template <int dim>
  class StepControl
  {
  public:
    /// All are kept by reference.
    StepControl(const Scene<dim> &scene,
                const TimeStepper &clock,
                StopRequests &stop,
                dealii::TimerOutput &timer,
                const MPI_Comm communicator)
        : scene(scene)
        , clock(clock)
        , stop(stop)
        , timer(timer)
        , communicator(communicator)
    {
    }

    /// Takes the speeds of the points as they are. Collective.
    void measure_speeds()
    {
      const Speeds of_rank = scene.speeds();
      std::vector<double> largest{ of_rank.wave, of_rank.points };
      agree_on(largest);
    }

    /// Takes the largest over ranks; the first two are speeds of waves and points, for the next step. Also agrees on
    /// whether to stop. Collective.
    void agree_on(std::vector<double> &largest);

    /// Of the points of all ranks.
    const Speeds &speeds_of_points() const
    {
      return speeds;
    }

    /// What limits the next step: of the points as they are, and of obstacles.
    Speeds limiting_speeds() const
    {
      Speeds all = speeds;
      for (const Obstacle<dim> &obstacle : scene.obstacles)
        all.include_point(obstacle.velocity_at(clock.time()).norm());
      return all;
    }

    /// Largest step, s, of the points as they are, by the run's clock.
    double stable_step() const
    {
      return stable_step(clock);
    }

    /// The same by another clock.
    double stable_step(const TimeStepper &other_clock) const
    {
      const Speeds all = limiting_speeds();
      return other_clock.stable_step(scene.grid.cell_size(), all.wave, all.points);
    }

    /// What makes it that large.
    StepLimit limit() const
    {
      return clock.limit(scene.grid.cell_size(), speeds.wave, speeds.points);
    }

    /// See TimeStepper::part_left().
    double part_left() const
    {
      return clock.part_left(scene.grid.cell_size(), speeds.wave, speeds.points);
    }

    /// Of all ranks.
    StopReason stop_reason() const
    {
      return reason;
    }

    /// Throw if the motion is unstable.
    void require_stable_step(const double largest_step, const double first_step) const;

    /// Throws if a point moves by two cells or more in a step, s.
    void require_stable_speed(const double time_step) const;

    /// Saves or loads the speeds of the last step (Boost).
    template <class Archive>
    void serialize(Archive &archive)
    {
      archive &speeds.wave &speeds.points;
    }

  private:
    const Scene<dim> &scene;
    const TimeStepper &clock;
    StopRequests &stop;
    dealii::TimerOutput &timer;
    const MPI_Comm communicator;
    Speeds speeds;                        // of all ranks
    StopReason reason = StopReason::none; // of all ranks
  };

  /// Keeps the points in fine cells. Depends on the state of the run only, so that a resumed run does it in the same
  /// step.
  template <int dim>
  class MeshAdaptation
  {
  public:
    /// Scene, scheme and timer are kept by reference.
    MeshAdaptation(Scene<dim> &scene, Scheme<dim> &scheme, dealii::TimerOutput &timer, const MPI_Comm communicator)
        : scene(scene)
        , scheme(scheme)
        , timer(timer)
        , communicator(communicator)
    {
    }

    /// Makes cells fine around the points as they are, and where they go to, once a point has come to the edge of the
    /// fine cells. Collective.
    /// @param reinit fits scene and scheme to the new mesh
    void follow_points(const double time_step, const std::function<void()> &reinit);

    /// A point of some rank has come to the edge of the fine cells. To be called on all ranks.
    void set_points_at_edge()
    {
      points_at_edge = true;
    }

    /// Looks whether that is so. Collective.
    void look_at_points()
    {
      points_at_edge = are_points_at_edge() || points_at_edge;
    }

    /// Logs how often cells were made fine, and how many there are. Collective.
    void summarise(RunFolder &folder) const
    {
      if (scene.grid.follows_points())
        folder.record(
            "fine cells at the end: " +
            number_text(dealii::Utilities::MPI::sum(double(scene.grid.fine_cells().n_owned()), communicator)) +
            "; they followed the points " + std::to_string(n_refinements) + " times, which took " +
            number_text(seconds_of(timer, TimerSection::repartition)) + " s");
    }

  private:
    /// The blocks that are to be fine, of all ranks: around the points and on their way. Collective.
    Blocks blocks_ahead(const double time_step) const;

    /// Whether a point of any rank has come to the edge of the fine cells. Collective.
    bool are_points_at_edge() const
    {
      const auto sets = scheme.point_sets();
      const bool own  = std::any_of(sets.begin(), sets.end(), [](const auto *points) { return points->is_at_edge(); });
      return dealii::Utilities::MPI::max(int(own), communicator) == 1;
    }

    Scene<dim> &scene;
    Scheme<dim> &scheme;
    dealii::TimerOutput &timer;
    const MPI_Comm communicator;
    bool points_at_edge        = false; // of any rank
    unsigned int n_refinements = 0;     // that followed the points
  };

  /// Adds what left the box through open walls to `totals`, and clears it. Throws if a point left through a closed
  /// one.
  /// @param time s, for the message
  template <int dim>
  void account_for_lost_points(Scene<dim> &scene, RunBalance<dim> &totals, const double time);
} // namespace scree

#endif
