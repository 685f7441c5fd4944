// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_element_element_command_line_h
#define scree_element_element_command_line_h

#include <string>
#include <vector>

namespace scree
{
  /// Does what the command line `scree-element ARGUMENTS` asks for; results and errors go to standard output and
  /// standard error. Returns the exit code. Does not throw.
  int run_element_command_line(const std::vector<std::string> &arguments);
} // namespace scree

#endif
