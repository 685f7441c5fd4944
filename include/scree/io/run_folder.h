// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_run_folder_h
#define scree_io_run_folder_h

#include <scree/input/input_error.h>
#include <scree/io/files.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <set>

namespace scree
{
  /// The folder a run writes to, its lock and its log. Only rank 0 touches the disk.
  class RunFolder
  {
  public:
    /// Makes the folder and its folder `solution`, and keeps other runs out as long as this lives; what is there stays.
    /// Collective; throws EntryError on all ranks if it is not writable, or if another run writes there.
    RunFolder(const std::string &path, const bool to_screen, const MPI_Comm communicator)
        : path(path)
        , to_screen(to_screen)
        , writer(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        , communicator(communicator)
    {
      const std::string fault = dealii::Utilities::MPI::broadcast(communicator, writer ? open() : std::string());
      require_entry(fault.empty(), { "", "Output directory", path }, fault);
    }

    /// Removes log, rows, pictures, maps and checkpoints of an earlier run. Collective.
    void remove_old_results();

    /// Writes a file of the folder with the given text, see write_whole_files().
    void write(const std::string &name, const std::string &text) const
    {
      if (writer)
        write_whole_files({ { file(name), text } });
    }

    /// Throws EntryError on all ranks if somebody has removed the folder. Collective.
    void require_presence() const
    {
      throw_on_all_ranks(
          !writer || is_present()
              ? ""
              : entry_message({ "", "Output directory", path },
                              "it was removed or renamed while the run wrote to it. Leave it alone until "
                              "the run has ended, and start anew."),
          communicator);
    }

    /// Lets `write` write a file that can wait. If the disk does not take it, standard error has that once, and the run
    /// goes on.
    void try_to_write(const std::string &name, const std::function<void()> &write);

    /// Adds lines to `log.txt` and, if asked, to the screen.
    void log(const std::string &lines)
    {
      record(lines);
      if (writer && to_screen)
        std::cout << lines << std::endl;
    }

    /// Adds lines to `log.txt` alone: details that the screen leaves out.
    void record(const std::string &lines)
    {
      if (!writer)
        return;
      log_file << lines << std::endl;
      if (!log_file)
        tell_once("log.txt", error_of_writing(file("log.txt"), lines.size() + 1).what());
      log_file.clear();
    }

    /// Path of a file in the folder.
    std::string file(const std::string &name) const
    {
      return path + "/" + name;
    }

    /// The run that wrote there before and has died without an end, in words; empty if there was none.
    std::string dead_run() const
    {
      return lock ? lock->dead_owner : "";
    }

    /// True on the rank that writes.
    bool is_writer() const
    {
      return writer;
    }

  private:
    /// Returns what is wrong, in words; empty if nothing is.
    std::string open()
    {
      std::error_code error;
      std::filesystem::create_directories(file("solution"), error);
      if (!error)
        log_file.open(file("log.txt"), std::ios::app);
      if (error || !log_file)
        return "the run cannot write there: " + (error ? error.message() : "no file can be written there") +
               ". Name a folder in which you may write.";
      lock = std::make_unique<FolderLock>(file("lock"));
      return lock->refusal;
    }
    bool is_present() const
    {
      return std::filesystem::is_directory(file("solution"));
    }
    void tell_once(const std::string &name, const std::string &fault)
    {
      if (refused.insert(name).second)
        std::cerr << "scree: " + fault + '\n' << std::flush;
    }

    const std::string path;
    const bool to_screen;
    const bool writer;
    const MPI_Comm communicator;
    std::unique_ptr<FolderLock> lock;
    std::ofstream log_file;
    std::set<std::string> refused; // files that the disk does not take at the moment
  };

  /// The line that names the columns of a table, such as `Time (s),Front 99.5 % (m)`.
  std::string csv_head(const std::vector<std::string> &columns);

  /// A row of a table, with its end of line: numbers with 13 digits, separated by commas; `nan` where there is none.
  std::string csv_row(const std::vector<double> &values);

  /// A table of a run that grows by rows, `NAME.csv`. It goes on where it was when a run is resumed, see RowFile. The
  /// rank that writes holds the rows.
  class TableFile
  {
  public:
    /// @param folder is kept by reference
    /// @param name of the file in the folder, without its ending
    TableFile(RunFolder &folder, const std::string &name)
        : folder(folder)
        , name(name + ".csv")
        , file(folder.file(this->name))
    {
    }

    /// Adds rows, below the names of the columns if they are the first ones. If the disk does not take them, standard
    /// error has that once, and they are written with the next ones.
    void append(const std::vector<std::string> &columns, const std::vector<std::vector<double>> &rows);

    /// Brings the rows to the disk, before a checkpoint counts on them.
    void sync()
    {
      folder.try_to_write(name, [this] { file.sync(); });
    }

    /// After the state has been read from a checkpoint: cuts off the rows that were written after it.
    void cut()
    {
      if (const std::string missing = folder.is_writer() ? file.cut() : std::string(); !missing.empty())
        folder.log(missing);
    }

    /// Writes rows that the disk did not take. Throws FileError if it still refuses them.
    void complete()
    {
      if (folder.is_writer() && !file.is_complete())
        file.append("");
    }

    /// Saves or loads the state of the file (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &file;
    }

  private:
    RunFolder &folder;
    const std::string name;
    RowFile file;
  };
} // namespace scree

#endif
