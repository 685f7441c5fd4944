// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_partition_h
#define scree_particles_partition_h

#include <scree/particles/point_set.h>

#include <deal.II/distributed/tria.h>

#include <functional>

namespace scree
{
  /// Work of a step between two places where the ranks wait for each other.
  enum class Work
  {
    to_nodes, ///< sorting, points to grid
    solving,  ///< at the nodes; with the time for messages
    to_points ///< grid to points and their law, places in cells
  };

  /// Which rank owns which cells: measures what cells cost and how evenly ranks work, and repartitions the mesh
  /// where that pays.
  ///
  /// A cut through the mesh's curve of cells can even out one kind of work: sorting and points to grid cost the same
  /// for each point, the law up to fifteen times more where the soil yields. It evens out the longer one.
  ///
  /// Costs are times of the processor, so on several ranks the partition may differ from run to run; results then
  /// differ by rounding.
  template <int dim>
  class Partition
  {
  public:
    /// All sets of points that live on the mesh. Both are kept by reference.
    Partition(dealii::parallel::distributed::Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets);

    /// Starts timing of a step; time since the last one is not attributed.
    void begin_step();

    /// The processor's time of this rank since the last call, or begin_step(), or resume(), was this work.
    void finish(const Work work);

    /// Adds to the time of a work, s.
    void add(const Work work, const double seconds)
    {
      work_of_rank[unsigned(work)] += seconds;
    }

    /// What happened since the last call was waiting.
    void resume()
    {
      last = thread_time();
    }

    /// Whether a new partition pays: since the last one, the slowest rank took longer beyond the mean than a
    /// repartition does. Before the first step: whether ranks hold unequal numbers of points. Looks once in some steps.
    /// Collective.
    bool is_worth_changing();

    /// The same where the mesh has changed, so that fitting all else costs nothing more.
    bool is_worth_changing_with_mesh() const
    {
      return surplus > duration - duration_of_fit;
    }

    /// Shares out cells, with their points, by what they cost. Collective.
    /// @param fit fits all else that lives on the mesh; its time counts
    void repartition(const std::function<void()> &fit);

    /// Time of the slowest ranks over the mean of all, work by work, without waiting; 1 where nothing was measured.
    /// Collective.
    double imbalance()
    {
      collect();
      return sum_of_mean > 0. ? sum_of_largest / sum_of_mean : 1.;
    }

    /// How often since the first step.
    unsigned int n_repartitions() const
    {
      return n_changes;
    }

  private:
    static constexpr unsigned int n_works = 3;

    /// What is to be evened out.
    enum class Weights
    {
      points, ///< all cost the same
      costs   ///< the work to the points, as measured
    };

    /// s
    struct WorkOfRanks
    {
      double largest, mean;
    };

    /// Closes the steps that are under way; returns the works that a partition can even out, by Weights. Collective.
    std::array<WorkOfRanks, 2> collect();

    double number_of_points() const
    {
      double n_points = 0;
      for (const PointSet<dim> *points : sets)
        n_points += points->n_points();
      return n_points;
    }

    /// Means of the measured costs, set by set, and this rank's calibration; collective.
    void find_typical_costs();

    /// p4est's unit is ours: ns a step.
    unsigned int weight_of(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

    dealii::parallel::distributed::Triangulation<dim> &mesh;
    const std::vector<PointSet<dim> *> sets;
    const MPI_Comm communicator;
    const unsigned int n_ranks;

    Weights weights = Weights::costs;  // equal ones, until some are measured
    std::vector<double> typical_costs; // of a point of each set, s
    boost::signals2::scoped_connection weight_signal;

    double last;                                    // thread_time()
    std::array<double, n_works> work_of_rank{ {} }; // of this rank, since the last collect(), s
    double to_points                  = 0;     // work of this rank since the last repartition, up to the last look, s
    unsigned int n_steps_in_partition = 0;     // of that work
    double calibration                = 1;     // work to the points over what this rank's cells say
    bool has_begun                    = false; // whether a look was taken before
    unsigned int n_steps              = 0;     // since the last look
    double surplus                    = 0;     // of the slowest rank's work over the mean since the last repartition, s
    double duration                   = 0;     // of the last repartition, s
    double duration_of_fit            = 0;     // in it, s
    unsigned int n_changes            = 0;
    double sum_of_largest = 0, sum_of_mean = 0; // of the steps collected, s
  };
} // namespace scree

#endif
