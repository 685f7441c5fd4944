// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_solid_phase_h
#define scree_momentum_solid_phase_h

#include <scree/step/step_report.h>
#include <scree/momentum/surface_load.h>
#include <scree/transfer/nonlocal_average.h>
#include <scree/transfer/transfer.h>

#include <list>
#include <memory>

namespace scree
{
  /// A group of bodies of soil with the loads on them, between their points and the nodes: what all schemes share.
  template <int dim>
  class SolidPhase
  {
  public:
    /// @param bodies of all groups
    /// @param group number of this one
    SolidPhase(const BackgroundGrid<dim> &grid,
               const TransferParameters &transfer,
               const StabilisationParameters &stabilisation,
               std::list<SoilBody<dim>> &bodies,
               std::list<SurfaceLoad<dim>> &loads,
               const unsigned int group = 0);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Averages over space what the laws of the bodies ask for, between two steps. Collective.
    void average(dealii::TimerOutput &timer);

    /// Sums mass, momentum and force of this rank's points at the nodes, at the time, s, of the step's start.
    /// Collective.
    void to_grid(const double time);

    /// Adds the loads as they are a time, s, after the step's start, before the nodes' sums go over ranks.
    void add_loads(const double delay);

    /// The impulse of the loads in a step, N s, of this rank.
    dealii::Tensor<1, dim> load_impulse(const double time_step) const
    {
      return time_step * load;
    }

    /// Moves bodies and loads after the solve of a step, and updates stress and state. Collective.
    /// @param damping_time of the skeleton, s, see SkeletonDamping
    void to_points(const double time_step, const double damping_time, StepReport<dim> &report);

    /// Appends the points of all bodies, then the markers of the loads.
    void append_point_sets(std::vector<PointSet<dim> *> &sets);

    /// Bodies of all groups, rigid ones too.
    std::list<SoilBody<dim>> &all_bodies()
    {
      return bodies;
    }

    /// Read-only access.
    const std::list<SoilBody<dim>> &all_bodies() const
    {
      return bodies;
    }

    /// The nodes of the soil: sums before the solve, velocity and its change after it.
    NodalField<dim> field;

  private:
    Transfer<dim> transfer;
    std::list<SoilBody<dim>> &bodies;
    std::vector<SoilBody<dim> *> moving; // of the group
    std::list<SurfaceLoad<dim>> &loads;
    std::unique_ptr<NonlocalAverage<dim>> nonlocal; // null if no body's law needs it
    double load_time = 0;                           // s; the step's start until add_loads()
    dealii::Tensor<1, dim> load;                    // sum of the loads of this rank, N
  };
} // namespace scree

#endif
