// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_number_table_h
#define scree_input_number_table_h

#include <fstream>
#include <string>
#include <vector>

namespace scree
{
  /// Opens a file that an entry names, behind a mark of byte order if it begins with one; throws EntryError if that
  /// fails.
  /// @param name entry_name() and the file's, for the message: `entry "Record" = a.csv: `
  std::ifstream open_file(const std::string &file, const std::string &name);

  /// What the first column of a table must be.
  enum class FirstColumn
  {
    ascending,
    any
  };

  /// Reads a file of numbers, a row a line, separated by commas or blanks; what follows a # is a comment, and the first
  /// line may name the columns.
  ///
  /// @param where entry_name() of the entry that names the file
  /// @param columns names with unit, for messages: { "x (m)", "y (m)" }
  /// Throws EntryError if there are not at least two such rows.
  std::vector<std::vector<double>> read_number_table(const std::string &file,
                                                     const std::string &where,
                                                     const std::vector<std::string> &columns,
                                                     const FirstColumn first_column = FirstColumn::ascending);
} // namespace scree

#endif
