// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace scree
{
  using namespace dealii;

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


  void sync_folder(const std::string &folder)
  {
    // Some disks cannot sync a folder, and need not: then errno is EINVAL.
    if (const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY); !descriptor.sync() && errno != EINVAL)
      throw error_of_writing(folder, 0);
  }


  void RowFile::append(const std::string &rows)
  {
    waiting += rows;
    Descriptor out(file, O_WRONLY | O_APPEND | (size == 0 ? O_CREAT | O_TRUNC : 0));
    if (!out.write(waiting))
      {
        const FileError error = error_of_writing(file, waiting.size());
        out.truncate(size); // A part of a row must not stay.
        throw error;
      }
    if (!out.close())
      throw error_of_writing(file, waiting.size());
    size += waiting.size();
    waiting.clear();
  }


  void RowFile::sync() const
  {
    if (size > 0 && !Descriptor(file, O_WRONLY).sync())
      throw error_of_writing(file, 0);
  }


  std::string RowFile::cut()
  {
    std::error_code is_missing;
    const std::uintmax_t found = std::filesystem::file_size(file, is_missing);
    const std::uint64_t wanted = size;
    if (is_missing)
      size = 0;
    else if (found < size)
      size = read_whole_file(file).rfind('\n') + 1; // 0 if there is none
    if (!is_missing && !Descriptor(file, O_WRONLY).truncate(size))
      throw error_of_writing(file, 0);
    return size == wanted ? ""
                          : file + " has lost " + std::to_string(wanted - size) + " of the " + std::to_string(wanted) +
                                " bytes that it had at the checkpoint: rows are missing there.";
  }


  namespace
  {
    /// When a process began, in ticks from the start of the machine: it stays so after its number has been given to
    /// another one. 0 if it is none, or dead and not yet collected by its parent, or if the system does not report.
    long long start_of(const long pid)
    {
      std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
      const std::string all{ std::istreambuf_iterator<char>(in), {} };
      // "pid (name) state ...", and the start is the 22nd word; a name may hold anything.
      std::istringstream words(all.substr(std::min(all.size(), all.rfind(')') + 1)));
      char state     = 'X';
      long long word = 0;
      words >> state;
      for (unsigned int i = 4; i <= 22; ++i)
        words >> word;
      return words && state != 'Z' && state != 'X' ? word : 0;
    }


    /// Whether a process of this machine still runs.
    /// @param start see start_of()
    bool runs(const long pid, const long long start)
    {
      const bool system_tells = start_of(getpid()) > 0;
      if (system_tells && start > 0)
        return start_of(pid) == start;
      return kill(pid, 0) == 0 || errno == EPERM;
    }


    std::string lock_text()
    {
      const std::time_t now = std::time(nullptr);
      std::ostringstream text;
      text << dealii::Utilities::System::get_hostname() << ' ' << getpid() << ' ' << start_of(getpid()) << ' '
           << std::put_time(std::gmtime(&now), "%Y-%m-%dT%H:%M:%SZ") << '\n';
      return text.str();
    }
  } // namespace


  FolderLock::FolderLock(const std::string &file)
      : file(file)
      , text(lock_text())
  {
    if (make())
      return;
    if (errno != EEXIST)
      {
        refusal = file + " cannot be written: " + std::strerror(errno) + '.';
        return;
      }
    std::string host, begun = "?";
    long pid        = 0;
    long long start = 0;
    std::ifstream in(file);
    const bool is_known       = bool(in >> host >> pid >> start >> begun);
    const std::string process = is_known ? "process " + std::to_string(pid) + " on " + host : "?";
    if (is_known && host == dealii::Utilities::System::get_hostname() && !runs(pid, start))
      {
        dead_owner = process + ", begun " + begun;
        std::filesystem::remove(file);
        if (make())
          return;
      }
    refusal = "another run writes there (" + process + ", begun " + begun +
              "). Wait for its end, or name another folder. If that run is dead, remove the file " + file + '.';
  }


  bool FolderLock::make()
  {
    Descriptor out(file, O_WRONLY | O_CREAT | O_EXCL);
    const bool is_whole = out.write(text);
    const int cause     = errno;
    if (out.close() && !is_whole)
      ::unlink(file.c_str());
    errno = cause;
    return is_whole;
  }


  FolderLock::~FolderLock()
  {
    std::ifstream in(file);
    const std::string found{ std::istreambuf_iterator<char>(in), {} };
    if (refusal.empty() && found == text) // and not that of a run that ignores this one
      ::unlink(file.c_str());
  }


  std::string fault_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const ExceptionBase &error)
      {
        return plain_text(error);
      }
    catch (const std::exception &error)
      {
        return error.what();
      }
    return "";
  }


  BackgroundWriter::~BackgroundWriter()
  {
    if (running.valid())
      running.wait();
    if (n_ranks == 1)
      for (unsigned int j = 1; j < jobs.size(); ++j)
        fault_of(jobs[j].stages[0]);
  }


  void BackgroundWriter::begin_stage()
  {
    std::function<void()> write;
    if (stage < jobs.front().stages.size())
      write = std::move(jobs.front().stages[stage++]);
    running = std::async(std::launch::async, [write = std::move(write)]() mutable {
      const auto freed_here = std::move(write);
      return freed_here ? fault_of(freed_here) : std::string();
    });
  }


  void BackgroundWriter::end_job(const std::string &fault)
  {
    const FileJob job = std::move(jobs.front());
    jobs.pop_front();
    longest_job =
        std::max(longest_job, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    try
      {
        if (!fault.empty())
          {
            AssertThrow(job.failed, ExcMessage(fault));
            job.failed(fault);
          }
        else if (job.done)
          job.done();
      }
    catch (...)
      {
        jobs.clear(); // The run ends.
        throw;
      }
    if (!jobs.empty())
      begin_job();
  }
} // namespace scree
