// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/run_folder.h>
#include <scree/io/whole_file.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Removes the files of a folder whose path `is_old`.
    template <typename Choice>
    void remove_files(const std::filesystem::path &folder, const Choice &is_old)
    {
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file() && is_old(entry.path()))
          std::filesystem::remove(entry.path());
    }

    bool is_picture(const std::filesystem::path &file)
    {
      const auto kind = file.extension();
      return kind == ".vtu" || kind == ".pvtu" || kind == ".pvd";
    }

    bool is_map(const std::filesystem::path &file)
    {
      const auto kind = file.extension();
      return kind == ".asc" || kind == ".prj" || kind == ".tif" || kind == ".csv";
    }

    bool is_probe(const std::filesystem::path &file)
    {
      return file.filename().string().rfind("probe_", 0) == 0;
    }
  } // namespace


  RunFolder::RunFolder(const std::string &path, const bool to_screen, const MPI_Comm communicator)
      : path(path)
      , to_screen(to_screen)
      , writer(Utilities::MPI::this_mpi_process(communicator) == 0)
      , communicator(communicator)
  {
    const std::string fault = Utilities::MPI::broadcast(communicator, writer ? open() : std::string());
    require_entry(fault.empty(), "", "Output directory", path, fault);
  }


  std::string RunFolder::open()
  {
    std::error_code error;
    std::filesystem::create_directories(file("solution"), error);
    if (!error)
      log_file.open(file("log.txt"), std::ios::app);
    if (error || !log_file)
      return "the run cannot write there: " + (error ? error.message() : "no file can be written there") +
             ". Name a folder in which you may write.";
    lock = std::make_unique<FolderLock>(file("lock"));
    return lock->refusal();
  }


  void RunFolder::remove_old_results()
  {
    if (writer)
      {
        remove_files(file("solution"), is_picture);
        if (std::filesystem::is_directory(file("maps")))
          remove_files(file("maps"), is_map);
        std::filesystem::remove_all(file("checkpoint"));
        for (const std::string name : { "statistics", "statistics.csv" })
          std::filesystem::remove(file(name));
        remove_files(path, is_probe);
        log_file.close();
        log_file.open(file("log.txt"), std::ios::trunc);
      }
    MPI_Barrier(communicator); // Nobody may write before the old is gone.
  }


  void RunFolder::write(const std::string &name, const std::string &text) const
  {
    if (writer)
      write_whole_file(file(name), text);
  }


  bool RunFolder::is_present() const
  {
    return std::filesystem::is_directory(file("solution"));
  }


  void RunFolder::require_presence() const
  {
    throw_on_all_ranks(!writer || is_present()
                           ? ""
                           : entry_message("",
                                           "Output directory",
                                           path,
                                           "it was removed or renamed while the run wrote to it. Leave it alone until "
                                           "the run has ended, and start anew."),
                       communicator);
  }


  void RunFolder::try_to_write(const std::string &name, const std::function<void()> &write)
  {
    if (!writer)
      return;
    try
      {
        write();
        if (refused.erase(name) > 0)
          log(file(name) + ": is written again, and nothing of it is missing.");
      }
    catch (const FileError &error)
      {
        if (is_present()) // or else require_presence() reports it
          tell_once(name, std::string(error.what()) + " The run goes on, and tries again each time.");
      }
  }


  void RunFolder::log(const std::string &lines)
  {
    record(lines);
    if (writer && to_screen)
      std::cout << lines << std::endl;
  }


  void RunFolder::record(const std::string &lines)
  {
    if (!writer)
      return;
    log_file << lines << std::endl;
    if (!log_file)
      tell_once("log.txt", error_of_writing(file("log.txt"), lines.size() + 1).what());
    log_file.clear();
  }


  void RunFolder::tell_once(const std::string &name, const std::string &fault)
  {
    if (refused.insert(name).second)
      std::cerr << "scree: " + fault + '\n' << std::flush;
  }
} // namespace scree
