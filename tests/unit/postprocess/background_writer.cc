// SPDX-License-Identifier: LGPL-2.1-or-later
// Files that are written while a run goes on: the order of stages and jobs, faults of one rank, and the end of a run.
#include "../test.h"

#include <scree/io/files.h>

#include <future>
#include <mutex>

namespace test_background_writer
{
/// What this rank has done, in its order.
class Record
{
public:
  std::function<void()> writes(const std::string &text)
  {
    return [this, text] {
      const std::lock_guard<std::mutex> guard(mutex);
      lines += text + '\n';
    };
  }

  /// On the first rank this has been done since the last call.
  void compare(const std::string &expected)
  {
    const std::lock_guard<std::mutex> guard(mutex);
    require(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0 || lines == expected, "It was done:\n" + lines);
    lines.clear();
  }

private:
  std::mutex mutex;
  std::string lines;
};

/// A job of two stages, the second one of the first rank alone.
FileJob job(Record &record, const std::string &name)
{
  FileJob job;
  job.stages = { record.writes(name + ": pieces"), {} };
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    job.stages[1] = record.writes(name + ": record");
  job.done   = record.writes(name + ": done");
  job.failed = [&record, name](const std::string &fault) { record.writes(name + ": failed: " + fault)(); };
  return job;
}

const UnitTest registered_test("background_writer", [] {
  const auto ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  Record record;
  std::promise<void> disk;
  const std::shared_future<void> is_free = disk.get_future().share();
  {
    BackgroundWriter writer(MPI_COMM_WORLD);
    FileJob slow   = job(record, "slow");
    slow.stages[0] = [is_free, write = slow.stages[0]] {
      is_free.wait();
      write();
    };
    writer.start(std::move(slow));
    writer.start(job(record, "next"));
    writer.look();
    record.compare(""); // the disk is busy
    disk.set_value();
    writer.finish();
    record.compare("slow: pieces\nslow: record\nslow: done\nnext: pieces\nnext: record\nnext: done\n");

    FileJob refused = job(record, "refused");
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == ranks - 1)
      refused.stages[0] = [] { throw FileError("the last rank finds no room"); };
    writer.start(std::move(refused));
    writer.start(job(record, "after it"));
    writer.finish();
    record.compare(
        std::string(ranks > 1 ? "refused: pieces\n" : "") +
        "refused: failed: the last rank finds no room\nafter it: pieces\nafter it: record\nafter it: done\n");

    // A run that ends by an error keeps what it had begun to write: all of it on one rank.
    writer.start(job(record, "last"));
    writer.start(job(record, "waiting"));
  }
  record.compare(ranks > 1 ? "last: pieces\n" : "last: pieces\nlast: record\nwaiting: pieces\nwaiting: record\n");
});
} // namespace test_background_writer

// Runs with mpirun=1,2.
