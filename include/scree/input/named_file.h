// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_named_file_h
#define scree_input_named_file_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// A file that an entry of a case names.
  struct NamedFile
  {
    std::string subsection, ///< path of the entry's subsection
        entry;              ///< its name
    std::string path;       ///< from the working folder
    std::string written;    ///< as the entry has it: from the folder of the file in which it stands
    std::string checksum;   ///< of the contents; empty if it is no regular file
  };

  /// Declares an entry that names a file to be read; `path` gets its path from the working folder. All such entries are
  /// declared so: their paths count from the case, and a checkpoint holds a checksum.
  void add_file_entry(dealii::ParameterHandler &prm,
                      const std::string &entry,
                      std::string &path,
                      const std::string &documentation);

  /// Whether add_file_entry() declared the entry that has this pattern.
  bool is_file_pattern(const std::string &pattern);

  /// The path from the working folder of a file that `reader` names.
  std::string path_beside(const std::string &reader, const std::string &file);

  /// The checksum of a file's contents, in hexadecimal digits; empty if it is no regular file that can be read.
  std::string checksum_of_file(const std::string &path);
} // namespace scree

#endif
