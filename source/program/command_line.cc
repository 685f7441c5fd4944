// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/program/command_line.h>
#include <scree/run/simulation.h>
#include <scree/version.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <sstream>

namespace scree
{
  namespace
  {
    constexpr char usage[] =
        "Usage: scree case.prm             run a case\n"
        "       scree case.prm --resume    continue from the newest checkpoint in its run folder\n"
        "       scree case.prm --advise [--accuracy 0.05]\n"
        "                                  regime, estimated cost and recommendations\n"
        "       scree --print-parameters [SUBSECTION]\n"
        "                                  all entries with defaults and descriptions, or those of a subsection\n"
        "       scree --print-parameters --json\n"
        "                                  all entries with their types, as JSON\n"
        "       scree --version            version and commit, libraries, compiler\n"
        "       scree --help, -h           this text\n"
        "In parallel: mpirun -np 2 scree case.prm\n"
        "Exit code: 0 finished, 1 error, 3 stopped on request before the end time (--resume continues, unless the run "
        "was settling)";

    constexpr int exit_code_of_a_stop = 3;

    void check_command_line(const std::vector<std::string> &arguments, const bool resume)
    {
      std::string fault;
      if (arguments.empty())
        fault = "a case file is missing.";
      else if (arguments[0].rfind("-", 0) == 0)
        fault =
            "the first argument is \"" + arguments[0] + "\", which is neither a case file nor an option for itself.";
      else if (arguments.size() > 1 && !resume)
        fault = "after the case file, \"" + arguments[1] + "\" does not read.";
      if (!fault.empty())
        throw InputError("command line: " + fault + '\n' + usage);
    }

    /// The relative error that `--advise case.prm --accuracy VALUE` asks for.
    double wanted_accuracy(const std::vector<std::string> &arguments)
    {
      std::string fault;
      double accuracy = default_accuracy;
      if (arguments.size() < 2 || arguments[1].rfind("-", 0) == 0)
        fault = "after \"--advise\", a case file is missing.";
      else if (arguments.size() > 2 && arguments[2] != "--accuracy")
        fault = "after the case file, \"" + arguments[2] + "\" does not read.";
      else if (arguments.size() == 3)
        fault = "after \"--accuracy\", a relative error is missing.";
      else if (arguments.size() > 4)
        fault = "after the accuracy, \"" + arguments[4] + "\" does not read.";
      else if (arguments.size() == 4)
        {
          std::istringstream number(arguments[3]);
          if (!(number >> accuracy) || !number.eof() || !(accuracy > 0 && accuracy < 1))
            fault = "the accuracy is \"" + arguments[3] + "\", but must be a relative error between 0 and 1.";
        }
      if (!fault.empty())
        throw InputError("command line: " + fault + '\n' + usage);
      return accuracy;
    }

    /// Calls `act` with a number of the type of the case's dimension; completes its errors.
    template <typename Function>
    void in_its_dimension(Parameters &parameters, const Function &act)
    {
      try
        {
          if (parameters.dimension == 2)
            act(std::integral_constant<int, 2>());
          else
            act(std::integral_constant<int, 3>());
        }
      catch (const EntryError &error)
        {
          throw parameters.error(error);
        }
      catch (const ValueError &error)
        {
          throw ValueError(parameters.error(EntryError(error.what())).what());
        }
    }

    /// Options may stand before the case file or after it: here, `--advise` comes first.
    std::vector<std::string> with_advise_first(std::vector<std::string> arguments)
    {
      if (const auto advise = std::find(arguments.begin(), arguments.end(), "--advise"); advise != arguments.end())
        std::rotate(arguments.begin(), advise, advise + 1);
      return arguments;
    }


    int run_case(const std::vector<std::string> &arguments, const MPI_Comm communicator, std::ostream &out)
    {
      if (arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h"))
        {
          out << usage << '\n';
          return 0;
        }
      if (arguments.size() == 1 && arguments[0] == "--version")
        {
          out << version_text();
          return 0;
        }
      if (arguments.size() <= 2 && !arguments.empty() && arguments[0] == "--print-parameters")
        {
          Parameters parameters;
          if (arguments.size() == 1)
            parameters.print(out);
          else if (arguments[1] == "--json")
            parameters.print_json(out);
          else
            parameters.print_subsection(arguments[1], out);
          return 0;
        }
      if (!arguments.empty() && arguments[0] == "--advise")
        {
          const double accuracy = wanted_accuracy(arguments);
          Parameters parameters(arguments[1]);
          in_its_dimension(parameters, [&](const auto dim) { advise<dim()>(parameters, accuracy, communicator, out); });
          return 0;
        }
      const bool resume = arguments.size() == 2 && arguments[1] == "--resume";
      check_command_line(arguments, resume);
      Parameters parameters(arguments[0]);
      const Start start = resume ? Start::resume : Start::fresh;
      End end           = End::complete;
      in_its_dimension(parameters,
                       [&](const auto dim) { end = Simulation<dim()>(parameters, start, communicator).run(); });
      return end == End::stopped ? exit_code_of_a_stop : 0;
    }
  } // namespace


  Ending run_command_line(const std::vector<std::string> &arguments, const MPI_Comm communicator)
  {
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);

    // All ranks meet the same input errors, so one speaks; anything else may strike a single rank.
    std::ostream silent(nullptr);
    const auto tell = [&](const std::string &fault) {
      std::cerr << "scree: stopped" + (n_ranks > 1 ? " on rank " + std::to_string(rank) : "") + ": " + fault + "\n";
    };
    Ending ending{ 1, false };
    try
      {
        ending.exit_code = run_case(with_advise_first(arguments), communicator, rank == 0 ? std::cout : silent);
      }
    catch (const InputError &error)
      {
        if (rank == 0)
          std::cerr << "scree: " + std::string(error.what()) + "\n";
      }
    catch (const dealii::ExceptionBase &error)
      {
        tell(plain_text(error));
        ending.others_may_wait = n_ranks > 1;
      }
    catch (const std::exception &error)
      {
        tell(error.what());
        ending.others_may_wait = n_ranks > 1;
      }
    return ending;
  }
} // namespace scree
