// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/case/case_checks.h>

#include <unistd.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Core-seconds of a checkpoint: by itself, and a point; measured over the cases of prm/.
    constexpr double checkpoint_seconds = 1.5e-3, checkpoint_seconds_per_point = 8e-7;

    /// Steps to `end` s, if they are shortened to meet the output times. The last interval goes on.
    /// @param step_of length of the steps of an interval, s
    template <class StepOf>
    double count_steps(const OutputParameters &output,
                       const double end,
                       const std::vector<SpeedInterval> &intervals,
                       const StepOf &step_of)
    {
      OutputTimes times(output, end);
      auto interval = intervals.begin();
      double begin = 0, n_before = 0; // of the interval; steps if nothing is to be written
      const auto so_far = [&](const double time) {
        while (time > begin + interval->duration && interval + 1 != intervals.end())
          {
            n_before += interval->duration / step_of(*interval);
            begin += (interval++)->duration;
          }
        return n_before + (time - begin) / step_of(*interval);
      };
      double n = 0, time = 0;
      while (!times.is_end(time))
        {
          times.begin(time);
          const double next = times.next(0.), before = so_far(time);
          n += std::max(1., std::ceil(so_far(next) - before - 1e-6));
          time = next;
        }
      return n;
    }

    double seconds_of_output(const SceneNumbers &scene, const Observation &seen, const OutputParameters &output)
    {
      const auto count = [&](const double interval) {
        return interval > 0 ? std::floor(scene.end_time / interval) + 1. : 0.;
      };
      return count(output.interval) * seen.picture + count(output.interval_of_statistics()) * seen.row +
             count(output.checkpoint_interval) * (checkpoint_seconds + checkpoint_seconds_per_point * scene.n_points());
    }

    /// Calls `act` with the seconds of every cost of a step in `seen`.
    template <class Act>
    void for_each_part(Observation &seen, const Act &act)
    {
      for (StepCost *steps : { &seen.first, &seen.later })
        {
          const double rest = steps->rest();
          steps->seconds    = act(TimerSection::output, rest);
          for (auto &[part, seconds] : steps->parts)
            {
              seconds = act(part, seconds);
              steps->seconds += seconds;
            }
        }
    }
  } // namespace


  RunCost cost_of_run(const SceneNumbers &scene, const Observation &seen, const Schedule &schedule)
  {
    const TimeStepper clock(schedule.time_step);
    Assert(!seen.intervals.empty(), ExcMessage("Nothing was seen of the run."));
    const auto step_of = [&](const SpeedInterval &interval) {
      return clock.stable_step(scene.cell_size, interval.wave, interval.speed);
    };
    RunCost cost;
    cost.first_step     = step_of(seen.intervals.front());
    cost.n_steps        = count_steps(schedule.output, scene.end_time, seen.intervals, step_of);
    cost.mean_step      = scene.end_time / cost.n_steps;
    const double n_seen = std::min(seen.n_first, cost.n_steps);
    cost.step_seconds   = seen.setup + n_seen * seen.first.seconds + (cost.n_steps - n_seen) * seen.later.seconds;
    cost.output_seconds = seconds_of_output(scene, seen, schedule.output);
    cost.memory         = seen.memory;
    return cost;
  }


  Observation with_pilot(Observation first_steps, const Observation &pilot)
  {
    constexpr double hardly = 0.02; // of a step
    const double points     = first_steps.n_points / pilot.n_points;
    StepCost &later         = first_steps.later;
    later                   = {};
    later.seconds           = first_steps.first.rest();
    for (const auto &[part, in_pilot] : pilot.later.parts)
      {
        const double first = pilot.first.seconds_of(part);
        const bool is_event =
            part == TimerSection::sort || part == TimerSection::repartition; // which first steps need not meet
        const double seconds = is_event || first < hardly * pilot.first.seconds
                                   ? in_pilot * points
                                   : in_pilot / first * first_steps.first.seconds_of(part);
        later.parts[part]    = seconds;
        later.seconds += seconds;
      }
    const double time = first_steps.duration();
    double begin      = 0;
    for (const SpeedInterval &interval : pilot.intervals)
      {
        const double end = begin + interval.duration;
        if (end > time)
          first_steps.intervals.push_back({ end - std::max(begin, time), interval.wave, interval.speed });
        begin = end;
      }
    return first_steps;
  }


  SceneNumbers with_cell_size(SceneNumbers scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for (double *number : { &scene.n_cells, &scene.n_occupied, &scene.n_soil_points, &scene.n_water_points })
      *number *= factor;
    scene.cell_size = cell_size;
    return scene;
  }


  Observation with_cell_size(Observation seen, const SceneNumbers &scene, const double cell_size)
  {
    const double factor = std::pow(scene.cell_size / cell_size, scene.dim);
    for_each_part(seen, [&](const TimerSection, const double seconds) { return factor * seconds; });
    for (double *number : { &seen.n_points, &seen.setup, &seen.picture, &seen.row })
      *number *= factor;
    seen.memory = seen.program_memory + std::max(0., seen.memory - seen.program_memory) * factor;
    return seen;
  }


  Observation without_water(Observation seen, const SceneNumbers &scene)
  {
    const double soil = scene.n_soil_points / scene.n_points();
    for_each_part(seen, [&](const TimerSection part, const double seconds) {
      switch (part)
        {
        case TimerSection::nodes:
        case TimerSection::pressure_system:
        case TimerSection::pressure_solve:
        case TimerSection::water_points:
          return 0.;
        case TimerSection::stress:
          return seconds;
        default:
          return soil * seconds;
        }
    });
    for (double *seconds : { &seen.setup, &seen.picture, &seen.row })
      *seconds *= soil;
    return seen;
  }


  namespace
  {
    /// Watches a run step by step.
    template <int dim>
    class Watch
    {
    public:
      Watch(Simulation<dim> &simulation, const MPI_Comm communicator)
          : simulation(simulation)
          , communicator(communicator)
      {
        for (const PointSet<dim> *points : simulation.point_sets())
          seen.n_points += points->handler().n_global_particles();
      }

      /// Of all ranks.
      template <class Act>
      double core_seconds_of(const Act &act) const
      {
        const double start = processor_time();
        act();
        return Utilities::MPI::sum(processor_time() - start, communicator);
      }

      /// Core-seconds of `act`, a mean, as once may be too short to be timed, of as many as fit into `seconds`. The
      /// first one makes files and starts libraries: it only counts if it alone takes as long.
      template <class Act>
      double mean_of_several(const double seconds, const Act &act) const
      {
        constexpr unsigned int most = 20;
        const double first          = core_seconds_of(act);
        if (first > seconds)
          return first;
        double sum     = 0;
        unsigned int n = 0;
        for (; n == 0 || (n < most && sum < 0.2 * seconds); ++n)
          sum += core_seconds_of(act);
        return sum / n;
      }

      void step()
      {
        const Speeds speeds   = simulation.limiting_speeds();
        const double duration = simulation.step(simulation.stable_step(), simulation.end_time());
        seen.intervals.push_back({ duration, speeds.wave, speeds.points });
      }

      /// Steps while `more`, which gets how many were taken, the core-seconds that rank 0 spent on them and the time
      /// of the run, s, and until the run's end. Adds them to n_steps.
      template <class More>
      StepCost steps_while(const More &more, double &n_steps)
      {
        auto before             = times_of_parts();
        const double wall_start = MPI_Wtime(), start = processor_time();
        double n         = 0;
        double of_rank_0 = 0; // which decides for all
        while (!simulation.is_at_end() && more(n, of_rank_0, simulation.time()))
          {
            step();
            ++n;
            of_rank_0 = Utilities::MPI::broadcast(communicator, processor_time() - start, 0);
          }
        StepCost cost;
        if (n == 0)
          return cost;
        const double wall = MPI_Wtime() - wall_start;
        cost.seconds      = Utilities::MPI::sum(processor_time() - start, communicator) / n;
        for (const auto &[part, seconds] : times_of_parts())
          cost.parts[part] = cost.seconds * (seconds - before[part]) / wall; // 0 s of new ones
        n_steps += n;
        return cost;
      }

      Observation seen;

    private:
      std::map<TimerSection, double> times_of_parts() const
      {
        std::map<TimerSection, double> seconds;
        for (const TimerSection part : step_parts())
          if (const double of_part = scree::seconds_of(simulation.times_of_parts(), part); of_part > 0.)
            seconds[part] = of_part;
        return seconds;
      }

      Simulation<dim> &simulation;
      const MPI_Comm communicator;
    };
  } // namespace


  template <int dim>
  Observation measure_first_steps(Simulation<dim> &simulation, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int most_steps = 2000;
    Watch<dim> watch(simulation, communicator);
    Observation &seen  = watch.seen;
    const double first = watch.core_seconds_of([&] { watch.step(); });
    seen.first         = watch.steps_while(
        [&](const double n, const double spent, const double) { return spent < seconds && n < most_steps; },
        seen.n_first);
    if (seen.n_first == 0) // The run is one step long.
      seen.first.seconds = first;
    seen.later   = seen.first;
    seen.setup   = std::max(0., first - seen.first.seconds);
    seen.row     = watch.mean_of_several(seconds, [&] { simulation.write_row(); });
    seen.picture = watch.mean_of_several(seconds, [&] { simulation.write_picture(); });
    Utilities::System::MemoryStats memory; // kB
    Utilities::System::get_memory_stats(memory);
    seen.memory = Utilities::MPI::sum(1024. * memory.VmHWM, communicator);
    seen.program_memory *= Utilities::MPI::n_mpi_processes(communicator);
    return seen;
  }


  template <int dim>
  Observation
  measure_run(Simulation<dim> &simulation, const double begin, const double seconds, const MPI_Comm communicator)
  {
    constexpr unsigned int least_steps = 10; // to take their time
    Watch<dim> watch(simulation, communicator);
    Observation &seen = watch.seen;
    watch.step();
    seen.first = watch.steps_while(
        [&](const double n, const double, const double time) { return time < begin || n < least_steps; }, seen.n_first);
    double n_later = 0;
    seen.later =
        watch.steps_while([&](const double, const double spent, const double) { return spent < seconds; }, n_later);
    if (n_later == 0)
      seen.later = seen.first;
    return seen;
  }

  template decltype(measure_first_steps<2>) measure_first_steps<2>;
  template decltype(measure_first_steps<3>) measure_first_steps<3>;
  template decltype(measure_run<2>) measure_run<2>;
  template decltype(measure_run<3>) measure_run<3>;


  namespace
  {
    /// All that the text of an advice is made of.
    struct Advice
    {
      SceneNumbers scene;                   ///< numbers that describe the case
      Observation seen;                     ///< measured steps and their cost
      std::function<double(double)> memory; ///< that a run with cells of this size (m) is estimated to need, bytes
      Schedule schedule;                    ///< entries of time step and output
      GridParameters grid;                  ///< box and cell size
      double accuracy      = 0;             ///< relative error for which cells are recommended
      double settling_time = 0;             ///< s, at most
      unsigned int n_ranks = 1;             ///< ranks of the run
      unsigned int coarser = 1; ///< how many times as wide the cells were in the first steps that were taken
      double pilot_coarser = 0; ///< and in the pilot; 0: there was none
      std::string pilot_fault;  ///< what kept it from its end
    };


    std::string rounded(const double value)
    {
      // Counts and seconds of some size in full, else three digits.
      return formatted(std::abs(value) >= 1e3 && std::abs(value) < 1e6 ? "%.0f" : "%.3g", value);
    }

    /// 5400 -> "1.5 core-hours"
    std::string core_time(const double seconds)
    {
      return rounded(seconds) + " core-seconds = " + rounded(seconds / 3600.) + " core-hours";
    }

    std::string megabytes(const double bytes)
    {
      return rounded(std::round(1e-6 * bytes)) + " MB";
    }

    class Writer
    {
    public:
      explicit Writer(std::ostream &out)
          : out(out)
      {
      }
      void title(const std::string &text)
      {
        out << '\n' << text << '\n';
      }
      void line(const std::string &name, const std::string &value)
      {
        constexpr std::size_t width = 48;
        out << "  " << name << std::string(name.size() < width ? width - name.size() : 1, ' ') << value << '\n';
      }
      void line(const std::string &name, const double value, const std::string &unit)
      {
        line(name, rounded(value) + (unit.empty() ? "" : ' ' + unit));
      }

    private:
      std::ostream &out;
    };


    void write_groups(const SceneNumbers &scene, Writer &writer)
    {
      const Groups groups = groups_of(scene);
      writer.title("Scales");
      writer.line("height H", scene.height, "m");
      if (groups.motion_time > 0)
        writer.line(scene.gravity > 0 ? "time of motion sqrt(H/g)" : "time of a wave H/c", groups.motion_time, "s");
      writer.line("density rho", scene.density(), "kg/m^3");
      if (scene.has_soil)
        {
          writer.line("modulus M = K + 4/3 G at the start, mean", scene.constrained_modulus(), "Pa");
          writer.line("wave speed, mean and largest",
                      rounded(groups.wave_speed) + " and " + rounded(scene.fastest.speed()) + " m/s");
        }
      if (scene.has_soil && scene.gravity > 0)
        {
          writer.line("strain by own weight rho g H/M", groups.own_strain, "");
          if (groups.shear_stress_ratio > 0)
            writer.line("weight over shear modulus rho g H/G", groups.shear_stress_ratio, "");
          writer.line("Mach number of the motion sqrt(g H)/c", groups.mach_number, "");
        }
    }


    void write_water(const SceneNumbers &scene, const double step, Writer &writer)
    {
      const Groups groups = groups_of(scene);
      writer.title("Soil and water");
      writer.line("consolidation coefficient c_v = k M/(rho_w g)", groups.consolidation_coefficient, "m^2/s");
      writer.line("drainage time H^2/c_v", groups.drainage_time, "s");
      writer.line("drainage time over time of motion", groups.drainage, "");
      writer.line("end time over drainage time, T_v", groups.time_factor, "");
      writer.line("drag relaxation time", groups.drag_time, "s");
      writer.line("drag relaxation time over time step", groups.drag_time / step, "(any is stable: drag is implicit)");
      writer.line(
          "drained is sufficient (static load) above k =", conductivity_for(scene, thresholds::drained_below), "m/s");
      writer.line(
          "undrained is sufficient (motion) below k =", conductivity_for(scene, thresholds::undrained_above), "m/s");
    }


    void write_size(const Advice &advice, const RunCost &cost, Writer &writer)
    {
      const SceneNumbers &scene = advice.scene;
      writer.title("Size");
      writer.line("cells of the box; with points", rounded(scene.n_cells) + "; " + rounded(scene.n_occupied));
      writer.line("cells over the height H/h", groups_of(scene).cells_over_height, "");
      if (scene.has_soil)
        writer.line("soil points", scene.n_soil_points, scene.is_single_point ? "(they carry the water)" : "");
      if (scene.n_water_points > 0)
        writer.line("water points", scene.n_water_points, "");
      writer.line("memory", megabytes(cost.memory));
    }


    void write_cost(const Advice &advice, const RunCost &cost, Writer &writer)
    {
      const SceneNumbers &scene = advice.scene;
      writer.title("Estimated cost of this case");
      writer.line("step at the start; mean expected", rounded(cost.first_step) + "; " + rounded(cost.mean_step) + " s");
      writer.line("steps to " + rounded(scene.end_time) + " s", cost.n_steps, "");
      const Observation &seen = advice.seen;
      const auto of_steps     = [&](const std::string &name, const double first, const double later) {
        const double to_ns = 1e9 / scene.n_points();
        writer.line(name, rounded(to_ns * first) + "; " + rounded(to_ns * later) + " ns a point");
      };
      of_steps("a step at the start; later", seen.first.seconds, seen.later.seconds);
      for (const TimerSection part : step_parts())
        if (seen.first.seconds_of(part) >= 0.02 * seen.first.seconds ||
            seen.later.seconds_of(part) >= 0.02 * seen.later.seconds)
          of_steps("  " + name_of(part), seen.first.seconds_of(part), seen.later.seconds_of(part));
      of_steps("  everything else", seen.first.rest(), seen.later.rest());
      writer.line("at the start: steps that were taken",
                  rounded(seen.n_first) +
                      (advice.coarser > 1 ? ", with cells " + std::to_string(advice.coarser) + " times as wide" : ""));
      if (!advice.pilot_fault.empty())
        writer.line("later", "not known, the run of the case with wider cells failed: " + advice.pilot_fault);
      else if (advice.pilot_coarser > 0)
        writer.line("later: the case was run with cells", rounded(advice.pilot_coarser) + " times as wide");
      writer.line("output", cost.output_seconds, "core-seconds");
      writer.line("run", core_time(cost.seconds()));
      if (advice.n_ranks > 1)
        writer.line("on " + std::to_string(advice.n_ranks) + " ranks, if shared out evenly",
                    rounded(cost.seconds() / advice.n_ranks) + " s, " + megabytes(advice.memory(scene.cell_size)) +
                        ", " + rounded(scene.n_points() / advice.n_ranks) +
                        " points each (ten thousand keep a rank busy)");
      if (advice.settling_time > 0)
        writer.line("settling, at most", core_time(cost.step_seconds / scene.end_time * advice.settling_time));
    }


    void write_recommendation(const Advice &advice, Writer &writer)
    {
      const SceneNumbers &scene         = advice.scene;
      const auto [regime, name, reason] = regime_choice(scene);
      const ErrorLaw law                = error_law_of(scene);
      writer.title("Recommendation for a relative error of " + rounded(advice.accuracy) + ' ' + law.measure);
      writer.line("model", name + ": " + reason);
      if (scene.has_water && scene.has_soil)
        {
          const PointSetChoice choice = point_sets_for(regime, scene);
          writer.line("water points",
                      (choice.sets == PointSets::double_point ? "double: " : "single: ") + choice.reason);
        }
      constexpr double fewest = 10.; // cells over the height, which the motion needs
      const double cells      = law.gap.empty() && law.remedy.empty()
                                    ? std::max(fewest, law.cells_over_height(advice.accuracy))
                                : scene.is_layer ? SoilMotion<2>::least_cells
                                                 : 0.;
      const bool is_as_now    = (!law.gap.empty() || !law.remedy.empty()) && scene.height >= cells * scene.cell_size;
      const double size       = is_as_now ? scene.cell_size : cell_size_for(advice.grid, scene.height, cells);
      const std::string error = "error up to about " + rounded(law.error(scene.height / scene.cell_size));
      writer.line("cell size",
                  rounded(size) + " m, H/h = " + rounded(scene.height / size) +
                      (is_as_now ? " as now: " : " (now " + rounded(scene.cell_size) + " m: ") +
                      (!law.gap.empty() ? "the error is not known" : error) + (is_as_now ? "" : ")"));
      if (!law.gap.empty())
        writer.line("error",
                    "not known: " + law.gap +
                        (law.remedy.empty() ? ". Halve the cells and the step, and compare" : ""));
      if (!law.remedy.empty())
        writer.line("do not refine", law.remedy);
      if (!law.range.empty())
        writer.line("measured in such scenes", law.range);
      const SceneNumbers wanted = with_cell_size(scene, size);
      const Observation seen    = with_cell_size(advice.seen, scene, size);
      Schedule schedule         = advice.schedule;
      schedule.time_step        = time_step_for(wanted, schedule.time_step);
      const RunCost cost        = cost_of_run(wanted, seen, schedule);
      writer.line(
          "step",
          "about " + rounded(cost.mean_step) +
              " s, with Courant number = " + rounded(schedule.time_step.courant_number) + ", Maximum time step = " +
              (std::isfinite(schedule.time_step.maximum_time_step) ? rounded(schedule.time_step.maximum_time_step)
                                                                   : schedule.time_step.maximum));
      writer.line("points", wanted.n_points(), "");
      writer.line("memory", megabytes(advice.memory(size)));
      writer.line("run", core_time(cost.seconds()));
      if (regime == Regime::drained || regime == Regime::undrained)
        {
          SceneNumbers soil   = wanted;
          soil.n_water_points = 0;
          writer.line("run of the soil alone",
                      core_time(cost_of_run(soil, without_water(seen, wanted), schedule).seconds()));
        }
    }


    /// Writes groups, size, cost and recommendation, a line a number with its unit.
    void write_report(const Advice &advice, std::ostream &out)
    {
      Writer writer(out);
      const SceneNumbers &scene = advice.scene;
      const RunCost cost        = cost_of_run(scene, advice.seen, advice.schedule);
      out << scene.dim << "D, " << regime_choice(scene).name << '\n';
      write_groups(scene, writer);
      if (scene.has_soil && scene.has_water)
        write_water(scene, cost.mean_step, writer);
      write_size(advice, cost, writer);
      write_cost(advice, cost, writer);
      write_recommendation(advice, writer);
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
    advice.accuracy           = accuracy;
    advice.grid               = parameters.grid;
    advice.schedule.time_step = parameters.time_step;
    advice.schedule.output    = parameters.output;
    advice.settling_time      = parameters.settling.maximum_time;
    advice.n_ranks            = n_ranks > 0 ? n_ranks : Utilities::MPI::n_mpi_processes(communicator);
    advice.coarser            = coarsening<dim>(parameters, communicator);
    advice.memory             = [&](const double cell_size) {
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
          const double of_run         = cost_of_run(advice.scene, advice.seen, advice.schedule).step_seconds;
          advice.pilot_coarser        = coarsening_of_pilot(advice, of_run);
          parameters.output_directory = *folder + "/pilot";
          parameters.grid             = advice.grid;
          parameters.time_step        = advice.schedule.time_step;
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
