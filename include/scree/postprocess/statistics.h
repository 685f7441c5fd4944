// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_h
#define scree_postprocess_statistics_h

#include <scree/boundary/obstacle.h>
#include <scree/postprocess/soil_motion.h>
#include <scree/step/step_report.h>
#include <scree/transfer/water_transfer.h>

#include <boost/range/adaptor/map.hpp>
#include <boost/range/iterator_range.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>

namespace scree
{
  /// Sums over the steps of a run, of this rank (2D: per m); what balances and the statistics need.
  template <int dim>
  struct RunBalance
  {
    Budget<dim> balance;                     ///< momentum and energy at the nodes
    dealii::Tensor<1, dim> lost_momentum;    ///< of soil and water points that left through an open wall, N s
    double lost_mass = 0;                    ///< of soil, kg
    dealii::Tensor<1, 2 * dim> lost_through; ///< the same by the face of the box that it left through, kg
    double lost_volume     = 0;              ///< of soil as dense as at the start, m^3 (2D: per m)
    double lost_water_mass = 0;              ///< kg
    double lost_energy     = 0;              ///< the same, without the elastic one, J
    dealii::Tensor<1, dim> entered_momentum; ///< of soil and water points of inflows, N s
    double n_entered          = 0;           ///< points of soil
    double entered_mass       = 0;           ///< of soil, kg
    double entered_water_mass = 0;           ///< kg
    double entered_energy     = 0;           ///< kept_energy() of BalanceState, J
    double removed_mass       = 0;           ///< of soil, by stages, kg
    double added_mass         = 0;           ///< of soil, by stages, kg
    double n_lost             = 0;           ///< points that left the box; exact, and travels like the rest
    UpdateReport material;                   ///< dissipation and counts of the stress updates
    double elastic_energy = 0;               ///< of the middle of the last step, see UpdateReport, J

    RunBalance() = default;

    /// @param n_obstacles of the scene
    explicit RunBalance(const unsigned int n_obstacles)
    {
      balance.obstacles.resize(n_obstacles);
    }

    /// The sums over ranks, on all of them. Collective.
    RunBalance sum_over_ranks(const MPI_Comm communicator) const
    {
      RunBalance total = *this;
      NumbersOf(total).sum_over_ranks(communicator);
      return total;
    }

    /// What soil and water have been given, N s.
    dealii::Tensor<1, dim> impulse() const
    {
      return balance.wall_impulse + balance.body_impulse + balance.pressure_impulse + balance.load_impulse +
             balance.bed_impulse + balance.obstacle_impulse() + entered_momentum - lost_momentum;
    }

    /// Energy that known losses have taken, less work and energy that has come in, J.
    double energy_taken() const
    {
      return material.plastic_dissipation + balance.wall_dissipation + balance.bed_dissipation +
             balance.contact_dissipation + balance.drag_dissipation + balance.viscous_dissipation + lost_energy -
             balance.load_work - balance.correction_work - balance.pressure_work - balance.obstacle_energy() -
             entered_energy;
    }

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &balance;
      archive &material.plastic_dissipation &material
          .averaging_work &lost_mass &lost_volume &lost_water_mass &lost_energy &lost_momentum &n_lost;
      archive &lost_through;
      archive &entered_momentum &n_entered &entered_mass &entered_water_mass &entered_energy;
      archive &removed_mass &added_mass;
      archive &elastic_energy;
      archive &material.n_updates &material.n_substeps &material.n_fallbacks;
      archive &material.n_vertices &material.n_unresolved;
    }
  };

  /// Soil and water of all ranks at the start of a run, which balances count from (2D: per m).
  template <int dim>
  struct BalanceStart
  {
    bool is_known = false;               ///< whether there has been a row
    dealii::Tensor<1, dim> momentum;     ///< with scaled masses, N s
    double energy               = 0;     ///< see BalanceState::kept_energy(), J
    bool has_step               = false; ///< whether it has that of the first step
    double least_averaging_work = 0;     ///< least sum since the start, see BalanceState::averaging_energy(), J

    /// Takes the length of the first step, s, and the work of the averaging.
    /// @param fall mass times velocity times gravity, W
    /// @param averaging_work its sum since the start, J
    void begin(const double time_step, const double fall, const double averaging_work)
    {
      if (is_known && !has_step)
        energy += 0.5 * time_step * fall;
      has_step             = is_known;
      least_averaging_work = std::min(least_averaging_work, averaging_work);
    }

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &is_known &momentum &energy &has_step &least_averaging_work;
    }
  };

  /// Momentum and energy of all ranks at the end of a step, beside the start (2D: per m).
  template <int dim>
  struct BalanceState
  {
    const BalanceStart<dim> &start;       ///< of the run
    const double mass_scaling;            ///< see BodyForces
    const dealii::Tensor<1, dim> gravity; ///< m/s^2
    const MovingSums<dim> &sums;          ///< now; before a step is over with the elastic energy of the start
    const RunBalance<dim> &totals;        ///< since the start
    const double time;                    ///< s
    const double time_step;               ///< s; 0 before the first step

    /// Momentum with scaled masses, N s.
    dealii::Tensor<1, dim> momentum() const
    {
      return mass_scaling * sums.momentum;
    }

    /// Kinetic, potential and elastic energy, with scaled masses, of one moment, J. Steps are those of symplectic
    /// Euler, v <- v + dt f(x), x <- x + dt v: velocities are those of the middle of the step, and so are the other
    /// energies, E - dt/2 dV/dt. (That is the energy which these steps conserve, for an oscillator without any error. E
    /// itself falls with what falls and rises with what rises, in first order of dt.)
    double kept_energy() const
    {
      return mass_scaling * sums.kinetic + sums.potential + 0.5 * time_step * (gravity * sums.momentum) +
             (time_step > 0. ? totals.elastic_energy : sums.elastic) + averaging_energy();
    }

    /// What the average of the volume change has taken from the nodes and not given back, J: with p = K P epsilon the
    /// force derives from K/2 epsilon P epsilon, and the points store K/2 |P epsilon|^2 of it. The sum of its work is
    /// at least 0 unless the average makes energy: this counts from the least sum, so that what it makes is a gain.
    double averaging_energy() const
    {
      return totals.material.averaging_work - start.least_averaging_work;
    }

    /// What the impulses since the start do not explain of the momentum, N s.
    double momentum_residual() const
    {
      return (momentum() - start.momentum - totals.impulse()).norm();
    }

    /// What known losses and work since the start do not explain of the energy, J.
    double numerical_dissipation() const
    {
      return start.energy - kept_energy() - totals.energy_taken();
    }
  };

  /// What there are columns for besides those of all scenes.
  template <int dim>
  struct SceneFeatures
  {
    bool loads                                = false,   ///< surface loads
        volume_correction                     = false,   ///< work of ParticleShifting
        pressure_work                         = false,   ///< of suction and of pressure at drained walls
        viscosity                             = false,   ///< viscosity of the water
        inflows                               = false,   ///< what has entered
        contacts                              = false,   ///< contact between bodies
        stages                                = false,   ///< what they have removed and added
        absorbing_walls                       = false;   ///< work of the ground beyond
    const DiscreteLevelSet<dim> *bed          = nullptr; ///< the bed; null without it
    const std::list<Obstacle<dim>> *obstacles = nullptr; ///< the obstacles; null without them
    std::vector<unsigned int> walls           = {};      ///< faces of the box whose forces have columns
    double mass_scaling                       = 1.;      ///< see BodyForces
  };

  /// What rows need of the start of a run, and of all ranks at the last row.
  template <int dim>
  struct RowHistory
  {
    BalanceStart<dim> start;     ///< of the run
    unsigned long long step = 0; ///< steps of the run
    double time             = 0; ///< s
    Budget<dim> balance;         ///< of all steps so far
  };

  /// What a column of the statistics may ask for: soil and water of all ranks when a row is due (2D: per m).
  template <int dim>
  struct Snapshot
  {
    const BackgroundGrid<dim> &grid;         ///< with the mesh as it is
    const dealii::Tensor<1, dim> gravity;    ///< m/s^2
    const SceneFeatures<dim> &further;       ///< what the scene has
    const std::list<SoilBody<dim>> &bodies;  ///< points of this rank
    const std::list<WaterPhase<dim>> &water; ///< points of this rank; empty without water
    const WaterView<dim> *view;              ///< the water at the nodes; null without
    const RowHistory<dim> &before;           ///< the start and the last row
    const UpdateReport &last_step;           ///< of this rank
    const PointSums<dim> sums;               ///< of one pass over all points
    const MotionNumbers motion;              ///< of the soil; 0 without
    const RunBalance<dim> totals;            ///< since the start
    const double time;                       ///< s
    const unsigned long long step;           ///< steps of the run
    const double time_step;                  ///< s

    /// What balances compare.
    BalanceState<dim> balance() const
    {
      return { before.start, further.mass_scaling, gravity, sums, totals, time, time_step };
    }

    /// Mean of the steps since the last row of what grows with each; 0 without a step.
    double mean_of_steps(const double now, const double at_last_row) const
    {
      return step > before.step ? (now - at_last_row) / (step - before.step) : 0.;
    }

    /// Mean over the time since the last row, 1/s; 0 if there is none.
    double mean_rate(const double now, const double at_last_row) const
    {
      const double duration = time - before.time;
      return duration > 0. ? (now - at_last_row) / duration : 0.;
    }
  };

  /// Values by the whole names of their columns, such as `Mass (kg)`.
  using StatisticsRow = std::vector<std::pair<std::string, double>>;

  /// Adds a value under its column's whole name.
  void add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const double value);

  /// Adds a vector: a column an axis.
  template <int dim>
  void
  add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const dealii::Tensor<1, dim> &value)
  {
    for (unsigned int a = 0; a < dim; ++a)
      add_value(row, name + ' ' + "xyz"[a], unit, value[a]);
  }

  /// The functions that add registered columns to a row, by name.
  template <int dim>
  std::map<std::string, std::function<void(const Snapshot<dim> &, StatisticsRow &)>> &registered_columns();

  /// Adds columns at the end of the rows, in the order of the names; their source file has one as a static constant.
  struct RegisterColumns
  {
    /// @param add is called with a Snapshot<2> or Snapshot<3> and a StatisticsRow, and adds the values of the columns
    /// that the scene has: the same in all rows. It may be collective.
    template <typename Add>
    RegisterColumns(const std::string &name, const Add &add)
    {
      registered_columns<2>()[name] = add;
      registered_columns<3>()[name] = add;
    }
  };

  /// The rows of the file `statistics.csv`: global numbers at each due time.
  template <int dim>
  class Statistics
  {
  public:
    /// Without a row.
    /// @param gravity m/s^2
    Statistics(const BackgroundGrid<dim> &grid,
               const dealii::Tensor<1, dim> &gravity,
               const SceneFeatures<dim> &further)
        : grid(grid)
        , gravity(gravity)
        , further(further)
        , motion(grid, gravity, further.bed)
    {
    }

    /// Makes a row: of soil and water together, of the soil if there is any, and of `water` unless it is empty.
    /// Collective.
    /// @param view asked for the pressure on walls; null without
    /// @return what the row is of; its `before` has this row already
    Snapshot<dim> collect(const std::list<SoilBody<dim>> &bodies,
                          const std::list<WaterPhase<dim>> &water,
                          const RunBalance<dim> &totals,
                          const double time,
                          const unsigned long long step,
                          const double time_step,
                          const UpdateReport &last_step,
                          const WaterView<dim> *view = nullptr);

    /// Balances and sums begin anew at the next row.
    void begin_balances()
    {
      history.start   = {};
      history.balance = {};
    }

    /// The start of the run, once its first row has been made.
    BalanceStart<dim> &start()
    {
      return history.start;
    }

    /// Throws if a number of the last row, of a `time` in s, is none.
    void require_numbers(const double time) const;

    /// The whole names of the columns of the last row.
    std::vector<std::string> columns() const
    {
      return boost::copy_range<std::vector<std::string>>(last_row | boost::adaptors::map_keys);
    }

    /// The numbers of the last row.
    std::vector<double> values() const
    {
      return boost::copy_range<std::vector<double>>(last_row | boost::adaptors::map_values);
    }

    /// Prints the last row, one quantity a line.
    void print_last_row(std::ostream &out) const;

    /// Steps of the run at the last row.
    unsigned long long step_of_last_row() const
    {
      return history.step;
    }

    /// The soil at the last row.
    const SoilMotion<dim> &soil_motion() const
    {
      return motion;
    }

    /// The oscillations of p' and p and the void share, means over the time since the first row.
    std::vector<CheckResult> results() const;

    /// Saves or loads the last row and the state that differences start from (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &history.start;
      archive &last_row &history.step &history.time &history.balance &motion;
      archive &time_sums;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const SceneFeatures<dim> further;
    SoilMotion<dim> motion;
    RowHistory<dim> history;
    StatisticsRow last_row;
    std::array<double, 3> time_sums{}; // of the columns that are judged by their means: integrals over time, s
  };
} // namespace scree

#endif
