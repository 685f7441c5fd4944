// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_run_folder_h
#define scree_io_run_folder_h

#include <scree/io/folder_lock.h>

#include <mpi.h>

#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace scree
{
  /// The folder a run writes to, its lock and its log. Only rank 0 touches the disk.
  class RunFolder
  {
  public:
    /// Makes the folder and its folder `solution`, and keeps other runs out as long as this lives; what is there stays.
    /// Collective; throws EntryError on all ranks if it is not writable, or if another run writes there.
    RunFolder(const std::string &path, const bool to_screen, const MPI_Comm communicator);

    /// Removes log, rows, pictures, maps and checkpoints of an earlier run. Collective.
    void remove_old_results();

    /// Writes a file of the folder with the given text, see write_whole_file().
    void write(const std::string &name, const std::string &text) const;

    /// Throws EntryError on all ranks if somebody has removed the folder. Collective.
    void require_presence() const;

    /// Lets `write` write a file that can wait. If the disk does not take it, standard error has that once, and the run
    /// goes on.
    void try_to_write(const std::string &name, const std::function<void()> &write);

    /// Adds lines to `log.txt` and, if asked, to the screen.
    void log(const std::string &lines);

    /// Adds lines to `log.txt` alone: details that the screen leaves out.
    void record(const std::string &lines);

    /// Path of a file in the folder.
    std::string file(const std::string &name) const
    {
      return path + "/" + name;
    }

    /// The run that wrote there before and has died without an end, in words; empty if there was none.
    std::string dead_run() const
    {
      return lock ? lock->dead_owner() : "";
    }

    /// True on the rank that writes.
    bool is_writer() const
    {
      return writer;
    }

  private:
    /// Returns what is wrong, in words; empty if nothing is.
    std::string open();
    bool is_present() const;
    void tell_once(const std::string &name, const std::string &fault);

    const std::string path;
    const bool to_screen;
    const bool writer;
    const MPI_Comm communicator;
    std::unique_ptr<FolderLock> lock;
    std::ofstream log_file;
    std::set<std::string> refused; // files that the disk does not take at the moment
  };
} // namespace scree

#endif
