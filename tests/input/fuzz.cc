// SPDX-License-Identifier: LGPL-2.1-or-later
// fuzz FOLDERS COUNT RIGHT: reads the cases FOLDERS/0/case.prm, FOLDERS/1/case.prm, ... of fuzz.py, of which the first
// RIGHT must be accepted. Each of the others must be, too, or be refused with one line that begins with the file at
// fault. What is accepted and small is also built and filled with points. A crash, a hang (20 s) and any other
// exception fail.

#include <scree/case/case_checks.h>
#include <scree/model/scene.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <filesystem>
#include <iostream>

using namespace scree;

namespace
{
  template <int dim>
  void build_if_small(const Parameters &parameters)
  {
    MemoryEstimate estimate;
    on_all_ranks(MPI_COMM_WORLD, [&] { estimate = estimate_memory<dim>(parameters); });
    constexpr double small = 3e4;
    if (estimate.n_cells + estimate.n_soil_points + estimate.n_water_points < small)
      Scene<dim>(parameters, MPI_COMM_WORLD).fill();
  }

  /// What is wrong with how the case was received; empty: nothing.
  std::string judge(const std::string &file, bool &accepted)
  {
    std::unique_ptr<Parameters> parameters;
    std::string message;
    try
      {
        try
          {
            parameters = std::make_unique<Parameters>(file);
            if (parameters->dimension == 2)
              build_if_small<2>(*parameters);
            else
              build_if_small<3>(*parameters);
            accepted = true;
            return "";
          }
        catch (const EntryError &error)
          {
            if (!parameters)
              throw;
            message = parameters->error(error).what();
          }
      }
    catch (const InputError &error)
      {
        message = error.what();
      }
    catch (const std::exception &error)
      {
        return std::string("another exception: ") + error.what();
      }
    const std::size_t colon = message.find(": "), comma = message.find(", line");
    const std::string place = message.substr(0, std::min(colon, comma));
    if (place != file && !std::filesystem::exists(place) &&
        message.find("no file that can be read") == std::string::npos)
      return "no file is named: " + message;
    if (message.find("----") != std::string::npos || message.size() < place.size() + 10)
      return "not a message for users: " + message;
    return "";
  }
} // namespace


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int n_cases = std::stoul(argv[2]), n_right = std::stoul(argv[3]);
  unsigned int n_accepted = 0, n_faults = 0;
  for (unsigned int i = 0; i < n_cases; ++i)
    {
      std::filesystem::current_path(std::filesystem::path(argv[1]) / std::to_string(i));
      alarm(20); // ends the program
      bool accepted     = false;
      std::string fault = judge("case.prm", accepted);
      if (i < n_right && !accepted)
        fault += " It must be accepted.";
      n_accepted += accepted;
      n_faults += !fault.empty();
      if (!fault.empty())
        std::cout << "Case " << i << ": " << fault << std::endl;
    }
  std::cout << n_cases << " cases, of them accepted " << n_accepted << ", wrongly received " << n_faults << '\n';
  // Were nearly all refused at their first statements, the faults would hide what is behind these.
  return n_faults > 0 || n_accepted < n_cases / 20;
}
