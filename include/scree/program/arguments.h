// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_program_arguments_h
#define scree_program_arguments_h

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
} // namespace scree

#endif
