// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/whole_file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace scree
{
  namespace
  {
    /// A file that is open for writing, or a folder: closed at the latest when this dies.
    class Descriptor
    {
    public:
      Descriptor(const std::string &path, const int flags)
          : number(::open(path.c_str(), flags | O_CLOEXEC, 0666))
      {
      }
      ~Descriptor()
      {
        close();
      }

      bool write(const std::string &content)
      {
        const char *next = content.data(), *const end = next + content.size();
        while (number >= 0 && next < end)
          if (const ssize_t n = ::write(number, next, end - next); n >= 0)
            next += n;
          else if (errno != EINTR)
            return false;
        return number >= 0;
      }

      bool truncate(const std::uintmax_t size) const
      {
        return number >= 0 && ::ftruncate(number, size) == 0;
      }

      bool sync() const
      {
        return number >= 0 && ::fsync(number) == 0;
      }

      /// Network disks report here that they are full.
      bool close()
      {
        const int open_number = number;
        number                = -1;
        return open_number >= 0 && ::close(open_number) == 0;
      }

      Descriptor(const Descriptor &)            = delete;
      Descriptor &operator=(const Descriptor &) = delete;

    private:
      int number;
    };

    std::string folder_of(const std::string &file)
    {
      const std::string folder = std::filesystem::path(file).parent_path();
      return folder.empty() ? "." : folder;
    }
  } // namespace


  FileError error_of_writing(const std::string &file, const std::uintmax_t n_bytes)
  {
    const std::string cause = std::strerror(errno);
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(folder_of(file), error);
    return FileError(file + ": cannot be written: " + cause + " (" + std::to_string(n_bytes) + " bytes are needed" +
                     (error ? "" : ", " + std::to_string(space.available) + " are free on that disk") +
                     "). Make room there, or name another \"Output directory\".");
  }


  void write_whole_file(const std::string &file, std::string content)
  {
    std::vector<FileContent> files;
    files.emplace_back(file, std::move(content));
    write_whole_files(files);
  }


  void write_whole_files(const std::vector<FileContent> &files)
  {
    const std::string unfinished = ".new";
    std::deque<Descriptor> open;
    const auto require = [&](const bool is_done, const FileContent &file) {
      if (is_done)
        return;
      const int cause = errno;
      open.clear();
      for (const auto &[name, content] : files)
        std::remove((name + unfinished).c_str());
      errno = cause;
      throw error_of_writing(file.first, file.second.size());
    };
    // All are written before the first one is waited for: the disk then takes them together.
    for (const FileContent &file : files)
      require(open.emplace_back(file.first + unfinished, O_WRONLY | O_CREAT | O_TRUNC).write(file.second), file);
    for (std::size_t f = 0; f < files.size(); ++f)
      require(open[f].sync() && open[f].close(), files[f]);
    for (const FileContent &file : files)
      require(std::rename((file.first + unfinished).c_str(), file.first.c_str()) == 0, file);
    if (!files.empty())
      sync_folder(folder_of(files.front().first));
  }


  std::string read_whole_file(const std::string &file)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      throw FileError(file + (std::filesystem::exists(file, error) ? ": is no file" : ": is missing"));
    std::ifstream in(file, std::ios::binary);
    if (!in)
      throw FileError(file + ": cannot be read");
    std::string content{ std::istreambuf_iterator<char>(in), {} };
    if (in.bad())
      throw FileError(file + ": cannot be read to its end");
    return content;
  }


  void append_to_file(const std::string &file, const std::uintmax_t size, const std::string &content)
  {
    Descriptor out(file, O_WRONLY | O_APPEND | (size == 0 ? O_CREAT | O_TRUNC : 0));
    if (!out.write(content))
      {
        const FileError error = error_of_writing(file, content.size());
        out.truncate(size); // A part of a row must not stay.
        throw error;
      }
    if (!out.close())
      throw error_of_writing(file, content.size());
  }


  void cut_file(const std::string &file, const std::uintmax_t size)
  {
    if (!Descriptor(file, O_WRONLY).truncate(size))
      throw error_of_writing(file, 0);
  }


  void sync_file(const std::string &file)
  {
    if (!Descriptor(file, O_WRONLY).sync())
      throw error_of_writing(file, 0);
  }


  void sync_folder(const std::string &folder)
  {
    // Some disks cannot sync a folder, and need not: then errno is EINVAL.
    if (const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY); !descriptor.sync() && errno != EINVAL)
      throw error_of_writing(folder, 0);
  }
} // namespace scree
