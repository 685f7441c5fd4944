// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_byte_reader_h
#define scree_io_byte_reader_h

#include <scree/io/whole_file.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace scree
{
  /// Appends numbers to a file's content, as they are in memory.
  template <typename Value>
  void append_bytes(std::string &buffer, const Value *values, const std::size_t n)
  {
    buffer.append(reinterpret_cast<const char *>(values), n * sizeof(Value));
  }

  /// Takes numbers from a file's content, as append_bytes() put them there.
  class ByteReader
  {
  public:
    /// Reads from the start.
    /// @param file name, for messages
    /// @param content of the file; must live on
    ByteReader(const std::string &file, const std::string &content)
        : file(file)
        , next(content.data())
        , end(content.data() + content.size())
    {
    }

    /// Reads the next `n` numbers. Throws FileError if there are fewer.
    template <typename Value>
    void take(Value *values, const std::size_t n)
    {
      if (n > std::size_t(end - next) / sizeof(Value))
        throw FileError(file + ": ends too early");
      std::memcpy(values, next, n * sizeof(Value));
      next += n * sizeof(Value);
    }

    /// Reads the next number. Throws FileError if there is none.
    std::uint64_t take()
    {
      std::uint64_t value;
      take(&value, 1);
      return value;
    }

  private:
    const std::string file;
    const char *next, *const end;
  };
} // namespace scree

#endif
