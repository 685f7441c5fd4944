// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>
#include <scree/run/motion_before_release.h>
#include <scree/run/settling.h>

#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Steps with damping, until the soil rests, its time is over, or the run is asked to stop.
    /// @return kinetic over elastic energy at the end, infinity if that is not known
    template <int dim>
    double settle_down(const Parameters &parameters,
                       const Scene<dim> &scene,
                       const StepControl<dim> &control,
                       const std::function<void(double)> &advance,
                       TimeStepper &settling_clock,
                       const MPI_Comm communicator)
    {
      const SettlingParameters &settling          = parameters.settling;
      constexpr unsigned int steps_between_checks = 50;
      double ratio                                = std::numeric_limits<double>::infinity();
      move_before_release(control, settling_clock, settling.maximum_time, steps_between_checks, advance, [&] {
        ratio = kinetic_to_elastic_energy(scene.bodies, scene.water, communicator);
        return ratio < settling.kinetic_energy;
      });
      return ratio;
    }
  } // namespace


  template <int dim>
  bool settle(const Parameters &parameters,
              Scene<dim> &scene,
              StepControl<dim> &control,
              RunFolder &folder,
              const std::function<void(double)> &advance,
              const MPI_Comm communicator)
  {
    const SettlingParameters &settling = parameters.settling;
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);
    scene.forcing.set_damping(settling.damping_rate);

    TimeStepper settling_clock(parameters.time_step);
    const double ratio        = settle_down(parameters, scene, control, advance, settling_clock, communicator);
    const bool is_released    = control.stop_reason() == StopReason::none;
    const std::string release = ratio < settling.kinetic_energy
                                    ? ". Released."
                                    : ", above the wanted " + number_text(settling.kinetic_energy) +
                                          ": not yet at rest. Released all the same.";
    folder.log("Settled for " + number_text(settling_clock.time()) + " s in " + std::to_string(settling_clock.step()) +
               " steps; kinetic over elastic energy " + number_text(ratio) +
               (is_released ? release : ". Asked to stop."));
    if (!is_released)
      return false;

    scene.forcing.set_damping(0.);
    scene.open_gate();
    scene.stop();
    control.measure_speeds();
    return true;
  }

  template bool settle(const Parameters &,
                       Scene<2> &,
                       StepControl<2> &,
                       RunFolder &,
                       const std::function<void(double)> &,
                       const MPI_Comm);
  template bool settle(const Parameters &,
                       Scene<3> &,
                       StepControl<3> &,
                       RunFolder &,
                       const std::function<void(double)> &,
                       const MPI_Comm);
} // namespace scree
