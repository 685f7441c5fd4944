// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/progress.h>
#include <scree/step/timer_section.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// 75 -> "1 min 15 s"
    std::string duration(const double seconds)
    {
      const long s = std::lround(seconds);
      if (s >= 3600)
        return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
      if (s >= 60)
        return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
      return std::to_string(s) + " s";
    }

    template <typename... Values>
    std::string format(const char *pattern, const Values... values)
    {
      char line[256];
      std::snprintf(line, sizeof line, pattern, values...);
      return line;
    }
  } // namespace


  double processor_time()
  {
    return double(std::clock()) / CLOCKS_PER_SEC;
  }


  Progress::Progress(RunFolder &folder, const double start_time, const double end_time)
      : folder(folder)
      , start_time(start_time)
      , end_time(end_time)
  {
  }


  void Progress::report(const double time, const unsigned long long step, const double time_step)
  {
    constexpr double seconds_between_lines = 5.;
    const double elapsed                   = clock.wall_time();
    if (time < end_time && elapsed - last_line < seconds_between_lines)
      return;
    last_line         = elapsed;
    const double done = (time - start_time) / (end_time - start_time);
    folder.log(
        format("t = %.4g s (%.0f %%), step %llu of %.3g s, ", time, 100 * done, step, time_step) +
        (done > 0 && done < 1 ? duration(elapsed / done * (1 - done)) + " left" : "wall time " + duration(elapsed)));
  }


  void Progress::summarise_steps(const double time)
  {
    const unsigned long long n_steps = std::accumulate(counts.begin(), counts.end(), 0ull);
    const double motion              = time - start_time;
    if (n_steps == 0 || motion <= 0)
      return;
    const auto percent = [&](const StepLimit limit) {
      return 100. * counts[static_cast<unsigned int>(limit)] / n_steps;
    };
    folder.log(format("per simulated second: %.4g steps, %.3g s wall time; time step limited by: wave speed %.0f %%, "
                      "largest speed %.0f %%, 'Maximum time step' %.0f %%",
                      n_steps / motion,
                      clock.wall_time() / motion,
                      percent(StepLimit::waves),
                      percent(StepLimit::motion),
                      percent(StepLimit::entry)));
    constexpr double most = 50.; // % of the steps
    if (percent(StepLimit::entry) > most && others > 0.)
      folder.log(
          format("'Maximum time step' bounds %.0f %% of the steps: without it the run would have taken %.3g times "
                 "fewer. Write a larger one, or auto, unless results depend on it",
                 percent(StepLimit::entry),
                 n_steps / others));
  }


  void Progress::summarise(const double time,
                           const TimerOutput &parts,
                           const double point_updates,
                           const std::string &point,
                           const MPI_Comm communicator)
  {
    if (point_updates <= 0)
      return;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const double core_seconds  = Utilities::MPI::sum(processor_time() - processor_time_before, communicator);
    summarise_steps(time);
    const double total            = clock.wall_time();
    const double to_ns            = 1e9 * n_ranks / point_updates;
    double accounted              = 0;
    const std::string last_column = "ns per " + point + " and step";
    const int width               = std::max<int>(22, last_column.size());
    folder.log(format("%-34s %10s %8s %*s", "part", "seconds", "share", width, last_column.c_str()));
    const auto line = [&](const std::string &name, const double s) {
      folder.log(format("%-34s %10.2f %6.1f %% %*.1f", name.c_str(), s, 100 * s / total, width, s * to_ns));
    };
    for (const TimerSection part : step_parts)
      if (const double s = seconds_of(parts, part); s > 0)
        {
          line(name_of(part), s);
          accounted += s;
        }
    line("everything else", total - accounted);
    line("total", total);
    folder.log(format("(ns are of one core: wall time x %u rank(s) / %.4g point updates; processor time %.4g s)",
                      n_ranks,
                      point_updates,
                      core_seconds));
  }


  void Progress::summarise_ranks(const double waiting,
                                 const double imbalance,
                                 const unsigned int n_repartitions,
                                 const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    const double total  = clock.wall_time();
    const auto of_ranks = Utilities::MPI::min_max_avg(waiting, communicator);
    folder.log(format("waiting: %.1f %% of the ranks' time (%.1f %% to %.1f %%)",
                      100 * of_ranks.avg / total,
                      100 * of_ranks.min / total,
                      100 * of_ranks.max / total));
    folder.log(format("imbalance: %.3f (slowest rank over mean, without waiting); repartitioned %u times",
                      imbalance,
                      n_repartitions));
  }
} // namespace scree
