// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/initial/water_start.h>
#include <scree/input/input_error.h>
#include <scree/output/checkpoint.h>
#include <scree/points/seeding.h>
#include <scree/points/water_seeding.h>
#include <scree/simulation.h>
#include <scree/tensor/invariants.h>

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
      , forcing(grid, parameters.gravity, parameters.body_force)
      , scheme(grid, walls, forcing)
      , clock(parameters.time_step)
      , graphics(grid, parameters.output, parameters.output_directory)
      , statistics(grid, forcing.gravity())
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
    // The one place that knows whose points carry the water.
    const bool affine      = parameters.transfer.carries_affine_field();
    const bool water_rides = parameters.has_water && parameters.water.point_sets_kind() == PointSets::single_point;
    for (const BodyParameters &body : parameters.bodies)
      {
        auto material = make_material<dim>(body.material);
        const PropertyLayout<dim> layout(material->internal_quantities().size(),
                                         affine,
                                         water_rides ? WaterLayout<dim>(0, affine).n_properties() : 0);
        phases.emplace_back(body.name,
                            body.bulk_density(),
                            body.seeding.grain_density,
                            std::move(material),
                            layout,
                            grid.triangulation(),
                            grid.mapping());
        if (water_rides)
          water.emplace_back(parameters.water.density, affine, phases.back());
      }
    if (parameters.has_water && !water_rides)
      water.emplace_back(parameters.water.density, affine, grid.triangulation(), grid.mapping());
    if (parameters.has_water)
      {
        water_walls   = std::make_unique<WaterBoundaryConditions<dim>>(grid, parameters.water_boundaries);
        semi_implicit = std::make_unique<SemiImplicitScheme<dim>>(
            grid, walls, *water_walls, forcing, parameters.transfer, parameters.water, parameters.pressure);
      }
    if (parameters.surface_load.is_set())
      load = std::make_unique<SurfaceLoad<dim>>(grid, parameters.surface_load);

    // Cost sits where the points are; an empty cell costs a little.
    grid.triangulation().signals.weight.connect([this](const auto &cell, const auto) {
      unsigned int weight = 1;
      if (cell->is_active() && cell->is_locally_owned())
        for (const PointSet<dim> *points : point_sets())
          weight += 20 * points->handler().n_particles_in_cell(cell);
      return weight;
    });
  }


  template <int dim>
  void Simulation<dim>::initialise()
  {
    fill_with_points();
    set_initial_state();
    folder.remove_old_results(); // not before the input has proved good
    share_out_cells();
    measure_speeds();
    if (parameters.settling.maximum_time > 0)
      settle();
    field.clear(); // what the settling left
    if (semi_implicit)
      semi_implicit->read_pressure(phases, water);
  }


  template <int dim>
  void Simulation<dim>::fill_with_points()
  {
    auto body = parameters.bodies.begin();
    for (auto &phase : phases)
      seed(phase, (body++)->seeding, grid.triangulation(), grid.cell_size());
    const auto soil = parameters.soil_regions();
    for (auto &part : water)
      seed_water(part, parameters.water, soil, grid.triangulation(), grid.cell_size());
    if (load)
      load->require_soil(phases, communicator);
  }


  template <int dim>
  void Simulation<dim>::set_initial_state()
  {
    const auto soil = parameters.soil_regions();
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
          overburden = std::make_unique<Overburden<dim>>(
              grid,
              effective_weight_layers<dim>(soil, parameters.has_water ? &parameters.water : nullptr),
              forcing.gravity(),
              grid.cell_size() / 4);
        set_k0_stress(phase, *overburden, state.k0);
      }
    if (parameters.has_water && parameters.water.initial_pressure == "hydrostatic" && forcing.gravity().norm() > 0)
      {
        Overburden<dim> water_above(
            grid, water_layers<dim>(parameters.water, soil), forcing.gravity(), grid.cell_size() / 4);
        for (auto &part : water)
          set_hydrostatic_pressure(part, water_above);
      }
  }


  template <int dim>
  void Simulation<dim>::measure_speeds()
  {
    std::vector<double> largest{ 0., 0. };
    const auto keep_largest = [&](const double *velocity) {
      double square = 0;
      for (unsigned int a = 0; a < dim; ++a)
        square += velocity[a] * velocity[a];
      largest[1] = std::max(largest[1], std::sqrt(square));
    };
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            const double *properties = cell.properties + p * phase.points.stride();
            const double bulk =
                phase.material->initial_bulk_modulus(mean_effective_stress(properties + phase.layout.stress));
            largest[0] = std::max(largest[0], phase.wave_speed(bulk));
            keep_largest(properties + phase.layout.velocity);
          }
    for (const auto &part : water)
      for (const auto &cell : part.points().cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          keep_largest(cell.properties + p * part.points().stride() + part.layout.velocity);
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
    forcing.start_settling(settling.damping_rate, held);

    Clock settling_clock(parameters.time_step);
    constexpr unsigned int steps_between_checks = 50;
    double ratio                                = std::numeric_limits<double>::infinity();
    while (settling_clock.time() < settling.maximum_time && ratio >= settling.kinetic_energy)
      {
        const double step = settling_clock.next_step(stable_step(), settling.maximum_time);
        advance(step);
        settling_clock.advance(step, settling.maximum_time);
        if (settling_clock.step() % steps_between_checks == 0 || settling_clock.time() >= settling.maximum_time)
          ratio = kinetic_to_elastic_energy(phases, water, communicator);
      }
    folder.log(
        "Settled for " + Utilities::to_string(settling_clock.time()) + " s in " +
        std::to_string(settling_clock.step()) + " steps; kinetic over elastic energy " + Utilities::to_string(ratio) +
        (ratio < settling.kinetic_energy ? ". Released."
                                         : ", above the wanted " + Utilities::to_string(settling.kinetic_energy) +
                                               ": not yet at rest. Released all the same."));

    forcing.release();
    const auto stop = [&](PointSet<dim> &points, const unsigned int velocity, const unsigned int affine) {
      for (const auto &cell : points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            double *properties = cell.properties + p * points.stride();
            std::fill_n(properties + velocity, dim, 0.);
            if (parameters.transfer.carries_affine_field())
              std::fill_n(properties + affine, dim * dim, 0.);
          }
    };
    for (auto &phase : phases)
      stop(phase.points, phase.layout.velocity, phase.layout.affine);
    for (auto &part : water)
      stop(part.points(), part.layout.velocity, part.layout.affine);
    // Balances begin at the release; what was lost stays lost.
    const RunTotals<dim> settled = totals;
    totals                       = RunTotals<dim>();
    totals.n_lost                = settled.n_lost;
    totals.lost_mass             = settled.lost_mass;
    totals.lost_water_mass       = settled.lost_water_mass;
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
    save_checkpoint(parameters.output_directory, grid, point_sets(), [&](auto &archive) { serialize_state(archive); });
    totals = own;
  }


  template <int dim>
  void Simulation<dim>::resume()
  {
    load_checkpoint(parameters.output_directory, grid, point_sets(), [&](auto &archive) { serialize_state(archive); });
    if (!folder.is_writer())
      totals = RunTotals<dim>(); // The writer holds the sums.
    field.reinit();
    if (semi_implicit)
      {
        semi_implicit->reinit();
        semi_implicit->read_pressure(phases, water);
      }
    make_appointments();
    folder.log("Resumed at t = " + Utilities::to_string(clock.time()) + " s, step " + std::to_string(clock.step()) +
               ".");
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace scree
