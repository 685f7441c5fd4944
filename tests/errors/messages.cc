// SPDX-License-Identifier: LGPL-2.1-or-later
// messages LIST FOLDER RESULTS: runs the cases of errors.py one after the other in this process. A line of LIST has a
// name, scree or scree-element, and the arguments, with tabs between them. FOLDER has all files of the cases. Of each
// case come NAME.error.RANK, all that was written to standard error, NAME.codes, the exit codes of the ranks, and
// NAME.log, the log of a run in results, into RESULTS.
//
// A case finds what a program of its own would find: the files of FOLDER and nothing else, and its own communicator. On
// several ranks the cases run in the reverse order: what one of them left to the next would show.

#include <scree/element/element_command_line.h>
#include <scree/program/command_line.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <unistd.h>

namespace
{
  namespace fs = std::filesystem;

  struct Case
  {
    std::string name, program;
    std::vector<std::string> arguments;
  };


  std::vector<Case> listed_cases(const fs::path &list)
  {
    std::vector<Case> cases;
    std::ifstream in(list);
    for (std::string line; std::getline(in, line);)
      {
        const auto words = dealii::Utilities::split_string_list(line, '\t');
        cases.push_back({ words[0], words[1], { words.begin() + 2, words.end() } });
      }
    return cases;
  }


  std::set<fs::path> files_of(const fs::path &folder)
  {
    std::set<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder))
      files.insert(entry.path());
    return files;
  }


  /// Standard output goes nowhere and standard error, also that of libraries in C, to a file, as long as this lives.
  class CapturedStreams
  {
  public:
    explicit CapturedStreams(const fs::path &error)
        : output_before(redirect(STDOUT_FILENO, "/dev/null", O_WRONLY))
        , error_before(redirect(STDERR_FILENO, error, O_WRONLY | O_CREAT | O_TRUNC))
    {
    }

    ~CapturedStreams()
    {
      std::cout.flush();
      std::cerr.flush();
      std::fflush(nullptr);
      restore(STDOUT_FILENO, output_before);
      restore(STDERR_FILENO, error_before);
      std::cout.copyfmt(std::ios(nullptr));
      std::cerr.copyfmt(std::ios(nullptr));
      std::cout.clear();
      std::cerr.clear();
    }

  private:
    static int redirect(const int stream, const fs::path &file, const int flags)
    {
      std::cout.flush();
      const int before = dup(stream);
      const int target = open(file.c_str(), flags, 0666);
      if (before < 0 || target < 0 || dup2(target, stream) < 0)
        throw std::runtime_error(file.string() + " cannot be written");
      close(target);
      return before;
    }

    static void restore(const int stream, const int before)
    {
      dup2(before, stream);
      close(before);
    }

    int output_before, error_before;
  };


  /// Runs a case in the present folder, with standard error to a file; returns its exit code on this rank.
  int run(const Case &one, const fs::path &error)
  {
    if (one.program == "scree-element")
      {
        const CapturedStreams streams(error);
        return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0
                   ? scree::run_element_command_line(one.arguments)
                   : 1;
      }
    MPI_Comm communicator;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    scree::Ending ending;
    {
      const CapturedStreams streams(error);
      ending = scree::run_command_line(one.arguments, communicator);
    }
    if (ending.others_may_wait)
      {
        std::cerr << one.name + " stopped on a rank, others may wait. See " + error.string();
        MPI_Abort(MPI_COMM_WORLD, 1);
      }
    MPI_Comm_free(&communicator);
    return ending.exit_code;
  }


  int test(const fs::path &list, const fs::path &folder, const fs::path &results)
  {
    using namespace dealii::Utilities::MPI;
    const unsigned int rank = this_mpi_process(MPI_COMM_WORLD), n_ranks = n_mpi_processes(MPI_COMM_WORLD);

    std::vector<Case> cases = listed_cases(list);
    if (n_ranks > 1)
      std::reverse(cases.begin(), cases.end());

    const std::set<fs::path> files = files_of(folder);
    for (const Case &one : cases)
      {
        if (rank == 0)
          std::cout << one.name << std::endl; // the last one, should a case end this program
        MPI_Barrier(MPI_COMM_WORLD);
        fs::current_path(folder);
        const int code               = run(one, results / (one.name + ".error." + std::to_string(rank)));
        const std::vector<int> codes = gather(MPI_COMM_WORLD, code);
        if (rank == 0)
          {
            std::ofstream out(results / (one.name + ".codes"));
            for (const int code_of_rank : codes)
              out << code_of_rank << ' ';
            if (fs::exists("results/log.txt"))
              fs::copy_file("results/log.txt", results / (one.name + ".log"));
            for (const fs::path &file : files_of(folder))
              if (files.count(file) == 0)
                fs::remove_all(file);
          }
      }
    return 0;
  }
} // namespace


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 4)
    return 1;
  try
    {
      return test(argv[1], argv[2], argv[3]);
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  return 1;
}
