// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/output/run_folder.h>
#include <scree/output/whole_file.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    void remove_pictures(const std::filesystem::path &folder)
    {
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (const auto kind = entry.path().extension(); kind == ".vtu" || kind == ".pvtu" || kind == ".pvd")
          std::filesystem::remove(entry.path());
    }
  } // namespace


  RunFolder::RunFolder(const std::string &path, const bool to_screen, const MPI_Comm communicator)
      : path(path)
      , to_screen(to_screen)
      , writer(Utilities::MPI::this_mpi_process(communicator) == 0)
      , communicator(communicator)
  {
    std::string fault;
    if (writer)
      {
        std::error_code error;
        std::filesystem::create_directories(path + "/solution", error);
        if (error)
          fault = error.message();
        else
          {
            log_file.open(file("log.txt"), std::ios::app);
            if (!log_file)
              fault = "no file can be written there";
          }
      }
    fault = Utilities::MPI::broadcast(communicator, fault);
    require_entry(fault.empty(),
                  "",
                  "Output directory",
                  path,
                  "the run cannot write there: " + fault + ". Name a folder in which you may write.");
  }


  void RunFolder::remove_old_results()
  {
    if (writer)
      {
        remove_pictures(file("solution"));
        std::filesystem::remove_all(file("checkpoint"));
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


  void RunFolder::log(const std::string &line)
  {
    if (!writer)
      return;
    log_file << line << std::endl;
    if (to_screen)
      std::cout << line << std::endl;
  }
} // namespace scree
