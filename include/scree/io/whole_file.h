// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_whole_file_h
#define scree_io_whole_file_h

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// A file that the disk did not take, or does not give back; what() names file, cause and remedy. It may strike a
  /// single rank.
  class FileError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// The FileError after a call has failed that was to write `n_bytes` to `file`: the cause is errno's.
  FileError error_of_writing(const std::string &file, const std::uintmax_t n_bytes);

  /// Replaces `file` by one of this content, so that at any instant the old or the new one is there as a whole: writes
  /// beside it, checks, brings it to the disk (fsync) and renames. Throws FileError; the old one then stays.
  void write_whole_file(const std::string &file, std::string content);

  /// Path and content of a file.
  using FileContent = std::pair<std::string, std::string>;

  /// The same of several files of a folder: they get their names in this order, when all of them are on the disk.
  void write_whole_files(const std::vector<FileContent> &files);

  /// The content of `file`. Throws FileError.
  std::string read_whole_file(const std::string &file);

  /// Writes `content` at the end of `file`, which has `size` bytes, or to a new file if that is 0. Throws FileError,
  /// also if a file that was begun is gone; it then is as long as before.
  void append_to_file(const std::string &file, const std::uintmax_t size, const std::string &content);

  /// Shortens `file` to `size` bytes. Throws FileError.
  void cut_file(const std::string &file, const std::uintmax_t size);

  /// Brings to the disk what was appended to `file`. Throws FileError.
  void sync_file(const std::string &file);

  /// Brings to the disk which files a folder has: after a rename or removal. Throws FileError.
  void sync_folder(const std::string &folder);
} // namespace scree

#endif
