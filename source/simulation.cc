// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/simulation.h>

#include <scree/initial/geostatic.h>
#include <scree/output/checkpoint.h>
#include <scree/points/seeding.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The first multiple of `interval` that is due after `n` have been.
    double due(const unsigned int n, const double interval)
    {
      return interval > 0 ? n * interval : std::numeric_limits<double>::infinity();
    }

    bool reached(const double time, const double appointment)
    {
      return time >= appointment * (1. - 1e-12);
    }

    /// Largest over ranks; a value that is not a number counts as infinite.
    void max_over_ranks(std::vector<double> &values, const MPI_Comm communicator)
    {
      for (double &value : values)
        if (std::isnan(value))
          value = std::numeric_limits<double>::infinity();
      Utilities::MPI::max(values, communicator, values);
    }

    std::string coordinates(const Point<2> &x)
    {
      return Utilities::to_string(x[0]) + ", " + Utilities::to_string(x[1]);
    }
    std::string coordinates(const Point<3> &x)
    {
      return Utilities::to_string(x[0]) + ", " + Utilities::to_string(x[1]) + ", " + Utilities::to_string(x[2]);
    }
  } // namespace


  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator)
      : parameters(parameters)
      , communicator(communicator)
      , folder(parameters.output_directory,
               start == Start::resume,
               parameters.output.screen_kind() == Screen::progress,
               communicator)
      , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
      , grid(parameters.grid, communicator)
      , walls(grid, parameters.boundaries)
      , field(grid)
      , transfer(grid, parameters.transfer, parameters.stabilisation)
      , scheme(grid, walls, parameters.gravity, parameters.body_force)
      , clock(parameters.time_step)
      , graphics(grid, parameters.output, parameters.output_directory)
      , statistics(grid, scheme.gravity())
  {
    folder.write("original.prm", parameters.original());
    std::ostringstream all_entries;
    parameters.print(all_entries);
    folder.write("parameters.prm", all_entries.str());

    make_phases();
    if (start == Start::resume)
      resume();
    else
      initialise();
  }


  template <int dim>
  void Simulation<dim>::make_phases()
  {
    for (const BodyParameters &body : parameters.bodies)
      {
        auto material = make_material<dim>(body.material);
        const PropertyLayout<dim> layout(material->internal_variable_names().size(),
                                         parameters.transfer.carries_affine_field());
        phases.emplace_back(
            body.name, body.bulk_density(), std::move(material), layout, grid.triangulation(), grid.mapping());
      }
    // Cost sits where the points are; an empty cell costs a little.
    grid.triangulation().signals.weight.connect([this](const auto &cell, const auto) {
      unsigned int weight = 1;
      if (cell->is_active() && cell->is_locally_owned())
        for (const auto &phase : phases)
          weight += 20 * phase.points.handler().n_particles_in_cell(cell);
      return weight;
    });
  }


  template <int dim>
  void Simulation<dim>::initialise()
  {
    auto body = parameters.bodies.begin();
    for (auto &phase : phases)
      seed(phase, (body++)->seeding, grid.triangulation(), grid.cell_size());
    set_initial_stress();
    balance_load();
    set_phases_in_motion();
    if (parameters.settling.maximum_time > 0)
      settle();
  }


  template <int dim>
  void Simulation<dim>::set_initial_stress()
  {
    std::unique_ptr<Overburden<dim>> overburden; // made when the first body asks for it
    auto body = parameters.bodies.begin();
    for (auto &phase : phases)
      {
        const InitialStateParameters &state = (body++)->initial_state;
        if (state.type != "K0")
          {
            set_isotropic_stress(phase, state.type == "isotropic" ? state.pressure : 0.);
            continue;
          }
        if (!overburden)
          {
            std::vector<typename Overburden<dim>::Layer> layers;
            for (const auto &layer : parameters.bodies)
              layers.push_back({ Region<dim>("Subsection " + layer.name + ": 'Region'", layer.seeding.region),
                                 layer.bulk_density() });
            overburden =
                std::make_unique<Overburden<dim>>(grid, std::move(layers), scheme.gravity(), grid.cell_size() / 4);
          }
        set_k0_stress(phase, *overburden, state.k0);
      }
  }


  template <int dim>
  void Simulation<dim>::set_phases_in_motion()
  {
    std::vector<double> largest{ 0., 0. };
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            const double *properties = cell.properties + p * phase.points.stride();
            const double bulk =
                phase.material->initial_bulk_modulus(mean_effective_stress(properties + phase.layout.stress));
            double square = 0;
            for (unsigned int a = 0; a < dim; ++a)
              square += properties[phase.layout.velocity + a] * properties[phase.layout.velocity + a];
            largest[0] = std::max(largest[0], phase.wave_speed(bulk));
            largest[1] = std::max(largest[1], std::sqrt(square));
          }
    max_over_ranks(largest, communicator);
    wave_speed    = largest[0];
    largest_speed = largest[1];
  }


  template <int dim>
  void Simulation<dim>::settle()
  {
    const SettlingParameters &settling = parameters.settling;
    std::vector<char> held;
    if (!settling.gate.empty())
      {
        const Region<dim> gate("Subsection Settling: 'Gate'", settling.gate);
        for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
          held.push_back(gate.contains(grid.node_position(node)));
      }
    scheme.start_settling(settling.damping_rate, held);

    Clock settling_clock(parameters.time_step);
    constexpr unsigned int steps_between_checks = 50;
    double ratio                                = 0;
    while (settling_clock.time() < settling.maximum_time)
      {
        const double step =
            settling_clock.next_step(grid.cell_size(), wave_speed, largest_speed, settling.maximum_time);
        advance(step);
        settling_clock.advance(step, settling.maximum_time);
        if (settling_clock.step() % steps_between_checks == 0)
          {
            ratio = kinetic_to_elastic_energy(phases, communicator);
            if (ratio < settling.kinetic_energy)
              break;
          }
      }
    folder.log("Settled for " + Utilities::to_string(settling_clock.time()) + " s in " +
               std::to_string(settling_clock.step()) + " steps; kinetic over elastic energy " +
               Utilities::to_string(ratio) + ". Released.");

    scheme.release();
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          std::fill_n(cell.properties + p * phase.points.stride() + phase.layout.velocity, dim, 0.);
    totals = RunTotals<dim>();
    set_phases_in_motion();
  }


  template <int dim>
  void Simulation<dim>::run()
  {
    Progress progress(folder, clock.time(), parameters.end_time);
    report();
    while (clock.time() < parameters.end_time)
      {
        const double appointment = next_appointment();
        last_time_step           = clock.next_step(grid.cell_size(), wave_speed, largest_speed, appointment);
        advance(last_time_step);
        clock.advance(last_time_step, appointment);
        report();
        progress.report(clock.time(), clock.step(), last_time_step);
      }
    const double updates = Utilities::MPI::sum(totals.n_updates, communicator);
    progress.summarise(timer, updates, Utilities::MPI::n_mpi_processes(communicator));
    folder.log("Results are in " + parameters.output_directory + " (open solution/points.pvd in ParaView).");
    if (folder.is_writer() && parameters.output.screen_kind() == Screen::statistics)
      statistics.print_last_row(std::cout);
  }


  template <int dim>
  void Simulation<dim>::advance(const double time_step)
  {
    {
      TimerOutput::Scope part(timer, "points to grid");
      field.clear();
      for (const auto &phase : phases)
        transfer.to_grid(phase, field);
      field.add_contributions();
    }
    {
      TimerOutput::Scope part(timer, "nodes");
      totals.balance += scheme.solve(field, clock.time(), time_step);
      field.update_ghosts();
    }

    // largest wave speed and speed; whether a point left
    std::vector<double> largest{ 0., 0., 0. };
    last_step = UpdateReport();
    for (auto &phase : phases)
      {
        {
          TimerOutput::Scope part(timer, "grid to points, stress");
          const MotionReport motion = transfer.to_points(phase, field, time_step);
          largest[0]                = std::max(largest[0], phase.wave_speed(motion.material.largest_bulk_modulus));
          largest[1] = motion.largest_speed <= largest[1] ? largest[1] : motion.largest_speed; // keeps a NaN
          last_step.add(motion.material);
        }
        {
          TimerOutput::Scope part(timer, "sort into cells and ranks");
          phase.points.sort();
          largest[2] = std::max<double>(largest[2], phase.points.lost().size());
        }
      }
    totals.add(last_step);

    TimerOutput::Scope part(timer, "agree on the next step");
    max_over_ranks(largest, communicator);
    wave_speed    = largest[0];
    largest_speed = largest[1];
    AssertThrow(std::isfinite(largest_speed) && largest_speed * time_step < 2 * grid.cell_size(),
                ExcMessage("The motion is unstable at t = " + Utilities::to_string(clock.time()) +
                           " s: a point moves at " + Utilities::to_string(largest_speed) +
                           " m/s. Remedies: a smaller 'Courant number' in subsection Time step, 'F-bar = modified' in "
                           "subsection Stabilisation."));
    if (largest[2] > 0)
      account_for_lost_points();
    constexpr unsigned int steps_between_balances = 100;
    if (clock.step() % steps_between_balances == steps_between_balances - 1)
      balance_load();
  }


  template <int dim>
  void Simulation<dim>::account_for_lost_points()
  {
    for (auto &phase : phases)
      {
        for (const LostPoint<dim> &point : phase.points.lost())
          {
            const auto [face, is_open] = walls.face_crossed(point.location);
            AssertThrow(is_open,
                        ExcMessage("A point of " + phase.name + " left the box through the closed wall '" + face +
                                   "' at (" + coordinates(point.location) +
                                   ") m, t = " + Utilities::to_string(clock.time()) +
                                   " s. Remedies: a smaller 'Courant number', or 'open' in subsection Boundaries."));
            const double mass = point.properties[phase.layout.mass];
            const Tensor<1, dim> velocity(make_array_view(point.properties.begin() + phase.layout.velocity,
                                                          point.properties.begin() + phase.layout.velocity + dim));
            ++totals.n_lost;
            totals.lost_mass += mass;
            totals.lost_momentum += mass * velocity;
            totals.lost_energy +=
                mass * (0.5 * velocity.norm_square() - scheme.gravity() * (point.location - Point<dim>()));
          }
        phase.points.lost().clear();
      }
  }


  template <int dim>
  void Simulation<dim>::balance_load()
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return;
    double n_points = 0;
    for (const auto &phase : phases)
      n_points += phase.points.handler().n_locally_owned_particles();
    const auto load                       = Utilities::MPI::min_max_avg(n_points, communicator);
    constexpr double worthwhile_imbalance = 1.1;
    if (load.max < worthwhile_imbalance * load.avg)
      return;

    TimerOutput::Scope part(timer, "balance load");
    for (auto &phase : phases)
      phase.points.handler().prepare_for_coarsening_and_refinement();
    grid.triangulation().repartition();
    for (auto &phase : phases)
      {
        phase.points.handler().unpack_after_coarsening_and_refinement();
        phase.points.sort();
      }
    grid.distribute_nodes();
    field.reinit();
  }


  template <int dim>
  double Simulation<dim>::next_appointment() const
  {
    const OutputParameters &output = parameters.output;
    return std::min({ parameters.end_time,
                      due(n_pictures, output.interval),
                      due(n_rows, output.interval_of_statistics()),
                      due(n_checkpoints, output.checkpoint_interval) });
  }


  template <int dim>
  void Simulation<dim>::report()
  {
    const OutputParameters &output = parameters.output;
    const double time              = clock.time();
    const bool at_end              = reached(time, parameters.end_time);
    TimerOutput::Scope part(timer, "output");

    if (at_end || reached(time, due(n_rows, output.interval_of_statistics())))
      {
        ++n_rows;
        statistics.collect(phases, totals, time, clock.step(), last_time_step, last_step);
        if (folder.is_writer())
          statistics.write(folder.file("statistics"));
      }
    if (at_end || reached(time, due(n_pictures, output.interval)))
      {
        ++n_pictures;
        graphics.write(phases, field, time);
      }
    if (reached(time, due(n_checkpoints, output.checkpoint_interval)))
      {
        ++n_checkpoints;
        write_checkpoint();
      }
  }


  template <int dim>
  template <class Archive>
  void Simulation<dim>::serialize_state(Archive &archive)
  {
    double time             = clock.time();
    unsigned long long step = clock.step();
    archive &time &step &wave_speed &largest_speed &last_time_step;
    archive &n_pictures &n_rows &n_checkpoints &totals &statistics &graphics;
    clock.set(time, step);
  }


  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    const RunTotals<dim> own = totals;
    totals                   = totals.sum_over_ranks(communicator);
    save_checkpoint(parameters.output_directory, grid, phases, [&](auto &archive) { serialize_state(archive); });
    totals = own;
  }


  template <int dim>
  void Simulation<dim>::resume()
  {
    load_checkpoint(parameters.output_directory, grid, phases, [&](auto &archive) { serialize_state(archive); });
    if (!folder.is_writer())
      totals = RunTotals<dim>(); // The writer holds the sums.
    field.reinit();
    folder.log("Resumed at t = " + Utilities::to_string(clock.time()) + " s, step " + std::to_string(clock.step()) +
               ".");
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace scree
