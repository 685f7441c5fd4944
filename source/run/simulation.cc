// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/run/simulation.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The column of the progress table that says where a scene is: the front of the soil, or of the water without
    /// soil; on a bed in space, where no axis is that of the motion, the largest speed.
    template <int dim>
    class ShownMotion
    {
    public:
      /// The scene is kept by reference.
      explicit ShownMotion(const Scene<dim> &scene)
          : scene(scene)
          , shows_speed(dim == 3 && scene.bed)
      {
      }

      /// Heading of the column, with the unit.
      std::string heading() const
      {
        return shows_speed ? "fastest (m/s)" : scene.bodies.empty() ? "water front 90 % (m)" : "front 90 % (m)";
      }

      /// Value of the column. Collective.
      double value() const
      {
        constexpr double part_behind_front = 0.90; // of the mass
        if (!shows_speed)
          return scene.bodies.empty() ? mass_percentiles(scene.water, scene.grid, { part_behind_front })[0]
                                      : mass_percentiles(scene.bodies, scene.grid, { part_behind_front })[0];
        double largest  = 0.;
        const auto look = [&](const auto &phase, const auto &point) {
          largest = std::max(largest, vector_of<dim>(point.properties + phase.layout.velocity).norm());
        };
        for_each_moving_point(scene.bodies, look);
        for_each_moving_point(scene.water, look);
        return Utilities::MPI::max(largest, scene.grid.communicator());
      }

    private:
      const Scene<dim> &scene;
      const bool shows_speed; // or a front
    };
  } // namespace


  template <int dim>
  void Simulation<dim>::initialise()
  {
    scene.fill();
    repartition();
    control.measure_speeds();
    scene.require_steps(stable_step(), control.speeds_of_points());
    folder.remove_old_results(); // not before the input has proved good
    record_case(parameters, folder);
    log_case(parameters, scene, folder, communicator);
    log_released(parameters, scene, folder, communicator);
    for (const std::string &remark : remarks_on(parameters, scene.bodies, communicator))
      folder.log(remark);
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
        parameters.start_folder.empty() ? parameters.output_directory : parameters.start_folder,
        [this](const std::string &line) { folder.log(line); },
        communicator);
    const std::vector<std::string> notes = notes_on_changes(checkpoint, parameters.entries());
    load_checkpoint(checkpoint, scene.grid, point_sets(), [&](auto &archive) { serialize_state(archive); });
    require_entry(!(parameters.end_time < clock.time()),
                  { "", "End time", parameters.end_time },
                  "the checkpoint " + checkpoint.folder + " is at " + number_text(clock.time()) +
                      " s already. Write a later time.");
    if (!folder.is_writer())
      totals = RunBalance<dim>(scene.obstacles.size()); // The writer holds the sums.
    reinit();
    scheme->set_ground_tractions(ground_tractions);
    adaptation.look_at_points();
    output_times.begin(clock.time());
    record_case(parameters, folder);
    log_case(parameters, scene, folder, communicator);
    results.cut();
    folder.log("Resumed at t = " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) + ", from " +
               checkpoint.folder + " of " + checkpoint.manifest.program + '.');
    for (const std::string &note : notes)
      folder.log(note);
  }


  template <int dim>
  End Simulation<dim>::run()
  {
    timer.reset(); // Only the steps' time is reported.
    stop.listen();
    const ShownMotion<dim> motion(scene);
    progress = std::make_unique<Progress>(folder, clock.time(), parameters.end_time, motion.heading());
    if (start == Start::fresh && is_released) // A resumed run has reported its first state, also that at t = 0.
      report();
    const double updates_before = point_updates;
    const double first_step     = stable_step();
    try
      {
        while (!is_at_end() && control.stop_reason() == StopReason::none)
          {
            const double largest_step = stable_step();
            control.require_stable_step(largest_step, first_step);
            progress->count(control.limit(), control.part_left());
            step(largest_step, output_times.next(largest_step));
            report();
            if (progress_is_due || is_at_end())
              progress->report(
                  clock.time(),
                  clock.step(),
                  last_time_step,
                  motion.value(),
                  PointSums<dim>(scene.bodies, scene.water, scene.forcing.gravity(), communicator).kinetic);
          }
      }
    catch (const InputError &)
      {
        results.writer().finish(); // Such errors are known to all ranks.
        throw;
      }
    const End end = is_at_end() ? End::complete : End::stopped;
    if (end == End::stopped)
      write_last();
    summarise(end, updates_before);
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
            "Stopped while settling, by " + text_of(control.stop_reason()) +
            ". There is no checkpoint, as nothing can go on from a state before the release: run the case again. "
            "The row at t = 0 is of the soil on its way to rest.");
        return;
      }
    write_checkpoint();
    // After the checkpoint, so that a resumed run drops it, unless it was due.
    if (results.step_of_last_row() != clock.step())
      write_row();
    folder.log("Stopped at t = " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) + ", by " +
               text_of(control.stop_reason()) + ". A checkpoint is written: --resume goes on from here.");
  }


  template <int dim>
  void Simulation<dim>::advance(const double time_step)
  {
    adaptation.follow_points(time_step, [this] {
      // By numbers of points: on a new mesh no cell has been measured.
      if (partition.is_worth_changing_with_mesh())
        partition.repartition([this] { reinit(); });
      else
        reinit();
    });
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
    scheme->solve(time_step, step);
    partition.finish(Work::solving);
    if (is_released) // Points in water are put back to where the ground is then.
      for (Obstacle<dim> &obstacle : scene.obstacles)
        obstacle.end_step(time_step);
    try
      {
        scheme->to_points(time_step, skeleton_damping_time(), step);
      }
    catch (const PointFault &fault)
      {
        AssertThrow(false, ExcMessage(fault.name + ", t = " + number_text(clock.time()) + " s: " + fault.what()));
      }
    place_points(time_step, step.speeds);

    totals.balance += step.balance;
    if (is_released && scene.forcing.mass_scaling() > 1.)
      totals.balance.motion += 0.5 * time_step * scheme->nodal_forces(time_step).kinetic;
    totals.material.add(step.material);
    last_update = step.material;
    point_updates += step.n_updates;
    account_for_lost_points(scene, totals, clock.time());
    if (is_released)
      end_step(time_step);
  }


  template <int dim>
  void Simulation<dim>::place_points(const double time_step, const Speeds &of_rank)
  {
    const auto sets = point_sets();
    // Besides speeds, whether a point is at the edge and a line of progress is due; then the disorder of each set.
    std::vector<double> largest{ of_rank.wave, of_rank.points, 0., double(progress && progress->is_due()) };
    const unsigned int first_set = largest.size();
    {
      const TimedPart part(timer, TimerSection::sort);
      for (PointSet<dim> *points : sets)
        {
          largest.push_back(static_cast<int>(points->update_places()));
          largest[2] = std::max(largest[2], double(points->is_at_edge()));
        }
    }
    partition.finish(Work::to_points);
    control.agree_on(largest);
    partition.resume();
    control.require_stable_speed(time_step);
    const TimedPart part(timer, TimerSection::sort);
    progress_is_due = largest[3] > 0.;
    if (largest[2] > 0.)
      adaptation.set_points_at_edge();
    bool is_sorted = false;
    for (unsigned int s = 0; s < sets.size(); ++s)
      {
        const auto disorder = static_cast<Disorder>(static_cast<int>(largest[first_set + s]));
        sets[s]->hand_over(disorder);
        is_sorted = is_sorted || disorder >= Disorder::scattered;
      }
    if (is_sorted && scene.grid.follows_points())
      adaptation.look_at_points();
    partition.finish(Work::to_nodes);
  }


  template <int dim>
  void Simulation<dim>::begin_checkpoint()
  {
    const RunBalance<dim> own = totals;
    totals                    = totals.sum_over_ranks(communicator);
    ground_tractions          = scheme->ground_tractions();
    results.sync();
    FileJob job = checkpoint_files(parameters.output_directory,
                                   clock.time(),
                                   clock.step(),
                                   parameters.entries(),
                                   scene.grid,
                                   point_sets(),
                                   [&](auto &archive) { serialize_state(archive); });
    totals      = own;
    job.done    = [this, step = clock.step()] { step_of_checkpoint = step; };
    results.write_checkpoint(std::move(job));
  }

  template class Simulation<2>;
  template class Simulation<3>;


  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator)
  {
    const double factor = parameters.safety.strength_factor;
    const bool weakens  = parameters.settling.maximum_time > 0. && factor != 1.;
    if (weakens && start == Start::fresh)
      {
        Parameters(parameters.case_file).reduce_strength(factor); // throws before files are touched
        parameters.set("Safety", "Strength factor", "1");
        const double begin = MPI_Wtime();
        Simulation<dim> settled(parameters, start, communicator);
        if (!settled.is_settled())
          return settled.run();
        settled.report();
        settled.write_checkpoint();
        if (double &limit = parameters.output.wall_time_limit; limit > 0.)
          limit = std::max(limit + begin - MPI_Wtime(), 1e-3); // 0 is no limit
      }
    if (weakens)
      parameters.reduce_strength(factor);
    return Simulation<dim>(parameters, weakens ? Start::resume : start, communicator).run();
  }

  template End run_in_phases<2>(Parameters &, const Start, const MPI_Comm);
  template End run_in_phases<3>(Parameters &, const Start, const MPI_Comm);
} // namespace scree
