// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_time_step_h
#define scree_schemes_time_step_h

#include <scree/input/input_error.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scree
{
  /// Subsection Time step.
  struct TimeStepParameters
  {
    std::string courant      = "auto"; ///< the entry: a number, or auto
    double courant_number    = 0.6;    ///< bound of (wave speed + speed) dt/h, what choose() has made of the entry
    double advection_number  = 0.3;    ///< bound of speed dt/h
    std::string maximum      = "auto"; ///< the entry: s, or auto
    double maximum_time_step = 1e-2;   ///< s, what choose_maximum() has made of the entry
    double mass_scaling      = 1.;     ///< mass that resists acceleration over mass that has weight

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Time step");
      prm.add_parameter("Courant number",
                        courant,
                        "Time step times (wave speed + velocity), over the cell size; from 1e-6 to 2. Above auto the "
                        "stress may oscillate or the run diverge. auto: 0.8 in dry cases with AFLIP, else 0.6.");
      prm.add_parameter("Advection number",
                        advection_number,
                        "Largest distance that a point moves in a time step, over the cell size.",
                        dealii::Patterns::Double(1e-6, 1));
      prm.add_parameter("Maximum time step",
                        maximum,
                        "s; upper bound of the time step. auto: with water sqrt(0.0005 h/g), but at least 0.01 s; "
                        "in dry cases sqrt(0.2 h/g) with gravity, none without.");
      prm.add_parameter(
          "Mass scaling",
          mass_scaling,
          "Inertia of soil and water over the true one, for consolidation and other slow motion; weight and "
          "all other forces are true. Time steps are longer by its square root, also the maximum of auto; a PIC rate "
          "of "
          "auto is smaller by it. Keep 4 H/c times this root below 0.05 H^2/c_v, with layer height H, wave speed c and "
          "coefficient "
          "of consolidation c_v.",
          dealii::Patterns::Double(1));
      prm.leave_subsection();
    }

    /// Throws EntryError if the Courant number or the maximum is no number.
    void check() const
    {
      if (courant != "auto")
        {
          const double number = number_of(courant);
          require_entry(number >= 1e-6 && number <= 2.,
                        { "Time step", "Courant number", courant },
                        "write auto, or a number from 1e-6 to 2.");
        }
      if (maximum == "auto")
        return;
      const double number = number_of(maximum);
      require_entry(number >= 1e-12 && std::isfinite(number),
                    { "Time step", "Maximum time step", maximum },
                    "write auto, or a number from 1e-12 on, in s.");
    }

    /// Sets what is `auto`. In the maximum step dry soil may fall through a tenth of a cell, from rest; with water
    /// through 1/4000 of a cell, or the step is 0.01 s, as its results depend on it. Both maxima grow with the root of
    /// the mass scaling, as waves slow down by it.
    /// @param courant_of_transfer see TransferParameters::courant_number()
    /// @param gravity m/s^2; without it there is no maximum in dry scenes
    /// @param cell_size m
    void choose(const bool has_water, const double courant_of_transfer, const double gravity, const double cell_size)
    {
      courant_number = courant != "auto" ? number_of(courant) : courant_of_transfer;
      choose_maximum(has_water, gravity, cell_size);
    }

    /// The same for the maximum alone.
    void choose_maximum(const bool has_water, const double gravity, const double cell_size)
    {
      constexpr double part_of_cell = 0.1, wet_part_of_cell = 2.5e-4, of_wet_soil = 1e-2;
      const auto fall_through = [&](const double part) { return std::sqrt(2. * part * cell_size / gravity); };
      if (maximum != "auto")
        maximum_time_step = number_of(maximum);
      else if (has_water)
        maximum_time_step =
            std::sqrt(mass_scaling) * std::max(of_wet_soil, gravity > 0. ? fall_through(wet_part_of_cell) : 0.);
      else
        maximum_time_step = gravity > 0. ? std::sqrt(mass_scaling) * fall_through(part_of_cell)
                                         : std::numeric_limits<double>::infinity();
    }
  };

  /// What bounds a step.
  enum class StepLimit
  {
    entry, ///< Maximum time step
    waves,
    motion
  };

  /// The clock of a run: steps that are stable and meet the output times exactly.
  class TimeStepper
  {
  public:
    /// Starts at t = 0 and step 0.
    explicit TimeStepper(const TimeStepParameters &parameters)
        : parameters(parameters)
    {
    }

    /// What bounds a step, by StepLimit, s: the maximum, Courant number times cell size over (wave speed + speed), and
    /// advection number times cell size over speed.
    std::array<double, 3> bounds(const double cell_size, const double wave_speed, const double speed) const
    {
      const auto over = [](const double length, const double velocity) {
        return velocity > 0 ? length / velocity : std::numeric_limits<double>::infinity();
      };
      return { { parameters.maximum_time_step,
                 over(parameters.courant_number * cell_size, wave_speed / std::sqrt(parameters.mass_scaling) + speed),
                 over(parameters.advection_number * cell_size, speed) } };
    }

    /// Largest step, s.
    double stable_step(const double cell_size, const double wave_speed, const double speed) const
    {
      const auto all = bounds(cell_size, wave_speed, speed);
      return *std::min_element(all.begin(), all.end());
    }

    /// The step, s, from now on: at most the stable one, and shortened so that equal steps end at `due`.
    double next_step(const double stable_step, const double due) const
    {
      const double remaining = due - current_time;
      return remaining / std::max(1., std::ceil(remaining / stable_step * (1. - 1e-12)));
    }

    /// Moves on by the step, to the due time itself if the step ends there. Throws if the step is too small to move the
    /// time.
    void advance(const double time_step, const double due)
    {
      AssertThrow(current_time + time_step > current_time,
                  dealii::ExcMessage("The time stands still: at t = " + dealii::Utilities::to_string(current_time) +
                                     " s the step is " + dealii::Utilities::to_string(time_step) +
                                     " s. Remedies: a shorter 'End time', smaller moduli or a smaller 'Viscosity'."));
      const bool arrives = current_time + 1.5 * time_step > due;
      current_time       = arrives ? due : current_time + time_step;
      ++n_steps;
    }

    /// Time at the end of the last step, s.
    double time() const
    {
      return current_time;
    }

    /// Number of steps since the start.
    unsigned long long step() const
    {
      return n_steps;
    }

    /// Goes on from the time, s, and step of a checkpoint.
    void set(const double time, const unsigned long long step)
    {
      current_time = time;
      n_steps      = step;
    }

  private:
    const TimeStepParameters parameters;
    double current_time        = 0;
    unsigned long long n_steps = 0;
  };
} // namespace scree

#endif
