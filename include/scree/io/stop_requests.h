// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_stop_requests_h
#define scree_io_stop_requests_h

#include <algorithm>
#include <chrono>
#include <string>

namespace scree
{
  /// What may ask a run to end before its end time; the largest of all ranks' is obeyed.
  enum class StopReason
  {
    none,
    terminate_file,
    wall_time_limit,
    signal_hangup,    ///< SIGHUP
    signal_user,      ///< SIGUSR1
    signal_interrupt, ///< SIGINT
    signal_terminate  ///< SIGTERM
  };

  /// The reason, as in the log.
  std::string text_of(const StopReason reason);

  /// Hears signals, looks for a file, and watches the wall time, so that a run can end with a checkpoint. All of it
  /// costs a step less than a microsecond.
  class StopRequests
  {
  public:
    /// @param terminate_file the file that stops the run; empty on ranks that do not look for it nor at the clock
    /// @param wall_time_limit from now on, s; 0: none
    StopRequests(const std::string &terminate_file, const double wall_time_limit)
        : terminate_file(terminate_file)
        , wall_time_limit(wall_time_limit)
        , start(std::chrono::steady_clock::now())
    {
    }

    /// From here on, signals stop the run by the end of its step, of settling, too; a second SIGINT ends it at once.
    /// Before, they end the program, which has nothing to save yet.
    void listen();

    /// What this rank has been asked for. To be called once a step: the longest time between two calls gives how much
    /// of the wall time limit has to be left for the checkpoint. A file that is found is removed.
    StopReason reason();

    /// Output in the background took up to `seconds`: it counts like a step of that length.
    void allow_for(const double seconds)
    {
      longest_step = std::max(longest_step, seconds);
    }

  private:
    using Time = std::chrono::steady_clock::time_point;

    const std::string terminate_file;
    const double wall_time_limit; // s
    const Time start;
    Time last_call, last_look;
    double longest_step = 0; // s
    bool is_listening   = false;
    StopReason found    = StopReason::none;
  };
} // namespace scree

#endif
