// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_advise_h
#define scree_advice_advise_h

#include <scree/advice/scene_numbers.h>

#include <ostream>

namespace scree
{
  /// What steps of a case take on this machine, core-seconds of all ranks together.
  struct StepCost
  {
    double seconds = 0;                   ///< a step
    std::map<TimerSection, double> parts; ///< of `seconds`

    /// 0 if the part was not met.
    double seconds_of(const TimerSection part) const
    {
      const auto found = parts.find(part);
      return found == parts.end() ? 0. : found->second;
    }

    /// What is in no part.
    double rest() const
    {
      double sum = seconds;
      for (const auto &[part, of_part] : parts)
        sum -= of_part;
      return std::max(0., sum);
    }
  };

  /// What limits the steps for a while.
  struct SpeedInterval
  {
    double duration = 0; ///< s
    double wave     = 0, ///< largest speed of a pressure wave, m/s
        speed       = 0; ///< largest speed of a point, m/s
  };

  /// What was seen of a run.
  struct Observation
  {
    std::vector<SpeedInterval> intervals; ///< from the start on
    double n_first  = 0;                  ///< steps whose cost is `first`
    double n_points = 0;                  ///< of soil and water
    StepCost first,                       ///< cost of the first steps
        later;                            ///< cost of the steps after them
    double setup          = 0;     ///< what the very first step takes beyond `first`: to make room, start libraries
    double picture        = 0,     ///< cost of writing a picture, core-seconds
        row               = 0;     ///< cost of writing a row of statistics, core-seconds
    double memory         = 0;     ///< of all ranks, bytes
    double program_memory = 1.2e8; ///< of `memory`, what does not grow with points and cells, bytes

    /// Of all intervals, s.
    double duration() const
    {
      double sum = 0;
      for (const SpeedInterval &interval : intervals)
        sum += interval.duration;
      return sum;
    }
  };

  /// What a whole run will take.
  struct RunCost
  {
    double first_step     = 0, ///< length of the first time step, s
        mean_step         = 0; ///< mean length over the run, s
    double n_steps        = 0; ///< number of time steps
    double step_seconds   = 0; ///< core-seconds
    double output_seconds = 0; ///< core-seconds
    double memory         = 0; ///< bytes

    /// Cost of steps and output, core-seconds.
    double seconds() const
    {
      return step_seconds + output_seconds;
    }
  };

  /// When a run steps and writes.
  struct Schedule
  {
    TimeStepParameters time_step; ///< entries of subsection Time step
    OutputParameters output;      ///< entries of subsection Output
  };

  /// The cost of a run of `scene` that goes as was seen: the steps by the speeds that limit them, their cost by the
  /// first and the later ones. What was not seen of the run goes on as the last of what was.
  RunCost cost_of_run(const SceneNumbers &scene, const Observation &seen, const Schedule &schedule);

  /// First steps that were seen in full, and what came later in a pilot, a run of the whole case with wider cells. A
  /// part of the later steps takes that many times as long as in the first ones as it does in the pilot; what the first
  /// ones hardly know takes as much a point as there.
  Observation with_pilot(Observation first_steps, const Observation &pilot);

  /// The same scene and run with other cells: points and cells in proportion, and the cost with them.
  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size);

  /// The same of an observation: its points and costs with other cells.
  Observation with_cell_size(Observation seen, const SceneNumbers &scene, const double cell_size);

  /// The run of the scene's soil without its water.
  Observation without_water(Observation seen, const SceneNumbers &scene);

  /// Takes the time of the first steps of a run, until rank 0 has spent `seconds` core-seconds or the run is at its
  /// end, and of what is written then; later steps count as the first. Collective.
  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator);

  /// Takes the time of a whole run, of its first steps until `begin` s and of those that come later; or of less, once
  /// rank 0 has spent `seconds` core-seconds. Nothing is written. Collective.
  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator);

  /// Default of the error that a run is to have.
  constexpr double default_accuracy = 0.05;

  /// Writes what a case is, what it will cost and what would serve it better, from its points and its first steps; its
  /// run folder is not touched. `parameters` must not be used for a run afterwards. Collective; throws as a run's
  /// start.
  /// @param accuracy relative error for which cells are recommended
  template <int dim>
  void advise(Parameters &parameters, const double accuracy, const MPI_Comm communicator, std::ostream &out);
} // namespace scree

#endif
