// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_results_h
#define scree_run_results_h

#include <scree/model/scene.h>
#include <scree/postprocess/checks.h>
#include <scree/postprocess/graphics.h>
#include <scree/postprocess/maps.h>

namespace scree
{
  /// Keeps the case with its results.
  void record_case(Parameters &parameters, RunFolder &folder);

  /// Begins the log with what has been made of the case: program, model, size, and what its ground, base and inflows
  /// are. Collective.
  template <int dim>
  void log_case(const Scene<dim> &scene, RunFolder &folder);

  /// Logs of each body that moves its volume, mass, density and stress before the first step, and of the water its
  /// mass. Collective.
  template <int dim>
  void log_released(const Scene<dim> &scene, RunFolder &folder);

  /// Logs volume and mass of what is in the box, of what left it through open walls and of what came in, and the
  /// largest memory so far. Volumes of soil are those at its density before the first step, so that they add up.
  /// Collective.
  /// @param totals of this rank
  template <int dim>
  void log_end(const Scene<dim> &scene, const RunBalance<dim> &totals, RunFolder &folder);

  /// What a run has come to, beside its points.
  template <int dim>
  struct RunState
  {
    const RunBalance<dim> &totals;   ///< of this rank
    const UpdateReport &last_update; ///< of this rank
    double time;                     ///< s
    unsigned long long step;         ///< number of the time step
    double time_step;                ///< the last one, s
  };

  /// What is written of a run to be looked at: statistics, probes, maps and pictures.
  template <int dim>
  class Results
  {
  public:
    /// All are kept by reference.
    Results(const Scene<dim> &scene, Scheme<dim> &scheme, RunFolder &folder)
        : parameters(scene.parameters)
        , scene(scene)
        , scheme(scheme)
        , folder(folder)
        , graphics(scene.grid, parameters.output, parameters.output_directory)
        , statistics(scene.grid,
                     scene.forcing.gravity(),
                     { !scene.loads.empty() || (!scene.forcing.is_gravity_alone() && !parameters.has_water),
                       parameters.water.volume_correction_rate > 0.,
                       scene.has_pressure_work(),
                       parameters.water.viscosity > 0.,
                       !parameters.inflows.empty() || parameters.rain.is_set(),
                       parameters.contact_groups().n > 1,
                       !parameters.stages.empty(),
                       scene.constraints.front().absorbing_faces() != 0,
                       scene.bed.get(),
                       &scene.obstacles,
                       faces_with_forces(scene),
                       scene.forcing.mass_scaling() })
        , rows(folder, "statistics")
        , probes(parameters.probes, scene.grid, !scene.bodies.empty(), parameters.has_water, folder)
        , maps(parameters.output.maps,
               { parameters.bed.map_origin, parameters.map_system },
               { parameters.end_time, parameters.output.interval },
               scene.grid,
               folder)
        , checks(scene.grid,
                 scene.forcing.gravity(),
                 scene.bed.get(),
                 parameters.probes.wall_forces ? nullptr : &scene.walls,
                 inflow_faces(scene.parameters),
                 folder)
        , balances(std::in_place, scene.grid, scene.forcing)
        , files(scene.grid.communicator())
    {
    }

    /// Writes what is due. Collective.
    /// @param at_start whether a run or a stage begins
    void report(const RunState<dim> &state, const OutputTimes &output_times, const bool at_start)
    {
      files.look();
      const double time          = state.time;
      const bool at_start_or_end = at_start || output_times.is_end(time);
      const bool row_is_due      = at_start_or_end || output_times.row_is_due(time);
      const bool picture_is_due  = at_start_or_end || output_times.picture_is_due(time);

      if (row_is_due || picture_is_due || output_times.checkpoint_is_due(time))
        folder.require_presence();
      constexpr unsigned int between_rows = 20, without_rows = 100; // steps: a look passes over all points
      checks.look(scene.bodies,
                  scene.water,
                  state.totals.n_lost,
                  time,
                  state.step,
                  at_start_or_end ? 0
                  : row_is_due    ? between_rows
                                  : without_rows);
      if (row_is_due)
        write_row(state);
      else if (picture_is_due)
        maps.sample(scene.bodies, time);
      if (picture_is_due)
        write_picture(state);
    }

    /// Compares the balances at the end of a step with those of the start, once that has its row.
    /// @param sums of all ranks, as the next one
    void watch(const MovingSums<dim> &sums, const RunBalance<dim> &totals, const double time, const double time_step)
    {
      if (!balances->has_looked())
        return;
      BalanceStart<dim> &start             = statistics.start();
      const dealii::Tensor<1, dim> gravity = scene.forcing.gravity();
      const double mass_scaling            = scene.forcing.mass_scaling();
      start.begin(time_step, gravity * start.momentum / mass_scaling, totals.material.averaging_work);
      balances->look({ start, mass_scaling, gravity, sums, totals, time, time_step });
    }

    /// Output of the state as it is. Collective.
    void write_row(const RunState<dim> &state)
    {
      const std::unique_ptr<WaterView<dim>> view = scheme.water_view();
      const Snapshot<dim> now                    = statistics.collect(scene.bodies,
                                                   scene.water,
                                                   state.totals,
                                                   state.time,
                                                   state.step,
                                                   state.time_step,
                                                   state.last_update,
                                                   view.get());
      if (!balances->has_looked())
        balances->look(now.balance());
      rows.append(statistics.columns(), { statistics.values() });
      probes.write_rows({ scene.bodies, scene.water, state.time });
      maps.sample(scene.bodies, state.time);
      statistics.require_numbers(state.time);
    }

    /// Pictures, lines and maps of the state as it is: gathered here, and written while the run goes on. Collective.
    void write_picture(const RunState<dim> &state)
    {
      const std::unique_ptr<WaterView<dim>> view = scheme.water_view();
      FileJob job = graphics.write(scene.bodies, scheme.soil_field(), state.time, view.get());
      probes.write_lines({ scene.bodies, scene.water, state.time });
      job.stages.push_back(maps.writing(state.time));
      job.failed = [this](const std::string &fault) {
        folder.require_presence();
        throw EntryError(fault);
      };
      files.start(std::move(job));
    }

    /// Writes the files of a checkpoint of `time`, s, while the run goes on; if that fails, the run stops, as the
    /// case says. Collective.
    void write_checkpoint(FileJob job)
    {
      job.failed = [this, fail = std::move(job.failed)](const std::string &fault) {
        folder.require_presence();
        fail(fault);
      };
      files.start(std::move(job));
    }

    /// What writes pictures, maps and checkpoints.
    BackgroundWriter &writer()
    {
      return files;
    }

    /// At the start of a stage: balances begin anew, and those of the stage before that did not hold stay.
    void begin_balances()
    {
      for (CheckResult &check : balances->results())
        if (check.is_exceeded)
          {
            check.name += " of an earlier stage";
            found.push_back(check);
          }
      balances.emplace(scene.grid, scene.forcing);
      statistics.begin_balances();
    }

    /// Brings all rows to the disk, before a checkpoint counts on them.
    void sync()
    {
      rows.sync();
      for (TableFile &table : probes.files())
        table.sync();
    }

    /// After a checkpoint has been read: drops from lists and rows what was written after it.
    void cut(const bool is_own_folder)
    {
      folder.write("checks.csv", ""); // those of a run that has gone on
      graphics.cut(is_own_folder);
      for (TableFile &table : probes.files())
        table.cut();
      rows.cut();
    }

    /// Adds to the checks that are reported at the end of the run.
    void add_checks(const std::vector<CheckResult> &results)
    {
      found.insert(found.end(), results.begin(), results.end());
    }

    /// At the end of a run: reports where the results are, and writes rows that the disk did not take. Throws FileError
    /// if it still refuses them.
    /// @param is_released whether soil that settles has come to its release: before, its motion is no result
    void complete(const bool is_released)
    {
      add_checks(balances->results());
      add_checks(checks.results());
      add_checks(statistics.results());
      if (is_released)
        {
          add_checks(statistics.soil_motion().results());
          if (const std::string text = statistics.soil_motion().text(); !text.empty())
            folder.log(text);
        }
      if (!found.empty())
        folder.log(verdict(found));
      folder.write("checks.csv", verdict_table(found));
      folder.log("Results     " + text_of_results());
      if (folder.is_writer() && parameters.output.screen_kind() == Screen::statistics)
        statistics.print_last_row(std::cout);
      folder.require_presence();
      rows.complete();
      for (TableFile &table : probes.files())
        table.complete();
    }

    /// Steps of the run at the last row.
    unsigned long long step_of_last_row() const
    {
      return statistics.step_of_last_row();
    }

    /// Saves or loads the state of all files (Boost).
    template <class Archive>
    void serialize(Archive &archive)
    {
      archive &statistics &graphics &rows &probes &maps &found &checks &*balances;
    }

  private:
    static std::set<unsigned int> inflow_faces(const Parameters &parameters)
    {
      std::set<unsigned int> faces;
      for (const InflowParameters &inflow : parameters.inflows)
        faces.insert(inflow.face_number(dim));
      return faces;
    }

    /// Faces of the box whose forces have columns: those that are closed to soil or water, if the case asks for them.
    static std::vector<unsigned int> faces_with_forces(const Scene<dim> &scene)
    {
      std::vector<unsigned int> faces;
      for (unsigned int face = 0; scene.parameters.probes.wall_forces && face < 2 * dim; ++face)
        if (!scene.walls.is_open(face) || (scene.water_walls && !scene.water_walls->is_open(face)))
          faces.push_back(face);
      return faces;
    }

    /// Where the results are.
    std::string text_of_results() const
    {
      const std::string path = parameters.output_directory + '/';
      return parameters.output.graphics_kind() == Pictures::none
                 ? path + "statistics.csv, log.txt"
                 : path + "solution/" + (scene.bodies.empty() ? "water" : "points") +
                       ".pvd (ParaView), statistics.csv, log.txt";
    }

    const Parameters &parameters;
    const Scene<dim> &scene;
    Scheme<dim> &scheme;
    RunFolder &folder;
    Graphics<dim> graphics;
    Statistics<dim> statistics;
    TableFile rows; // of the statistics
    Probes<dim> probes;
    Maps<dim> maps;
    std::vector<CheckResult> found; // in checks that have ended
    RunChecks<dim> checks;
    std::optional<BalanceChecks<dim>> balances; // of the stage
    BackgroundWriter files;                     // the last member: its jobs use others
  };
} // namespace scree

#endif
