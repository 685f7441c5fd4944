// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case_changes.h>
#include <scree/input/input_error.h>
#include <scree/lost_points.h>
#include <scree/output/checkpoint.h>
#include <scree/output/log_header.h>
#include <scree/simulation.h>
#include <scree/unusual_units.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const std::string remedy_for_instability =
        "Remedies: a smaller 'Courant number' in subsection Time step, 'F-bar = modified' in subsection Stabilisation.";
  } // namespace


  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator)
      : parameters(parameters)
      , start(start)
      , communicator(communicator)
      , folder(parameters.output_directory, parameters.output.screen_kind() == Screen::progress, communicator)
      , stop(folder.is_writer() ? folder.file("terminate") : "", parameters.output.wall_time_limit)
      , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
      , scene(parameters, communicator)
      , scheme(scene.make_scheme(timer))
      , partition(scene.grid.triangulation(), scheme->point_sets())
      , clock(parameters.time_step)
      , output_times(parameters.output, parameters.end_time)
      , graphics(scene.grid, parameters.output, parameters.output_directory)
      , statistics(scene.grid,
                   scene.forcing.gravity(),
                   { !scene.loads.empty(),
                     parameters.water.volume_correction_rate > 0.,
                     parameters.water.viscosity > 0.,
                     !parameters.inflows.empty(),
                     parameters.contact_groups().n > 1,
                     scene.bed.get(),
                     &scene.obstacles })
      , rows(folder.file("statistics"))
      , probes(parameters.probes, scene.grid, scene.walls, scene.water_walls.get(), !scene.bodies.empty(), folder)
      , maps(parameters.output.maps,
             { parameters.bed.map_origin, scene.ground ? scene.ground->map_system() : "" },
             scene.grid,
             folder)
      , totals(scene.obstacles.size())
  {
    if (start == Start::resume)
      resume();
    else
      initialise();
  }


  template <int dim>
  void Simulation<dim>::initialise()
  {
    scene.fill();
    repartition();
    measure_speeds();
    scene.require_steps(stable_step(), speeds);
    folder.remove_old_results(); // not before the input has proved good
    record_case();
    log_case();
    for (const std::string &question : unusual_units(parameters))
      folder.log(question);
    if (parameters.settling.maximum_time > 0)
      settle();
    if (!is_released)
      return;
    scene.mark_start();
    scheme->read_points();
  }


  template <int dim>
  void Simulation<dim>::resume()
  {
    const Checkpoint checkpoint = find_checkpoint(
        parameters.output_directory, [this](const std::string &line) { folder.log(line); }, communicator);
    const std::vector<std::string> notes = notes_on_changes(checkpoint, parameters.entries());
    load_checkpoint(checkpoint, scene.grid, point_sets(), [&](auto &archive) { serialize_state(archive); });
    require_entry(!(parameters.end_time < clock.time()),
                  "",
                  "End time",
                  parameters.end_time,
                  "the checkpoint " + checkpoint.folder + " is at " + number_text(clock.time()) +
                      " s already. Write a later time.");
    if (!folder.is_writer())
      totals = RunTotals<dim>(scene.obstacles.size()); // The writer holds the sums.
    reinit();
    points_at_edge = are_points_at_edge();
    output_times.begin(clock.time());
    record_case();
    log_case();
    cut_output();
    folder.log("Resumed at t = " + Utilities::to_string(clock.time()) + " s, step " + std::to_string(clock.step()) +
               ", from " + checkpoint.folder + " of " + checkpoint.manifest.program + '.');
    for (const std::string &note : notes)
      folder.log(note);
  }


  template <int dim>
  void Simulation<dim>::record_case()
  {
    folder.write("original.prm", parameters.original());
    std::ostringstream all_entries;
    parameters.print(all_entries);
    folder.write("parameters.prm", all_entries.str());
    log_program(folder, communicator);
  }


  template <int dim>
  void Simulation<dim>::log_case()
  {
    log_size(folder,
             scene.grid,
             scene.bodies,
             scene.water,
             scene.expected_memory.bytes(Utilities::MPI::n_mpi_processes(communicator)));
    folder.log("Transfer: " + parameters.transfer.text());
    if (const Point<2> &origin = parameters.bed.map_origin; origin != Point<2>())
      folder.log("Local origin: x = 0, y = 0 is " + number_text(origin) +
                 " m on the map. Rasters, outlines and maps are in the map's coordinates, all else, the pictures, too, "
                 "from this place.");
    if (scene.ground)
      if (const std::string remark = scene.ground->remark(); !remark.empty())
        folder.log(remark);
    if (const std::string base = scene.forcing.text_of_base(); !base.empty())
      folder.log(base);
    for (const std::string &text : scene.texts_of_inflows())
      folder.log(text);
  }


  template <int dim>
  void Simulation<dim>::cut_output()
  {
    graphics.cut();
    probes.cut();
    if (folder.is_writer())
      if (const std::string missing = rows.cut(); !missing.empty())
        folder.log(missing);
  }


  template <int dim>
  void Simulation<dim>::reinit()
  {
    scene.reinit();
    scheme->reinit();
    scheme->read_points();
  }


  template <int dim>
  End Simulation<dim>::run()
  {
    timer.reset(); // Only the steps' time is to be told.
    stop.listen();
    Progress progress(folder, clock.time(), parameters.end_time);
    if (start == Start::fresh && is_released) // A resumed run has reported its first state, also that at t = 0.
      report();
    const double updates_before = point_updates;
    const double first_step     = stable_step();
    while (!is_at_end() && stop_reason == StopReason::none)
      {
        const double largest_step = stable_step();
        check_step(largest_step, first_step);
        progress.count(clock.limit(scene.grid.cell_size(), speeds.wave, speeds.points));
        step(largest_step, output_times.next(largest_step));
        report();
        progress.report(clock.time(), clock.step(), last_time_step);
      }
    const End end = is_at_end() ? End::complete : End::stopped;
    if (end == End::stopped)
      write_last();
    summarise(progress, updates_before);
    return end;
  }


  template <int dim>
  void Simulation<dim>::write_last()
  {
    folder.require_presence();
    if (!is_released)
      {
        write_row();
        folder.log(
            "Stopped while settling, by " + text_of(stop_reason) +
            ". There is no checkpoint, as nothing can go on from a state before the release: run the case again. "
            "The row at t = 0 is of the soil on its way to rest.");
        return;
      }
    if (step_of_checkpoint != clock.step())
      write_checkpoint();
    require_entry(
        step_of_checkpoint == clock.step(),
        "Output",
        "Checkpoint failure",
        parameters.output.checkpoint_failure,
        "the run was stopped by " + text_of(stop_reason) +
            ", and its last checkpoint could not be written. The log tells why; make room, and use --resume if "
            "there is an older one.");
    // After the checkpoint, so that a resumed run drops it, unless it was due.
    if (statistics.step_of_last_row() != clock.step())
      write_row();
    folder.log("Stopped at t = " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) + ", by " +
               text_of(stop_reason) + ". A checkpoint is written: --resume goes on from here.");
  }


  template <int dim>
  void Simulation<dim>::summarise(Progress &progress, const double point_updates_before)
  {
    progress.summarise(clock.time(),
                       timer,
                       Utilities::MPI::sum(point_updates - point_updates_before, communicator),
                       scene.name_of_a_point(),
                       communicator);
    progress.summarise_ranks(
        seconds_of(timer, StepPart::waiting), partition.imbalance(), partition.n_repartitions(), communicator);
    if (scene.grid.follows_points())
      folder.log("fine cells at the end: " +
                 number_text(Utilities::MPI::sum(double(scene.grid.fine_cells().n_owned()), communicator)) +
                 "; they followed the points " + std::to_string(n_refinements) + " times, which took " +
                 number_text(seconds_of(timer, StepPart::repartition)) + " s");
    log_peak_memory(folder, communicator);
    folder.log(
        "Results are in " + parameters.output_directory +
        (parameters.output.graphics_kind() == Pictures::none ? "." : " (open solution/points.pvd in ParaView)."));
    if (folder.is_writer() && parameters.output.screen_kind() == Screen::statistics)
      statistics.print_last_row(std::cout);
    folder.require_presence();
    if (folder.is_writer() && !rows.is_complete())
      rows.append(""); // throws if the disk still refuses them
    probes.complete();
  }


  template <int dim>
  double Simulation<dim>::step(const double largest_step, const double due)
  {
    last_time_step = clock.next_step(largest_step, due);
    advance(last_time_step);
    clock.advance(last_time_step, due);
    return last_time_step;
  }


  template <int dim>
  void Simulation<dim>::advance(const double time_step)
  {
    follow_points(time_step);
    repartition();
    for ([[maybe_unused]] const PointSet<dim> *points : point_sets())
      Assert(points->is_in_inner_cells(), ExcMessage("A point lies beside cells without nodes."));
    partition.begin_step();
    StepReport<dim> step;
    if (is_released)
      scene.begin_step(clock.time(), time_step);
    else
      scene.forcing.set_start();
    scheme->to_grid(clock.time());
    partition.finish(Work::to_nodes);
    wait();
    scheme->solve(time_step, step);
    partition.finish(Work::to_nodes);
    if (is_released)
      scene.move_obstacles(time_step); // Points in water are put back to where the ground is then.
    scheme->to_points(time_step, step);
    place_points(time_step, step.speeds);

    totals.balance += step.balance;
    totals.add(step.material);
    last_update = step.material;
    point_updates += step.n_updates;
    account_for_lost_points(scene, totals, clock.time());
    if (is_released)
      end_step(time_step);
  }


  template <int dim>
  void Simulation<dim>::end_step(const double time_step)
  {
    const std::unique_ptr<WaterView<dim>> water = scene.inflows.empty() ? nullptr : scheme->water_view();
    scene.let_in(time_step, water ? water->pressure_of_cell : PressureOfCell<dim>(), totals);
    if (scene.wet_ground_moves())
      {
        const TimedPart part(timer, StepPart::bed);
        scene.open_cells->follow();
        scheme->follow_ground();
      }
  }


  template <int dim>
  void Simulation<dim>::wait()
  {
    const TimedPart part(timer, StepPart::waiting);
    partition.wait();
  }


  template <int dim>
  void Simulation<dim>::place_points(const double time_step, const Speeds &of_rank)
  {
    const auto sets = point_sets();
    std::vector<double> largest{ of_rank.wave, of_rank.points, 0. }; // and the disorder of each set
    {
      const TimedPart part(timer, StepPart::sort);
      for (PointSet<dim> *points : sets)
        {
          largest.push_back(static_cast<int>(points->update_places()));
          largest[2] = std::max(largest[2], double(points->is_at_edge()));
        }
    }
    partition.finish(Work::to_points);
    agree_on(largest);
    partition.resume();
    check_speed(time_step);
    const TimedPart part(timer, StepPart::sort);
    points_at_edge = points_at_edge || largest[2] > 0.;
    bool is_sorted = false;
    for (unsigned int s = 0; s < sets.size(); ++s)
      {
        const auto disorder = static_cast<Disorder>(static_cast<int>(largest[3 + s]));
        sets[s]->hand_over(disorder);
        is_sorted = is_sorted || disorder == Disorder::far;
      }
    if (is_sorted && scene.grid.follows_points())
      points_at_edge = are_points_at_edge() || points_at_edge;
    partition.finish(Work::to_nodes);
  }


  template <int dim>
  void Simulation<dim>::agree_on(std::vector<double> &largest)
  {
    const TimedPart part(timer, StepPart::waiting);
    for (double &value : largest)
      if (std::isnan(value))
        value = std::numeric_limits<double>::infinity();
    largest.push_back(static_cast<double>(stop.reason()));
    Utilities::MPI::max(largest, communicator, largest);
    speeds = { largest[0], largest[1] };
    scene.include_inflows(speeds);
    stop_reason = static_cast<StopReason>(largest.back());
    largest.pop_back();
  }


  template <int dim>
  void Simulation<dim>::measure_speeds()
  {
    const Speeds of_rank = scene.speeds();
    std::vector<double> largest{ of_rank.wave, of_rank.points };
    agree_on(largest);
  }


  template <int dim>
  Speeds Simulation<dim>::limiting_speeds() const
  {
    Speeds all = speeds;
    scene.include_obstacles(all, clock.time());
    return all;
  }


  template <int dim>
  double Simulation<dim>::stable_step() const
  {
    const Speeds all = limiting_speeds();
    return clock.stable_step(scene.grid.cell_size(), all.wave, all.points);
  }


  template <int dim>
  void Simulation<dim>::check_step(const double largest_step, const double first_step) const
  {
    // A run that gains energy would creep on with ever smaller steps.
    AssertThrow(largest_step > 1e-3 * first_step,
                ExcMessage("The motion is unstable: at t = " + Utilities::to_string(clock.time()) +
                           " s the stable step has fallen to " + Utilities::to_string(largest_step) + " s, from " +
                           Utilities::to_string(first_step) + " s at the start. " + remedy_for_instability));
  }


  template <int dim>
  void Simulation<dim>::check_speed(const double time_step) const
  {
    AssertThrow(std::isfinite(speeds.points) && speeds.points * time_step < 2 * scene.grid.cell_size(),
                ExcMessage("The motion is unstable at t = " + Utilities::to_string(clock.time()) +
                           " s: a point moves at " + Utilities::to_string(speeds.points) + " m/s. " +
                           remedy_for_instability));
  }


  template <int dim>
  double Simulation<dim>::settle_down(Clock &settling_clock)
  {
    const SettlingParameters &settling          = parameters.settling;
    constexpr unsigned int steps_between_checks = 50;
    double ratio                                = std::numeric_limits<double>::infinity();
    while (settling_clock.time() < settling.maximum_time && ratio >= settling.kinetic_energy &&
           stop_reason == StopReason::none)
      {
        const double step = settling_clock.next_step(stable_step(), settling.maximum_time);
        advance(step);
        settling_clock.advance(step, settling.maximum_time);
        if (settling_clock.step() % steps_between_checks == 0 || settling_clock.time() >= settling.maximum_time)
          ratio = kinetic_to_elastic_energy(scene.bodies, scene.water, communicator);
      }
    return ratio;
  }


  template <int dim>
  void Simulation<dim>::settle()
  {
    const SettlingParameters &settling = parameters.settling;
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);
    scene.forcing.set_damping(settling.damping_rate);
    stop.listen();
    is_released = false;

    Clock settling_clock(parameters.time_step);
    const double ratio        = settle_down(settling_clock);
    is_released               = stop_reason == StopReason::none;
    const std::string release = ratio < settling.kinetic_energy
                                    ? ". Released."
                                    : ", above the wanted " + Utilities::to_string(settling.kinetic_energy) +
                                          ": not yet at rest. Released all the same.";
    folder.log("Settled for " + Utilities::to_string(settling_clock.time()) + " s in " +
               std::to_string(settling_clock.step()) + " steps; kinetic over elastic energy " +
               Utilities::to_string(ratio) + (is_released ? release : ". Asked to stop."));
    // Balances begin at the release; what was lost stays lost.
    const RunTotals<dim> settled = totals;
    totals                       = RunTotals<dim>(scene.obstacles.size());
    totals.n_lost                = settled.n_lost;
    totals.lost_mass             = settled.lost_mass;
    totals.lost_water_mass       = settled.lost_water_mass;
    if (!is_released)
      return;

    scene.forcing.set_damping(0.);
    scene.open_gate();
    scene.stop();
    measure_speeds();
  }


  template <int dim>
  void Simulation<dim>::follow_points(const double time_step)
  {
    if (!points_at_edge)
      return;
    const TimedPart part(timer, StepPart::repartition);
    const Blocks blocks = blocks_ahead(time_step);
    const auto sets     = point_sets();
    for (PointSet<dim> *points : sets)
      points->lift();
    scene.grid.refine(blocks, Shares::kept);
    for (PointSet<dim> *points : sets)
      {
        points->put_down();
        points->costs().reinit(scene.grid.triangulation().n_active_cells());
      }
    reinit();
    points_at_edge = are_points_at_edge();
    ++n_refinements;
    AssertThrow(!points_at_edge, ExcInternalError("A point is outside the fine cells."));
  }


  template <int dim>
  Blocks Simulation<dim>::blocks_ahead(const double time_step) const
  {
    // A new mesh costs some tens of steps, and no more cells than twice those around the points are to lie ahead of
    // them.
    constexpr double steps_ahead = 500, most_blocks = 2;
    const auto blocks = [this](const double time) {
      return scene.grid.with_surroundings(scene.blocks_of_points(time));
    };
    const Blocks around = blocks(0.);
    for (double steps = steps_ahead; steps > 1; steps /= 2)
      if (Blocks ahead = blocks(steps * time_step); ahead.size() <= most_blocks * around.size())
        return ahead;
    return around;
  }


  template <int dim>
  bool Simulation<dim>::are_points_at_edge()
  {
    const auto sets = point_sets();
    const bool own  = std::any_of(sets.begin(), sets.end(), [](const auto *points) { return points->is_at_edge(); });
    return Utilities::MPI::max(int(own), communicator) == 1;
  }


  template <int dim>
  void Simulation<dim>::repartition()
  {
    if (!partition.is_worth_changing())
      return;
    const TimedPart part(timer, StepPart::repartition);
    partition.repartition([this] { reinit(); });
  }


  template <int dim>
  void Simulation<dim>::report()
  {
    const double time          = clock.time();
    const bool at_start_or_end = clock.step() == 0 || output_times.is_end(time);
    const bool row_is_due      = at_start_or_end || output_times.row_is_due(time);
    const bool picture_is_due  = at_start_or_end || output_times.picture_is_due(time);
    const TimedPart part(timer, StepPart::output);

    if (row_is_due || picture_is_due || output_times.checkpoint_is_due(time))
      folder.require_presence();
    if (row_is_due)
      write_row();
    else if (picture_is_due)
      maps.sample(scene.bodies, time);
    if (picture_is_due)
      write_picture();
    if (output_times.checkpoint_is_due(time))
      write_checkpoint();
    output_times.begin(time);
  }


  template <int dim>
  void Simulation<dim>::write_row()
  {
    statistics.collect(scene.bodies, scene.water, totals, clock.time(), clock.step(), last_time_step, last_update);
    folder.try_to_write("statistics",
                        [&] { rows.append((rows.is_empty() ? statistics.head() : "") + statistics.row()); });
    probes.write_rows(probed_state(scheme->water_view().get()));
    maps.sample(scene.bodies, clock.time());
  }


  template <int dim>
  void Simulation<dim>::write_picture()
  {
    const std::unique_ptr<WaterView<dim>> view = scheme->water_view();
    graphics.write(scene.bodies, scheme->soil_field(), clock.time(), view.get());
    probes.write_lines(probed_state(view.get()));
    maps.write(clock.time());
  }


  template <int dim>
  ProbedState<dim> Simulation<dim>::probed_state(const WaterView<dim> *view) const
  {
    return { scene.bodies, scene.water, totals.balance, clock.time(), view };
  }


  template <int dim>
  template <class Archive>
  void Simulation<dim>::serialize_state(Archive &archive)
  {
    double time             = clock.time();
    unsigned long long step = clock.step();
    archive &time &step &speeds.wave &speeds.points &last_time_step;
    archive &totals &statistics &graphics &rows &probes &maps;
    for (Obstacle<dim> &obstacle : scene.obstacles)
      archive &obstacle;
    for (Inflow<dim> &inflow : scene.inflows)
      archive &inflow;
    for (PointSet<dim> *points : point_sets())
      archive & points->next_id;
    clock.set(time, step);
  }


  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    const RunTotals<dim> own = totals;
    totals                   = totals.sum_over_ranks(communicator);
    folder.try_to_write("statistics", [&] { rows.sync(); });
    probes.sync();
    std::string fault;
    try
      {
        save_checkpoint(parameters.output_directory,
                        clock.time(),
                        clock.step(),
                        parameters.entries(),
                        scene.grid,
                        point_sets(),
                        [&](auto &archive) { serialize_state(archive); });
      }
    catch (const EntryError &error)
      {
        fault = error.what();
      }
    totals = own;
    if (!fault.empty() && parameters.output.stops_without_checkpoint())
      throw EntryError(fault);
    if (fault.empty())
      step_of_checkpoint = clock.step();
    else
      folder.log("No checkpoint at t = " + Utilities::to_string(clock.time()) + " s: " + fault);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace scree
