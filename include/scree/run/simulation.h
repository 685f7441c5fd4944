// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_simulation_h
#define scree_run_simulation_h

#include <scree/io/stop_requests.h>
#include <scree/mesh/partition.h>
#include <scree/run/results.h>

namespace scree
{
  /// How a run begins.
  enum class Start
  {
    fresh,
    resume,   ///< from the newest checkpoint in the run folder
    new_stage ///< from the same, which is of the end of the stage before
  };

  /// How a run ends.
  enum class End
  {
    complete, ///< at its end time
    stopped   ///< before, as it was asked to
  };

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
    bool has_moved           = false;               ///< whether this is beyond the displacement of soil that fails
    double time              = 0.;                  ///< s
    unsigned long long steps = 0;                   ///< number of time steps
    std::string zone;                               ///< where the soil has moved, in words; empty if it rests
  };

  /// A run: a scene, the scheme that moves it, and its output. The top-level class of a run; `--safety` and `--advise`
  /// make runs of their own.
  template <int dim>
  class Simulation
  {
  public:
    /// Throws InputError or dealii exceptions if the parameters do not make a run.
    Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator)
        : parameters(parameters)
        , start(start)
        , communicator(communicator)
        , folder(parameters.output_directory, parameters.output.screen_kind() == Screen::progress, communicator)
        , stop(folder.is_writer() ? folder.file("terminate") : "", parameters.output.wall_time_limit)
        , timer(std::cout, dealii::TimerOutput::never, dealii::TimerOutput::wall_times)
        , scene(parameters, communicator)
        , scheme(scene.make_scheme(timer))
        , partition(scene.grid, scheme->point_sets())
        , clock(parameters.time_step)
        , output_times(parameters.output, parameters.end_time)
        , results(scene, *scheme, folder)
        , totals(scene.obstacles.size())
    {
      if (start == Start::fresh)
        initialise();
      else
        resume();
      if (start == Start::new_stage)
        begin_stage();
    }

    /// From the start to the end time, with all output; or to a request to stop (StopRequests), with a checkpoint
    /// unless the soil was still settling.
    End run();

    /// Moves all by `time_step` s.
    void advance(const double time_step);

    /// Largest step, s, of the points as they are.
    double stable_step() const
    {
      return stable_step(clock);
    }

    /// Whether no settling at the start was stopped.
    bool is_settled() const
    {
      return is_released;
    }

    /// Motion from the state as it is with viscous damping and the pore pressure held, until the soil rests or fails;
    /// then it is stopped. Records how it went. Collective.
    /// @param displacement of soil that fails, over the height of the slope
    Trial try_strength(const double displacement);

    /// Writes a checkpoint of the state as it is, to the end. Collective.
    void write_checkpoint()
    {
      results.writer().finish();
      if (step_of_checkpoint != clock.step()) // or else it was due
        begin_checkpoint();
      results.writer().finish();
    }

    /// Writes what is due of the state as it is. Collective.
    void report(const bool at_start = false)
    {
      const TimedPart part(timer, TimerSection::output);
      results.report(state(), output_times, at_start || clock.step() == 0);
      if (output_times.checkpoint_is_due(clock.time()))
        begin_checkpoint();
      output_times.begin(clock.time());
      if (is_at_end())
        results.writer().finish();
      stop.allow_for(results.writer().longest());
    }

    /// One step of the run, of `largest_step` s and to the time `due`, s, at most.
    /// @return its length, s
    double step(const double largest_step, const double due)
    {
      last_time_step = clock.next_step(largest_step, due);
      advance(last_time_step);
      clock.advance(last_time_step, due);
      return last_time_step;
    }

    /// Output of the state as it is. Collective.
    void write_row()
    {
      results.write_row(state());
    }

    /// Pictures, lines and maps of the state as it is, to the end. Collective.
    void write_picture()
    {
      results.write_picture(state());
      results.writer().finish();
    }

    /// What it moves: mesh, bodies of soil and water with the points of this rank, bed.
    const Scene<dim> &state_of_scene() const
    {
      return scene;
    }

    /// What limits the next step: of the points as they are, and of obstacles.
    Speeds limiting_speeds() const
    {
      Speeds all = speeds;
      for (const Obstacle<dim> &obstacle : scene.obstacles)
        all.include_point(obstacle.velocity_at(clock.time()).norm());
      return all;
    }

    /// Wall time of the parts of the steps so far.
    const dealii::TimerOutput &times_of_parts() const
    {
      return timer;
    }

    /// Time at the end of the last step, s.
    double time() const
    {
      return clock.time();
    }

    /// End of the run, s.
    double end_time() const
    {
      return parameters.end_time;
    }

    /// Whether the end of the run is reached, within rounding.
    bool is_at_end() const
    {
      return output_times.is_end(clock.time());
    }

    /// All sets of points, in a fixed order.
    std::vector<PointSet<dim> *> point_sets()
    {
      return scheme->point_sets();
    }

  private:
    void initialise();
    void resume();

    /// Removes and adds what the stage does; the soil settles if the case says so. Balances begin anew. Collective.
    void begin_stage();
    double stable_step(const TimeStepper &by_clock) const
    {
      const Speeds all = limiting_speeds();
      return by_clock.stable_step(scene.grid.cell_size(), all.wave, all.points);
    }

    /// Motion before the release with kinetic damping, behind a gate if there is one, as subsection Settling says; logs
    /// how it went. Collective.
    void settle();

    /// Damped motion under gravity until `is_over`, which is asked every few steps and at the end, a time, s, is over,
    /// or the run is asked to stop. All is at rest and free then, but for a request to stop. Displacements count from
    /// its start. Collective.
    /// @param is_over of the clock and the length of the step before, s
    /// @return the clock
    TimeStepper relax(const double maximum_time,
                      const unsigned int steps_between_looks,
                      const std::function<bool(const TimeStepper &, double)> &is_over);

    /// All sums begin anew, but for what was lost, removed and added.
    void begin_balances();

    std::vector<CheckResult> checks_of_settling(const double unbalanced_force) const;

    /// The displacement that 1 % of the mass exceeds, m. Collective.
    double displacement() const;

    /// Fits scene and scheme to a new partition of the mesh.
    void reinit()
    {
      scene.reinit();
      scheme->reinit();
      scheme->read_points();
    }

    /// Repartitions the mesh, if that is due and worthwhile.
    void repartition()
    {
      if (!partition.is_worth_changing())
        return;
      const TimedPart part(timer, TimerSection::repartition);
      partition.repartition();
      reinit();
    }

    /// Makes cells fine around the points as they are, and where they go to, once a point has come to the edge of the
    /// fine cells. It depends on the state of the run only, so that a resumed run does it in the same step. Collective.
    void follow_points(const double time_step);

    /// The blocks that are to be fine, of all ranks: around the points and on their way. Collective.
    Blocks blocks_ahead(const double time_step) const;

    /// Whether a point of any rank has come to the edge of the fine cells. Collective.
    bool are_points_at_edge() const
    {
      const auto sets = scheme->point_sets();
      const bool own  = std::any_of(sets.begin(), sets.end(), [](const auto *points) { return points->is_at_edge(); });
      return dealii::Utilities::MPI::max(int(own), communicator) == 1;
    }

    /// Moves on what the scene moves by itself, and puts in what enters.
    void end_step(const double time_step)
    {
      const std::unique_ptr<WaterView<dim>> water = scene.is_fed() ? scheme->water_view() : nullptr;
      scene.let_in(clock.time(), time_step, water ? water->pressure_of_cell : PressureOfCell<dim>(), totals);
      if (scene.rigid_ground && scene.rigid_ground->moves()) // then the cut cells follow it
        {
          const TimedPart part(timer, TimerSection::bed);
          scene.cut_cells->follow();
          scheme->follow_ground();
        }
    }

    /// After a step: the points to the cells and ranks they are in now, and the speeds of all ranks for the next step.
    /// Watches the balances. Collective.
    void place_points(const double time_step, const StepReport<dim> &step);

    /// Takes the speeds of the points as they are. Collective.
    void measure_speeds()
    {
      const Speeds of_rank = scene.speeds();
      std::vector<double> largest{ of_rank.wave, of_rank.points };
      agree_on(largest);
    }

    /// Takes the largest over ranks; the first two are speeds of waves and points, for the next step. Also agrees on
    /// whether to stop. Collective.
    /// @param sums are replaced by those over ranks
    void agree_on(std::vector<double> &largest, const NumbersOf &sums = {});

    /// Throws if the motion is unstable.
    void require_stable_step(const double largest_step, const double first_step) const;

    /// Throws if a point moves by two cells or more in a step, s.
    void require_stable_speed(const double time_step) const;

    /// Adds what left the box through open walls to the totals, and clears it. Throws if a point left through a closed
    /// one.
    void account_for_lost_points(const double time_step);

    /// Gathers a checkpoint, which is written while the run goes on. Collective.
    void begin_checkpoint();
    RunState<dim> state() const
    {
      return { totals, last_update, clock.time(), clock.step(), last_time_step };
    }

    /// Writes what --resume and the eye need of a run that ends before its time.
    void write_last();

    /// What is reported when a run ends.
    void summarise(const End end, const double point_updates_before);

    /// Of the damping of the skeleton, s: it follows the wave speed, as the step does.
    double skeleton_damping_time() const
    {
      const double speed = speeds.wave / std::sqrt(parameters.time_step.mass_scaling);
      return parameters.damps_skeleton() && speed > 0.
                 ? parameters.stabilisation.skeleton_damping * scene.grid.cell_size() / speed
                 : 0.;
    }

    template <class Archive>
    void serialize_state(Archive &archive)
    {
      double time             = clock.time();
      unsigned long long step = clock.step();
      archive &time &step;
      archive &speeds.wave &speeds.points &last_time_step &totals;
      results.serialize(archive);
      for (Obstacle<dim> &obstacle : scene.obstacles)
        archive &obstacle;
      for (Inflow<dim> &inflow : scene.inflows)
        archive &inflow;
      if (scene.rain)
        archive &*scene.rain;
      for (PointSet<dim> *points : point_sets())
        archive & points->next_id;
      archive &solver_state;
      clock.set(time, step);
    }

    Parameters &parameters;
    const Start start;
    const MPI_Comm communicator;
    RunFolder folder;
    StopRequests stop;
    dealii::TimerOutput timer;
    Scene<dim> scene;
    std::unique_ptr<Scheme<dim>> scheme;
    Partition<dim> partition;

    TimeStepper clock;
    OutputTimes output_times;
    Results<dim> results;

    std::unique_ptr<Progress> progress; // of run(); null before
    bool progress_is_due = false;       // on some rank

    Speeds speeds;                                 // of the points of all ranks
    StopReason reason          = StopReason::none; // to stop, of all ranks
    bool points_at_edge        = false;            // of the fine cells, on any rank
    unsigned int n_refinements = 0;                // that followed the points

    RunBalance<dim> totals;
    SolverState<dim> solver_state;             // of all ranks, at checkpoints
    double point_updates = 0;                  // points times steps, of this rank
    UpdateReport last_update;                  // of this rank
    double last_time_step                 = 0; // s
    unsigned long long step_of_checkpoint = std::numeric_limits<unsigned long long>::max(); // the newest, of this run
    bool is_released                      = true; // or was stopped while it settled
  };

  /// Runs a case and its stages to the end of the last one or to a request to stop. If the case settles, its "Strength
  /// factor" acts from the release on: the run then goes on from a checkpoint of the settled soil. Collective.
  /// @param parameters of the case before its stages; afterwards with the strength that the run had
  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator);
} // namespace scree

#endif
