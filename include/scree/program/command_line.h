// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_program_command_line_h
#define scree_program_command_line_h

#include <mpi.h>

#include <string>
#include <vector>

namespace scree
{
  /// How a command line has ended.
  struct Ending
  {
    int exit_code;        ///< 0: done; 1: error; 3: stopped on request
    bool others_may_wait; ///< an error that may have struck this rank alone: no collective call after it, but MPI_Abort
  };

  /// Does what the command line `scree ARGUMENTS` asks for; results and errors go to standard output and standard
  /// error. Does not throw. Collective.
  Ending run_command_line(const std::vector<std::string> &arguments, MPI_Comm communicator);
} // namespace scree

#endif
