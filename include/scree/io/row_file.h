// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_row_file_h
#define scree_io_row_file_h

#include <cstdint>
#include <string>

namespace scree
{
  /// A text file that grows by rows: what stands there is not touched again, and a resumed run goes on from the row at
  /// which its checkpoint was written. One rank owns and writes it; on others it only travels through checkpoints.
  class RowFile
  {
  public:
    /// @param file path; it is made with the first row
    explicit RowFile(const std::string &file);

    /// Whether there is no row yet: the first one brings the head of the file along.
    bool is_empty() const
    {
      return size == 0 && waiting.empty();
    }

    /// Whether the disk has taken all rows.
    bool is_complete() const
    {
      return waiting.empty();
    }

    /// Adds rows, which end with an end of line. Throws FileError if the disk does not take them: then they wait, and
    /// are written before the next ones.
    void append(const std::string &rows);

    /// Brings the rows to the disk, before a checkpoint counts on them. Throws FileError.
    void sync() const;

    /// After the state has been read from a checkpoint: cuts off the rows that were written after it. Returns what is
    /// missing of those written before, in words; usually nothing. Throws FileError.
    std::string cut();

    /// Saves or loads the size of the file, bytes, and the rows that wait (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &size &waiting;
    }

  private:
    const std::string file;
    std::uint64_t size = 0; // bytes that the disk has taken
    std::string waiting;    // rows that it has not
  };
} // namespace scree

#endif
