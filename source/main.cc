// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/program/command_line.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>

int main(int argc, char *argv[])
{
  // Ranks that wait leave the processor to others, such as ranks of this run; on an idle machine that costs nothing.
  // Open MPI reads it when it starts; what the user has set stays.
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", /* overwrite */ 0);
  // Only the program's name: PETSc would report Scree's options as unknown ones.
  int n_words = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, argv, 1);
  const scree::Ending ending = scree::run_command_line({ argv + 1, argv + argc }, MPI_COMM_WORLD);
  if (ending.others_may_wait)
    MPI_Abort(MPI_COMM_WORLD, ending.exit_code);
  return ending.exit_code;
}
