// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/run/simulation.h>
#include <scree/tensor/invariants.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Heading of the column of the progress table that says where a scene is, and its value now: how far the toe of
    /// the soil has moved, or the speed of water alone. Collective.
    template <int dim>
    std::pair<std::string, double> shown_motion(const Scene<dim> &scene)
    {
      if (!scene.bodies.empty())
        return { "toe moved (m)",
                 SoilMotion<dim>(scene.grid, scene.forcing.gravity(), nullptr).path(scene.bodies).toe_displacement };
      double largest = 0.;
      for_each_moving_point(scene.water, [&](const auto &phase, const auto &point) {
        largest = std::max(largest, vector_of<dim>(point.properties + phase.layout.velocity).norm());
      });
      return { "fastest (m/s)", Utilities::MPI::max(largest, scene.grid.communicator()) };
    }
  } // namespace


  template <int dim>
  void Simulation<dim>::initialise()
  {
    scene.fill();
    repartition();
    measure_speeds();
    scene.require_steps(stable_step(), speeds);
    folder.remove_old_results(); // not before the input has proved good
    record_case(parameters, folder);
    log_case(scene, folder);
    log_released(scene, folder);
    for (const std::string &remark :
         remarks_on(parameters, scene.bodies, scene.water, scene.ground.get(), communicator))
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
    const std::vector<std::string> notes = notes_on_changes(
        checkpoint, parameters.entries(), start == Start::new_stage || !parameters.start_folder.empty());
    load_checkpoint(checkpoint, scene.grid, point_sets(), [&](auto &archive) { serialize_state(archive); });
    require_entry(!(parameters.end_time < clock.time()),
                  { "", "End time", parameters.end_time },
                  "the checkpoint " + checkpoint.folder + " is at " + number_text(clock.time()) +
                      " s already. Write a later time.");
    if (!folder.is_writer())
      totals = RunBalance<dim>(scene.obstacles.size()); // The writer holds the sums.
    reinit();
    scheme->set_solver_state(solver_state);
    points_at_edge = are_points_at_edge() || points_at_edge;
    output_times.begin(clock.time());
    results.cut(parameters.start_folder.empty());
    if (start == Start::resume)
      {
        if (parameters.stage.name.empty() || !parameters.start_folder.empty()) // that of a trial is its own
          record_case(parameters, folder);
        log_case(scene, folder);
        folder.log("Resumed at t = " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) +
                   ", from " + checkpoint.folder + " of " + checkpoint.program + '.');
      }
    else
      folder.log("Stage       " + parameters.stage.name + ", from t = " + number_text(clock.time()) + " to " +
                 number_text(parameters.end_time) + " s");
    for (const std::string &note : notes)
      folder.log(note);
  }


  template <int dim>
  void Simulation<dim>::begin_stage()
  {
    const std::string unit   = dim == 2 ? " kg/m" : " kg";
    const StageMasses masses = scene.begin_stage();
    const auto removal       = parameters.stage.removal();
    if (!removal.second.empty())
      folder.log("Removed     soil " + number_text(masses.removed_soil) + unit +
                 (scene.water.empty() ? "" : ", water " + number_text(masses.removed_water) + unit));
    if (masses.removed_water > 0. && masses.removed_soil > 0.)
      folder.log("Unusual value: " + entry_name(parameters.stage.subsection(), removal.first) +
                 ": what it removes is in part below the water table. The water around it keeps its pressure and flows "
                 "in, which lifts the floor; for a pit that is kept dry write the lowered water table.");
    if (!parameters.stage.adds.empty())
      folder.log("Added       soil " + number_text(masses.added_soil) + unit);
    require_entry(removal.second.empty() || masses.removed_soil + masses.removed_water > 0.,
                  { parameters.stage.subsection(), removal.first, removal.second },
                  "no point is there. Look at the place.");
    require_entry(std::any_of(scene.bodies.begin(),
                              scene.bodies.end(),
                              [](const auto &body) { return body.points.handler().n_global_particles() > 0; }) ||
                      parameters.bodies.empty(),
                  { parameters.stage.subsection(), removal.first, removal.second },
                  "no soil is left. Look at the place.");
    reinit();
    measure_speeds();
    clock.set(clock.time(), clock.step() + 1); // The end of the stage before keeps its checkpoint.
    if (folder.is_writer())
      {
        totals.removed_mass += masses.removed_soil;
        totals.added_mass += masses.added_soil;
      }
    if (parameters.settling.maximum_time > 0.)
      settle();
    else
      begin_balances();
    if (!is_released)
      return;
    results.begin_balances();
    last_time_step = 0.; // The energy is that of the points as they are.
    scene.mark_start();
    scheme->read_points();
  }


  template <int dim>
  void Simulation<dim>::begin_balances()
  {
    const RunBalance<dim> before = totals;
    totals                       = RunBalance<dim>(scene.obstacles.size());
    totals.n_lost                = before.n_lost;
    totals.lost_mass             = before.lost_mass;
    totals.lost_through          = before.lost_through;
    totals.lost_volume           = before.lost_volume;
    totals.lost_water_mass       = before.lost_water_mass;
    totals.removed_mass          = before.removed_mass;
    totals.added_mass            = before.added_mass;
  }


  template <int dim>
  End Simulation<dim>::run()
  {
    timer.reset(); // Only the steps' time is reported.
    stop.listen();
    progress = std::make_unique<Progress>(folder, clock.time(), parameters.end_time, shown_motion(scene).first);
    if (start != Start::resume && is_released) // A resumed run has reported its first state, also that at t = 0.
      report(/* at_start */ true);
    const double updates_before = point_updates;
    const double first_step     = stable_step();
    try
      {
        while (!is_at_end() && reason == StopReason::none)
          {
            const double largest_step = stable_step();
            require_stable_step(largest_step, first_step);
            progress->count(clock.bounds(scene.grid.cell_size(), speeds.wave, speeds.points));
            step(largest_step, output_times.next(largest_step));
            report();
            if (progress_is_due || is_at_end())
              progress->report(clock.time(),
                               clock.step(),
                               last_time_step,
                               shown_motion(scene).second,
                               PointSums<dim>(scene.bodies, scene.water, scene.forcing.gravity(), scene.grid).kinetic);
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
    else if (!parameters.stages.empty() && StageParameters::prefix + parameters.stage.name != parameters.stages.back())
      write_checkpoint(); // for the next stage
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
        folder.log("Stopped while settling, by " + text_of(reason) +
                   (start == Start::new_stage ? ". --resume goes on from the end of the stage before."
                                              : ". There is no checkpoint, as nothing can go on from a state before "
                                                "the release: run the case again. "
                                                "The row at t = 0 is of the soil on its way to rest."));
        return;
      }
    write_checkpoint();
    // After the checkpoint, so that a resumed run drops it, unless it was due.
    if (results.step_of_last_row() != clock.step())
      write_row();
    folder.log("Stopped at t = " + number_text(clock.time()) + " s, step " + std::to_string(clock.step()) + ", by " +
               text_of(reason) + ". A checkpoint is written: --resume goes on from here.");
  }


  template <int dim>
  void Simulation<dim>::advance(const double time_step)
  {
    follow_points(time_step);
    repartition();
    for ([[maybe_unused]] const PointSet<dim> *points : point_sets())
      Assert(points->is_in_inner_cells(), ExcMessage("A point lies beside cells without nodes."));
    StepReport<dim> step;
    if (is_released)
      scene.begin_step(clock.time(), time_step);
    else
      scene.forcing.set_start();
    scheme->to_grid(clock.time());
    scheme->solve(time_step, step);
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
    totals.balance += step.balance;
    if (is_released && scene.forcing.mass_scaling() > 1.)
      totals.balance.motion += 0.5 * time_step * scheme->nodal_forces(time_step).kinetic;
    totals.material.add(step.material);
    totals.elastic_energy = step.material.elastic_energy;
    last_update           = step.material;
    point_updates += step.n_updates;
    place_points(time_step, step);
    account_for_lost_points(time_step);
    if (is_released)
      end_step(time_step);
  }


  template <int dim>
  void Simulation<dim>::place_points(const double time_step, const StepReport<dim> &step)
  {
    const auto sets = point_sets();
    // Besides speeds, whether a point is at the edge and a line of progress is due; then the disorder of each set.
    std::vector<double> largest{ step.speeds.wave, step.speeds.points, 0., double(progress && progress->is_due()) };
    const unsigned int first_set = largest.size();
    {
      const TimedPart part(timer, TimerSection::sort);
      for (PointSet<dim> *points : sets)
        {
          largest.push_back(static_cast<int>(points->update_places()));
          largest[2] = std::max(largest[2], double(points->is_at_edge()));
        }
    }
    MovingSums<dim> sums(step.soil, step.water, step.material.elastic_energy, scene.forcing.gravity());
    RunBalance<dim> all_totals = totals;
    NumbersOf summed(sums);
    summed &all_totals;
    agree_on(largest, summed);
    require_stable_speed(time_step);
    if (is_released) // What leaves the box in this step is in the sums, and not in the totals yet.
      results.watch(sums, all_totals, clock.time() + time_step, time_step);
    const TimedPart part(timer, TimerSection::sort);
    progress_is_due = largest[3] > 0.;
    points_at_edge  = points_at_edge || largest[2] > 0.;
    bool is_sorted  = false;
    for (unsigned int s = 0; s < sets.size(); ++s)
      {
        const auto disorder = static_cast<Disorder>(static_cast<int>(largest[first_set + s]));
        sets[s]->hand_over(disorder);
        is_sorted = is_sorted || disorder >= Disorder::scattered;
      }
    if (is_sorted && scene.grid.follows_points())
      points_at_edge = are_points_at_edge() || points_at_edge;
  }


  template <int dim>
  void Simulation<dim>::begin_checkpoint()
  {
    const RunBalance<dim> own = totals;
    totals                    = totals.sum_over_ranks(communicator);
    solver_state              = scheme->solver_state();
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


  template <int dim>
  void Simulation<dim>::summarise(const End end, const double point_updates_before)
  {
    const double n_updates = Utilities::MPI::sum(point_updates - point_updates_before, communicator);
    progress->conclude(end == End::complete ? "Finished" : "Stopped",
                       clock.time(),
                       n_updates,
                       parameters.time_step.maximum != "auto",
                       communicator);
    progress->summarise(timer, n_updates, scene.water.empty() ? "point" : "soil or water point", communicator);
    progress->summarise_ranks(
        seconds_of(timer, TimerSection::waiting), partition.imbalance(), partition.n_repartitions(), communicator);
    if (scene.grid.follows_points())
      folder.record("fine cells at the end: " +
                    number_text(Utilities::MPI::sum(double(scene.grid.fine_cells().n_owned()), communicator)) +
                    "; they followed the points " + std::to_string(n_refinements) + " times, which took " +
                    number_text(seconds_of(timer, TimerSection::repartition)) + " s");
    log_end(scene, totals, folder);
    results.complete(is_released);
  }


  namespace
  {
    const std::string remedy_for_instability = "Remedies: a smaller 'Courant number' in subsection Time step, 'F-bar = "
                                               "projected' in subsection Stabilisation.";

    /// What and where the fastest point of this rank is, its speed beside, m/s; "" and 0 without points.
    template <int dim>
    std::pair<double, std::string> fastest_point(const Scene<dim> &scene)
    {
      std::pair<double, std::string> fastest{ 0., "" };
      Point<dim> place;
      const auto look = [&](const std::string &name, const PointSet<dim> &points, const unsigned int velocity) {
        for_each_point(points, [&](const auto &point) {
          const double speed = vector_of<dim>(point.properties + velocity).norm();
          if (std::isfinite(speed) && speed <= fastest.first)
            return;
          place   = point.location;
          fastest = { std::isfinite(speed) ? speed : std::numeric_limits<double>::infinity(),
                      "a point of " + name + " at (" + number_text(place) + ") m" };
        });
      };
      for (const auto &body : scene.bodies)
        look(body.name, body.points, PropertyLayout<dim>::velocity);
      for (const auto &part : scene.water)
        if (part.carrier() == nullptr)
          look("the water", part.points(), part.layout.velocity);
      if (fastest.second.empty())
        return fastest;
      const unsigned int face = nearest_face(scene.grid, place);
      const double to_wall    = face % 2 == 0 ? place[face / 2] - scene.grid.lower_corner()[face / 2]
                                              : scene.grid.upper_corner()[face / 2] - place[face / 2];
      if (to_wall < 2. * scene.grid.cell_size())
        {
          const auto of_soil = scene.walls.face_crossed(place);
          fastest.second += " beside the wall '" + of_soil.first + "'";
          if (scene.water_walls && of_soil.second != scene.water_walls->face_crossed(place).second)
            fastest.second += of_soil.second ? ", which is open to soil and closed to water: open it to both"
                                             : ", which is closed to soil and open to water: close it to both";
        }
      return fastest;
    }
  } // namespace


  template <int dim>
  void Simulation<dim>::agree_on(std::vector<double> &largest, const NumbersOf &sums)
  {
    const TimedPart part(timer, TimerSection::waiting);
    for (double &value : largest)
      if (std::isnan(value))
        value = std::numeric_limits<double>::infinity();
    largest.push_back(static_cast<double>(stop.reason()));
    sums.sum_over_ranks(communicator, largest);
    speeds = { largest[0], largest[1] };
    scene.include_inflows(speeds);
    reason = static_cast<StopReason>(largest.back());
    largest.pop_back();
  }


  template <int dim>
  void Simulation<dim>::require_stable_step(const double largest_step, const double first_step) const
  {
    // A run that gains energy would creep on with ever smaller steps.
    AssertThrow(largest_step > 1e-3 * first_step,
                ExcMessage("The motion is unstable: at t = " + Utilities::to_string(clock.time()) +
                           " s the stable step has fallen to " + Utilities::to_string(largest_step) + " s, from " +
                           Utilities::to_string(first_step) + " s at the start. " + remedy_for_instability));
  }


  template <int dim>
  void Simulation<dim>::require_stable_speed(const double time_step) const
  {
    if (std::isfinite(speeds.points) && speeds.points * time_step < 2 * scene.grid.cell_size())
      return;
    const auto of_ranks = Utilities::MPI::all_gather(communicator, fastest_point(scene));
    const auto fastest  = *std::max_element(of_ranks.begin(), of_ranks.end());
    AssertThrow(false,
                ExcMessage("The motion is unstable at t = " + number_text(clock.time()) + " s: " +
                           number_text(speeds.points) + " m/s, " + fastest.second + ". " + remedy_for_instability));
  }


  template <int dim>
  void Simulation<dim>::follow_points(const double time_step)
  {
    if (!points_at_edge)
      return;
    const TimedPart part(timer, TimerSection::repartition);
    partition.refine(blocks_ahead(time_step));
    reinit();
    points_at_edge = are_points_at_edge();
    ++n_refinements;
    AssertThrow(!points_at_edge, ExcInternalError("A point is outside the fine cells."));
  }


  template <int dim>
  Blocks Simulation<dim>::blocks_ahead(const double time_step) const
  {
    constexpr double steps_ahead = 4000; // A new mesh costs 40 to 140 steps, a cell without points memory alone.
    constexpr double few_blocks  = GridParameters::least_ahead / (1 << dim);
    const auto blocks            = [this](const double time) {
      return scene.grid.with_surroundings(scene.blocks_of_points(time));
    };
    const Blocks around = blocks(0.);
    for (double steps = steps_ahead; steps > 1; steps /= 2)
      if (Blocks ahead = blocks(steps * time_step);
          ahead.size() <= std::max(few_blocks, GridParameters::most_ahead * around.size()))
        return ahead;
    return around;
  }


  template <int dim>
  void Simulation<dim>::account_for_lost_points(const double time_step)
  {
    const auto lose = [&](const std::string &name,
                          const std::vector<LostPoint<dim>> &points,
                          const auto &layout,
                          const BoundaryConditions<dim> &walls,
                          double &lost_mass) {
      for (const LostPoint<dim> &point : points)
        {
          const auto [face, is_open] = walls.face_crossed(point.location);
          AssertThrow(is_open,
                      ExcMessage("A point of " + name + " left the box through the closed wall '" + face + "' at (" +
                                 number_text(point.location) + ") m, t = " + number_text(clock.time()) +
                                 " s. Remedies: a smaller 'Courant number', or 'open' (water: 'drained') in subsection "
                                 "Boundaries."));
          const double mass             = point.properties[layout.mass];
          const double inertia          = scene.forcing.mass_scaling() * mass;
          const Tensor<1, dim> velocity = vector_of<dim>(point.properties.data() + layout.velocity);
          lost_mass += mass;
          totals.lost_momentum += inertia * velocity;
          totals.lost_energy +=
              0.5 * inertia * velocity.norm_square() -
              mass * (scene.forcing.gravity() * (point.location - Point<dim>() - 0.5 * time_step * velocity));
        }
    };
    for (auto &part : scene.water)
      lose("the water",
           part.points().lost(),
           part.layout,
           part.own_points() != nullptr ? *scene.water_walls : scene.walls,
           totals.lost_water_mass);
    for (auto &body : scene.bodies)
      {
        lose(body.name, body.points.lost(), body.layout, scene.walls, totals.lost_mass);
        for (const LostPoint<dim> &point : body.points.lost())
          {
            totals.lost_volume += point.properties[body.layout.mass] / body.density;
            totals.lost_through[nearest_face(scene.grid, point.location)] += point.properties[body.layout.mass];
          }
        totals.n_lost += body.points.lost().size();
        body.points.lost().clear();
      }
    for (auto &part : scene.water)
      part.points().lost().clear();
    for (auto &load : scene.loads)
      load.points().lost().clear();
  }


  namespace
  {
    constexpr double part_that_moves   = 0.01; // of the mass; single points at the surface do not count
    constexpr double damping_of_trials = 2.;   // decay rate of the velocity, times sqrt(height of the soil/gravity)
    constexpr double speed_at_rest     = 2e-4; // over sqrt(g H): terminal speed with a thousandth of strength missing


    /// Extents along gravity, m.
    struct Heights
    {
      double soil;  ///< all of it
      double slope; ///< its free surface
    };


    /// Columns of cells along the axis nearest to gravity.
    template <int dim>
    struct Columns
    {
      explicit Columns(const Scene<dim> &scene)
          : up(-scene.forcing.gravity() / scene.forcing.gravity().norm())
          , lower_corner(scene.grid.lower_corner())
          , h(scene.grid.cell_size())
      {
        unsigned int axis = 0;
        for (unsigned int a = 1; a < dim; ++a)
          if (std::abs(up[a]) >= std::abs(up[axis]))
            axis = a;
        for (unsigned int a = 0; a < dim; ++a)
          n_all *= n[a] = a == axis ? 1 : std::lround((scene.grid.upper_corner()[a] - lower_corner[a]) / h);
      }

      /// Number of the column in which a place is.
      std::size_t at(const Point<dim> &x) const
      {
        std::size_t column = 0;
        for (unsigned int a = 0; a < dim; ++a)
          column = column * n[a] + std::clamp<long>((x[a] - lower_corner[a]) / h, 0, n[a] - 1);
        return column;
      }

      /// Height of a place, m.
      double height(const Point<dim> &x) const
      {
        return Tensor<1, dim>(x) * up;
      }

      const Tensor<1, dim> up;
      const Point<dim> lower_corner;
      const double h;                 // cell size, m
      std::array<std::size_t, dim> n; // along each axis
      std::size_t n_all = 1;

      static constexpr double nowhere = std::numeric_limits<double>::lowest(); // height of an empty column
    };


    /// Highest and lowest points of columns. The free surface is the tops of all columns, and the bottoms of those
    /// beside a column without soil. Where it is level within a cell, the slope is all the soil. Collective.
    template <int dim>
    Heights heights_of(const Scene<dim> &scene, const MPI_Comm communicator)
    {
      const Columns<dim> columns(scene);
      const auto &n               = columns.n;
      const std::size_t n_columns = columns.n_all;
      constexpr double nowhere    = Columns<dim>::nowhere;
      std::vector<double> tops(n_columns, nowhere), depths(n_columns, nowhere); // depth: minus the lowest height
      for_each_moving_point(scene.bodies, [&](const auto &, const auto &point) {
        const std::size_t column = columns.at(point.location);
        const double height      = columns.height(point.location);
        tops[column]             = std::max(tops[column], height);
        depths[column]           = std::max(depths[column], -height);
      });
      Utilities::MPI::max(tops, communicator, tops);
      Utilities::MPI::max(depths, communicator, depths);

      double lowest_of_surface = std::numeric_limits<double>::max();
      for (std::size_t column = 0; column < n_columns; ++column)
        if (tops[column] > nowhere)
          {
            lowest_of_surface = std::min(lowest_of_surface, tops[column]);
            for (std::size_t a = dim, stride = 1; a-- > 0; stride *= n[a])
              {
                const std::size_t place = column / stride % n[a];
                if ((place > 0 && tops[column - stride] == nowhere) ||
                    (place + 1 < n[a] && tops[column + stride] == nowhere))
                  lowest_of_surface = std::min(lowest_of_surface, -depths[column]);
              }
          }
      const double top = *std::max_element(tops.begin(), tops.end());
      const double all = top + *std::max_element(depths.begin(), depths.end()), relief = top - lowest_of_surface;
      return { all, relief < columns.h ? all : relief };
    }


    /// What the part of the mass that moves exceeds. Collective.
    /// @param value of a body and a point, not negative
    template <int dim, typename Value>
    double exceeded_by(const std::list<SoilBody<dim>> &bodies, const Value &value, const MPI_Comm communicator)
    {
      std::vector<PartOfMass> parts;
      for_each_moving_point(bodies, [&](const auto &body, const auto &point) {
        parts.push_back({ value(body, point), point.properties[body.layout.mass] });
      });
      return percentile(parts, 1. - part_that_moves, communicator);
    }


    /// Where soil has moved by more than half of a displacement, m, in words: volume, centre, the body that has most of
    /// it, and the largest depth. Collective.
    template <int dim>
    std::string zone_of(const Scene<dim> &scene, const double displacement, const MPI_Comm communicator)
    {
      const Columns<dim> columns(scene);
      constexpr double nowhere = Columns<dim>::nowhere;
      std::vector<double> tops(columns.n_all, nowhere), depths(columns.n_all, nowhere); // of all; of the zone, minus
      std::vector<double> sums(dim + 2 + scene.bodies.size(),
                               0.); // volumes: times place, of all, of the zone, of bodies
      unsigned int b = dim + 2;
      for (const SoilBody<dim> &body : scene.bodies)
        {
          if (!body.is_rigid)
            for_each_point(body.points, [&](const auto &point) {
              const double volume        = point.properties[body.layout.volume];
              const Tensor<1, dim> place = point.location - Point<dim>();
              const double height        = columns.height(point.location);
              double &top                = tops[columns.at(point.location)];
              top                        = std::max(top, height);
              sums[dim] += volume;
              if ((place - vector_of<dim>(point.properties + body.layout.start)).norm() < 0.5 * displacement)
                return;
              double &depth = depths[columns.at(point.location)];
              depth         = std::max(depth, -height);
              for (unsigned int a = 0; a < dim; ++a)
                sums[a] += volume * place[a];
              sums[dim + 1] += volume;
              sums[b] += volume;
            });
          ++b;
        }
      Utilities::MPI::sum(sums, communicator, sums);
      Utilities::MPI::max(tops, communicator, tops);
      Utilities::MPI::max(depths, communicator, depths);
      double largest_depth = 0.;
      for (std::size_t c = 0; c < tops.size(); ++c)
        largest_depth = std::max(largest_depth, depths[c] > nowhere ? tops[c] + depths[c] : 0.);
      std::string centre;
      for (unsigned int a = 0; a < dim; ++a)
        centre += (a > 0 ? ", " : "") + short_text(sums[a] / sums[dim + 1]);
      const auto most = std::max_element(sums.begin() + dim + 2, sums.end());
      const auto body = std::next(scene.bodies.begin(), most - sums.begin() - dim - 2);
      return short_text(sums[dim + 1]) + (dim == 2 ? " m^3/m, " : " m^3, ") +
             short_text(100. * sums[dim + 1] / sums[dim]) + " % of the soil, about (" + centre + ") m, down to " +
             short_text(largest_depth) + " m below the surface; " + short_text(100. * *most / sums[dim + 1]) +
             " % of it is of " + body->name;
    }


    /// Largest plastic shear strain; 0 if no law has it. Collective.
    template <int dim>
    double largest_plastic_strain(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator)
    {
      double largest = 0.;
      for (const auto &body : bodies)
        {
          const auto quantities = body.material->internal_quantities;
          for (unsigned int q = 0; q < quantities.size(); ++q)
            if (quantities[q].name == "plastic_shear_strain")
              for_each_point(body.points, [&](const auto &point) {
                largest = std::max(largest, point.properties[body.layout.internal_variables + q]);
              });
        }
      return Utilities::MPI::max(largest, communicator);
    }


    /// Settlement of an elastic layer as high as the soil by its weight, rho g H^2/(2 M), M = rho c^2. Collective.
    template <int dim>
    double elastic_settlement(const std::list<SoilBody<dim>> &bodies,
                              const double gravity,
                              const double height,
                              const MPI_Comm communicator)
    {
      std::vector<double> sums(2, 0.); // mass, and mass over the square of the wave speed
      for_each_moving_point(bodies, [&](const auto &body, const auto &point) {
        const double pressure = mean_effective_stress(point.properties + body.layout.stress);
        const double c        = body.wave_speed(body.material->initial_bulk_modulus(pressure), /* compression */ 0.);
        const double m        = point.properties[body.layout.mass];
        sums                  = { sums[0] + m, sums[1] + m / (c * c) };
      });
      Utilities::MPI::sum(sums, communicator, sums);
      return 0.5 * gravity * height * height * sums[1] / sums[0];
    }
  } // namespace


  template <int dim>
  TimeStepper Simulation<dim>::relax(const double maximum_time,
                                     const unsigned int steps_between_looks,
                                     const std::function<bool(const TimeStepper &, double)> &is_over)
  {
    TimeStepParameters held_water = parameters.time_step; // An auto maximum is that of dry soil.
    held_water.choose_maximum(/* has_water */ false, scene.forcing.gravity().norm(), scene.grid.cell_size());
    TimeStepper until_rest(held_water);
    stop.listen();
    is_released = false;
    scene.mark_start();
    scheme->settle(true);
    bool goes_on = true;
    while (goes_on && until_rest.time() < maximum_time && reason == StopReason::none)
      {
        const double step = until_rest.next_step(stable_step(until_rest), maximum_time);
        advance(step);
        until_rest.advance(step, maximum_time);
        if (until_rest.step() % steps_between_looks == 0 || until_rest.time() >= maximum_time)
          goes_on = !is_over(until_rest, step);
      }
    if (reason == StopReason::none)
      {
        scheme->settle(false);
        scene.open_gate();
        scene.stop();
        measure_speeds();
      }
    return until_rest;
  }


  template <int dim>
  void Simulation<dim>::settle()
  {
    constexpr unsigned int steps_between_lines = 1000;
    constexpr double past_peak                 = 0.9; // part of the largest kinetic energy: a fixed angle of any mode
    constexpr unsigned int steps_at_rest       = 20;  // The force of an oscillation vanishes for a moment.
    const SettlingParameters &settling         = parameters.settling;
    const std::string name_of_ratio            = "unbalanced force over weight ";
    if (!settling.gate.empty())
      scene.close_gate(settling.gate);

    // All stops where the kinetic energy is largest (@source{barnes1999}), whatever the stiffness.
    double ratio          = std::numeric_limits<double>::infinity(); // not known yet
    double largest        = 0.;                                      // kinetic energy since the last stop
    unsigned int n_below  = 0;
    const auto is_at_rest = [&](const TimeStepper &until_rest, const double step) {
      const NodalForces forces = scheme->nodal_forces(step).sum_over_ranks(communicator);
      ratio                    = forces.ratio();
      n_below                  = ratio < settling.unbalanced_force ? n_below + 1 : 0;
      const bool is_past_peak  = forces.kinetic < past_peak * largest;
      if (is_past_peak)
        scene.stop();
      largest = is_past_peak ? 0. : std::max(largest, forces.kinetic);
      if (until_rest.step() % steps_between_lines == 0)
        folder.log("Settling: " + number_text(until_rest.time()) + " s, step " + std::to_string(until_rest.step()) +
                   ", " + name_of_ratio + number_text(ratio));
      return n_below >= steps_at_rest;
    };
    const TimeStepper until_rest = relax(settling.maximum_time, 1, is_at_rest);
    is_released                  = reason == StopReason::none;
    folder.log("Settled for " + number_text(until_rest.time()) + " s in " + std::to_string(until_rest.step()) +
               " steps; " + name_of_ratio + number_text(ratio) + (is_released ? ". Released." : ". Asked to stop."));
    if (is_released)
      {
        auto checks = checks_of_settling(ratio);
        for (CheckResult &check : checks)
          if (!parameters.stage.name.empty())
            check.name += ", " + parameters.stage.name;
        for (const CheckResult &check : checks)
          if (check.is_exceeded)
            folder.log("Check: " + check.name + ' ' + check.value + ", bound " + check.bound + ": " + check.remedy +
                       '.');
          else
            folder.record("Settling: " + check.name + ' ' + check.value);
        results.add_checks(checks);
      }
    begin_balances(); // at the release
  }


  template <int dim>
  std::vector<CheckResult> Simulation<dim>::checks_of_settling(const double unbalanced_force) const
  {
    const Heights height = heights_of(scene, communicator);
    const double elastic = elastic_settlement(scene.bodies, scene.forcing.gravity().norm(), height.soil, communicator);
    const double allowed = parameters.safety.displacement * height.slope + elastic;
    const double moved   = displacement();
    const bool stands    = !(moved > allowed);
    const bool rests     = unbalanced_force < parameters.settling.unbalanced_force;
    return { { "displacement while settling",
               short_text(moved) + " m",
               short_text(allowed) + " m",
               !stands,
               "this slope does not stand: see --safety" },
             { "unbalanced force at the release",
               short_text(unbalanced_force) + " of the weight",
               short_text(parameters.settling.unbalanced_force),
               !rests,
               "write a larger \"Maximum time\" in subsection Settling" },
             { "largest plastic shear strain of settling",
               short_text(largest_plastic_strain(scene.bodies, communicator)) } };
  }


  template <int dim>
  double Simulation<dim>::displacement() const
  {
    return exceeded_by(
        scene.bodies,
        [](const auto &body, const auto &point) {
          return (Tensor<1, dim>(point.location) - vector_of<dim>(point.properties + body.layout.start)).norm();
        },
        communicator);
  }


  template <int dim>
  Trial Simulation<dim>::try_strength(const double displacement_of_failure)
  {
    constexpr unsigned int steps_between_looks = 20;
    const Heights height                       = heights_of(scene, communicator);
    const double gravity                       = scene.forcing.gravity().norm();
    const double time_scale                    = std::sqrt(height.soil / gravity);
    const TrialBounds bounds{ time_scale,
                              speed_at_rest * gravity * time_scale,
                              displacement_of_failure * height.slope,
                              parameters.safety.longest_trial * time_scale };
    TrialJudge judge(bounds);
    Trial trial;
    scene.forcing.set_damping(damping_of_trials / time_scale);
    const auto has_ended = [&](const TimeStepper &until_rest, const double) {
      trial.displacement = displacement();
      const double speed = exceeded_by(
          scene.bodies,
          [](const auto &body, const auto &point) {
            return vector_of<dim>(point.properties + body.layout.velocity).norm();
          },
          communicator);
      trial.end = judge.look(until_rest.time(), trial.displacement, speed);
      folder.record("t " + number_text(until_rest.time()) + " s, displacement " + number_text(trial.displacement) +
                    " m, speed " + number_text(speed) + " m/s");
      return trial.end != TrialEnd::undecided;
    };
    const TimeStepper until_rest = relax(bounds.maximum_time, steps_between_looks, has_ended);
    scene.forcing.set_damping(0.);
    trial.has_moved = trial.displacement > bounds.displacement;
    trial.time      = until_rest.time();
    trial.steps     = until_rest.step();
    if (trial.end == TrialEnd::fails)
      trial.zone = zone_of(scene, trial.displacement, communicator);
    return trial;
  }

  template class Simulation<2>;
  template class Simulation<3>;


  namespace
  {
    /// The case itself, without its stages.
    template <int dim>
    End run_case(Parameters &parameters, const Start start, const MPI_Comm communicator)
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
  } // namespace


  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator)
  {
    auto next         = parameters.stages.begin();
    bool is_to_resume = false; // the stage in which the newest checkpoint is
    if (start == Start::resume && !parameters.stages.empty())
      {
        const CaseEntries entries = find_checkpoint(
                                        parameters.output_directory, [](const std::string &) {}, communicator)
                                        .entries;
        if (const CaseEntry *name = entries.find("Stage", "Name"))
          {
            next         = std::find(next, parameters.stages.end(), StageParameters::prefix + name->value);
            is_to_resume = next != parameters.stages.end();
            require_entry(is_to_resume,
                          { "", "Output directory", parameters.output_directory },
                          "its newest checkpoint is of a stage " + quoted(name->value) +
                              ", which the case does not have. Run without --resume.");
          }
      }
    End end = is_to_resume ? End::complete : run_case<dim>(parameters, start, communicator);
    for (; next != parameters.stages.end() && end == End::complete; ++next, is_to_resume = false)
      {
        Parameters of_stage(parameters.case_file, *next);
        try
          {
            end = Simulation<dim>(of_stage, is_to_resume ? Start::resume : Start::new_stage, communicator).run();
          }
        catch (const EntryError &error)
          {
            throw of_stage.error(error);
          }
      }
    return end;
  }

  template End run_in_phases<2>(Parameters &, const Start, const MPI_Comm);
  template End run_in_phases<3>(Parameters &, const Start, const MPI_Comm);
} // namespace scree
