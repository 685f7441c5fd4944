// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/program/arguments.h>
#include <scree/program/command_line.h>
#include <scree/program/new_case.h>
#include <scree/run/phases.h>
#include <scree/run/safety.h>
#include <scree/version.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace scree
{
  namespace
  {
    constexpr int exit_code_of_a_stop = 3;

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

    void print_parameters(const Arguments &arguments, std::ostream &out)
    {
      Parameters parameters = arguments.case_file.empty() ? Parameters() : Parameters(arguments.case_file);
      if (arguments.names_of_sections)
        parameters.print_sections(arguments.subsection, out);
      else if (arguments.as_json)
        parameters.print_json(out);
      else if (arguments.subsection.empty())
        parameters.print(out);
      else
        parameters.print_subsection(arguments.subsection, out);
    }


    int run_case(const Arguments &arguments, const MPI_Comm communicator)
    {
      Parameters parameters(arguments.case_file);
      const Start start = arguments.task == Task::resume ? Start::resume : Start::fresh;
      End end           = End::complete;
      in_its_dimension(parameters,
                       [&](const auto dim) { end = run_in_phases<dim()>(parameters, start, communicator); });
      return end == End::stopped ? exit_code_of_a_stop : 0;
    }


    int find_safety_of_case(const Arguments &arguments, const MPI_Comm communicator)
    {
      Parameters parameters(arguments.case_file);
      End end = End::complete;
      in_its_dimension(parameters, [&](const auto dim) { end = find_safety<dim()>(parameters, communicator); });
      return end == End::stopped ? exit_code_of_a_stop : 0;
    }


    int perform(const Arguments &arguments, const MPI_Comm communicator, std::ostream &out)
    {
      switch (arguments.task)
        {
        case Task::help:
          out << usage();
          return 0;
        case Task::version:
          out << version_text();
          return 0;
        case Task::print_parameters:
          print_parameters(arguments, out);
          return 0;
        case Task::new_case:
          out << (arguments.scene.empty()
                      ? list_of_scenes()
                      : write_new_case(arguments.scene, arguments.case_file, arguments.overwrite, communicator));
          return 0;
        case Task::safety:
          return find_safety_of_case(arguments, communicator);
        case Task::advise:
          {
            Parameters parameters(arguments.case_file);
            in_its_dimension(parameters,
                             [&](const auto dim) { advise<dim()>(parameters, arguments.accuracy, communicator, out); });
            return 0;
          }
        default:
          return run_case(arguments, communicator);
        }
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
        ending.exit_code = perform(read_arguments(arguments), communicator, rank == 0 ? std::cout : silent);
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
