// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_program_command_line_h
#define scree_program_command_line_h

#include <mpi.h>

#include <string>
#include <vector>

namespace scree
{
  /// What a command line asks for.
  enum class Task
  {
    run,
    resume,
    safety,
    advise,
    print_parameters,
    new_case,
    version,
    help
  };

  /// A command line, read.
  struct Arguments
  {
    Task task = Task::run;          ///< what to do
    std::string case_file;          ///< to read; of Task::new_case to write; may be empty where the task needs none
    double accuracy = 0;            ///< of Task::advise, relative error
    std::string subsection;         ///< of Task::print_parameters; empty: all
    bool as_json           = false; ///< of Task::print_parameters
    bool names_of_sections = false; ///< of Task::print_parameters: no more than the names of the subsections
    std::string scene;              ///< of Task::new_case; empty: the list of scenes is asked for
    bool overwrite = false;         ///< of Task::new_case
  };

  /// Reads the words behind `scree`; options may stand before or after the case file. Throws InputError at an unknown
  /// option, with the closest one, and at words that are missing, too many or without effect.
  Arguments read_arguments(const std::vector<std::string> &words);

  /// The text of `--help`.
  std::string usage();

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
