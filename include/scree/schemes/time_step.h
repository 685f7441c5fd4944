// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_time_step_h
#define scree_schemes_time_step_h

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>

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
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if the Courant number or the maximum is no number.
    void check() const;

    /// Sets what is `auto`. In the maximum step dry soil may fall through a tenth of a cell, from rest; with water it
    /// is 0.01 s, as its results depend on the step. Both maxima grow with the root of the mass scaling, as waves slow
    /// down by it.
    /// @param courant_of_transfer see TransferParameters::courant_number()
    /// @param gravity m/s^2; without it there is no maximum in dry scenes
    /// @param cell_size m
    void choose(const bool has_water, const double courant_of_transfer, const double gravity, const double cell_size);

    /// The parameters while the pore pressure is held: an `auto` maximum is that of dry soil.
    TimeStepParameters with_held_pressure(const double gravity, const double cell_size) const
    {
      TimeStepParameters held = *this;
      held.choose_maximum(/* has_water */ false, gravity, cell_size);
      return held;
    }

  private:
    void choose_maximum(const bool has_water, const double gravity, const double cell_size);
  };

  /// What bounds a step.
  enum class StepLimit
  {
    entry, ///< Maximum time step
    waves,
    motion
  };

  /// Steps by what bounds them.
  using StepCounts = std::array<unsigned long long, 3>;

  /// The clock of a run: steps that are stable and meet the output times exactly.
  class TimeStepper
  {
  public:
    /// Starts at t = 0 and step 0.
    explicit TimeStepper(const TimeStepParameters &parameters);

    /// Largest step, s: Courant number times cell size over (wave speed + speed), advection number times cell size over
    /// speed, and at most the maximum.
    double stable_step(const double cell_size, const double wave_speed, const double speed) const;

    /// What makes it that large.
    StepLimit limit(const double cell_size, const double wave_speed, const double speed) const;

    /// The part of the step that waves and motion alone would allow which the maximum leaves.
    double part_left(const double cell_size, const double wave_speed, const double speed) const;

    /// The step, s, from now on: at most the stable one, and shortened so that equal steps end at `due`.
    double next_step(const double stable_step, const double due) const;

    /// Moves on by the step, to the due time itself if the step ends there. Throws if the step is too small to move the
    /// time.
    void advance(const double time_step, const double due);

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
    /// The bounds by StepLimit, s.
    std::array<double, 3> bounds(const double cell_size, const double wave_speed, const double speed) const;

    const TimeStepParameters parameters;
    double current_time        = 0;
    unsigned long long n_steps = 0;
  };
} // namespace scree

#endif
