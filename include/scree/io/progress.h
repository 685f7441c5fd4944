// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_progress_h
#define scree_io_progress_h

#include <scree/io/run_folder.h>
#include <scree/schemes/time_step.h>

#include <deal.II/base/timer.h>

#include <cstdio>
#include <numeric>

namespace scree
{
  /// What a check beyond its bound means.
  enum class Finding
  {
    fault,     ///< the run is not sound
    resolution ///< the run is sound, and some of its results are coarse, cut off or not final
  };

  /// What a run has found in a check of itself.
  struct CheckResult
  {
    std::string name;                    ///< the same in all runs
    std::string value;                   ///< the worst, with its unit
    std::string bound  = "";             ///< what is not exceeded, in words; empty: the value is for information
    bool is_exceeded   = false;          ///< whether the bound is
    std::string remedy = "";             ///< what to do if it is
    Finding finding    = Finding::fault; ///< what it then is
    std::string where  = "";             ///< point, place and time of the worst value; may be empty

    /// Saves or loads all of it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &name &value &bound &is_exceeded &remedy &finding &where;
    }
  };

  /// Text by a pattern of printf, at most 255 letters.
  template <typename... Values>
  std::string formatted(const char *pattern, const Values... values)
  {
    char text[256];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
  }

  /// A number with three digits.
  inline std::string short_text(const double value)
  {
    return formatted("%.3g", value);
  }

  /// 75 -> "1 min 15 s"
  std::string duration(const double seconds);

  /// A text of the log behind its label, in lines of at most 100 letters.
  std::string in_lines(const std::string &label, const std::string &text);

  /// The lines `Checks`: faults and what is coarse with bound, place and remedy, then values within bounds.
  std::string verdict(const std::vector<CheckResult> &results);

  /// The same for programs: a `.csv` with a line a check.
  std::string verdict_table(const std::vector<CheckResult> &results);

  /// Processor time that this process has taken so far, its own and the system's for it, s. (deal.II's CPUClock counts
  /// its own alone, which the system guesses from ticks: of short runs that is nothing or twice as much.)
  double processor_time();

  /// Reports how far a run is and how long it will take, and in the end where its time went.
  class Progress
  {
  public:
    /// @param start_time s, of the run or of the checkpoint
    /// @param end_time s
    /// @param place_column heading of what report() shows of the motion, such as `front 90 % (m)`
    Progress(RunFolder &folder, const double start_time, const double end_time, const std::string &place_column)
        : folder(folder)
        , start_time(start_time)
        , end_time(end_time)
        , place_column(place_column)
    {
    }

    /// Whether the last line of this rank is some seconds old.
    bool is_due() const
    {
      constexpr double seconds_between_lines = 5.;
      return clock.wall_time() - last_line >= seconds_between_lines;
    }

    /// Writes a line of the table, before the first one its heading.
    /// @param time s
    /// @param time_step s
    /// @param place value of the place column
    /// @param kinetic_energy J
    void report(const double time,
                const unsigned long long step,
                const double time_step,
                const double place,
                const double kinetic_energy);

    /// Counts a step by what bounds it.
    /// @param bounds see TimeStepper::bounds()
    void count(const std::array<double, 3> &bounds)
    {
      ++counts[std::min_element(bounds.begin(), bounds.end()) - bounds.begin()];
      others += std::min(1., bounds[0] / std::min(bounds[1], bounds[2]));
    }

    /// Writes how long the run took, and what bounded its steps.
    /// @param how `Finished` or `Stopped`
    /// @param time s, of the end
    /// @param point_updates points times steps, of all ranks
    /// @param has_maximum whether the case has a number as `Maximum time step`
    void conclude(const std::string &how,
                  const double time,
                  const double point_updates,
                  const bool has_maximum,
                  const MPI_Comm communicator);

    /// Records the table of seconds by part, and ns per point and step. Collective.
    /// @param parts timed sections of this rank
    /// @param point_updates points times steps, of all ranks
    /// @param point what is counted as one: "soil or water point" where there is water
    void summarise(const dealii::TimerOutput &parts,
                   const double point_updates,
                   const std::string &point,
                   const MPI_Comm communicator);

    /// Records how evenly several ranks have worked. Collective.
    /// @param waiting time that this rank has waited for others, s
    /// @param imbalance points of the fullest rank over the mean
    /// @param n_repartitions how often the mesh was repartitioned
    void summarise_ranks(const double waiting,
                         const double imbalance,
                         const unsigned int n_repartitions,
                         const MPI_Comm communicator);

  private:
    double percent(const StepLimit limit) const
    {
      return n_steps() > 0 ? 100. * counts[static_cast<unsigned int>(limit)] / n_steps() : 0.;
    }
    unsigned long long n_steps() const
    {
      return std::accumulate(counts.begin(), counts.end(), 0ull);
    }

    RunFolder &folder;
    const double start_time, end_time;
    const std::string place_column;
    dealii::Timer clock;
    const double processor_time_before       = processor_time();
    double last_line                         = 0; // wall time, s
    bool has_heading                         = false;
    std::array<unsigned long long, 3> counts = {}; // by StepLimit
    double others                            = 0;  // steps that the run would have taken without 'Maximum time step'
  };
} // namespace scree

#endif
