// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/regime.h>
#include <scree/advice/report.h>

#include <cmath>

namespace scree
{
  namespace
  {
    std::string rounded(const double value)
    {
      char text[32];
      // Counts and seconds of some size in full, else three digits.
      std::snprintf(text, sizeof text, std::abs(value) >= 1e3 && std::abs(value) < 1e6 ? "%.0f" : "%.3g", value);
      return text;
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
      for (const TimerSection part : step_parts)
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
        writer.line("on " + std::to_string(advice.n_ranks) + " ranks", cost.seconds() / advice.n_ranks, "s");
      if (advice.settling_time > 0)
        writer.line("settling, at most", core_time(cost.step_seconds / scene.end_time * advice.settling_time));
    }


    void write_recommendation(const Advice &advice, Writer &writer)
    {
      const SceneNumbers &scene = advice.scene;
      const Regime regime       = regime_of(scene);
      const ErrorLaw law        = error_law_of(scene);
      writer.title("Recommendation for a relative error of " + rounded(advice.accuracy) + ' ' + law.measure);
      writer.line("model", name_of(regime) + ": " + reason_for(regime, scene));
      if (scene.has_water && scene.has_soil)
        {
          const PointSetChoice choice = point_sets_for(regime, scene);
          writer.line("water points",
                      (choice.sets == PointSets::double_point ? "double: " : "single: ") + choice.reason);
        }
      const double size       = law.gap.empty() && law.remedy.empty()
                                    ? cell_size_for(advice.grid, scene.height, law.cells_over_height(advice.accuracy))
                                    : scene.cell_size;
      const std::string error = "error up to about " + rounded(law.error(scene.height / scene.cell_size));
      writer.line("cell size",
                  rounded(size) + " m, H/h = " + rounded(scene.height / size) +
                      (!law.gap.empty()     ? " as now: the error is not known"
                       : law.remedy.empty() ? " (now " + rounded(scene.cell_size) + " m: " + error + ")"
                                            : " as now: " + error));
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
      writer.line("memory", megabytes(cost.memory));
      writer.line("run", core_time(cost.seconds()));
      if (regime == Regime::drained || regime == Regime::undrained)
        {
          SceneNumbers soil   = wanted;
          soil.n_water_points = 0;
          writer.line("run of the soil alone",
                      core_time(cost_of_run(soil, without_water(seen, wanted), schedule).seconds()));
        }
    }
  } // namespace


  void write_report(const Advice &advice, std::ostream &out)
  {
    Writer writer(out);
    const SceneNumbers &scene = advice.scene;
    const RunCost cost        = cost_of_run(scene, advice.seen, advice.schedule);
    out << scene.dim << "D, " << name_of(regime_of(scene)) << '\n';
    write_groups(scene, writer);
    if (scene.has_soil && scene.has_water)
      write_water(scene, cost.mean_step, writer);
    write_size(advice, cost, writer);
    write_cost(advice, cost, writer);
    write_recommendation(advice, writer);
  }
} // namespace scree
