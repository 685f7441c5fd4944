// SPDX-License-Identifier: LGPL-2.1-or-later
// main NAME: runs the test of that name; without one, lists those of this program.
#include <deal.II/base/mpi.h>

#include <iostream>
#include <map>

#include "test.h"

namespace
{
using Tests = std::map<std::string, void (*)()>;

Tests &all_tests()
{
  static Tests tests;
  return tests;
}
} // namespace


UnitTest::UnitTest(const std::string &name, void (*run)())
{
  all_tests()[name] = run;
}


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (const auto test = all_tests().find(argc == 2 ? argv[1] : ""); test != all_tests().end())
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
        std::cout.rdbuf(nullptr);
      test->second();
      return 0;
    }
  std::cerr << "One of these tests is to be named:\n";
  for (const auto &test : all_tests())
    std::cerr << test.first << '\n';
  return 1;
}
