// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_cost_h
#define scree_advice_cost_h

#include <scree/advice/scene_numbers.h>
#include <scree/output/output_parameters.h>
#include <scree/scheme/step_part.h>
#include <scree/scheme/time_step.h>

#include <map>

namespace scree
{
  /// What the first steps of a case took on this machine.
  struct StepCost
  {
    double n_steps = 0;               ///< looked at
    double seconds = 0;               ///< a step, of all ranks together
    std::map<StepPart, double> parts; ///< of `seconds`
    double first_seconds = 0;         ///< what the first step takes beyond `seconds`: to make room, start libraries
    double sorting       = 0;         ///< all points in memory, core-seconds
    double picture = 0, row = 0;      ///< writing one, core-seconds
    double memory         = 0;        ///< of all ranks, bytes
    double program_memory = 1.2e8;    ///< of `memory`, what does not grow with points and cells, bytes
  };

  /// What a whole run will take.
  struct RunCost
  {
    double first_step = 0, mean_step = 0; ///< s
    double n_steps        = 0;            ///<
    double step_seconds   = 0;            ///< core-seconds
    double output_seconds = 0;            ///< core-seconds
    double memory         = 0;            ///< bytes

    double seconds() const
    {
      return step_seconds + output_seconds;
    }
  };

  /// When a run steps and writes.
  struct Schedule
  {
    TimeStepParameters time_step;
    OutputParameters output;
  };

  /// The cost of a run of `scene` whose first steps cost `first_steps`. In motion, steps of soil that flows are shorter
  /// and dearer than the first ones, at rest cheaper: measured factors.
  RunCost cost_of_run(const SceneNumbers &scene, const StepCost &first_steps, const Schedule &schedule);

  /// The same scene and steps with other cells: points and cells in proportion, and the cost with them.
  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size);
  StepCost with_cell_size(StepCost steps, const SceneNumbers &scene, const double cell_size);

  /// The cost of a step of the scene's soil without its water.
  StepCost without_water(StepCost steps, const SceneNumbers &scene);
} // namespace scree

#endif
