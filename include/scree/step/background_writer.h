// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_background_writer_h
#define scree_step_background_writer_h

#include <mpi.h>

#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace scree
{
  /// What an action of this rank complains of; empty: nothing.
  std::string fault_of(const std::function<void()> &action);

  /// Files of a picture or a checkpoint, whose content is gathered. Ranks write theirs stage by stage.
  struct FileJob
  {
    /// What this rank does, and all have one of; empty: nothing. Each begins when all ranks are through the one before.
    /// No stage may use MPI or what a step changes.
    std::vector<std::function<void()>> stages;
    std::function<void()> done; ///< after the last stage, on all ranks
    /// With the first rank's fault after a stage that threw, on all ranks; may throw. Empty: the fault is thrown.
    std::function<void(const std::string &)> failed;
  };

  /// Writes files while the steps of a run go on: one job at a time, in the order of their start. The thread of each
  /// rank only writes: ranks agree in look(), which the run calls once a step.
  class BackgroundWriter
  {
  public:
    /// Without a job.
    explicit BackgroundWriter(const MPI_Comm communicator);

    /// On a single rank all jobs are written first; faults are ignored.
    ~BackgroundWriter();

    /// Begins the job after those before it, of which it waits for all but one. Collective.
    void start(FileJob job);

    /// Goes on with what has been written, without waiting. Collective; throws what `failed` of a job does.
    void look();

    /// Waits for all jobs. Collective; throws like look().
    void finish();

    /// The longest time that a job took, s.
    double longest() const
    {
      return longest_job;
    }

    BackgroundWriter(const BackgroundWriter &)            = delete;
    BackgroundWriter &operator=(const BackgroundWriter &) = delete;

  private:
    void begin_job();
    void begin_stage();

    /// Waits for the stage and begins the next one, or ends the job. Collective.
    void end_stage();
    void end_job(const std::string &fault);

    const MPI_Comm communicator;
    const unsigned int n_ranks;
    std::deque<FileJob> jobs;
    unsigned int stage = 0;           // of the first job
    std::future<std::string> running; // the fault of this rank's stage
    std::chrono::steady_clock::time_point begin;
    double longest_job = 0.; // s
  };
} // namespace scree

#endif
