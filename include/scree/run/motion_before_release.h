// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_motion_before_release_h
#define scree_run_motion_before_release_h

#include <scree/run/step_control.h>

#include <functional>

namespace scree
{
  /// Steps until `is_over`, which is asked every few steps and at the end, the time is over, or the run is asked to
  /// stop. Collective.
  /// @param clock of these steps
  /// @param maximum_time s, on that clock
  /// @param advance moves all by a step, s
  /// @param is_over of the length of the step before it, s
  template <int dim>
  void move_before_release(const StepControl<dim> &control,
                           TimeStepper &clock,
                           const double maximum_time,
                           const unsigned int steps_between_looks,
                           const std::function<void(double)> &advance,
                           const std::function<bool(double)> &is_over);
} // namespace scree

#endif
