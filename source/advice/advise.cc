// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/case/case_checks.h>

#include <unistd.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// All that the text of an advice is made of.
    struct Advice
    {
      SceneNumbers scene;                   ///< numbers that describe the case
      Observation seen;                     ///< measured steps and their cost
      std::function<double(double)> memory; ///< that a run with cells of this size (m) is estimated to need, bytes
      TimeStepParameters time_step;         ///< entries
      OutputParameters output;              ///< entries
      GridParameters grid;                  ///< box and cell size
      double accuracy      = 0;             ///< relative error for which cells are recommended
      double settling_time = 0;             ///< s, at most
      double stages_time   = 0;             ///< of all stages with their settling, s, at most
      unsigned int n_ranks = 1;             ///< ranks of the run
      unsigned int coarser = 1; ///< how many times as wide the cells were in the first steps that were taken
      double pilot_coarser = 0; ///< and in the pilot; 0: there was none
      std::string pilot_fault;  ///< what kept it from its end
    };


    /// A line of the report.
    struct Line
    {
      std::string name, value;
      bool applies = true; ///< to this scene
    };


    void write(std::ostream &out, const std::string &title, const std::vector<Line> &lines)
    {
      constexpr std::size_t width = 48;
      out << '\n' << title << '\n';
      for (const Line &line : lines)
        if (line.applies)
          out << "  " << line.name << std::string(std::max<int>(1, width - line.name.size()), ' ') << line.value
              << '\n';
    }

    /// Counts and seconds of some size in full, else three digits.
    std::string rounded(const double value, const std::string &unit = "")
    {
      const bool is_long = std::abs(value) >= 1e3 && std::abs(value) < 1e6;
      return formatted(is_long ? "%.0f" : "%.3g", value) + (unit.empty() ? "" : ' ' + unit);
    }

    /// 5400 -> "5400 core-seconds = 1.5 core-hours"
    std::string core_time(const double seconds)
    {
      return rounded(seconds, "core-seconds") + " = " + rounded(seconds / 3600., "core-hours");
    }

    std::string megabytes(const double bytes)
    {
      return rounded(std::round(1e-6 * bytes), "MB");
    }


    std::vector<Line> scales(const SceneNumbers &scene)
    {
      const Groups groups   = groups_of(scene);
      const bool has_weight = scene.has_soil && scene.gravity > 0;
      return {
        { "height H", rounded(scene.height, "m") },
        { scene.gravity > 0 ? "time of motion sqrt(H/g)" : "time of a wave H/c",
          rounded(groups.motion_time, "s"),
          groups.motion_time > 0 },
        { "density rho", rounded(scene.density(), "kg/m^3") },
        { "modulus M = K + 4/3 G at the start, mean", rounded(scene.constrained_modulus(), "Pa"), scene.has_soil },
        { "wave speed, mean and largest",
          rounded(groups.wave_speed) + " and " + rounded(scene.largest_wave_speed, "m/s"),
          scene.has_soil },
        { "strain by own weight rho g H/M", rounded(groups.own_strain), has_weight },
        { "weight over shear modulus rho g H/G",
          rounded(groups.shear_stress_ratio),
          has_weight && groups.shear_stress_ratio > 0 },
        { "Mach number of the motion sqrt(g H)/c", rounded(groups.mach_number), has_weight }
      };
    }


    std::vector<Line> soil_and_water(const SceneNumbers &scene, const double step)
    {
      const Groups groups = groups_of(scene);
      return { { "consolidation coefficient c_v = k M/(rho_w g)", rounded(groups.consolidation_coefficient, "m^2/s") },
               { "drainage time H^2/c_v", rounded(groups.drainage_time, "s") },
               { "drainage time over time of motion", rounded(groups.drainage) },
               { "end time over drainage time, T_v", rounded(groups.time_factor) },
               { "drag relaxation time", rounded(groups.drag_time, "s") },
               { "drag relaxation time over time step",
                 rounded(groups.drag_time / step, "(any is stable: drag is implicit)") },
               { "drained is sufficient (static load) above k =",
                 rounded(conductivity_for(scene, thresholds::drained_below), "m/s") },
               { "undrained is sufficient (motion) below k =",
                 rounded(conductivity_for(scene, thresholds::undrained_above), "m/s") } };
    }


    std::vector<Line> size(const Advice &advice)
    {
      const SceneNumbers &scene = advice.scene;
      return { { "cells of the box; with points", rounded(scene.n_cells) + "; " + rounded(scene.n_occupied) },
               { "cells over the height H/h", rounded(groups_of(scene).cells_over_height) },
               { "soil points",
                 rounded(scene.n_soil_points, scene.is_single_point ? "(they carry the water)" : ""),
                 scene.has_soil },
               { "water points", rounded(scene.n_water_points), scene.n_water_points > 0 },
               { "memory", megabytes(advice.memory(scene.cell_size)) } };
    }


    std::vector<Line> cost_of_case(const Advice &advice, const RunCost &cost)
    {
      const SceneNumbers &scene = advice.scene;
      const double first = seconds_of(advice.seen.first), later = seconds_of(advice.seen.later);
      const auto nanoseconds = [&](const double of_first, const double of_later) {
        const double unit = 1e9 / scene.n_points();
        return rounded(unit * of_first) + "; " + rounded(unit * of_later, "ns a point");
      };
      std::vector<Line> lines = { { "step at the start; mean expected",
                                    rounded(cost.first_step) + "; " + rounded(cost.mean_step, "s") },
                                  { "steps to " + rounded(scene.end_time, "s"), rounded(cost.n_steps) },
                                  { "a step at the start; later", nanoseconds(first, later) } };
      StepCost of_first = advice.seen.first, of_later = advice.seen.later;
      std::vector<std::string> parts;
      for (const TimerSection part : step_parts())
        parts.push_back(name_of(part));
      parts.emplace_back(other_parts);
      constexpr double least = 0.02; // of a step
      for (const std::string &part : parts)
        lines.push_back({ "  " + part,
                          nanoseconds(of_first[part], of_later[part]),
                          part == other_parts || of_first[part] >= least * first || of_later[part] >= least * later });
      const std::string cells = std::to_string(advice.coarser), ranks = std::to_string(advice.n_ranks);
      const bool has_failed        = !advice.pilot_fault.empty();
      const std::vector<Line> rest = {
        { "at the start: steps that were taken",
          rounded(advice.seen.n_first) + (advice.coarser > 1 ? ", with cells " + cells + " times as wide" : "") },
        { "later", "not known, the run of the case with wider cells failed: " + advice.pilot_fault, has_failed },
        { "later: the case was run with cells",
          rounded(advice.pilot_coarser, "times as wide"),
          !has_failed && advice.pilot_coarser > 0 },
        { "output", rounded(cost.output_seconds, "core-seconds") },
        { "run", core_time(cost.seconds()) },
        { "on " + ranks + " ranks, if shared out evenly",
          rounded(cost.seconds() / advice.n_ranks) + " s, " + megabytes(advice.memory(scene.cell_size)) + ", " +
              rounded(scene.n_points() / advice.n_ranks) + " points each (ten thousand keep a rank busy)",
          advice.n_ranks > 1 },
        { "settling, at most",
          core_time(cost.step_seconds / scene.end_time * advice.settling_time),
          advice.settling_time > 0 },
        { "stages with their settling, at most",
          core_time(cost.step_seconds / scene.end_time * advice.stages_time),
          advice.stages_time > 0 }
      };
      lines.insert(lines.end(), rest.begin(), rest.end());
      return lines;
    }


    std::vector<Line> recommendation(const Advice &advice, const ErrorLaw &law)
    {
      const SceneNumbers &scene = advice.scene;
      const Choice model = model_for(scene), points = water_points_for(scene);
      constexpr double fewest            = 10.; // cells over the height, which the motion needs
      const bool decides                 = law.gap.empty() && law.remedy.empty();
      const double cells                 = decides          ? std::max(fewest, law.cells_over_height(advice.accuracy))
                                           : scene.is_layer ? SoilMotion<2>::least_cells
                                                            : 0.;
      const bool stays                   = !decides && scene.height >= cells * scene.cell_size;
      const double size                  = stays ? scene.cell_size : cell_size_for(advice.grid, scene.height, cells);
      const std::string error            = law.gap.empty()
                                               ? "error up to about " + rounded(law.error(scene.height / scene.cell_size))
                                               : "the error is not known";
      const SceneNumbers wanted          = with_cell_size(scene, size);
      const Observation seen             = with_cell_size(advice.seen, scene, size);
      const TimeStepParameters time_step = time_step_for(wanted, advice.time_step);
      const double maximum               = time_step.maximum_time_step;
      const RunCost cost                 = cost_of_run(wanted, seen, time_step, advice.output);
      SceneNumbers soil                  = wanted;
      soil.n_water_points                = 0;
      const bool soil_serves             = model.name == "drained" || model.name == "undrained";
      const double alone =
          soil_serves ? cost_of_run(soil, without_water(seen, wanted), time_step, advice.output).seconds() : 0.;
      return { { "model", model.name + ": " + model.reason },
               { "water points", points.name + ": " + points.reason, scene.has_water && scene.has_soil },
               { "cell size",
                 rounded(size, "m, H/h = ") + rounded(scene.height / size) +
                     (stays ? " as now: " + error : " (now " + rounded(scene.cell_size, "m: ") + error + ')') },
               { "error",
                 "not known: " + law.gap + (law.remedy.empty() ? ". Halve the cells and the step, and compare" : ""),
                 !law.gap.empty() },
               { "do not refine", law.remedy, !law.remedy.empty() },
               { "measured in such scenes", law.range, !law.range.empty() },
               { "step",
                 "about " + rounded(cost.mean_step, "s, with Courant number = ") + rounded(time_step.courant_number) +
                     ", Maximum time step = " + (std::isfinite(maximum) ? rounded(maximum) : time_step.maximum) },
               { "points", rounded(wanted.n_points()) },
               { "memory", megabytes(advice.memory(size)) },
               { "run", core_time(cost.seconds()) },
               { "run of the soil alone", core_time(alone), soil_serves } };
    }


    /// Writes groups, size, cost and recommendation, a line a number with its unit.
    void write_report(const Advice &advice, std::ostream &out)
    {
      const SceneNumbers &scene = advice.scene;
      const RunCost cost        = cost_of_run(scene, advice.seen, advice.time_step, advice.output);
      const ErrorLaw law        = error_law_of(scene);
      out << scene.dim << "D, " << model_for(scene).name << '\n';
      write(out, "Scales", scales(scene));
      if (scene.has_soil && scene.has_water)
        write(out, "Soil and water", soil_and_water(scene, cost.mean_step));
      write(out, "Size", size(advice));
      write(out, "Estimated cost of this case", cost_of_case(advice, cost));
      write(out,
            "Recommendation for a relative error of " + rounded(advice.accuracy, law.measure),
            recommendation(advice, law));
    }


    /// A run folder of its own for the steps that are looked at; removed with its owner. Collective.
    std::shared_ptr<const std::string> passing_folder(const MPI_Comm communicator)
    {
      const std::string name = std::filesystem::temp_directory_path() / ("scree-advice-" + std::to_string(getpid()));
      const bool removes     = Utilities::MPI::this_mpi_process(communicator) == 0;
      return { new std::string(Utilities::MPI::broadcast(communicator, name)), [removes](const std::string *folder) {
                std::error_code nobody_minds;
                if (removes)
                  std::filesystem::remove_all(*folder, nobody_minds);
                delete folder;
              } };
    }


    /// How many times as wide cells keep a case to what can be looked at in seconds. Collective.
    template <int dim>
    unsigned int coarsening(const Parameters &parameters, const MPI_Comm communicator)
    {
      constexpr double most = 4e5; // points and fine cells
      MemoryEstimate size;
      on_all_ranks(communicator, [&] { size = estimate_memory<dim>(parameters); });
      const double n = size.n_soil_points + size.n_water_points + size.n_cells;
      return std::max(1., std::ceil(std::pow(n / most, 1. / dim)));
    }


    /// Makes the cells `factor` times as wide, and the longest step. Where they do not fill the box, it is cut: beyond
    /// it there may be no ground.
    void coarsen(Parameters &parameters, const double factor)
    {
      GridParameters &grid    = parameters.grid;
      const double width      = factor * grid.cell_size;
      constexpr double one_up = 1 + 1e-9;
      parameters.time_step.maximum_time_step *= factor;
      for (unsigned int a = 0; a < grid.upper_corner.size(); ++a)
        grid.upper_corner[a] =
            grid.lower_corner[a] + width * std::max(1., std::floor(grid.n_cells_along(a) / factor * one_up));
      grid.cell_size = width;
    }


    constexpr double seconds_of_pilot = 2.; // core-seconds that a run with wider cells may take

    /// How many times as wide the cells of a pilot are: as few as its time allows, and not so many that no height is
    /// left; somewhat more if cells then fill the box.
    double coarsening_of_pilot(const Advice &advice, const double of_run)
    {
      const double least_cells = advice.scene.is_layer ? 0.5 : 3.; // over the height
      const double wanted      = std::pow(of_run / seconds_of_pilot, 1. / (advice.scene.dim + 1));
      const double allowed     = advice.scene.height / advice.scene.cell_size / least_cells;
      const double factor      = std::max({ 2., double(advice.coarser), std::min(wanted, allowed) });
      long common              = 0; // divisor of the cells along all axes
      for (unsigned int a = 0; a < advice.scene.dim; ++a)
        common = std::gcd(common, advice.grid.n_cells_along(a));
      const double exact = common / std::max(1., std::floor(common / factor));
      return exact >= factor && exact < 1.5 * factor ? exact : std::ceil(factor);
    }
  } // namespace


  template <int dim>
  void advise(Parameters &parameters,
              const double accuracy,
              const unsigned int n_ranks,
              const MPI_Comm communicator,
              std::ostream &out)
  {
    constexpr double seconds_of_steps = 0.5;
    for (const InflowParameters &inflow : parameters.inflows)
      require_entry(
          false,
          { inflow.subsection, "Body", inflow.body },
          "--advise looks at the points of the start, and cannot tell what a case costs whose points enter on "
          "the way. Remove the inflow for it, and write its points as a body.");
    const auto folder = passing_folder(communicator);

    Advice advice;
    advice.accuracy      = accuracy;
    advice.grid          = parameters.grid;
    advice.time_step     = parameters.time_step;
    advice.output        = parameters.output;
    advice.settling_time = parameters.settling.maximum_time;
    advice.stages_time   = parameters.later_duration + parameters.stages.size() * advice.settling_time;
    advice.n_ranks       = n_ranks > 0 ? n_ranks : Utilities::MPI::n_mpi_processes(communicator);
    advice.coarser       = coarsening<dim>(parameters, communicator);
    advice.memory        = [&](const double cell_size) {
      const GridParameters of_last_run = std::exchange(parameters.grid, advice.grid);
      parameters.grid.cell_size        = cell_size;
      const double bytes               = estimate_memory<dim>(parameters).bytes(advice.n_ranks);
      parameters.grid                  = of_last_run;
      return bytes;
    };

    parameters.output.screen              = "nothing";
    parameters.output.interval            = 0; // what is written is looked at by itself
    parameters.output.statistics_interval = 0;
    parameters.output.checkpoint_interval = 0;
    parameters.settling.maximum_time      = 0;
    parameters.output_directory           = *folder + "/first_steps";
    coarsen(parameters, advice.coarser);
    {
      Simulation<dim> simulation(parameters, Start::fresh, communicator);
      const SceneNumbers seeded = survey(simulation, parameters, communicator);
      advice.seen               = measure_first_steps(simulation, seconds_of_steps, communicator);
      advice.scene              = with_cell_size(seeded, advice.grid.cell_size);
      advice.seen               = with_cell_size(advice.seen, seeded, advice.grid.cell_size);
      const Scene<dim> &scene   = simulation.state_of_scene();
      const auto of_first_steps = std::exchange(parameters.grid, advice.grid);
      for (const std::string &remark :
           remarks_on(parameters, scene.bodies, scene.water, scene.ground.get(), communicator))
        out << remark << '\n';
      parameters.grid = of_first_steps;
    }
    const double seen = advice.seen.duration();
    if (seen < (1. - 1e-9) * advice.scene.end_time)
      try
        {
          const double of_run  = cost_of_run(advice.scene, advice.seen, advice.time_step, advice.output).step_seconds;
          advice.pilot_coarser = coarsening_of_pilot(advice, of_run);
          parameters.output_directory = *folder + "/pilot";
          parameters.grid             = advice.grid;
          parameters.time_step        = advice.time_step;
          coarsen(parameters, advice.pilot_coarser);
          Simulation<dim> pilot(parameters, Start::fresh, communicator);
          advice.seen = with_pilot(advice.seen, measure_run(pilot, seen, 2. * seconds_of_pilot, communicator));
        }
      catch (const std::exception &fault)
        {
          if (Utilities::MPI::n_mpi_processes(communicator) > 1) // It may be on one rank only.
            throw;
          advice.pilot_fault = fault.what();
        }
    write_report(advice, out);
  }

  template decltype(advise<2>) advise<2>;
  template decltype(advise<3>) advise<3>;
} // namespace scree
