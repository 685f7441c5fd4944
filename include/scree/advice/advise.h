// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_advise_h
#define scree_advice_advise_h

#include <scree/run/simulation.h>

#include <ostream>

namespace scree
{
  /// What a pressure wave in dry soil runs through.
  struct WaveMedium
  {
    double bulk_modulus = 0, ///< K, Pa
        shear_modulus   = 0; ///< G, Pa
    double density      = 0; ///< dry, kg/m^3

    /// m/s; 0 without soil.
    double speed() const
    {
      return density > 0 ? std::sqrt((bulk_modulus + 4. / 3. * shear_modulus) / density) : 0.;
    }
  };

  /// What a case starts from, in numbers of all ranks: sizes, stiffness, counts. SI units; in 2D per metre of
  /// thickness.
  struct SceneNumbers
  {
    unsigned int dim = 2;    ///< space dimension, 2 or 3
    double gravity   = 9.81; ///< m/s^2
    double end_time  = 1;    ///< s

    /// Of the soil (without soil: of the water) along gravity, on a bed its thickness normal to it; without
    /// gravity its longest side, m.
    double height = 0;
    double fall   = 0; ///< what the centre of mass sinks until all lies level in the box, m

    bool has_changing_forces = false; ///< a load that depends on time, or a body force

    bool has_soil              = false; ///< whether any body can move
    bool sticks                = false; ///< on a floor or bed that holds the soil
    bool is_layer              = false; ///< on a bed: the height is a thickness
    bool is_elastic            = false; ///< all bodies are linear elastic
    double courant_of_transfer = 0;     ///< see TransferParameters::courant_number()
    WaveMedium mean;                    ///< means over the volume of the soil
    double largest_wave_speed = 0;      ///< of all points, m/s
    double grain_density      = 0;      ///< kg/m^3, mean
    double porosity           = 0;      ///< mean
    double grain_diameter     = 0;      ///< of friction that grows with the rate, m, smallest of all bodies; 0: none

    bool has_water        = false; ///< whether there is a subsection Water
    bool is_single_point  = false; ///< whether the soil's points carry the water
    bool water_fills_soil = false; ///< in all the soil's pores and nowhere else
    double water_density  = 1000;  ///< kg/m^3
    double conductivity   = 0;     ///< m/s, at Earth's gravity

    double cell_size      = 0; ///< m
    double n_cells        = 0; ///< of the box
    double n_occupied     = 0; ///< cells with points
    double n_soil_points  = 0; ///< points of all bodies
    double n_water_points = 0; ///< 0 if the soil's points carry the water

    /// Whether the scene collapses or runs out.
    bool falls() const
    {
      constexpr double least_part = 0.05; // of the height
      return fall > least_part * height;
    }

    /// M = K + 4/3 G of the soil, Pa, mean: the modulus of compression without lateral strain.
    double constrained_modulus() const
    {
      return mean.bulk_modulus + 4. / 3. * mean.shear_modulus;
    }

    /// Of soil with the water in its pores, or of water alone, kg/m^3.
    double density() const
    {
      return has_soil ? mean.density + (has_water ? porosity * water_density : 0.) : water_density;
    }

    /// Points of soil and water.
    double n_points() const
    {
      return n_soil_points + n_water_points;
    }
  };

  /// The scales of a scene and the dimensionless groups they make; doc/running.md, "Cost estimate",
  /// has the formulas and their sources. A number that a scene does not have is 0.
  struct Groups
  {
    double motion_time        = 0; ///< sqrt(H/g), s; without gravity H over the wave speed
    double wave_speed         = 0; ///< sqrt(M/rho) of the mean soil, m/s
    double own_strain         = 0; ///< rho g H/M, -: strain of the lowest soil under its own weight
    double shear_stress_ratio = 0; ///< rho g H/G, -
    double mach_number        = 0; ///< sqrt(g H) over the wave speed, -: 1 where motion is as fast as pressure waves

    double consolidation_coefficient = 0; ///< c_v = k M/(rho_w g), m^2/s
    double drainage_time             = 0; ///< H^2/c_v, s
    double drainage                  = 0; ///< drainage time over motion time, -
    double time_factor               = 0; ///< T_v = end time over drainage time, -
    double drag_time                 = 0; ///< in which drag takes the slip between soil and water, s

    double cells_over_height = 0; ///< H/h, -
  };

  /// Computes the groups of a scene of soil and water.
  Groups groups_of(const SceneNumbers &scene);

  /// Conductivity, m/s, at which drainage time over motion time is `drainage`.
  double conductivity_for(const SceneNumbers &scene, const double drainage);

  /// Looks at the points of a run before its first step. Collective.
  template <int dim>
  SceneNumbers survey(const Simulation<dim> &simulation, const Parameters &parameters, const MPI_Comm communicator);

  /// Where the simpler models are within 5 % of soil and water, measured: doc/studies/pages/drained_or_coupled.md
  /// (columns that collapse in air and under water and that are loaded, until 4 sqrt(H/g)).
  namespace thresholds
  {
    /// Drainage time over motion time, of loads (0.54 to 0.7). In a collapse the drained model differs by 20 to 34 % in
    /// air and by 23 % or more under water, whatever the conductivity.
    constexpr double drained_below = 0.54;

    /// Drainage time over motion time, in all scenes (a collapse in air: 38 to 414, under water: 100, loads: 256 to
    /// 296).
    constexpr double undrained_above = 414.;

    /// T_v at the end, beyond which pressure leaves: that of the study's runs at the limit.
    constexpr double consolidates_above = 4. / undrained_above;
  } // namespace thresholds

  /// What to choose, and why.
  struct Choice
  {
    std::string name, ///< as the report writes it
        reason;       ///< the numbers behind it, as a sentence
  };

  // The choices and laws for a scene are rows of source/advice/choices.table.

  /// The simplest model that is within 5 % in a scene: "dry", "water alone", "drained" (excess pressure leaves as fast
  /// as it comes), "undrained" (water stays where it is in the soil), or "coupled".
  Choice model_for(const SceneNumbers &scene);

  /// Whose points should carry the water of a scene: "single" or "double".
  Choice water_points_for(const SceneNumbers &scene);

  /// A measured law of convergence: relative error = factor (h/H)^order, down to the resolution that carries motion and
  /// the smallest error that was measured. Of the run-out it is the largest error that was measured.
  struct ErrorLaw
  {
    std::string measure;     ///< what the error is of
    double factor;           ///< relative error at h = H
    double order;            ///< order of convergence
    std::string range  = ""; ///< errors that were measured, and against what
    std::string gap    = ""; ///< why the law does not decide this scene's error; empty: it does
    std::string remedy = ""; ///< why finer cells make it worse, and what to do; empty: they help

    static constexpr double smallest = 2e-4; ///< smallest relative error that was measured

    /// Relative error at H/h cells over the height.
    double error(const double cells_over_height) const
    {
      return std::max(smallest, factor * std::pow(cells_over_height, -order));
    }

    /// H/h for a relative error: the inverse of error().
    double cells_over_height(const double error) const
    {
      return std::pow(factor / error, 1. / order);
    }
  };

  /// The law of a scene's kind: run-out of plastic soil, elastic soil under a constant load, free water that falls. The
  /// run-out of undrained soil, and of soil with water on a base that holds it, has not converged; that of thin soil on
  /// a bed was not measured. Other scenes have lengths of their own. Where there is no law, `gap` says why.
  ErrorLaw error_law_of(const SceneNumbers &scene);

  /// Largest cell size, m, that divides the box and gives at least `cells` over `height`, m.
  double cell_size_for(const GridParameters &grid, const double height, const double cells);

  /// The entries of subsection Time step that serve a scene, by measurement: the rest stays as it is.
  TimeStepParameters time_step_for(const SceneNumbers &scene, TimeStepParameters present);

  /// What a step of a case takes on this machine, by part: core-seconds of all ranks together.
  using StepCost = std::map<std::string, double>;

  /// Name of what is in no part.
  constexpr const char *other_parts = "everything else";

  /// Of all parts, core-seconds.
  double seconds_of(const StepCost &cost);

  /// What limits the steps for a while.
  struct SpeedInterval
  {
    double duration = 0; ///< s
    double wave     = 0, ///< largest speed of a pressure wave, m/s
        speed       = 0; ///< largest speed of a point, m/s
  };

  /// What was seen of a run.
  struct Observation
  {
    std::vector<SpeedInterval> intervals; ///< from the start on
    double n_first  = 0;                  ///< steps whose cost is `first`
    double n_points = 0;                  ///< of soil and water
    StepCost first,                       ///< cost of the first steps
        later;                            ///< cost of the steps after them
    double setup   = 0; ///< what the very first step takes beyond `first`: to make room, start libraries
    double picture = 0, ///< cost of writing a picture, core-seconds
        row        = 0; ///< cost of writing a row of statistics, core-seconds

    /// Of all intervals, s.
    double duration() const
    {
      double sum = 0;
      for (const SpeedInterval &interval : intervals)
        sum += interval.duration;
      return sum;
    }
  };

  /// What a whole run will take.
  struct RunCost
  {
    double first_step     = 0, ///< length of the first time step, s
        mean_step         = 0; ///< mean length over the run, s
    double n_steps        = 0; ///< number of time steps
    double step_seconds   = 0; ///< core-seconds
    double output_seconds = 0; ///< core-seconds

    /// Cost of steps and output, core-seconds.
    double seconds() const
    {
      return step_seconds + output_seconds;
    }
  };

  /// The cost of a run of `scene` that goes as was seen: the steps by the speeds that limit them, their cost by the
  /// first and the later ones. What was not seen of the run goes on as the last of what was.
  RunCost cost_of_run(const SceneNumbers &scene,
                      const Observation &seen,
                      const TimeStepParameters &time_step,
                      const OutputParameters &output);

  /// First steps that were seen in full, and what came later in a pilot, a run of the whole case with wider cells. A
  /// part of the later steps takes that many times as long as in the first ones as it does in the pilot; what the first
  /// ones hardly know takes as much a point as there.
  Observation with_pilot(Observation first_steps, const Observation &pilot);

  /// The same scene and run with other cells: points and cells in proportion, and the cost with them.
  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size);

  /// The same of an observation: its points and costs with other cells.
  Observation with_cell_size(Observation seen, const SceneNumbers &scene, const double cell_size);

  /// The run of the scene's soil without its water.
  Observation without_water(const Observation &seen, const SceneNumbers &scene);

  /// Takes the time of the first steps of a run, until rank 0 has spent `seconds` core-seconds or the run is at its
  /// end, and of what is written then; later steps count as the first. Collective.
  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator);

  /// Takes the time of a whole run, of its first steps until `begin` s and of those that come later; or of less, once
  /// rank 0 has spent `seconds` core-seconds. Nothing is written. Collective.
  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator);

  /// Default of the error that a run is to have.
  constexpr double default_accuracy = 0.05;

  /// Writes what a case is, what it will cost and what would serve it better, from its points and its first steps; its
  /// run folder is not touched. `parameters` must not be used for a run afterwards. Collective; throws as a run's
  /// start.
  /// @param accuracy relative error for which cells are recommended
  /// @param n_ranks that a run is to have; 0: as many as there are now
  template <int dim>
  void advise(Parameters &parameters,
              const double accuracy,
              const unsigned int n_ranks,
              const MPI_Comm communicator,
              std::ostream &out);
} // namespace scree

#endif
