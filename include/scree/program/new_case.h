// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_program_new_case_h
#define scree_program_new_case_h

#include <mpi.h>

#include <string>

namespace scree
{
  /// The scenes that a case may start from, one per line, each with its description.
  std::string list_of_scenes();

  /// Writes the case of a scene and the files that it names; its run folder is named after the case file.
  /// @param file to write; empty: SCENE.prm in the working folder. Its other files stand beside it.
  /// @param overwrite whether files that differ are replaced
  /// @return what was written and what to do next, in words
  ///
  /// Throws InputError if there is no such scene, or if a file is there already or cannot be written. Collective.
  std::string
  write_new_case(const std::string &scene, const std::string &file, const bool overwrite, const MPI_Comm communicator);
} // namespace scree

#endif
