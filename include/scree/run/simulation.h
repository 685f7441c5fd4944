// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_simulation_h
#define scree_run_simulation_h

#include <scree/io/output_parameters.h>
#include <scree/io/progress.h>
#include <scree/model/scene.h>
#include <scree/particles/partition.h>
#include <scree/run/relaxation.h>
#include <scree/run/results.h>
#include <scree/run/step_control.h>
#include <scree/step/step_report.h>

#include <limits>
#include <memory>

namespace scree
{
  /// How a run begins.
  enum class Start
  {
    fresh,
    resume ///< from the newest checkpoint in the run folder
  };

  /// How a run ends.
  enum class End
  {
    complete, ///< at its end time
    stopped   ///< before, as it was asked to
  };

  /// A run: a scene, the scheme that moves it, and its output. Top-level class; no other class depends on it.
  template <int dim>
  class Simulation
  {
  public:
    /// Throws InputError or dealii exceptions if the parameters do not make a run.
    Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator);

    /// From the start to the end time, with all output; or to a request to stop (StopRequests), with a checkpoint
    /// unless the soil was still settling.
    End run();

    /// Moves all by `time_step` s.
    void advance(const double time_step);

    /// Largest step, s, of the points as they are.
    double stable_step() const
    {
      return control.stable_step();
    }

    /// Whether no settling at the start was stopped.
    bool is_settled() const
    {
      return is_released;
    }

    /// Damped motion from the state as it is, until the soil rests or fails; then it is stopped. Collective.
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
    void report();

    /// One step of the run, of `largest_step` s and to the time `due`, s, at most.
    /// @return its length, s
    double step(const double largest_step, const double due);

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

    /// Bodies of soil with the points of this rank.
    const std::list<SoilBody<dim>> &bodies() const
    {
      return scene.bodies;
    }

    /// The water; empty in a dry scene.
    const std::list<WaterPhase<dim>> &water_phases() const
    {
      return scene.water;
    }

    /// Mesh and nodes of the velocity.
    const BackgroundGrid<dim> &background_grid() const
    {
      return scene.grid;
    }

    /// The bed as the mesh sees it; null without one.
    const DiscreteLevelSet<dim> *bed() const
    {
      return scene.bed.get();
    }

    /// What limits the next step: of the points as they are, and of obstacles.
    Speeds limiting_speeds() const
    {
      return control.limiting_speeds();
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
    void settle();

    /// Damped motion of the scene before the release.
    Relaxation<dim> relaxation();

    /// Fits scene and scheme to a new partition of the mesh.
    void reinit();

    /// Repartitions the mesh, if that is due and worthwhile.
    void repartition();

    /// Moves on what the scene moves by itself, and puts in what enters.
    void end_step(const double time_step);

    /// After a step: the points to the cells and ranks they are in now, and the speeds of all ranks for the next step.
    void place_points(const double time_step, const Speeds &of_rank);

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

    template <class Archive>
    void serialize_state(Archive &archive);

    Parameters &parameters;
    const Start start;
    const MPI_Comm communicator;
    RunFolder folder;
    StopRequests stop;
    dealii::TimerOutput timer;
    Scene<dim> scene;
    std::unique_ptr<Scheme<dim>> scheme;
    Partition<dim> partition;
    MeshAdaptation<dim> adaptation;

    TimeStepper clock;
    StepControl<dim> control;
    OutputTimes output_times;
    Results<dim> results;

    std::unique_ptr<Progress> progress; // of run(); null before
    bool progress_is_due = false;       // on some rank

    RunBalance<dim> totals;
    std::vector<FacetTractions<dim>> ground_tractions; // of all ranks, at checkpoints
    double point_updates = 0;                          // points times steps, of this rank
    UpdateReport last_update;                          // of this rank
    double last_time_step                 = 0;         // s
    unsigned long long step_of_checkpoint = std::numeric_limits<unsigned long long>::max(); // the newest, of this run
    bool is_released                      = true; // or was stopped while it settled
  };

  /// Runs a case to its end time or to a request to stop. If it settles, its "Strength factor" acts from the release
  /// on: the run then goes on from a checkpoint of the settled soil. Collective.
  /// @param parameters of the case; afterwards with the strength that the run had
  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator);
} // namespace scree

#endif
