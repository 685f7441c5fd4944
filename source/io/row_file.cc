// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/row_file.h>
#include <scree/io/whole_file.h>

#include <filesystem>

namespace scree
{
  RowFile::RowFile(const std::string &file)
      : file(file)
  {
  }


  void RowFile::append(const std::string &rows)
  {
    waiting += rows;
    append_to_file(file, size, waiting);
    size += waiting.size();
    waiting.clear();
  }


  void RowFile::sync() const
  {
    if (size > 0)
      sync_file(file);
  }


  std::string RowFile::cut()
  {
    std::error_code is_missing;
    const std::uintmax_t found = std::filesystem::file_size(file, is_missing);
    const std::uint64_t wanted = size;
    if (is_missing)
      size = 0;
    else if (found >= size)
      cut_file(file, size);
    else
      {
        size = read_whole_file(file).rfind('\n') + 1; // 0 if there is none
        cut_file(file, size);
      }
    return size == wanted ? ""
                          : file + " has lost " + std::to_string(wanted - size) + " of the " + std::to_string(wanted) +
                                " bytes that it had at the checkpoint: rows are missing there.";
  }
} // namespace scree
