// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/input/input_error.h>
#include <scree/output/checkpoint.h>
#include <scree/points/seeding.h>
#include <scree/simulation.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, const Start start, const MPI_Comm communicator)
      : parameters(parameters)
      , communicator(communicator)
      , folder(parameters.output_directory, parameters.output.screen_kind() == Screen::progress, communicator)
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
        phases.emplace_back(body.name,
                            body.bulk_density(),
                            body.seeding.grain_density,
                            std::move(material),
                            layout,
                            grid.triangulation(),
                            grid.mapping());
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
    folder.remove_old_results(); // not before the input has proved good
    balance_load();
    measure_speeds();
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
              layers.push_back(
                  { Region<dim>(entry_name(layer.name, "Region"), layer.seeding.region), layer.bulk_density() });
            overburden =
                std::make_unique<Overburden<dim>>(grid, std::move(layers), scheme.gravity(), grid.cell_size() / 4);
          }
        set_k0_stress(phase, *overburden, state.k0);
      }
  }


  template <int dim>
  void Simulation<dim>::measure_speeds()
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
    largest       = largest_of_ranks(largest);
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
        const Region<dim> gate(entry_name("Settling", "Gate"), settling.gate);
        for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
          held.push_back(gate.contains(grid.node_position(node)));
      }
    scheme.start_settling(settling.damping_rate, held);

    Clock settling_clock(parameters.time_step);
    constexpr unsigned int steps_between_checks = 50;
    double ratio                                = std::numeric_limits<double>::infinity();
    while (settling_clock.time() < settling.maximum_time && ratio >= settling.kinetic_energy)
      {
        const double step = settling_clock.next_step(
            settling_clock.stable_step(grid.cell_size(), wave_speed, largest_speed), settling.maximum_time);
        advance(step);
        settling_clock.advance(step, settling.maximum_time);
        if (settling_clock.step() % steps_between_checks == 0 || settling_clock.time() >= settling.maximum_time)
          ratio = kinetic_to_elastic_energy(phases, {}, communicator);
      }
    folder.log(
        "Settled for " + Utilities::to_string(settling_clock.time()) + " s in " +
        std::to_string(settling_clock.step()) + " steps; kinetic over elastic energy " + Utilities::to_string(ratio) +
        (ratio < settling.kinetic_energy ? ". Released."
                                         : ", above the wanted " + Utilities::to_string(settling.kinetic_energy) +
                                               ": not yet at rest. Released all the same."));

    scheme.release();
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          std::fill_n(cell.properties + p * phase.points.stride() + phase.layout.velocity, dim, 0.);
    // Balances begin at the release; what was lost stays lost.
    const RunTotals<dim> settled = totals;
    totals                       = RunTotals<dim>();
    totals.n_lost                = settled.n_lost;
    totals.lost_mass             = settled.lost_mass;
    measure_speeds();
  }


  template <int dim>
  template <class Archive>
  void Simulation<dim>::serialize_state(Archive &archive)
  {
    double time             = clock.time();
    unsigned long long step = clock.step();
    archive &time &step &wave_speed &largest_speed &last_time_step;
    archive &totals &statistics &graphics;
    clock.set(time, step);
  }


  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    const RunTotals<dim> own = totals;
    totals                   = totals.sum_over_ranks(communicator);
    std::vector<PointSet<dim> *> sets;
    for (auto &phase : phases)
      sets.push_back(&phase.points);
    save_checkpoint(parameters.output_directory, grid, sets, [&](auto &archive) { serialize_state(archive); });
    totals = own;
  }


  template <int dim>
  void Simulation<dim>::resume()
  {
    std::vector<PointSet<dim> *> sets;
    for (auto &phase : phases)
      sets.push_back(&phase.points);
    load_checkpoint(parameters.output_directory, grid, sets, [&](auto &archive) { serialize_state(archive); });
    if (!folder.is_writer())
      totals = RunTotals<dim>(); // The writer holds the sums.
    field.reinit();
    make_appointments();
    folder.log("Resumed at t = " + Utilities::to_string(clock.time()) + " s, step " + std::to_string(clock.step()) +
               ".");
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace scree
