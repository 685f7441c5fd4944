// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_h
#define scree_postprocess_statistics_h

#include <scree/postprocess/measures.h>
#include <scree/postprocess/point_sums.h>
#include <scree/boundary/obstacle.h>
#include <scree/step/budget.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

namespace scree
{
  /// Sums over the steps of a run, of this rank (2D: per m); what balances and the statistics need.
  template <int dim>
  struct RunTotals
  {
    Budget<dim> balance;                     ///< momentum and energy at the nodes
    dealii::Tensor<1, dim> lost_momentum;    ///< of soil and water points that left through an open wall, N s
    double lost_mass       = 0;              ///< of soil, kg
    double lost_volume     = 0;              ///< of soil as dense as at the start, m^3 (2D: per m)
    double lost_water_mass = 0;              ///< kg
    double lost_energy     = 0;              ///< kinetic and potential, J
    dealii::Tensor<1, dim> entered_momentum; ///< of soil and water points of inflows, N s
    double n_entered           = 0;          ///< points of soil
    double entered_mass        = 0;          ///< of soil, kg
    double entered_water_mass  = 0;          ///< kg
    double entered_energy      = 0;          ///< kinetic, potential and elastic, J
    double plastic_dissipation = 0;          ///< J

    // Counts; doubles hold them exactly and travel like the rest.
    double n_lost    = 0, ///< points that left the box
        n_updates    = 0, ///< updates of stress, points times steps
        n_substeps   = 0, ///< return maps
        n_fallbacks  = 0, ///< see UpdateReport::n_fallbacks
        n_vertices   = 0, ///< see UpdateReport::n_vertices
        n_unresolved = 0; ///< see UpdateReport::n_unresolved

    RunTotals() = default;

    /// @param n_obstacles of the scene
    explicit RunTotals(const unsigned int n_obstacles)
    {
      balance.obstacles.resize(n_obstacles);
    }

    /// Adds dissipation and counts of a step's stress updates.
    void add(const UpdateReport &report);

    /// The sums over ranks, on all of them. Collective.
    RunTotals sum_over_ranks(const MPI_Comm communicator) const;

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &balance;
      archive &plastic_dissipation &lost_mass &lost_volume &lost_water_mass &lost_energy &lost_momentum &n_lost;
      archive &entered_momentum &n_entered &entered_mass &entered_water_mass &entered_energy;
      archive &n_updates &n_substeps &n_fallbacks &n_vertices &n_unresolved;
    }
  };

  /// What there are columns for besides those of all scenes.
  template <int dim>
  struct FurtherColumns
  {
    bool loads                                = false,   ///< surface loads
        volume_correction                     = false,   ///< work of ParticleShifting
        viscosity                             = false,   ///< viscosity of the water
        inflows                               = false,   ///< what has entered
        contacts                              = false;   ///< contact between bodies
    const DiscreteLevelSet<dim> *bed          = nullptr; ///< the bed; null without it
    const std::list<Obstacle<dim>> *obstacles = nullptr; ///< the obstacles; null without them
  };

  /// The rows of the file `statistics`: global numbers at each due time.
  template <int dim>
  class Statistics
  {
  public:
    /// Names the columns.
    /// @param gravity m/s^2
    Statistics(const BackgroundGrid<dim> &grid,
               const dealii::Tensor<1, dim> &gravity,
               const FurtherColumns<dim> &further);

    /// Makes a row: of soil and water together, of the soil if there is any, and of `water` unless it is empty.
    /// Collective.
    void collect(const std::list<SoilBody<dim>> &bodies,
                 const std::list<WaterPhase<dim>> &water,
                 const RunTotals<dim> &totals,
                 const double time,
                 const unsigned long long step,
                 const double time_step,
                 const UpdateReport &last_step);

    /// Throws if a number of the last row, of a `time` in s, is none.
    void require_numbers(const double time) const;

    /// The lines above the first row, which name the columns.
    std::string head() const;

    /// The last row, as a line of the file.
    std::string row() const;

    /// Prints the last row, one quantity a line.
    void print_last_row(std::ostream &out) const;

    /// Steps of the run at the last row.
    unsigned long long step_of_last_row() const
    {
      return last_row_step;
    }

    /// Saves or loads the last row and the state that differences start from (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &has_start &start_momentum &start_energy &last_row &last_row_step &iterations_at_last_row;
      archive &cavitating_at_last_row &viscous_iterations_at_last_row;
      archive &last_row_time &obstacles_at_last_row;
    }

  private:
    void add_soil_columns(const std::list<SoilBody<dim>> &bodies,
                          const PointSums<dim> &now,
                          const RunTotals<dim> &totals,
                          const UpdateReport &last_step);
    void add_bed_columns(const std::list<SoilBody<dim>> &bodies,
                         const std::list<WaterPhase<dim>> &water,
                         const Budget<dim> &balance);
    void add_inflow_columns(const std::list<WaterPhase<dim>> &water, const RunTotals<dim> &totals);
    void add_obstacle_columns(const Budget<dim> &balance, const double time);
    void add_water_columns(const std::list<SoilBody<dim>> &bodies,
                           const std::list<WaterPhase<dim>> &water,
                           const PointSums<dim> &now,
                           const RunTotals<dim> &totals,
                           const unsigned long long step);
    void add(const std::string &column, const double value);

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const FurtherColumns<dim> further;
    bool has_start = false;
    dealii::Tensor<1, dim> start_momentum;
    double start_energy                   = 0;
    unsigned long long last_row_step      = 0;
    double iterations_at_last_row         = 0;
    double cavitating_at_last_row         = 0;
    double viscous_iterations_at_last_row = 0;
    double last_row_time                  = 0;
    std::vector<ObstacleBalance<dim>> obstacles_at_last_row;
    std::vector<std::pair<std::string, double>> last_row;
  };
} // namespace scree

#endif
