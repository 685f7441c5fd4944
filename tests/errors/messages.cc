// SPDX-License-Identifier: LGPL-2.1-or-later
// messages SOURCE SCRATCH: all wrong cases of tests/errors and the command lines below, one
// after the other in this process. Each X.prm must end at once with what X.expected says, and nothing else, on standard
// error of all ranks together, and with exit code 1, or 0 if nothing is expected. Those that do not are listed at the
// end.
//
// A case finds what a program of its own would find: a folder with the files of SOURCE and nothing else, its own
// communicator, and this process's streams and signal handlers as they were. On several ranks the cases run in the
// reverse order: what one of them left to the next would show.

#include <scree/element/element_command_line.h>
#include <scree/program/command_line.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <unistd.h>

namespace
{
  namespace fs    = std::filesystem;
  using Arguments = std::vector<std::string>;

  struct Case
  {
    std::string name; ///< of its .expected
    Arguments arguments;
    bool is_for_element = false; ///< scree-element, which has one rank
  };

  const std::vector<Case> command_lines{
    { "command_line_empty", {} },
    { "command_line_option", { "--fast" } },
    { "command_line_option_near", { "valid.prm", "--resum" } },
    { "command_line_option_one_dash", { "-advise", "valid.prm" } },
    { "command_line_two_tasks", { "--resume", "valid.prm", "--advise" } },
    { "command_line_accuracy_alone", { "valid.prm", "--accuracy", "0.1" } },
    { "command_line_version_of_case", { "--version", "valid.prm" } },
    { "command_line_print_two", { "--print-parameters", "Time", "step" } },
    { "command_line_print_json_subsection", { "--print-parameters", "Mesh", "--json" } },
    { "command_line_print_nested", { "--print-parameters", "Initial state" } },
    { "command_line_new_scene", { "--new", "colum" } },
    { "command_line_second_argument", { "valid.prm", "resume" } },
    { "command_line_advise_without_case", { "--advise", "--accuracy", "0.1" } },
    { "command_line_advise_second_case", { "--advise", "valid.prm", "other.prm" } },
    { "command_line_advise_accuracy_missing", { "--advise", "valid.prm", "--accuracy" } },
    { "command_line_advise_accuracy_zero", { "--advise", "valid.prm", "--accuracy", "0" } },
    { "command_line_advise_accuracy_text", { "--advise", "valid.prm", "--accuracy", "5%" } },
    { "command_line_advise_last", { "valid.prm", "--accuracy=0", "--advise" } },
    { "command_line_print_no_subsection", { "--print-parameters", "Sol" } },
    { "command_line_print_subsection", { "--print-parameters", "Soil/Nor-Sand" } },
    { "command_line_advise_inflow", { "--advise", "command_line_advise_inflow.part" } },
    { "file_missing", { "no_such_case.prm" } },
    { "file_is_folder", { "." } },
    { "resume_without_checkpoint", { "--resume", "valid.prm" } },
    { "mass_scaling_and_safety", { "--safety", "mass_scaling_and_safety.part" } },
    { "safety_nor_sand", { "--safety", "safety_nor_sand.part" } },
    { "command_line_element_option", { "--hepl" }, /* is_for_element */ true },
    { "element_rigid", { "element_rigid.part" }, /* is_for_element */ true },
  };


  std::string content(const fs::path &file)
  {
    std::ifstream in(file);
    return { std::istreambuf_iterator<char>(in), {} };
  }


  std::vector<Case> all_cases(const fs::path &source)
  {
    std::vector<Case> cases = command_lines;
    for (const auto &entry : fs::directory_iterator(source))
      if (const std::string name = entry.path().stem(); entry.path().extension() == ".prm")
        cases.push_back({ name, { name + ".prm" } });
    std::sort(cases.begin(), cases.end(), [](const Case &a, const Case &b) { return a.name < b.name; });
    return cases;
  }


  /// X.expected that no case is compared with.
  std::vector<std::string> left_over(const fs::path &source, const std::vector<Case> &cases)
  {
    std::set<std::string> names;
    for (const Case &one : cases)
      names.insert(one.name);
    std::vector<std::string> left;
    for (const auto &entry : fs::directory_iterator(source))
      if (const std::string name = entry.path().stem();
          entry.path().extension() == ".expected" && names.count(name) == 0)
        left.push_back(name + ".expected");
    return left;
  }


  /// The folder of the cases, with the files of `source` that cases read.
  class CaseFolder
  {
  public:
    CaseFolder(const fs::path &source, const fs::path &folder)
        : folder(folder)
    {
      fs::remove_all(folder);
      fs::create_directories(folder);
      for (const auto &entry : fs::directory_iterator(source))
        if (const std::string type = entry.path().extension(); type == ".prm" || type == ".part" || type == ".tif" ||
                                                               type == ".prj" || type == ".vrt" || type == ".geojson")
          {
            originals[entry.path().filename()] = entry.path();
            copy(entry.path());
          }
    }

    /// As it was at first.
    void restore()
    {
      std::set<std::string> missing;
      for (const auto &original : originals)
        missing.insert(original.first);
      for (const auto &entry : fs::directory_iterator(folder))
        if (const std::string name = entry.path().filename(); originals.count(name) && is_as_written(entry.path()))
          missing.erase(name);
        else
          fs::remove_all(entry.path());
      for (const std::string &name : missing)
        copy(originals[name]);
    }

  private:
    void copy(const fs::path &original)
    {
      const fs::path file = folder / original.filename();
      fs::copy_file(original, file);
      written[file] = fs::last_write_time(file);
    }

    bool is_as_written(const fs::path &file)
    {
      return fs::is_regular_file(fs::symlink_status(file)) && fs::last_write_time(file) == written[file];
    }

    fs::path folder;
    std::map<std::string, fs::path> originals;
    std::map<fs::path, fs::file_time_type> written;
  };


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


  /// Puts back the handlers of the signals that a run listens to.
  class SignalHandlers
  {
  public:
    SignalHandlers()
    {
      for (std::size_t i = 0; i < signals.size(); ++i)
        sigaction(signals[i], nullptr, &before[i]);
    }

    ~SignalHandlers()
    {
      for (std::size_t i = 0; i < signals.size(); ++i)
        sigaction(signals[i], &before[i], nullptr);
    }

  private:
    static constexpr std::array<int, 4> signals{ { SIGHUP, SIGTERM, SIGUSR1, SIGINT } };
    std::array<struct sigaction, 4> before;
  };


  /// Runs a case in the present folder, with standard error to a file; returns its exit code on this rank.
  int run(const Case &one, const fs::path &error)
  {
    if (one.is_for_element)
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
      const SignalHandlers handlers;
      ending = scree::run_command_line(one.arguments, communicator);
    }
    if (ending.others_may_wait)
      {
        std::cerr << one.name + " stopped on a rank, others may wait. " + content(error);
        MPI_Abort(MPI_COMM_WORLD, 1);
      }
    MPI_Comm_free(&communicator);
    return ending.exit_code;
  }


  /// What is not as expected, or "".
  std::string fault_of(const fs::path &expected, const std::vector<int> &codes, const std::string &got)
  {
    if (!fs::exists(expected))
      return "there is no " + expected.filename().string() + "; standard error was:\n" + got;
    std::string fault;
    const std::string wanted = content(expected);
    const int wanted_code    = wanted.empty() ? 0 : 1;
    if (got != wanted)
      fault += "expected:\n" + wanted + "got:\n" + got;
    for (std::size_t rank = 0; rank < codes.size(); ++rank)
      if (codes[rank] != wanted_code)
        fault += "The exit code of rank " + std::to_string(rank) + " is " + std::to_string(codes[rank]) +
                 " and should be " + std::to_string(wanted_code) + ".\n";
    return fault;
  }


  int test(const fs::path &source, const fs::path &scratch)
  {
    using namespace dealii::Utilities::MPI;
    const unsigned int rank = this_mpi_process(MPI_COMM_WORLD), n_ranks = n_mpi_processes(MPI_COMM_WORLD);
    const fs::path folder = scratch / "cases", error = scratch / ("error." + std::to_string(rank));

    std::vector<Case> cases = all_cases(source);
    if (n_ranks > 1)
      std::reverse(cases.begin(), cases.end());

    std::unique_ptr<CaseFolder> files;
    if (rank == 0)
      files = std::make_unique<CaseFolder>(source, folder);
    std::vector<std::string> failed;
    for (const Case &one : cases)
      {
        if (rank == 0)
          std::cout << one.name << std::endl; // the last one, should a case end this program
        MPI_Barrier(MPI_COMM_WORLD);
        fs::current_path(folder);
        const int code                       = run(one, error);
        const std::vector<int> codes         = gather(MPI_COMM_WORLD, code);
        const std::vector<std::string> texts = gather(MPI_COMM_WORLD, content(error));
        if (rank == 0)
          {
            std::string got;
            for (const std::string &text : texts)
              got += text;
            if (const std::string fault = fault_of(source / (one.name + ".expected"), codes, got); !fault.empty())
              {
                std::cout << fault << std::flush;
                failed.push_back(one.name);
              }
            files->restore();
          }
      }

    if (rank == 0)
      {
        constexpr unsigned int fewest_cases = 300;
        if (cases.size() < fewest_cases)
          failed.push_back("the number of cases, " + std::to_string(cases.size()));
        for (const std::string &name : left_over(source, cases))
          failed.push_back(name + ", to which no case belongs");
        std::cout << '\n' << cases.size() << " cases, " << failed.size() << " not as expected:\n";
        for (const std::string &name : failed)
          std::cout << "  " << name << '\n';
      }
    return broadcast(MPI_COMM_WORLD, failed.empty() ? 0 : 1);
  }
} // namespace


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 3)
    return 1;
  try
    {
      return test(fs::absolute(argv[1]), fs::absolute(argv[2]));
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  return 1;
}
