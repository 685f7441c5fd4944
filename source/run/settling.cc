// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/motion_before_release.h>
#include <scree/run/settling.h>

#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const std::string name_of_ratio = "unbalanced force over weight";


    /// Steps with kinetic damping, until the soil rests, its time is over, or the run is asked to stop: all stops where
    /// the kinetic energy is largest (@source{barnes1999}), whatever the stiffness.
    /// @return the unbalanced force over the weight at the end, infinity if that is not known
    template <int dim>
    double settle_down(const SettlingParameters &settling,
                       Scene<dim> &scene,
                       const Scheme<dim> &scheme,
                       const StepControl<dim> &control,
                       const std::function<void(double)> &advance,
                       TimeStepper &settling_clock,
                       RunFolder &folder,
                       const MPI_Comm communicator)
    {
      constexpr unsigned int steps_between_lines = 1000;
      constexpr unsigned int least_way           = 4;  // Single points do not stop the others.
      constexpr unsigned int steps_at_rest       = 20; // The force of an oscillation vanishes for a moment.
      double ratio                               = std::numeric_limits<double>::infinity();
      double kinetic                             = 0.;
      unsigned int n_falling                     = 0; // steps with less kinetic energy since the last stop
      unsigned int n_below                       = 0;
      move_before_release(control, settling_clock, settling.maximum_time, 1, advance, [&](const double step) {
        const NodalForces forces = scheme.nodal_forces(step).sum_over_ranks(communicator);
        ratio                    = forces.ratio();
        n_below                  = ratio < settling.unbalanced_force ? n_below + 1 : 0;
        const bool is_past_peak  = forces.kinetic < kinetic && ++n_falling >= least_way;
        if (is_past_peak)
          {
            scene.stop();
            n_falling = 0;
          }
        kinetic = is_past_peak ? 0. : forces.kinetic;
        if (settling_clock.step() % steps_between_lines == 0)
          folder.log("Settling: " + number_text(settling_clock.time()) + " s, step " +
                     std::to_string(settling_clock.step()) + ", " + name_of_ratio + ' ' + number_text(ratio));
        return n_below >= steps_at_rest;
      });
      return ratio;
    }
  } // namespace


  template <int dim>
  bool settle(const Parameters &parameters,
              Scene<dim> &scene,
              Scheme<dim> &scheme,
              StepControl<dim> &control,
              RunFolder &folder,
              const std::function<void(double)> &advance,
              const MPI_Comm communicator)
  {
    const SettlingParameters &settling = parameters.settling;
    const bool is_drained              = settling.drainage() == Drainage::drained;
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);
    scheme.set_drainage(settling.drainage());

    TimeStepper settling_clock(
        is_drained ? parameters.time_step.with_held_pressure(scene.forcing.gravity().norm(), scene.grid.cell_size())
                   : parameters.time_step);
    const double ratio = settle_down(settling, scene, scheme, control, advance, settling_clock, folder, communicator);
    const bool is_released    = control.stop_reason() == StopReason::none;
    const std::string release = ratio < settling.unbalanced_force
                                    ? ". Released."
                                    : ", above the wanted " + number_text(settling.unbalanced_force) +
                                          ": not yet at rest. Released all the same.";
    folder.log("Settled for " + number_text(settling_clock.time()) + " s in " + std::to_string(settling_clock.step()) +
               " steps; " + name_of_ratio + ' ' + number_text(ratio) + (is_released ? release : ". Asked to stop."));
    if (!is_released)
      return false;

    scheme.set_drainage(Drainage::undrained);
    scene.open_gate();
    scene.stop();
    control.measure_speeds();
    return true;
  }

  template bool settle(const Parameters &,
                       Scene<2> &,
                       Scheme<2> &,
                       StepControl<2> &,
                       RunFolder &,
                       const std::function<void(double)> &,
                       const MPI_Comm);
  template bool settle(const Parameters &,
                       Scene<3> &,
                       Scheme<3> &,
                       StepControl<3> &,
                       RunFolder &,
                       const std::function<void(double)> &,
                       const MPI_Comm);
} // namespace scree
