// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/folder_lock.h>

#include <deal.II/base/utilities.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <unistd.h>

namespace scree
{
  namespace
  {
    std::string utc_date()
    {
      const std::time_t now = std::time(nullptr);
      char text[32];
      std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
      return text;
    }

    /// Who a process is, also after its number has been given to another one.
    struct Process
    {
      std::string host;
      long pid         = 0;
      long long starts = 0; ///< ticks from the start of the machine to that of the process; 0: not known

      static Process myself()
      {
        return { dealii::Utilities::System::get_hostname(), getpid(), start_of(getpid()) };
      }

      /// 0 if the process is none, or dead and only not yet collected by its parent, or if the system does not report.
      static long long start_of(const long pid)
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

      /// Whether this process of this machine still runs.
      bool runs() const
      {
        const bool system_tells = start_of(getpid()) > 0;
        if (system_tells && starts > 0)
          return start_of(pid) == starts;
        return kill(pid, 0) == 0 || errno == EPERM;
      }
    };

    std::istream &operator>>(std::istream &in, Process &process)
    {
      return in >> process.host >> process.pid >> process.starts;
    }

    std::ostream &operator<<(std::ostream &out, const Process &process)
    {
      return out << process.host << ' ' << process.pid << ' ' << process.starts;
    }

    std::string lock_text()
    {
      std::ostringstream text;
      text << Process::myself() << ' ' << utc_date() << '\n';
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
        why_not = file + " cannot be written: " + std::strerror(errno) + '.';
        return;
      }
    Process owner;
    std::string begun = "?";
    std::ifstream in(file);
    const bool is_known       = bool(in >> owner >> begun);
    const std::string process = is_known ? "process " + std::to_string(owner.pid) + " on " + owner.host : "?";
    if (is_known && owner.host == dealii::Utilities::System::get_hostname() && !owner.runs())
      {
        replaced = process + ", begun " + begun;
        std::filesystem::remove(file);
        if (make())
          return;
      }
    why_not = "another run writes there (" + process + ", begun " + begun +
              "). Wait for its end, or name another folder. If that run is dead, remove the file " + file + '.';
  }


  bool FolderLock::make()
  {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
      return false;
    const bool is_whole = ::write(descriptor, text.data(), text.size()) == ssize_t(text.size());
    const int cause     = errno;
    ::close(descriptor);
    if (!is_whole)
      ::unlink(file.c_str());
    errno = cause;
    return is_whole;
  }


  FolderLock::~FolderLock()
  {
    std::ifstream in(file);
    const std::string found{ std::istreambuf_iterator<char>(in), {} };
    if (why_not.empty() && found == text) // and not that of a run that ignores this one
      ::unlink(file.c_str());
  }
} // namespace scree
