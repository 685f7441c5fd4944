// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_files_h
#define scree_io_files_h

#include <scree/input/input_error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <future>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// A file that the disk did not take, or does not give back; what() names file, cause and remedy. It may strike a
  /// single rank.
  class FileError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// The FileError after a call has failed that was to write `n_bytes` to `file`: the cause is errno's.
  FileError error_of_writing(const std::string &file, const std::uintmax_t n_bytes);

  /// Path and content of a file.
  using FileContent = std::pair<std::string, std::string>;

  /// Replaces files of a folder, so that at any instant the old or the new one of each is there as a whole: writes
  /// beside them, checks, brings them to the disk (fsync) and renames them in this order, when all of them are there.
  /// Throws FileError; old ones then stay.
  void write_whole_files(const std::vector<FileContent> &files);

  /// The content of `file`. Throws FileError.
  std::string read_whole_file(const std::string &file);

  /// Brings to the disk which files a folder has: after a rename or removal. Throws FileError.
  void sync_folder(const std::string &folder);

  /// A text file that grows by rows: what stands there is not touched again, and a resumed run goes on from the row at
  /// which its checkpoint was written. One rank owns and writes it; on others it only travels through checkpoints.
  class RowFile
  {
  public:
    /// @param file path; it is made with the first row
    explicit RowFile(const std::string &file)
        : file(file)
    {
    }

    /// Whether there is no row yet: the first one brings the head of the file along.
    bool is_empty() const
    {
      return size == 0 && waiting.empty();
    }

    /// Whether the disk has taken all rows.
    bool is_complete() const
    {
      return waiting.empty();
    }

    /// Adds rows, which end with an end of line. Throws FileError if the disk does not take them: then they wait, and
    /// are written before the next ones.
    void append(const std::string &rows);

    /// Brings the rows to the disk, before a checkpoint counts on them. Throws FileError.
    void sync() const;

    /// After the state has been read from a checkpoint: cuts off the rows that were written after it. Returns what is
    /// missing of those written before, in words; usually nothing. Throws FileError.
    std::string cut();

    /// Saves or loads the size of the file, bytes, and the rows that wait (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &size &waiting;
    }

  private:
    const std::string file;
    std::uint64_t size = 0; // bytes that the disk has taken
    std::string waiting;    // rows that it has not
  };

  /// A file that says which run writes to a folder: host, process, start of the process, date. It is there as long as
  /// this lives; that of a process that has died is recognised and replaced.
  class FolderLock
  {
  public:
    /// Takes the lock, if no other process has it.
    explicit FolderLock(const std::string &file);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

    std::string refusal, ///< who has the lock and what to do, in words; empty if this has it
        dead_owner;      ///< the process whose lock was replaced, in words; empty if there was none

  private:
    bool make();

    const std::string file, text;
  };

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
    explicit BackgroundWriter(const MPI_Comm communicator)
        : communicator(communicator)
        , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
    {
    }

    /// On a single rank all jobs are written first; faults are ignored.
    ~BackgroundWriter();

    /// Begins the job after those before it, of which it waits for all but one. Collective.
    void start(FileJob job)
    {
      while (jobs.size() > 1)
        end_stage();
      if (n_ranks == 1) // It does not wait between the stages.
        {
          auto all = [stages = std::move(job.stages)] {
            for (const auto &write : stages)
              if (write)
                write();
          };
          job.stages.clear();
          job.stages.emplace_back(std::move(all)); // which may hold maps: it is not copied
        }
      jobs.push_back(std::move(job));
      if (jobs.size() == 1)
        begin_job();
    }

    /// Goes on with what has been written, without waiting. Collective; throws what `failed` of a job does.
    void look()
    {
      while (!jobs.empty())
        {
          const int is_ready = running.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
          if ((n_ranks > 1 ? dealii::Utilities::MPI::min(is_ready, communicator) : is_ready) == 0)
            return;
          end_stage();
        }
    }

    /// Waits for all jobs. Collective; throws like look().
    void finish()
    {
      while (!jobs.empty())
        end_stage();
    }

    /// The longest time that a job took, s.
    double longest() const
    {
      return longest_job;
    }

    BackgroundWriter(const BackgroundWriter &)            = delete;
    BackgroundWriter &operator=(const BackgroundWriter &) = delete;

  private:
    void begin_job()
    {
      begin = std::chrono::steady_clock::now();
      stage = 0;
      begin_stage();
    }
    void begin_stage();

    /// Waits for the stage and begins the next one, or ends the job. Collective.
    void end_stage()
    {
      const std::string own   = running.get();
      const std::string fault = n_ranks > 1 ? first_fault(own, communicator) : own;
      if (fault.empty() && stage < jobs.front().stages.size())
        begin_stage();
      else
        end_job(fault);
    }
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
