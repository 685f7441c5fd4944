// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/stop_requests.h>

#include <atomic>
#include <csignal>
#include <filesystem>

namespace scree
{
  namespace
  {
    std::atomic<int> received{ 0 }; // the last signal, which any thread may get
    static_assert(std::atomic<int>::is_always_lock_free, "A signal must not wait.");

    /// Whether the program was started under nohup: asked before the constructors of the libraries, since those of Open
    /// MPI 5 and MPI_InitFinalize set handlers of their own.
    bool hangup_is_ignored = false;

    void look_for_nohup()
    {
      struct sigaction action; // To set it to 0 might take an instruction that require_processor() has yet to look for.
      sigaction(SIGHUP, nullptr, &action);
      hangup_is_ignored = action.sa_handler == SIG_IGN;
    }
    [[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)() = look_for_nohup;

    extern "C" void remember(const int signal)
    {
      received = signal;
    }

    struct ListenedSignal
    {
      int number;
      StopReason reason;
      const char *name;
    };
    constexpr ListenedSignal listened[] = { { SIGHUP, StopReason::signal_hangup, "SIGHUP" },
                                            { SIGUSR1, StopReason::signal_user, "SIGUSR1" },
                                            { SIGINT, StopReason::signal_interrupt, "SIGINT" },
                                            { SIGTERM, StopReason::signal_terminate, "SIGTERM" } };

    double seconds(const std::chrono::steady_clock::duration time)
    {
      return std::chrono::duration<double>(time).count();
    }
  } // namespace


  std::string text_of(const StopReason reason)
  {
    for (const ListenedSignal &signal : listened)
      if (reason == signal.reason)
        return signal.name;
    return reason == StopReason::terminate_file ? "the file terminate" : "the entry \"Wall time limit\"";
  }


  void StopRequests::listen()
  {
    for (const ListenedSignal &signal : listened)
      {
        struct sigaction action = {};
        action.sa_handler       = remember;
        action.sa_flags         = SA_RESTART | (signal.number == SIGINT ? int(SA_RESETHAND) : 0);
        if (signal.number == SIGHUP && hangup_is_ignored)
          action.sa_handler = SIG_IGN;
        sigaction(signal.number, &action, nullptr);
      }
    is_listening = true;
    last_call    = std::chrono::steady_clock::now();
  }


  StopReason StopRequests::reason()
  {
    if (!is_listening || found != StopReason::none)
      return found;
    for (const ListenedSignal &signal : listened)
      if (received == signal.number)
        found = signal.reason;
    if (found != StopReason::none || terminate_file.empty())
      return found;
    constexpr double seconds_between_looks = 1.;
    const Time now                         = std::chrono::steady_clock::now();
    longest_step                           = std::max(longest_step, seconds(now - last_call));
    last_call                              = now;
    // The longest step had the dearest output so far. Room for this step, what is being written (at most two pictures
    // or checkpoints), the checkpoint after it, and a slower disk.
    const double left = std::max(0.01 * wall_time_limit, 5 * longest_step);
    if (wall_time_limit > 0 && seconds(now - start) + left >= wall_time_limit)
      found = StopReason::wall_time_limit;
    else if (seconds(now - last_look) >= seconds_between_looks)
      {
        last_look = now;
        std::error_code nobody_minds;
        if (std::filesystem::remove(terminate_file, nobody_minds))
          found = StopReason::terminate_file;
      }
    return found;
  }
} // namespace scree
