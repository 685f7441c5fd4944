// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/simulation.h>
#include <scree/transfer/load_transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const std::string remedy_for_instability =
        "Remedies: a smaller 'Courant number' in subsection Time step, 'F-bar = modified' in subsection Stabilisation.";

    /// The first multiple of `interval` after `time`; never, if there is no interval.
    double first_after(const double time, const double interval)
    {
      return interval > 0 ? (std::floor(time / interval * (1. + 1e-12)) + 1.) * interval
                          : std::numeric_limits<double>::infinity();
    }

    /// Appointments that differ by rounding only are one.
    bool reached(const double time, const double appointment)
    {
      return time >= appointment * (1. - 1e-12);
    }

    template <int dim>
    std::string coordinates(const Point<dim> &x)
    {
      std::string text = Utilities::to_string(x[0]);
      for (unsigned int a = 1; a < dim; ++a)
        text += ", " + Utilities::to_string(x[a]);
      return text;
    }
  } // namespace


  template <int dim>
  void Simulation<dim>::run()
  {
    timer.reset(); // Only the steps' time is to be told.
    Progress progress(folder, clock.time(), parameters.end_time);
    if (clock.step() == 0)
      report();
    const double updates_before = totals.n_updates;
    const double first_step     = stable_step();
    while (!reached(clock.time(), parameters.end_time))
      {
        const double largest_step = stable_step();
        // A run that gains energy would creep on with ever smaller steps.
        AssertThrow(largest_step > 1e-3 * first_step,
                    ExcMessage("The motion is unstable: at t = " + Utilities::to_string(clock.time()) +
                               " s the stable step has fallen to " + Utilities::to_string(largest_step) + " s, from " +
                               Utilities::to_string(first_step) + " s at the start. " + remedy_for_instability));
        const double appointment = next_appointment(largest_step);
        last_time_step           = clock.next_step(largest_step, appointment);
        advance(last_time_step);
        clock.advance(last_time_step, appointment);
        report();
        progress.report(clock.time(), clock.step(), last_time_step);
      }
    const double updates = Utilities::MPI::sum(totals.n_updates - updates_before + water_updates, communicator);
    progress.summarise(timer,
                       updates,
                       Utilities::MPI::n_mpi_processes(communicator),
                       parameters.has_water ? "soil or water point" : "point");
    folder.log("Results are in " + parameters.output_directory +
               (parameters.output.graphics == "none" ? "." : " (open solution/points.pvd in ParaView)."));
    if (folder.is_writer() && parameters.output.screen_kind() == Screen::statistics)
      statistics.print_last_row(std::cout);
  }


  template <int dim>
  void Simulation<dim>::advance(const double time_step)
  {
    constexpr unsigned int steps_between_balances = 100;
    if (clock.step() % steps_between_balances == steps_between_balances - 1)
      share_out_cells();

    solve_nodes(time_step);

    // largest wave speed and speed; whether a point left
    std::vector<double> largest{ 0., 0., 0. };
    move_points(time_step, largest);
    {
      TimerOutput::Scope part(timer, "sort into cells and ranks");
      for (PointSet<dim> *points : point_sets())
        {
          points->sort();
          largest[2] = std::max<double>(largest[2], points->lost().size());
        }
    }
    {
      TimerOutput::Scope part(timer, "agree on the next step");
      largest = largest_of_ranks(largest);
    }
    wave_speed    = largest[0];
    largest_speed = largest[1];
    AssertThrow(std::isfinite(largest_speed) && largest_speed * time_step < 2 * grid.cell_size(),
                ExcMessage("The motion is unstable at t = " + Utilities::to_string(clock.time()) +
                           " s: a point moves at " + Utilities::to_string(largest_speed) + " m/s. " +
                           remedy_for_instability));
    if (largest[2] > 0)
      account_for_lost_points();
  }


  template <int dim>
  void Simulation<dim>::solve_nodes(const double time_step)
  {
    forcing.set_time(clock.time());
    StepBalance<dim> balance;
    {
      TimerOutput::Scope part(timer, "points to grid");
      field.clear();
      for (const auto &phase : phases)
        transfer.to_grid(phase, field);
      if (semi_implicit)
        semi_implicit->gather(phases, water);
      if (load)
        balance.load_impulse = time_step * add_load(*load, clock.time(), grid, field);
      if (!semi_implicit)
        field.add_contributions();
    }
    if (semi_implicit)
      {
        double shear_modulus = 0;
        for (const auto &phase : phases)
          shear_modulus = std::max(shear_modulus, phase.material->shear_modulus());
        totals.balance += semi_implicit->solve(field, time_step, shear_modulus, timer);
        // The scheme sees the load among the forces on the soil.
        balance.pressure_impulse = -balance.load_impulse;
      }
    else
      {
        TimerOutput::Scope part(timer, "nodes");
        totals.balance += scheme.solve(field, time_step);
        field.update_ghosts();
      }
    totals.balance += balance;
  }


  template <int dim>
  void Simulation<dim>::move_points(const double time_step, std::vector<double> &largest)
  {
    const auto keep_largest = [&](const double speed) {
      largest[1] = speed <= largest[1] ? largest[1] : speed; // keeps a NaN
    };
    last_step = UpdateReport();
    {
      TimerOutput::Scope part(timer, "grid to points, stress");
      for (auto &phase : phases)
        {
          const MotionReport motion = transfer.to_points(phase, field, time_step);
          largest[0]                = std::max(largest[0], phase.wave_speed(motion.material.largest_bulk_modulus));
          keep_largest(motion.largest_speed);
          last_step.add(motion.material);
          if (semi_implicit)
            semi_implicit->fluidise(phase);
        }
      if (load)
        totals.balance.load_work += move_load(*load, clock.time(), grid, field, time_step);
    }
    if (semi_implicit)
      {
        TimerOutput::Scope part(timer, "grid to water points");
        for (auto &part_of_water : water)
          {
            keep_largest(semi_implicit->to_points(part_of_water, time_step));
            semi_implicit->correct_volume(part_of_water, time_step, totals.balance);
            if (const PointSet<dim> *own = part_of_water.own_points())
              water_updates += own->handler().n_locally_owned_particles();
          }
      }
    totals.add(last_step);
  }


  template <int dim>
  double Simulation<dim>::stable_step() const
  {
    const double step = clock.stable_step(grid.cell_size(), wave_speed, largest_speed);
    return semi_implicit ? std::min(step, semi_implicit->largest_step()) : step;
  }


  template <int dim>
  std::vector<PointSet<dim> *> Simulation<dim>::point_sets()
  {
    std::vector<PointSet<dim> *> sets;
    for (auto &phase : phases)
      sets.push_back(&phase.points);
    for (auto &part : water)
      if (PointSet<dim> *own = part.own_points())
        sets.push_back(own);
    if (load)
      sets.push_back(&load->points());
    return sets;
  }


  template <int dim>
  std::vector<double> Simulation<dim>::largest_of_ranks(std::vector<double> values) const
  {
    for (double &value : values)
      if (std::isnan(value))
        value = std::numeric_limits<double>::infinity();
    Utilities::MPI::max(values, communicator, values);
    return values;
  }


  template <int dim>
  void Simulation<dim>::account_for_lost_points()
  {
    const auto leave = [&](const std::string &name,
                           const LostPoint<dim> &point,
                           const std::pair<std::string, bool> &face_and_whether_open,
                           const unsigned int velocity_slot,
                           const unsigned int mass_slot,
                           double &lost_mass) {
      const auto &[face, is_open] = face_and_whether_open;
      AssertThrow(is_open,
                  ExcMessage("A point of " + name + " left the box through the closed wall '" + face + "' at (" +
                             coordinates(point.location) + ") m, t = " + Utilities::to_string(clock.time()) +
                             " s. Remedies: a smaller 'Courant number', or 'open' (water: 'drained') in subsection "
                             "Boundaries."));
      const double mass = point.properties[mass_slot];
      const Tensor<1, dim> velocity(
          make_array_view(point.properties.begin() + velocity_slot, point.properties.begin() + velocity_slot + dim));
      lost_mass += mass;
      totals.lost_momentum += mass * velocity;
      totals.lost_energy += mass * (0.5 * velocity.norm_square() - forcing.gravity() * (point.location - Point<dim>()));
    };
    for (auto &part : water)
      for (const LostPoint<dim> &point : part.points().lost())
        leave("the water",
              point,
              part.own_points() != nullptr ? water_walls->face_crossed(point.location)
                                           : walls.face_crossed(point.location),
              part.layout.velocity,
              part.layout.mass,
              totals.lost_water_mass);
    for (auto &phase : phases)
      for (const LostPoint<dim> &point : phase.points.lost())
        {
          leave(phase.name,
                point,
                walls.face_crossed(point.location),
                phase.layout.velocity,
                phase.layout.mass,
                totals.lost_mass);
          ++totals.n_lost;
        }
    for (PointSet<dim> *points : point_sets())
      points->lost().clear();
  }


  template <int dim>
  void Simulation<dim>::share_out_cells()
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return;
    const auto sets = point_sets();
    double n_points = 0;
    for (const PointSet<dim> *points : sets)
      n_points += points->handler().n_locally_owned_particles();
    const auto of_ranks                   = Utilities::MPI::min_max_avg(n_points, communicator);
    constexpr double worthwhile_imbalance = 1.1;
    if (of_ranks.max < worthwhile_imbalance * of_ranks.avg)
      return;

    TimerOutput::Scope part(timer, "balance load");
    for (PointSet<dim> *points : sets)
      points->handler().prepare_for_coarsening_and_refinement();
    grid.triangulation().repartition();
    for (PointSet<dim> *points : sets)
      {
        points->handler().unpack_after_coarsening_and_refinement();
        points->sort();
      }
    grid.distribute_nodes();
    field.reinit();
    if (semi_implicit)
      semi_implicit->reinit();
  }


  template <int dim>
  void Simulation<dim>::make_appointments()
  {
    const OutputParameters &output = parameters.output;
    next_picture                   = first_after(clock.time(), output.interval);
    next_row                       = first_after(clock.time(), output.interval_of_statistics());
    next_checkpoint                = first_after(clock.time(), output.checkpoint_interval);
  }


  template <int dim>
  double Simulation<dim>::next_appointment(const double largest_step) const
  {
    const auto due     = { parameters.end_time, next_picture, next_row, next_checkpoint };
    const double first = std::min(due);
    // Those that follow at once are met together: in a step that is far shorter than the others the pressure would
    // answer to what divergence the last one left with a shock.
    double last = first;
    for (const double time : due)
      if (time <= first + 0.1 * largest_step)
        last = std::max(last, time);
    return std::min(last, parameters.end_time);
  }


  template <int dim>
  void Simulation<dim>::write_picture(const double time)
  {
    if (!semi_implicit)
      {
        graphics.write(phases, field, time);
        return;
      }
    const WaterView<dim> view{ water, semi_implicit->water_field(), [&](const unsigned int cell) {
                                return semi_implicit->corner_pressure(cell);
                              } };
    graphics.write(phases, field, time, &view);
  }


  template <int dim>
  void Simulation<dim>::report()
  {
    const double time          = clock.time();
    const bool at_start_or_end = clock.step() == 0 || reached(time, parameters.end_time);
    TimerOutput::Scope part(timer, "output");

    if (at_start_or_end || reached(time, next_row))
      {
        statistics.collect(phases, water, totals, time, clock.step(), last_time_step, last_step);
        if (folder.is_writer())
          statistics.write(folder.file("statistics"));
      }
    if (at_start_or_end || reached(time, next_picture))
      write_picture(time);
    if (reached(time, next_checkpoint))
      write_checkpoint();
    make_appointments();
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace scree
