// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_snapshot_h
#define scree_postprocess_statistics_snapshot_h

#include <scree/boundary/obstacle.h>
#include <scree/postprocess/measures.h>
#include <scree/postprocess/point_sums.h>
#include <scree/postprocess/run_totals.h>
#include <scree/postprocess/statistics/soil_motion.h>

namespace scree
{
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
    double mass_scaling                       = 1.;      ///< see BodyForces
  };

  /// What rows need of the start of a run, and of all ranks at the last row.
  template <int dim>
  struct RowHistory
  {
    bool has_start = false;                      ///< whether there has been a row
    dealii::Tensor<1, dim> start_momentum;       ///< N s
    double start_energy         = 0;             ///< kinetic, potential and elastic, J
    unsigned long long step     = 0;             ///< steps of the run
    double time                 = 0;             ///< s
    double n_iterations         = 0;             ///< see Budget::n_iterations
    double n_cavitating         = 0;             ///< see Budget::n_cavitating
    double n_viscous_iterations = 0;             ///< see Budget::n_viscous_iterations
    std::vector<ObstacleBalance<dim>> obstacles; ///< see Budget::obstacles
  };

  /// What a column of the statistics may ask for: soil and water of all ranks when a row is due (2D: per m).
  template <int dim>
  struct Snapshot
  {
    static constexpr unsigned int dimension = dim; ///< 2 or 3

    const BackgroundGrid<dim> &grid;         ///< with the mesh as it is
    const FurtherColumns<dim> &further;      ///< what the scene has
    const std::list<SoilBody<dim>> &bodies;  ///< points of this rank
    const std::list<WaterPhase<dim>> &water; ///< points of this rank; empty without water
    const RowHistory<dim> &before;           ///< the start and the last row
    const UpdateReport &last_step;           ///< of this rank
    const PointSums<dim> sums;               ///< of one pass over all points
    const WaterMeasures of_water;            ///< 0 without water
    const std::vector<double> fronts;        ///< of the soil: x below which 90, 99 and 99.5 % of its mass are, m
    const std::vector<double> water_fronts;  ///< the same of the water
    const MotionNumbers motion;              ///< of the soil; 0 without
    const RunTotals<dim> totals;             ///< since the start
    const double time;                       ///< s
    const unsigned long long step;           ///< steps of the run
    const double time_step;                  ///< s

    /// Kinetic, potential and elastic energy of the balance, with scaled masses, J.
    double energy() const
    {
      return further.mass_scaling * sums.kinetic + sums.potential + sums.elastic;
    }

    /// Momentum of the balance, with scaled masses, N s.
    dealii::Tensor<1, dim> momentum() const
    {
      return further.mass_scaling * sums.momentum;
    }

    /// What soil and water have been given since the start, N s.
    dealii::Tensor<1, dim> impulse() const
    {
      return totals.impulse();
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
} // namespace scree

#endif
