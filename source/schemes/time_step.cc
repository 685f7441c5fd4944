// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/schemes/time_step.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  void TimeStepParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Time step");
    prm.add_parameter("Courant number",
                      courant,
                      "Time step times (wave speed + velocity), over the cell size; from 1e-6 to 2. Above auto the "
                      "stress may oscillate or the run diverge. auto: 0.8 in dry cases with AFLIP, else 0.6.",
                      Patterns::Anything());
    prm.add_parameter("Advection number",
                      advection_number,
                      "Largest distance that a point moves in a time step, over the cell size.",
                      Patterns::Double(1e-6, 1));
    prm.add_parameter("Maximum time step",
                      maximum,
                      "s; upper bound of the time step. auto: 0.01 s with water; sqrt(0.2 h/g) in dry cases with "
                      "gravity; none in dry cases without gravity.",
                      Patterns::Anything());
    prm.add_parameter(
        "Mass scaling",
        mass_scaling,
        "Inertia of soil and water over the true one, for consolidation and other slow motion; weight and "
        "all other forces are true. Time steps are longer by its square root, also the maximum of auto; a PIC rate of "
        "auto is smaller by it. Keep 4 H/c times this root below 0.05 H^2/c_v, with layer height H, wave speed c and "
        "coefficient "
        "of consolidation c_v.",
        Patterns::Double(1));
    prm.leave_subsection();
  }


  void TimeStepParameters::check() const
  {
    if (courant != "auto")
      {
        const double number = number_of(courant);
        require_entry(number >= 1e-6 && number <= 2.,
                      "Time step",
                      "Courant number",
                      courant,
                      "write auto, or a number from 1e-6 to 2.");
      }
    if (maximum == "auto")
      return;
    const double number = number_of(maximum);
    require_entry(number >= 1e-12 && std::isfinite(number),
                  "Time step",
                  "Maximum time step",
                  maximum,
                  "write auto, or a number from 1e-12 on, in s.");
  }


  void TimeStepParameters::choose(const bool has_water,
                                  const double courant_of_transfer,
                                  const double gravity,
                                  const double cell_size)
  {
    courant_number = courant != "auto" ? number_of(courant) : courant_of_transfer;
    choose_maximum(has_water, gravity, cell_size);
  }


  void TimeStepParameters::choose_maximum(const bool has_water, const double gravity, const double cell_size)
  {
    constexpr double part_of_cell = 0.1, of_wet_soil = 1e-2;
    if (maximum != "auto")
      maximum_time_step = number_of(maximum);
    else if (has_water)
      maximum_time_step = of_wet_soil * std::sqrt(mass_scaling);
    else
      maximum_time_step = gravity > 0. ? std::sqrt(2. * part_of_cell * cell_size * mass_scaling / gravity)
                                       : std::numeric_limits<double>::infinity();
  }


  TimeStepper::TimeStepper(const TimeStepParameters &parameters)
      : parameters(parameters)
  {
  }


  std::array<double, 3> TimeStepper::bounds(const double cell_size, const double wave_speed, const double speed) const
  {
    const auto over = [](const double length, const double velocity) {
      return velocity > 0 ? length / velocity : std::numeric_limits<double>::infinity();
    };
    return { { parameters.maximum_time_step,
               over(parameters.courant_number * cell_size, wave_speed / std::sqrt(parameters.mass_scaling) + speed),
               over(parameters.advection_number * cell_size, speed) } };
  }


  double TimeStepper::stable_step(const double cell_size, const double wave_speed, const double speed) const
  {
    const auto all = bounds(cell_size, wave_speed, speed);
    return *std::min_element(all.begin(), all.end());
  }


  StepLimit TimeStepper::limit(const double cell_size, const double wave_speed, const double speed) const
  {
    const auto all = bounds(cell_size, wave_speed, speed);
    return static_cast<StepLimit>(std::min_element(all.begin(), all.end()) - all.begin());
  }


  double TimeStepper::part_left(const double cell_size, const double wave_speed, const double speed) const
  {
    const auto all = bounds(cell_size, wave_speed, speed);
    return std::min(1., all[0] / std::min(all[1], all[2]));
  }


  double TimeStepper::next_step(const double stable_step, const double due) const
  {
    const double remaining = due - current_time;
    return remaining / std::max(1., std::ceil(remaining / stable_step * (1. - 1e-12)));
  }


  void TimeStepper::advance(const double time_step, const double due)
  {
    AssertThrow(current_time + time_step > current_time,
                ExcMessage("The time stands still: at t = " + Utilities::to_string(current_time) + " s the step is " +
                           Utilities::to_string(time_step) +
                           " s. Remedies: a shorter 'End time', smaller moduli or a smaller 'Viscosity'."));
    const bool arrives = current_time + 1.5 * time_step > due;
    current_time       = arrives ? due : current_time + time_step;
    ++n_steps;
  }
} // namespace scree
