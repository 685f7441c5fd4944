// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_simulation_h
#define scree_simulation_h

#include <scree/output/graphics.h>
#include <scree/output/progress.h>
#include <scree/output/statistics.h>
#include <scree/parameters.h>
#include <scree/scheme/explicit_scheme.h>
#include <scree/scheme/semi_implicit_scheme.h>
#include <scree/transfer/transfer.h>

#include <list>

namespace scree
{
  /// How a run begins.
  enum class Start
  {
    fresh,
    resume ///< from the newest checkpoint in the run folder
  };

  /// A run: owns everything, and nobody knows it.
  template <int dim>
  class Simulation
  {
  public:
    /// Throws InputError or dealii exceptions if the parameters do not make a run.
    Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator);

    /// From the start to the end time, with all output.
    void run();

    /// One step of `time_step` s.
    void advance(const double time_step);

    const std::list<SoilBody<dim>> &bodies() const
    {
      return phases;
    }
    const std::list<WaterPhase<dim>> &water_phases() const
    {
      return water;
    }
    const BackgroundGrid<dim> &background_grid() const
    {
      return grid;
    }

    /// Largest step, s, of the points as they are.
    double stable_step() const;

    /// Wall time of the parts of the steps so far.
    const dealii::TimerOutput &times_of_parts() const
    {
      return timer;
    }
    double time() const
    {
      return clock.time();
    }

    /// All sets of points, in a fixed order.
    std::vector<PointSet<dim> *> point_sets();

  private:
    void make_phases();
    void initialise();
    void fill_with_points();
    void set_initial_state();
    void resume();
    void settle();

    /// Velocity of the nodes at the end of a step, from the points.
    void solve_nodes(const double time_step);

    /// Soil, water and markers follow the nodes; they are not sorted yet.
    void move_points(const double time_step, std::vector<double> &largest);

    /// Wave speed and largest speed of the points as they are, for the first step.
    void measure_speeds();

    void make_appointments();
    double next_appointment(const double largest_step) const;
    void report();
    void write_picture(const double time);
    void account_for_lost_points();
    void share_out_cells();

    /// Largest over ranks; what is not a number counts as infinite.
    std::vector<double> largest_of_ranks(std::vector<double> values) const;

    void write_checkpoint();

    template <class Archive>
    void serialize_state(Archive &archive);

    Parameters &parameters;
    const MPI_Comm communicator;
    RunFolder folder;
    dealii::TimerOutput timer;
    BackgroundGrid<dim> grid;
    BoundaryConditions<dim> walls;
    NodalField<dim> field;
    Transfer<dim> transfer;
    Forcing<dim> forcing;
    ExplicitScheme<dim> scheme;
    std::list<SoilBody<dim>> phases;
    std::unique_ptr<SurfaceLoad<dim>> load; // null without

    // Of a scene with water; else null and empty.
    std::unique_ptr<WaterBoundaryConditions<dim>> water_walls;
    std::unique_ptr<SemiImplicitScheme<dim>> semi_implicit;
    std::list<WaterPhase<dim>> water;

    Clock clock;
    Graphics<dim> graphics;
    Statistics<dim> statistics;

    RunTotals<dim> totals;
    double water_updates = 0;                                   // points times steps, of this rank
    UpdateReport last_step;                                     // of this rank
    double wave_speed     = 0;                                  // largest of all ranks, m/s
    double largest_speed  = 0;                                  // of points, of all ranks, m/s
    double last_time_step = 0;                                  // s
    double next_picture = 0, next_row = 0, next_checkpoint = 0; // s
  };
} // namespace scree

#endif
