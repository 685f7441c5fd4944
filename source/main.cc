// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/simulation.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace
{
  constexpr char usage[] = "Usage: scree case.prm             run a case\n"
                           "       scree case.prm --resume    go on from the newest checkpoint in its run folder\n"
                           "       scree --print-parameters   all entries with defaults and explanations\n"
                           "       scree --help               this text\n"
                           "In parallel: mpirun -np 2 scree case.prm\n";

  template <int dim>
  void run(scree::Parameters &parameters, const scree::Start start)
  {
    scree::Simulation<dim>(parameters, start, MPI_COMM_WORLD).run();
  }

  int run_case(const std::vector<std::string> &arguments, std::ostream &out)
  {
    if (arguments.size() == 1 && arguments[0] == "--help")
      {
        out << usage;
        return 0;
      }
    if (arguments.size() == 1 && arguments[0] == "--print-parameters")
      {
        scree::Parameters().print(out);
        return 0;
      }
    const bool resume = arguments.size() == 2 && arguments[1] == "--resume";
    if (arguments.empty() || arguments[0].rfind("--", 0) == 0 || (arguments.size() > 1 && !resume))
      throw scree::InputError(std::string("The command line does not read.\n") + usage);

    scree::Parameters  parameters(arguments[0]);
    const scree::Start start = resume ? scree::Start::resume : scree::Start::fresh;
    if (parameters.dimension == 2)
      run<2>(parameters, start);
    else
      run<3>(parameters, start);
    return 0;
  }
} // namespace


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                       rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);

  // All ranks meet the same input errors, so one speaks; anything else may strike a single rank.
  std::ostream silent(nullptr);
  try
    {
      return run_case({argv + 1, argv + argc}, rank == 0 ? std::cout : silent);
    }
  catch (const scree::InputError &error)
    {
      if (rank == 0)
        std::cerr << "scree: " << error.what() << std::endl;
      return 1;
    }
  catch (const dealii::ExceptionBase &error)
    {
      std::cerr << "scree: stopped on rank " << rank << ".";
      error.print_info(std::cerr);
      std::cerr << std::endl;
    }
  catch (const std::exception &error)
    {
      std::cerr << "scree: stopped on rank " << rank << ". " << error.what() << std::endl;
    }
  MPI_Abort(MPI_COMM_WORLD, 1);
}
