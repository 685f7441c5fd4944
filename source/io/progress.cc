// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/progress.h>
#include <scree/step/step_report.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <ctime>
#include <sstream>

namespace scree
{
  using namespace dealii;

  std::string in_lines(const std::string &label, const std::string &text)
  {
    constexpr std::size_t margin = 100, indent = 11;
    std::string lines, word, line = label + std::string(indent - label.size(), ' ');
    for (std::istringstream words(text); words >> word; line += ' ' + word)
      if (line.size() + 1 + word.size() > margin)
        {
          lines += line + '\n';
          line = std::string(indent, ' ');
        }
    return lines + line;
  }


  std::string verdict(const std::vector<CheckResult> &results)
  {
    std::string lines, within;
    for (const Finding finding : { Finding::fault, Finding::resolution })
      for (const CheckResult &result : results)
        if (result.is_exceeded && result.finding == finding)
          lines +=
              in_lines(lines.empty() ? "Checks" : "",
                       (finding == Finding::fault ? "fault: " : "resolution: ") + result.name + ' ' + result.value +
                           " (bound " + result.bound + ')' + (result.where.empty() ? "" : "; " + result.where) +
                           (result.remedy.empty() ? "" : "; what to do: " + result.remedy)) +
              '\n';
    for (const CheckResult &result : results)
      if (!result.is_exceeded)
        within += (within.empty() ? "within bounds: " : "; ") + result.name + ' ' + result.value;
    lines += in_lines(lines.empty() ? "Checks" : "", within);
    return boost::algorithm::trim_right_copy(lines);
  }


  std::string verdict_table(const std::vector<CheckResult> &results)
  {
    const auto quoted = [](const std::string &text) {
      return '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
    };
    std::string table = "check,value,bound,class,is_exceeded,place,remedy\n";
    for (const CheckResult &result : results)
      {
        const std::string finding = result.bound.empty()               ? "information"
                                    : result.finding == Finding::fault ? "fault"
                                                                       : "resolution";
        for (const std::string &text : { result.name, result.value, result.bound, finding })
          table += quoted(text) + ',';
        table += (result.is_exceeded ? "1," : "0,") + quoted(result.where) + ',' +
                 quoted(result.is_exceeded ? result.remedy : "") + '\n';
      }
    return table;
  }


  std::string duration(const double seconds)
  {
    const long s = std::lround(seconds);
    if (s >= 3600)
      return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
    if (s >= 60)
      return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
    return std::to_string(s) + " s";
  }


  double processor_time()
  {
    return double(std::clock()) / CLOCKS_PER_SEC;
  }


  void Progress::report(const double time,
                        const unsigned long long step,
                        const double time_step,
                        const double place,
                        const double kinetic_energy)
  {
    const int width = std::max<int>(16, place_column.size() + 2);
    if (!has_heading)
      folder.log(formatted("\n%12s %7s %9s %10s %*s %14s %13s",
                           "time (s)",
                           "done",
                           "step",
                           "dt (s)",
                           width,
                           place_column.c_str(),
                           "kinetic (J)",
                           "remaining"));
    has_heading          = true;
    const double elapsed = clock.wall_time();
    last_line            = elapsed;
    const double done    = std::min(1., (time - start_time) / (end_time - start_time));
    // Five digits of the end time.
    const int decimals = 4 - static_cast<int>(std::floor(std::log10(std::max(end_time, 1e-300))));
    folder.log((decimals <= 8 ? formatted("%12.*f", std::max(0, decimals), time) : formatted("%12.4e", time)) +
               formatted(" %5.0f %% %9llu %10.2e %*.4f %14.4g %13s",
                         100 * done,
                         step,
                         time_step,
                         width,
                         place,
                         kinetic_energy,
                         (done > 0 ? duration(elapsed / done * (1 - done)) : std::string()).c_str()));
  }


  void Progress::conclude(const std::string &how,
                          const double time,
                          const double point_updates,
                          const bool has_maximum,
                          const MPI_Comm communicator)
  {
    const double total         = clock.wall_time();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    folder.log(formatted("\n%-11s wall time %s, %llu steps",
                         how.c_str(),
                         total < 60 ? formatted("%.1f s", total).c_str() : duration(total).c_str(),
                         n_steps()) +
               (point_updates > 0
                    ? formatted(", %.0f ns per point and step and core", 1e9 * n_ranks * total / point_updates)
                    : ""));
    if (n_steps() == 0)
      return;
    std::string limits;
    for (const auto &[limit, name] : { std::make_pair(StepLimit::waves, "wave speed"),
                                       { StepLimit::motion, "largest speed" },
                                       { StepLimit::entry, "Maximum time step" } })
      if (const double share = percent(limit); share > 0)
        limits += (limits.empty() ? "" : ", ") + formatted(share < 1 ? "%s (below 1 %%" : "%s (%.0f %%", name, share) +
                  (limits.empty() ? " of steps)" : ")");
    folder.log("Limits      time step limited by " + limits);
    constexpr double most       = 50.,
                     most_times = 100.; // % of the steps; with more, other bounds are none, as of still water
    if (has_maximum && percent(StepLimit::entry) > most && n_steps() < most_times * others)
      folder.log(
          formatted("Warning     'Maximum time step' bounds %.0f %% of the steps: without it the run would have "
                    "taken %.3g times fewer.\n            Write a larger one, or auto, unless results depend on it.",
                    percent(StepLimit::entry),
                    n_steps() / others));
    if (const double motion = time - start_time; motion > 0)
      folder.record(
          formatted("Per simulated second: %.4g steps, %.3g s wall time", n_steps() / motion, total / motion));
  }


  void Progress::summarise(const TimerOutput &parts,
                           const double point_updates,
                           const std::string &point,
                           const MPI_Comm communicator)
  {
    if (point_updates <= 0)
      return;
    const unsigned int n_ranks    = Utilities::MPI::n_mpi_processes(communicator);
    const double core_seconds     = Utilities::MPI::sum(processor_time() - processor_time_before, communicator);
    const double total            = clock.wall_time();
    const double to_ns            = 1e9 * n_ranks / point_updates;
    double accounted              = 0;
    const std::string last_column = "ns per " + point + " and step";
    const int width               = std::max<int>(22, last_column.size());
    folder.record(formatted("%-34s %10s %8s %*s", "part", "seconds", "share", width, last_column.c_str()));
    const auto line = [&](const std::string &name, const double s) {
      folder.record(formatted("%-34s %10.2f %6.1f %% %*.1f", name.c_str(), s, 100 * s / total, width, s * to_ns));
    };
    for (const TimerSection part : step_parts())
      if (const double s = seconds_of(parts, part); s > 0)
        {
          line(name_of(part), s);
          accounted += s;
        }
    line("everything else", total - accounted);
    line("total", total);
    folder.record(formatted("(ns are of one core: wall time x %u rank(s) / %.4g point updates; processor time %.4g s)",
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
    folder.record(formatted("waiting: %.1f %% of the ranks' time (%.1f %% to %.1f %%)",
                            100 * of_ranks.avg / total,
                            100 * of_ranks.min / total,
                            100 * of_ranks.max / total));
    folder.record(formatted("imbalance: %.3f (points of the fullest rank over the mean); repartitioned %u times",
                            imbalance,
                            n_repartitions));
  }
} // namespace scree
