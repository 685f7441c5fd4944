// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_progress_h
#define scree_io_progress_h

#include <scree/io/run_folder.h>
#include <scree/schemes/time_step.h>

#include <deal.II/base/timer.h>

namespace scree
{
  /// Processor time that this process has taken so far, its own and the system's for it, s. (deal.II's CPUClock counts
  /// its own alone, which the system guesses from ticks: of short runs that is nothing or twice as much.)
  double processor_time();

  /// Tells how far a run is, how long it will take, and in the end where its time went.
  class Progress
  {
  public:
    /// @param start_time s, of the run or of the checkpoint
    /// @param end_time s
    Progress(RunFolder &folder, const double start_time, const double end_time);

    /// Writes a line if the last one is some seconds old, or at the end.
    void report(const double time, const unsigned long long step, const double time_step);

    /// Counts a step by what bounds it.
    /// @param part of the step that waves and motion alone would allow
    void count(const StepLimit limit, const double part)
    {
      ++counts[static_cast<unsigned int>(limit)];
      others += part;
    }

    /// Writes the table of seconds by part, and ns per point and step; before that how many steps a second of motion
    /// takes, what bounded them, and how long it takes to compute. Collective.
    /// @param time s, of the end
    /// @param parts timed sections of this rank
    /// @param point_updates points times steps, of all ranks
    /// @param point what is counted as one: "soil or water point" where there is water
    void summarise(const double time,
                   const dealii::TimerOutput &parts,
                   const double point_updates,
                   const std::string &point,
                   const MPI_Comm communicator);

    /// Writes how evenly several ranks have worked. Collective.
    /// @param waiting time that this rank has waited for others, s
    /// @param imbalance time of the slowest ranks over the mean, without waiting
    /// @param n_repartitions how often the mesh was repartitioned
    void summarise_ranks(const double waiting,
                         const double imbalance,
                         const unsigned int n_repartitions,
                         const MPI_Comm communicator);

  private:
    /// Writes what summarise() says before the table.
    void summarise_steps(const double time);

    RunFolder &folder;
    const double start_time, end_time;
    dealii::Timer clock;
    const double processor_time_before = processor_time();
    double last_line                   = 0; // wall time, s
    StepCounts counts                  = {};
    double others                      = 0; // steps that the run would have taken without 'Maximum time step'
  };
} // namespace scree

#endif
