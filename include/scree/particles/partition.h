// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_partition_h
#define scree_particles_partition_h

#include <scree/particles/point_set.h>

#include <deal.II/distributed/tria.h>

#include <functional>

namespace scree
{
  /// Which rank owns which cells: p4est cuts its curve through the cells into pieces of equal weight, here of equal
  /// numbers of points, once the points that the fullest rank had beyond the mean outweigh what a repartition costs.
  ///
  /// It follows from the state of the run alone, so that runs on the same ranks are the same.
  template <int dim>
  class Partition
  {
  public:
    /// All sets of points that live on the mesh. Both are kept by reference.
    Partition(dealii::parallel::distributed::Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets);

    /// Whether a new partition pays before the next step: looks once in some steps. Before the first step: whether
    /// ranks hold unequal numbers of points. Collective.
    bool is_worth_changing();

    /// The same where the mesh has changed, so that fitting all else costs nothing more.
    bool is_worth_changing_with_mesh() const
    {
      return surplus > updates_worth_a_point * points.avg;
    }

    /// Shares out cells with their points. Collective.
    /// @param fit fits all else that lives on the mesh
    void repartition(const std::function<void()> &fit);

    /// Points of the fullest rank over the mean of all, mean of the steps.
    double imbalance() const
    {
      return sum_of_mean > 0. ? sum_of_largest / sum_of_mean : 1.;
    }

    /// How often since the first step.
    unsigned int n_repartitions() const
    {
      return n_changes;
    }

  private:
    // A repartition takes about 15 us a cell, mostly for deal.II's mesh, and 5 us a point; an update of a point 200 ns.
    static constexpr double updates_worth_a_cell  = 75.;
    static constexpr double updates_worth_a_point = 25.;

    /// Counts the points of the ranks. Collective.
    void count_points();

    dealii::parallel::distributed::Triangulation<dim> &mesh;
    const std::vector<PointSet<dim> *> sets;
    const MPI_Comm communicator;
    const unsigned int n_ranks;
    boost::signals2::scoped_connection weight_signal;

    dealii::Utilities::MPI::MinMaxAvg points; // of the ranks, at the last look
    bool has_begun         = false;           // whether a look was taken before
    unsigned int n_steps   = 0;               // since the last look
    double surplus         = 0;               // updates of points on the fullest rank over the mean
    unsigned int n_changes = 0;
    double sum_of_largest = 0, sum_of_mean = 0; // updates of points
  };
} // namespace scree

#endif
