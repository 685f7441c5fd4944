// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/motion_before_release.h>

namespace scree
{
  template <int dim>
  void move_before_release(const StepControl<dim> &control,
                           TimeStepper &clock,
                           const double maximum_time,
                           const unsigned int steps_between_looks,
                           const std::function<void(double)> &advance,
                           const std::function<bool(double)> &is_over)
  {
    bool goes_on = true;
    while (goes_on && clock.time() < maximum_time && control.stop_reason() == StopReason::none)
      {
        const double step = clock.next_step(control.stable_step(clock), maximum_time);
        advance(step);
        clock.advance(step, maximum_time);
        if (clock.step() % steps_between_looks == 0 || clock.time() >= maximum_time)
          goes_on = !is_over(step);
      }
  }

  template void move_before_release(const StepControl<2> &,
                                    TimeStepper &,
                                    const double,
                                    const unsigned int,
                                    const std::function<void(double)> &,
                                    const std::function<bool(double)> &);
  template void move_before_release(const StepControl<3> &,
                                    TimeStepper &,
                                    const double,
                                    const unsigned int,
                                    const std::function<void(double)> &,
                                    const std::function<bool(double)> &);
} // namespace scree
