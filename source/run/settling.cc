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
    /// What tells whether the soil rests: a ratio that has to fall below a bound.
    struct Rest
    {
      std::string name;                    ///< of the ratio, for the log
      double bound;                        ///< of the entry
      unsigned int steps_between_checks;   ///< the ratio costs a reduction
      unsigned int n_checks;               ///< at so many of them in a row it has to be below
      std::function<double(double)> ratio; ///< after a step of that many s. Collective
    };


    /// The ratio of energies.
    template <int dim>
    Rest energy_rest(const Scene<dim> &scene, const double bound, const MPI_Comm communicator)
    {
      return { "kinetic over elastic energy", bound, 50, 1, [&scene, communicator](const double) {
                return kinetic_to_elastic_energy(scene.bodies, scene.water, communicator);
              } };
    }


    /// The ratio of forces, and kinetic damping on the way: all stops where the kinetic energy is largest
    /// (@source{barnes1999}), whatever the stiffness.
    template <int dim>
    Rest force_rest(Scene<dim> &scene, const Scheme<dim> &scheme, const double bound, const MPI_Comm communicator)
    {
      double kinetic         = 0.;
      unsigned int n_falling = 0; // steps with less kinetic energy since the last stop
      return { "unbalanced force over weight", bound, 1, 20, [=, &scene, &scheme](const double step) mutable {
                constexpr unsigned int least_way = 4; // Single points do not stop the others.
                const NodalForces forces         = scheme.nodal_forces(step).sum_over_ranks(communicator);
                const bool is_past_peak          = forces.kinetic < kinetic && ++n_falling >= least_way;
                if (is_past_peak)
                  {
                    scene.stop();
                    n_falling = 0;
                  }
                kinetic = is_past_peak ? 0. : forces.kinetic;
                return forces.ratio();
              } };
    }


    /// Steps with damping, until the soil rests, its time is over, or the run is asked to stop.
    /// @return the ratio at the end, infinity if that is not known
    template <int dim>
    double settle_down(const double maximum_time,
                       const Rest &rest,
                       const StepControl<dim> &control,
                       const std::function<void(double)> &advance,
                       TimeStepper &settling_clock,
                       RunFolder &folder)
    {
      constexpr unsigned int steps_between_lines = 1000;
      double ratio                               = std::numeric_limits<double>::infinity();
      unsigned int n_below                       = 0;
      const auto rests                           = [&](const double step) {
        ratio   = rest.ratio(step);
        n_below = ratio < rest.bound ? n_below + 1 : 0;
        if (settling_clock.step() % steps_between_lines == 0)
          folder.log("Settling: " + number_text(settling_clock.time()) + " s, step " +
                     std::to_string(settling_clock.step()) + ", " + rest.name + ' ' + number_text(ratio));
        return n_below >= rest.n_checks;
      };
      move_before_release(control, settling_clock, maximum_time, rest.steps_between_checks, advance, rests);
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
    const Rest rest                    = settling.drainage() == Drainage::drained
                                             ? force_rest(scene, scheme, settling.unbalanced_force, communicator)
                                             : energy_rest(scene, settling.kinetic_energy, communicator);
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);
    scene.forcing.set_damping(settling.drainage() == Drainage::drained ? 0. : settling.damping_rate);
    scheme.set_drainage(settling.drainage());

    TimeStepper settling_clock(
        settling.drainage() == Drainage::drained
            ? parameters.time_step.with_held_pressure(scene.forcing.gravity().norm(), scene.grid.cell_size())
            : parameters.time_step);
    const double ratio        = settle_down(settling.maximum_time, rest, control, advance, settling_clock, folder);
    const bool is_released    = control.stop_reason() == StopReason::none;
    const std::string release = ratio < rest.bound ? ". Released."
                                                   : ", above the wanted " + number_text(rest.bound) +
                                                         ": not yet at rest. Released all the same.";
    folder.log("Settled for " + number_text(settling_clock.time()) + " s in " + std::to_string(settling_clock.step()) +
               " steps; " + rest.name + ' ' + number_text(ratio) + (is_released ? release : ". Asked to stop."));
    if (!is_released)
      return false;

    scene.forcing.set_damping(0.);
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
