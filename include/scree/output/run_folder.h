// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_output_run_folder_h
#define scree_output_run_folder_h

#include <mpi.h>

#include <fstream>
#include <string>

namespace scree
{
  /// The folder a run writes to, and its log. Only rank 0 touches the disk.
  class RunFolder
  {
  public:
    /// Makes the folder and its folder `solution`. Collective; throws EntryError on all ranks if it is not writable.
    RunFolder(const std::string &path, const bool to_screen, const MPI_Comm communicator);

    /// Removes log, pictures and checkpoints of an earlier run. Collective.
    void remove_old_results();

    /// Writes a file of the folder with the given text, see write_whole_file().
    void write(const std::string &name, const std::string &text) const;

    /// Adds a line to `log.txt` and, if wanted, to the screen.
    void log(const std::string &line);

    std::string file(const std::string &name) const
    {
      return path + "/" + name;
    }

    /// True on the rank that writes.
    bool is_writer() const
    {
      return writer;
    }

  private:
    const std::string path;
    const bool to_screen;
    const bool writer;
    const MPI_Comm communicator;
    std::ofstream log_file;
  };
} // namespace scree

#endif
