// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_partition_h
#define scree_mesh_partition_h

#include <scree/mesh/background_grid.h>
#include <scree/particles/point_set.h>

namespace scree
{
  /// Which rank owns which cells: p4est cuts its curve through the cells into pieces of equal weight, here of equal
  /// numbers of points, whenever the fine cells change, and once the points that the fullest rank had beyond the mean
  /// outweigh what a repartition costs.
  ///
  /// It follows from the state of the run alone, so that runs on the same ranks are the same.
  template <int dim>
  class Partition
  {
  public:
    /// All sets of points that live on the mesh. Both are kept by reference.
    Partition(BackgroundGrid<dim> &grid, const std::vector<PointSet<dim> *> &sets);

    /// Whether a new partition pays before the next step: looks once in some steps. Before the first step: whether
    /// ranks hold unequal numbers of points. Collective.
    bool is_worth_changing();

    /// Shares out cells with their points. Collective.
    void repartition()
    {
      change_mesh(nullptr);
      n_changes += sum_of_mean > 0.;
    }

    /// The same on a mesh with these blocks of fine cells. Collective.
    void refine(const Blocks &blocks)
    {
      change_mesh(&blocks);
    }

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
    /// Changes the cells of the grid with the points off the mesh. Collective.
    void change_mesh(const Blocks *fine);

    /// Counts the points of the ranks. Collective.
    void count_points();

    BackgroundGrid<dim> &grid;
    const std::vector<PointSet<dim> *> sets;
    const MPI_Comm communicator;
    const unsigned int n_ranks;

    dealii::Utilities::MPI::MinMaxAvg points; // of the ranks, at the last look
    bool has_begun         = false;           // whether a look was taken before
    unsigned int n_steps   = 0;               // since the last look
    double surplus         = 0;               // updates of points on the fullest rank over the mean
    unsigned int n_changes = 0;
    double sum_of_largest = 0, sum_of_mean = 0; // updates of points
  };
} // namespace scree

#endif
