// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/relaxation.h>
#include <scree/tensor/invariants.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double part_that_moves   = 0.01; // of the mass; single points at the surface do not count
    constexpr double damping_of_trials = 2.;   // decay rate of the velocity, times sqrt(height of the soil/gravity)
    constexpr double speed_at_rest     = 2e-4; // over sqrt(g H): terminal speed with a thousandth of strength missing


    /// Extents along gravity, m.
    struct Heights
    {
      double soil;  ///< all of it
      double slope; ///< its free surface
    };


    /// Highest and lowest points of columns of cells. The free surface is the tops of all columns, and the bottoms of
    /// those beside a column without soil. Where it is level within a cell, the slope is all the soil. Collective.
    template <int dim>
    Heights heights_of(const Scene<dim> &scene, const MPI_Comm communicator)
    {
      constexpr double nowhere   = std::numeric_limits<double>::lowest();
      const double h             = scene.grid.cell_size();
      const Tensor<1, dim> up    = -scene.forcing.gravity() / scene.forcing.gravity().norm();
      const Tensor<1, dim> sides = scene.grid.upper_corner() - scene.grid.lower_corner();
      std::array<std::size_t, dim> n; // columns along each axis: one along the axis nearest to gravity
      std::size_t axis = 0, n_columns = 1;
      for (unsigned int a = 1; a < dim; ++a)
        if (std::abs(up[a]) >= std::abs(up[axis]))
          axis = a;
      for (unsigned int a = 0; a < dim; ++a)
        n_columns *= n[a] = a == axis ? 1 : std::lround(sides[a] / h);

      std::vector<double> tops(n_columns, nowhere), depths(n_columns, nowhere); // depth: minus the lowest height
      for_each_moving_point(scene.bodies, [&](const auto &, const auto &point) {
        std::size_t column = 0;
        for (unsigned int a = 0; a < dim; ++a)
          column =
              column * n[a] + std::clamp<long>((point.location[a] - scene.grid.lower_corner()[a]) / h, 0, n[a] - 1);
        const double height = Tensor<1, dim>(point.location) * up;
        tops[column]        = std::max(tops[column], height);
        depths[column]      = std::max(depths[column], -height);
      });
      Utilities::MPI::max(tops, communicator, tops);
      Utilities::MPI::max(depths, communicator, depths);

      double lowest_of_surface = std::numeric_limits<double>::max();
      for (std::size_t column = 0; column < n_columns; ++column)
        if (tops[column] > nowhere)
          {
            lowest_of_surface = std::min(lowest_of_surface, tops[column]);
            for (std::size_t a = dim, stride = 1; a-- > 0; stride *= n[a])
              {
                const std::size_t place = column / stride % n[a];
                if ((place > 0 && tops[column - stride] == nowhere) ||
                    (place + 1 < n[a] && tops[column + stride] == nowhere))
                  lowest_of_surface = std::min(lowest_of_surface, -depths[column]);
              }
          }
      const double top = *std::max_element(tops.begin(), tops.end());
      const double all = top + *std::max_element(depths.begin(), depths.end()), relief = top - lowest_of_surface;
      return { all, relief < h ? all : relief };
    }


    /// What this part of the mass exceeds, within 1 %. Collective.
    /// @param value of a body and a point, not negative
    template <int dim, typename Value>
    double exceeded_by(const double part,
                       const std::list<SoilBody<dim>> &bodies,
                       const Value &value,
                       const MPI_Comm communicator)
    {
      constexpr unsigned int n_bins = 1500;
      constexpr double bins_per_e   = 100.;
      double largest                = 0.;
      for_each_moving_point(
          bodies, [&](const auto &body, const auto &point) { largest = std::max(largest, value(body, point)); });
      largest = Utilities::MPI::max(largest, communicator);
      if (largest == 0. || part == 0.)
        return largest;

      std::vector<double> masses(n_bins, 0.); // from the largest value down
      for_each_moving_point(bodies, [&](const auto &body, const auto &point) {
        const double bin = -bins_per_e * std::log(std::max(value(body, point), 1e-100) / largest);
        masses[std::min(bin, n_bins - 1.)] += point.properties[body.layout.mass];
      });
      Utilities::MPI::sum(masses, communicator, masses);
      double all = 0.;
      for (const double mass : masses)
        all += mass;
      unsigned int bin = 0;
      for (double above = masses[0]; bin + 1 < n_bins && above <= part * all;)
        above += masses[++bin];
      return largest * std::exp(-(bin + 0.5) / bins_per_e);
    }


    /// Largest plastic shear strain; 0 if no law has it. Collective.
    template <int dim>
    double largest_plastic_strain(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator)
    {
      double largest = 0.;
      for (const auto &body : bodies)
        {
          const auto quantities = body.material->internal_quantities;
          for (unsigned int q = 0; q < quantities.size(); ++q)
            if (quantities[q].name == "plastic_shear_strain")
              for_each_point(body.points, [&](const auto &point) {
                largest = std::max(largest, point.properties[body.layout.internal_variables + q]);
              });
        }
      return Utilities::MPI::max(largest, communicator);
    }


    /// Settlement of an elastic layer as high as the soil by its weight, rho g H^2/(2 M), M = rho c^2. Collective.
    template <int dim>
    double elastic_settlement(const std::list<SoilBody<dim>> &bodies,
                              const double gravity,
                              const double height,
                              const MPI_Comm communicator)
    {
      std::vector<double> sums(2, 0.); // mass, and mass over the square of the wave speed
      for_each_moving_point(bodies, [&](const auto &body, const auto &point) {
        const double pressure = mean_effective_stress(point.properties + body.layout.stress);
        const double c        = body.wave_speed(body.material->initial_bulk_modulus(pressure), /* compression */ 0.);
        const double m        = point.properties[body.layout.mass];
        sums                  = { sums[0] + m, sums[1] + m / (c * c) };
      });
      Utilities::MPI::sum(sums, communicator, sums);
      return 0.5 * gravity * height * height * sums[1] / sums[0];
    }
  } // namespace


  template <int dim>
  TimeStepper Relaxation<dim>::relax(const double maximum_time,
                                     const unsigned int steps_between_looks,
                                     const std::function<bool(const TimeStepper &, double)> &is_over)
  {
    TimeStepper clock(parameters.time_step.with_held_pressure(gravity, scene.grid.cell_size()));
    scheme.hold_water(true);
    bool goes_on = true;
    while (goes_on && clock.time() < maximum_time && control.stop_reason() == StopReason::none)
      {
        const double step = clock.next_step(control.stable_step(clock), maximum_time);
        advance(step);
        clock.advance(step, maximum_time);
        if (clock.step() % steps_between_looks == 0 || clock.time() >= maximum_time)
          goes_on = !is_over(clock, step);
      }
    if (control.stop_reason() == StopReason::none)
      {
        scheme.hold_water(false);
        scene.open_gate();
        scene.stop();
        control.measure_speeds();
      }
    return clock;
  }


  template <int dim>
  std::vector<CheckResult> Relaxation<dim>::settle()
  {
    constexpr unsigned int steps_between_lines = 1000;
    constexpr unsigned int least_way           = 4;  // Single points do not stop the others.
    constexpr unsigned int steps_at_rest       = 20; // The force of an oscillation vanishes for a moment.
    const SettlingParameters &settling         = parameters.settling;
    const std::string name_of_ratio            = "unbalanced force over weight ";
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);

    // All stops where the kinetic energy is largest (@source{barnes1999}), whatever the stiffness.
    double ratio           = std::numeric_limits<double>::infinity(); // not known yet
    double kinetic         = 0.;
    unsigned int n_falling = 0; // steps with less kinetic energy since the last stop
    unsigned int n_below   = 0;
    const auto is_at_rest  = [&](const TimeStepper &clock, const double step) {
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
      if (clock.step() % steps_between_lines == 0)
        folder.log("Settling: " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) + ", " +
                   name_of_ratio + number_text(ratio));
      return n_below >= steps_at_rest;
    };
    const TimeStepper clock = relax(settling.maximum_time, 1, is_at_rest);
    const bool is_released  = control.stop_reason() == StopReason::none;
    folder.log("Settled for " + number_text(clock.time()) + " s in " + std::to_string(clock.step()) + " steps; " +
               name_of_ratio + number_text(ratio) + (is_released ? ". Released." : ". Asked to stop."));
    if (!is_released)
      return {};
    const auto checks = checks_of_settling(ratio);
    for (const CheckResult &check : checks)
      if (check.is_exceeded)
        folder.log("Check: " + check.text + ", bound " + check.bound + '.');
      else
        folder.record("Settling: " + check.text);
    return checks;
  }


  template <int dim>
  std::vector<CheckResult> Relaxation<dim>::checks_of_settling(const double unbalanced_force)
  {
    const Heights height = heights_of(scene, communicator);
    const double elastic = elastic_settlement(scene.bodies, gravity, height.soil, communicator);
    const double allowed = parameters.safety.displacement * height.slope + elastic;
    const double moved   = displacement();
    const bool stands    = !(moved > allowed);
    const bool rests     = unbalanced_force < parameters.settling.unbalanced_force;
    return { { stands ? "displacement while settling " + short_text(moved) + " m"
                      : "this slope does not stand (moved " + short_text(moved) + " m while settling): see --safety",
               short_text(allowed) + " m",
               !stands },
             { "unbalanced force at the release " + short_text(unbalanced_force) + " of the weight",
               short_text(parameters.settling.unbalanced_force),
               !rests },
             { "largest plastic shear strain of settling " +
                   short_text(largest_plastic_strain(scene.bodies, communicator)),
               "" } };
  }


  template <int dim>
  double Relaxation<dim>::displacement() const
  {
    return exceeded_by(
        part_that_moves,
        scene.bodies,
        [](const auto &body, const auto &point) {
          return (Tensor<1, dim>(point.location) - vector_of<dim>(point.properties + body.layout.start)).norm();
        },
        communicator);
  }


  template <int dim>
  Trial Relaxation<dim>::try_strength(const double displacement_of_failure)
  {
    constexpr unsigned int steps_between_looks = 20;
    const Heights height                       = heights_of(scene, communicator);
    const double time_scale                    = std::sqrt(height.soil / gravity);
    const TrialBounds bounds{ time_scale,
                              speed_at_rest * gravity * time_scale,
                              displacement_of_failure * height.slope,
                              parameters.safety.longest_trial * time_scale };
    TrialJudge judge(bounds);
    Trial trial;
    scene.forcing.set_damping(damping_of_trials / time_scale);
    const auto has_ended = [&](const TimeStepper &clock, const double) {
      trial.displacement = displacement();
      const double speed = exceeded_by(
          part_that_moves,
          scene.bodies,
          [](const auto &body, const auto &point) {
            return vector_of<dim>(point.properties + body.layout.velocity).norm();
          },
          communicator);
      trial.end = judge.look(clock.time(), trial.displacement, speed);
      folder.record("t " + number_text(clock.time()) + " s, displacement " + number_text(trial.displacement) +
                    " m, speed " + number_text(speed) + " m/s");
      return trial.end != TrialEnd::undecided;
    };
    const TimeStepper clock = relax(bounds.maximum_time, steps_between_looks, has_ended);
    scene.forcing.set_damping(0.);
    trial.time  = clock.time();
    trial.steps = clock.step();
    return trial;
  }

  template class Relaxation<2>;
  template class Relaxation<3>;
} // namespace scree
