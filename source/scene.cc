// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/joined_surface.h>
#include <scree/initial/geostatic.h>
#include <scree/initial/water_start.h>
#include <scree/points/seeding.h>
#include <scree/points/water_seeding.h>
#include <scree/scene.h>
#include <scree/scheme/coupled_scheme.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/principal.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Where the case puts points at the start.
    template <int dim>
    PlacesOfPoints<dim> places_of_points(const Parameters &parameters)
    {
      struct Part
      {
        Region<dim> region;
        unsigned int points_per_cell;
      };
      const auto parts = std::make_shared<std::vector<Part>>();
      const auto soil  = parameters.soil_regions();
      for (unsigned int i = 0; i < soil.size(); ++i)
        parts->push_back({ soil[i].template places<dim>(), parameters.bodies[i].seeding.points_per_cell });
      if (parameters.has_water && parameters.water.point_sets_kind() == PointSets::double_point)
        for (const WaterPart &part : water_parts(parameters.water, soil))
          parts->push_back(
              { Region<dim>(entry_name("Water", "Region"), part.region), parameters.water.points_per_cell });
      struct Section // of an inflow
      {
        Region<dim> region;
        unsigned int axis;
        double lower; // coordinate of the lower side of a layer, m
      };
      const auto sections = std::make_shared<std::vector<Section>>();
      for (const InflowParameters &inflow : parameters.inflows)
        {
          const unsigned int face = inflow.face_number(dim);
          const double x          = inflow.place(parameters.grid);
          sections->push_back(
              { Region<dim>(entry_name(inflow.subsection, "Region"), inflow.region),
                face / 2,
                face % 2 == 0 ? x : x - parameters.grid.cell_size / parameters.points_per_cell(inflow) });
        }
      unsigned int n_places = 0;
      for (const Part &part : *parts)
        n_places += Utilities::fixed_power<dim>(part.points_per_cell) * Region<dim>::n_places_of_cube;
      const auto loaded = [&parameters](const Point<dim> &cell) {
        return parameters.surface_load.touches_cell(cell.begin_raw(), parameters.grid, dim);
      };
      const auto fed = [sections, &parameters](const Point<dim> &cell) {
        return std::any_of(sections->begin(), sections->end(), [&](const Section &section) {
          const double beyond = section.lower - cell[section.axis], width = parameters.grid.cell_size;
          return beyond > -1e-6 * width && beyond < (1. - 1e-6) * width && section.region.touches_cube(cell, width);
        });
      };
      const auto in_cell = [parts, loaded, fed, &parameters](const Point<dim> &cell) {
        const auto touches_cell = [&](const Part &part) {
          const unsigned int n = part.points_per_cell;
          const double width   = parameters.grid.cell_size / n;
          for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
            {
              Point<dim> corner = cell;
              for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
                corner[a] += width * (rest % n);
              if (part.region.touches_cube(corner, width))
                return true;
            }
          return false;
        };
        return loaded(cell) || fed(cell) || std::any_of(parts->begin(), parts->end(), touches_cell);
      };
      const auto at_place = [parts, loaded, fed](const Point<dim> &cell, const Point<dim> &x) {
        return loaded(cell) || fed(cell) ||
               std::any_of(parts->begin(), parts->end(), [&](const Part &part) { return part.region.contains(x); });
      };
      return { in_cell, at_place, n_places };
    }

    /// Fewest and most of all bodies, along an axis; without bodies as many as there are numbers, and 1.
    std::pair<unsigned int, unsigned int> points_per_cell(const Parameters &parameters)
    {
      std::pair<unsigned int, unsigned int> range(numbers::invalid_unsigned_int, 1);
      for (const BodyParameters &body : parameters.bodies)
        {
          range.first  = std::min(range.first, body.seeding.points_per_cell);
          range.second = std::max(range.second, body.seeding.points_per_cell);
        }
      return range;
    }
  } // namespace


  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters, const MPI_Comm communicator)
      : expected_memory(require_memory<dim>(parameters, communicator))
      , grid(parameters.grid, places_of_points<dim>(parameters), communicator)
      , walls(grid, parameters.boundaries)
      , water_walls(parameters.has_water
                        ? std::make_unique<WaterBoundaryConditions<dim>>(grid, parameters.water_boundaries)
                        : nullptr)
      , constraints(grid, walls, water_walls.get())
      , forcing(grid, parameters.gravity, parameters.body_force, parameters.base_motion)
      , parameters(parameters)
      , groups(parameters.contact_groups())
      , communicator(communicator)
  {
    make_bodies();
    if (groups.n > 1 &&
        std::any_of(bodies.begin(), bodies.end(), [](const SoilBody<dim> &body) { return body.is_rigid; }))
      walls_alone = std::make_unique<Constraints<dim>>(grid, walls, water_walls.get());
    ground = make_bed<dim>(
        parameters.bed, parameters.grid.lower_corner, parameters.grid.upper_corner, parameters.grid.cell_size);
    if (ground)
      bed = std::make_unique<SampledSurface<dim>>(grid, *ground);
    if (!parameters.bed.friction_angles.empty())
      bed_friction = read_friction(parameters.bed, parameters.grid.lower_corner, parameters.grid.upper_corner);
    for (const ObstacleParameters &obstacle : parameters.obstacles)
      if (obstacle.surface.is_set())
        obstacles.emplace_back(obstacle, parameters.grid, grid);
    if (parameters.has_water)
      join_ground();
    for (const InflowParameters &inflow : parameters.inflows)
      {
        const auto body = std::find_if(parameters.bodies.begin(), parameters.bodies.end(), [&](const auto &one) {
          return one.name == inflow.body;
        });
        inflows.emplace_back(inflow,
                             grid,
                             parameters.grid.cell_size / parameters.points_per_cell(inflow),
                             body == parameters.bodies.end() ? 1. : body->initial_porosity(),
                             joined_ground ? joined_ground.get() : ground.get());
      }
    hold_at_inflows();
    if (parameters.surface_load.is_set())
      loads.emplace_back(grid, parameters.surface_load, points_per_cell(parameters).second);
  }


  template <int dim>
  void Scene<dim>::join_ground()
  {
    if (!obstacles.empty())
      {
        std::vector<const LevelSet<dim> *> parts;
        if (ground)
          parts.push_back(ground.get());
        for (const Obstacle<dim> &obstacle : obstacles)
          parts.push_back(&obstacle.shape());
        joined_ground  = std::make_unique<JoinedSurface<dim>>(parts);
        joined_samples = std::make_unique<SampledSurface<dim>>(grid, *joined_ground);
      }
    if (wet_ground() != nullptr)
      open_cells = std::make_unique<OpenCells<dim>>(grid, *wet_ground());
  }


  template <int dim>
  void Scene<dim>::make_bodies()
  {
    // The one place that knows whose points carry the water.
    const bool affine      = parameters.transfer.carries_affine_field();
    const bool water_rides = parameters.has_water && parameters.water.point_sets_kind() == PointSets::single_point;
    for (const BodyParameters &body : parameters.bodies)
      {
        auto material = make_material<dim>(body.material);
        const PropertyLayout<dim> layout(material->internal_quantities().size(),
                                         affine,
                                         water_rides ? WaterLayout<dim>(0, affine).n_properties() : 0,
                                         parameters.probes.displacement,
                                         parameters.has_water ? 0 : parameters.n_rigid_surfaces());
        bodies.emplace_back(body.name,
                            body.bulk_density(),
                            body.seeding.grain_density,
                            std::move(material),
                            layout,
                            grid.triangulation(),
                            grid.mapping());
        bodies.back().is_rigid = body.is_rigid();
        bodies.back().group    = groups.of_body[bodies.size() - 1];
        bodies.back().spacing  = grid.cell_size() / body.seeding.points_per_cell;
        if (parameters.has_water)
          bodies.back().drag.emplace(body.seepage.in_place_of(parameters.water), body.initial_porosity());
        if (water_rides)
          water.emplace_back(parameters.water.density, affine, bodies.back());
      }
    if (parameters.has_water && !water_rides)
      water.emplace_back(parameters.water.density, affine, grid.triangulation(), grid.mapping());
  }


  template <int dim>
  std::unique_ptr<Scheme<dim>> Scene<dim>::make_scheme(TimerOutput &timer)
  {
    if (!parameters.has_water)
      return std::make_unique<DryScheme<dim>>(grid,
                                              forcing,
                                              parameters.transfer,
                                              parameters.stabilisation,
                                              bodies,
                                              loads,
                                              surroundings_of_groups(),
                                              groups.pairs,
                                              timer);
    return std::make_unique<CoupledScheme<dim>>(
        grid,
        constraints,
        *water_walls,
        forcing,
        parameters.transfer,
        parameters.stabilisation,
        parameters.water,
        parameters.pressure,
        bodies,
        points_per_cell(parameters).first,
        water,
        loads,
        open_cells.get(),
        open_cells ? std::make_unique<BedProjection<dim>>(
                         grid, *wet_ground(), rigid_surfaces(), *open_cells, parameters.pressure.relative_tolerance)
                   : nullptr,
        inflows,
        timer);
  }


  template <int dim>
  std::vector<GroupSurroundings<dim>> Scene<dim>::surroundings_of_groups()
  {
    std::vector<GroupSurroundings<dim>> result(groups.n);
    for (unsigned int g = 0; g < groups.n; ++g)
      {
        const bool sticks_to_rigid = std::any_of(
            bodies.begin(), bodies.end(), [g](const SoilBody<dim> &body) { return body.is_rigid && body.group == g; });
        result[g].constraints = walls_alone && !sticks_to_rigid ? walls_alone.get() : &constraints;
        if (parameters.n_rigid_surfaces() > 0)
          result[g].bed = std::make_unique<BedContact<dim>>(
              grid, *result[g].constraints, rigid_surfaces(), forcing.gravity().norm(), bodies, g);
      }
    return result;
  }


  template <int dim>
  void Scene<dim>::hold_rigid_nodes()
  {
    constraints.hold_soil(rigid_nodes());
    if (walls_alone)
      walls_alone->reinit();
  }


  template <int dim>
  void Scene<dim>::close_gate(const std::string &region)
  {
    const auto make_region = [&] { return std::make_unique<Region<dim>>(entry_name("Settling", "Gate"), region); };
    constraints.close_gate(make_region());
    if (walls_alone)
      walls_alone->close_gate(make_region());
  }


  template <int dim>
  void Scene<dim>::open_gate()
  {
    constraints.open_gate();
    if (walls_alone)
      walls_alone->open_gate();
  }


  template <int dim>
  void Scene<dim>::reinit()
  {
    grid.distribute_nodes();
    hold_rigid_nodes();
    if (bed)
      bed->reinit();
    for (Obstacle<dim> &obstacle : obstacles)
      obstacle.reinit();
    if (joined_samples)
      joined_samples->reinit();
    if (open_cells)
      open_cells->reinit();
    for (Inflow<dim> &inflow : inflows)
      inflow.reinit();
    hold_at_inflows();
  }


  template <int dim>
  std::vector<RigidSurface<dim>> Scene<dim>::rigid_surfaces() const
  {
    std::vector<RigidSurface<dim>> surfaces;
    if (bed)
      surfaces.push_back({ bed.get(), parameters.bed.friction_coefficient(), bed_friction ? &*bed_friction : nullptr });
    for (const Obstacle<dim> &obstacle : obstacles)
      surfaces.push_back({ &obstacle.surface, obstacle.friction_coefficient, nullptr, &obstacle });
    return surfaces;
  }


  template <int dim>
  void Scene<dim>::begin_step(const double time, const double time_step)
  {
    forcing.set_step(time, time_step);
    for (Obstacle<dim> &obstacle : obstacles)
      obstacle.begin_step(time, time_step);
    bool has_changed = false;
    for (Inflow<dim> &inflow : inflows)
      {
        has_changed = has_changed || inflow.is_open != inflow.lasts(time);
        on_all_ranks(communicator, [&] { inflow.begin_step(time, time_step); });
      }
    if (has_changed)
      hold_at_inflows();
    unsigned int number = 0;
    for (const Inflow<dim> &inflow : inflows)
      constraints.set_inflow_velocity(number++, inflow.velocity());
  }


  template <int dim>
  void Scene<dim>::end_step(const double time_step, const PressureOfCell<dim> &pressure, RunTotals<dim> &totals)
  {
    for (Obstacle<dim> &obstacle : obstacles)
      obstacle.end_step(time_step);
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.water_share > 0.)
        totals.entered_energy += time_step * inflow.power_of_pressure(pressure);
    for (Inflow<dim> &inflow : inflows)
      if (const unsigned int n_layers = inflow.end_step(); n_layers > 0)
        {
          unsigned int n_points = 0;
          for (unsigned int back = n_layers; back-- > 0;)
            {
              if (inflow.brings_soil)
                n_points += add_soil(inflow, back, totals);
              if (inflow.water_share > 0.)
                n_points += add_water(inflow, back, pressure, totals);
            }
          const unsigned int n_sets = inflow.brings_soil + (inflow.water_share > 0.);
          AssertThrow(Utilities::MPI::sum(n_points, communicator) == n_sets * n_layers * inflow.places().size(),
                      ExcInternalError("Points entered beyond the cells of the section."));
        }
  }


  template <int dim>
  template <typename Fill>
  unsigned int Scene<dim>::add_layer(const Inflow<dim> &inflow,
                                     const unsigned int back,
                                     PointSet<dim> &points,
                                     const unsigned int mass_slot,
                                     const Fill &fill,
                                     RunTotals<dim> &totals) const
  {
    std::vector<double> properties(points.stride());
    const Tensor<1, dim> &velocity = inflow.velocity();
    unsigned int n_points          = 0;
    for (unsigned int i = 0; i < inflow.places().size(); ++i)
      {
        const auto &place  = inflow.places()[i];
        const Point<dim> x = place.location + inflow.advance_of(back) * inflow.inward();
        const auto *cell   = inflow.cell_at(x);
        if (cell == nullptr)
          continue;
        std::fill(properties.begin(), properties.end(), 0.);
        fill(Entrant{ place.volume,
                      x,
                      (*cell)->active_cell_index(),
                      Point<dim>((x - (*cell)->vertex(0)) / grid.cell_size()) },
             properties);
        const double mass = properties[mass_slot];
        totals.entered_momentum += mass * velocity;
        totals.entered_energy += mass * (0.5 * velocity.norm_square() - forcing.gravity() * (x - Point<dim>()));
        points.add(*cell, x, points.next_id + i, properties);
        ++n_points;
      }
    points.next_id += inflow.places().size();
    points.finish_adding();
    return n_points;
  }


  template <int dim>
  unsigned int Scene<dim>::add_soil(const Inflow<dim> &inflow, const unsigned int back, RunTotals<dim> &totals)
  {
    SoilBody<dim> &body =
        *std::find_if(bodies.begin(), bodies.end(), [&](const SoilBody<dim> &one) { return one.name == inflow.body; });
    const auto surfaces = parameters.has_water ? std::vector<RigidSurface<dim>>() : rigid_surfaces();
    const auto &layout  = body.layout;
    return add_layer(
        inflow,
        back,
        body.points,
        layout.mass,
        [&](const Entrant &entrant, std::vector<double> &properties) {
          fill_entrant(entrant, body, properties);
          std::copy_n(inflow.velocity().begin_raw(), dim, properties.begin() + layout.velocity);
          set_touching_distances(body, surfaces, entrant.cell, entrant.place, properties.data());
          ++totals.n_entered;
          totals.entered_mass += properties[layout.mass];
          totals.entered_energy +=
              entrant.volume * body.material->elastic_energy(properties.data() + layout.left_cauchy_green);
        },
        totals);
  }


  template <int dim>
  unsigned int Scene<dim>::add_water(const Inflow<dim> &inflow,
                                     const unsigned int back,
                                     const PressureOfCell<dim> &pressure,
                                     RunTotals<dim> &totals)
  {
    WaterPhase<dim> &phase = water.front();
    return add_layer(
        inflow,
        back,
        phase.points(),
        phase.layout.mass,
        [&](Entrant entrant, std::vector<double> &properties) {
          entrant.volume *= inflow.water_share;
          fill_entrant(entrant, phase, pressure(entrant.cell), properties);
          std::copy_n(inflow.velocity().begin_raw(), dim, properties.begin() + phase.layout.velocity);
          totals.entered_water_mass += properties[phase.layout.mass];
        },
        totals);
  }


  template <int dim>
  void
  Scene<dim>::fill_entrant(const Entrant &entrant, const SoilBody<dim> &body, std::vector<double> &properties) const
  {
    const auto &layout = body.layout;
    const auto entry = std::find_if(parameters.bodies.begin(), parameters.bodies.end(), [&](const BodyParameters &one) {
      return one.name == body.name;
    });
    const InitialStateParameters &state = entry->initial_state;
    properties[layout.mass]             = body.density * entrant.volume;
    properties[layout.volume]           = entrant.volume;
    if (layout.has_start)
      std::copy_n(entrant.location.begin_raw(), dim, properties.begin() + layout.start);
    double stress[n_symmetric_components<dim>] = {};
    if (state.stress_kind() == InitialStress::isotropic)
      std::fill_n(stress, 3, -state.pressure);
    body.material->initialise(stress,
                              properties.data() + layout.left_cauchy_green,
                              properties.data() + layout.stress,
                              properties.data() + layout.internal_variables);
  }


  template <int dim>
  void Scene<dim>::fill_entrant(const Entrant &entrant,
                                const WaterPhase<dim> &phase,
                                const std::array<double, (1 << dim)> &pressure,
                                std::vector<double> &properties) const
  {
    const auto &layout        = phase.layout;
    properties[layout.mass]   = phase.density * entrant.volume;
    properties[layout.volume] = entrant.volume;
    for (unsigned int v = 0; v < pressure.size(); ++v)
      {
        properties[layout.pressure] += pressure[v] * GeometryInfo<dim>::d_linear_shape_function(entrant.place, v);
        const Tensor<1, dim> slope = GeometryInfo<dim>::d_linear_shape_function_gradient(entrant.place, v);
        for (unsigned int a = 0; a < dim; ++a)
          properties[layout.pressure_gradient + a] += pressure[v] * slope[a] / grid.cell_size();
      }
  }


  template <int dim>
  void Scene<dim>::hold_at_inflows()
  {
    if (inflows.empty())
      return;
    std::vector<unsigned int> inflow_of_node(grid.numbering().n_local(), Constraints<dim>::free);
    std::vector<typename Constraints<dim>::MovedByInflow> moved;
    for (const Inflow<dim> &inflow : inflows)
      {
        for (unsigned int node = 0; node < inflow_of_node.size(); ++node)
          if (inflow.is_open && inflow.moves(node))
            inflow_of_node[node] = moved.size();
        moved.push_back({ Tensor<1, dim>(), inflow.brings_soil });
      }
    constraints.set_inflows(inflow_of_node, moved);
  }


  template <int dim>
  void Scene<dim>::include_inflows(Speeds &speeds) const
  {
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.is_open)
        {
          speeds.include_point(inflow.velocity().norm());
          for (const SoilBody<dim> &body : bodies)
            if (body.name == inflow.body)
              speeds.include_wave(body.wave_speed(body.material->initial_bulk_modulus(0.), 0.));
        }
  }


  template <int dim>
  std::vector<std::string> Scene<dim>::texts_of_inflows() const
  {
    std::vector<std::string> texts;
    for (const Inflow<dim> &inflow : inflows)
      texts.push_back("Inflow " + inflow.name + ": " + number_text(inflow.area()) + (dim == 2 ? " m" : " m^2") +
                      " are open; " + std::to_string(inflow.places().size()) + " points a layer of " + inflow.body);
    return texts;
  }


  template <int dim>
  Blocks Scene<dim>::blocks_of_points(const double time) const
  {
    Blocks blocks;
    const auto append = [&](const PointSet<dim> &points, const unsigned int velocity) {
      for_each_point(points, [&](const auto &point) {
        const double *v = point.properties + velocity;
        grid.append_blocks(point.location, time * Tensor<1, dim>(make_array_view(v, v + dim)), blocks);
      });
    };
    for (const auto &body : bodies)
      append(body.points, body.layout.velocity);
    for (const auto &part : water)
      append(part.points(), part.layout.velocity);
    for (const auto &inflow : inflows)
      if (inflow.is_open)
        blocks.insert(blocks.end(), inflow.blocks().begin(), inflow.blocks().end());
    for (const auto &load : loads)
      for_each_point(load.points(),
                     [&](const auto &point) { grid.append_blocks(point.location, Tensor<1, dim>(), blocks); });
    make_unique(blocks);
    return blocks;
  }


  template <int dim>
  std::vector<char> Scene<dim>::rigid_nodes() const
  {
    if (std::none_of(bodies.begin(), bodies.end(), [](const auto &body) { return body.is_rigid; }))
      return {};
    NodalField<dim> field(grid); // sums over ranks: the points around a node may be another's
    for (const auto &body : bodies)
      if (body.is_rigid)
        for (const auto &cell : body.points.cells())
          {
            field.activate_cell(cell.cell);
            for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
              field[grid.nodes(cell.cell)[i]][NodalField<dim>::mass] = 1.;
          }
    field.add_contributions();
    field.update_ghosts();
    std::vector<char> is_rigid(grid.numbering().n_local());
    for (unsigned int node = 0; node < is_rigid.size(); ++node)
      is_rigid[node] = field[node][NodalField<dim>::mass] > 0.;
    return is_rigid;
  }


  template <int dim>
  void Scene<dim>::fill()
  {
    fill_with_points();
    hold_rigid_nodes();
    hold_at_inflows();
    set_initial_state();
  }


  template <int dim>
  void Scene<dim>::fill_with_points()
  {
    const auto soil = parameters.soil_regions();
    if (soil.size() > 1)
      require_apart(soil, points_per_cell(parameters).second, grid.triangulation(), grid.cell_size());
    auto entries = parameters.bodies.begin();
    for (auto &body : bodies)
      seed(body, (entries++)->seeding, grid.triangulation(), grid.cell_size(), ground.get());
    for (auto &part : water)
      seed_water(part,
                 parameters.water,
                 soil,
                 grid.triangulation(),
                 grid.cell_size(),
                 joined_ground ? joined_ground.get() : ground.get());
    for (const auto &load : loads)
      load.require_soil(bodies, communicator);
    // Points that keep their velocity would give a gradient of the first step to the nodes on top of it.
    if (parameters.transfer.transfer_method() == TransferMethod::aflip)
      set_velocity_gradients();
    require_points_outside_obstacles();
    if (!parameters.has_water)
      set_touching_distances();
  }


  template <int dim>
  void Scene<dim>::require_points_outside_obstacles() const
  {
    auto entries = parameters.bodies.begin();
    for (const auto &body : bodies)
      {
        const auto [entry, region] = (entries++)->seeding.place();
        for (const Obstacle<dim> &obstacle : obstacles)
          {
            std::string fault;
            for_each_point(body.points, [&](const auto &point) {
              if (fault.empty() && obstacle.contains(point.location))
                fault = entry_message(
                    body.name,
                    entry,
                    region,
                    "it reaches into " + quoted(ObstacleParameters::prefix + obstacle.name) + ", for instance at " +
                        number_text(std::vector<double>(point.location.begin_raw(), point.location.end_raw())) +
                        " m. Let it end where the obstacle begins.");
            });
            throw_on_all_ranks(fault, communicator);
          }
      }
    for (const Inflow<dim> &inflow : inflows)
      for (const Obstacle<dim> &obstacle : obstacles)
        for (const auto &place : inflow.places())
          require_entry(!obstacle.contains(place.location),
                        InflowParameters::prefix + inflow.name,
                        "Region",
                        inflow.region,
                        "points would enter in " + quoted(ObstacleParameters::prefix + obstacle.name) +
                            ", for instance at " +
                            number_text(std::vector<double>(place.location.begin_raw(), place.location.end_raw())) +
                            " m. Let it end where the obstacle begins.");
  }


  template <int dim>
  void Scene<dim>::set_touching_distances()
  {
    const auto surfaces = rigid_surfaces();
    for (auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        set_touching_distances(body, surfaces, point.cell, point.reference_location, point.properties);
      });
  }


  template <int dim>
  void Scene<dim>::set_touching_distances(const SoilBody<dim> &body,
                                          const std::vector<RigidSurface<dim>> &surfaces,
                                          const unsigned int cell,
                                          const Point<dim> &place,
                                          double *properties) const
  {
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        double &distance = properties[body.layout.touching_distance(s)];
        distance         = 0.5 * body.spacing;
        if (!surfaces[s].samples->is_near(cell))
          continue;
        const SurfaceView<dim> view = surfaces[s].samples->view(cell, place);
        double largest              = 0.; // component of the normal
        for (unsigned int a = 0; a < dim; ++a)
          largest = std::max(largest, std::abs(view.normal[a]));
        if (view.distance < body.spacing * largest * (1. + 1e-9)) // the lattice's lowest point over the surface
          distance = std::max(0., view.distance);
      }
  }


  template <int dim>
  void Scene<dim>::set_velocity_gradients()
  {
    const auto set = [&](PointSet<dim> &points, const std::string &velocity, const unsigned int slot) {
      if (!velocity.empty())
        set_velocity_gradient(points, velocity, slot, grid.cell_size());
    };
    auto part    = water.begin();
    auto entries = parameters.bodies.begin();
    for (auto &body : bodies)
      {
        const std::string &velocity = (entries++)->seeding.initial_velocity;
        set(body.points, velocity, body.layout.affine);
        if (part != water.end() && part->carrier() != nullptr)
          set(body.points, velocity, (part++)->layout.affine);
      }
    if (part != water.end())
      set(part->points(), parameters.water.initial_velocity, part->layout.affine);
  }


  template <int dim>
  void Scene<dim>::set_initial_state()
  {
    const auto soil = parameters.soil_regions();
    std::unique_ptr<Overburden<dim>> overburden; // made when the first body asks for it
    auto entries = parameters.bodies.begin();
    for (auto &body : bodies)
      {
        const InitialStateParameters &state = (entries++)->initial_state;
        if (state.stress_kind() != InitialStress::k0)
          {
            set_isotropic_stress(
                body, state.stress_kind() == InitialStress::isotropic ? state.pressure : 0., communicator);
            continue;
          }
        if (!overburden)
          overburden = std::make_unique<Overburden<dim>>(
              grid,
              effective_weight_layers<dim>(soil, parameters.has_water ? &parameters.water : nullptr),
              forcing.gravity(),
              grid.cell_size() / 4);
        set_k0_stress(body, *overburden, state.k0);
      }
    if (!water.empty() && parameters.water.initial_pressure_kind() == InitialPressure::hydrostatic &&
        forcing.gravity().norm() > 0)
      {
        Overburden<dim> water_above(
            grid, water_layers<dim>(parameters.water, soil), forcing.gravity(), grid.cell_size() / 4);
        for (auto &part : water)
          set_hydrostatic_pressure(part, water_above);
      }
  }


  template <int dim>
  Speeds Scene<dim>::speeds() const
  {
    Speeds largest;
    const auto include_point = [&](const double *velocity) {
      largest.include_point(Tensor<1, dim>(make_array_view(velocity, velocity + dim)).norm());
    };
    for (const auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        const double *stress            = point.properties + body.layout.stress;
        const PrincipalValues principal = PrincipalFrame<dim>(stress).values();
        const double compression        = std::max(0., -*std::min_element(principal.begin(), principal.end()));
        largest.include_wave(
            body.wave_speed(body.material->initial_bulk_modulus(mean_effective_stress(stress)), compression));
        include_point(point.properties + body.layout.velocity);
      });
    for (const auto &part : water)
      for_each_point(part.points(), [&](const auto &point) { include_point(point.properties + part.layout.velocity); });
    return largest;
  }


  template <int dim>
  void Scene<dim>::require_viscosity(const double stable_step) const
  {
    constexpr double most = 1e10; // beyond, rounding of the velocities outweighs all other forces
    const double stress =
        parameters.water.viscosity / parameters.water.density * stable_step / (grid.cell_size() * grid.cell_size());
    require_entry(stress <= most,
                  "Water",
                  "Viscosity",
                  parameters.water.viscosity,
                  "in a step of " + number_text(stable_step) + " s it would spread momentum over " +
                      number_text(std::sqrt(stress)) + " cells, and at most 1e5 are possible. Write a smaller one.");
  }


  template <int dim>
  void Scene<dim>::require_steps(const double stable_step, const Speeds &speeds) const
  {
    if (parameters.has_water)
      require_viscosity(stable_step);
    constexpr double most_steps = 1e10; // months, even of the smallest mesh
    const double time           = std::max(parameters.end_time, parameters.settling.maximum_time);
    if (time / stable_step <= most_steps)
      return;
    const std::string remedy = "the step is " + number_text(stable_step) + " s, so that a run of " + number_text(time) +
                               " s would take " + number_text(time / stable_step) +
                               " steps, and at most 1e10 are possible.";
    const TimeStepParameters &step = parameters.time_step;
    require_entry(stable_step < step.maximum_time_step,
                  "Time step",
                  "Maximum time step",
                  step.maximum_time_step,
                  remedy + " Write a larger one.");
    const bool by_waves = speeds.wave >= speeds.points;
    const std::string c = number_text(by_waves ? speeds.wave : speeds.points) + " m/s: ";
    const auto stiffest = [](const auto &a, const auto &b) {
      constexpr double pressure = 1e5; // Pa, of a few metres of soil
      return a.wave_speed(a.material->initial_bulk_modulus(pressure), pressure) <
             b.wave_speed(b.material->initial_bulk_modulus(pressure), pressure);
    };
    if (by_waves)
      {
        const auto body   = std::max_element(bodies.begin(), bodies.end(), stiffest);
        const auto &entry = parameters.bodies[std::distance(bodies.begin(), body)];
        entry.material.throw_too_stiff(
            entry.name, "waves in the soil run at " + c + remedy + " Write a softer soil, or look at its density.");
      }
    for (const BodyParameters &body : parameters.bodies)
      require_entry(body.seeding.initial_velocity.empty(),
                    body.name,
                    "Initial velocity",
                    body.seeding.initial_velocity,
                    "points move at " + c + remedy + " Write slower ones.");
    require_entry(
        false, "Water", "Initial velocity", parameters.water.initial_velocity, "points move at " + c + remedy);
  }


  template <int dim>
  void Scene<dim>::stop()
  {
    const auto stop = [&](PointSet<dim> &points, const unsigned int velocity, const unsigned int affine) {
      for_each_point(points, [&](const auto &point) {
        std::fill_n(point.properties + velocity, dim, 0.);
        if (parameters.transfer.carries_affine_field())
          std::fill_n(point.properties + affine, dim * dim, 0.);
      });
    };
    for (auto &body : bodies)
      stop(body.points, body.layout.velocity, body.layout.affine);
    for (auto &part : water)
      stop(part.points(), part.layout.velocity, part.layout.affine);
  }


  template <int dim>
  void Scene<dim>::mark_start()
  {
    for (auto &body : bodies)
      if (body.layout.has_start)
        for_each_point(body.points, [&](const auto &point) {
          std::copy_n(point.location.begin_raw(), dim, point.properties + body.layout.start);
        });
  }


  template <int dim>
  void Scene<dim>::lose(const std::string &name,
                        const LostPoint<dim> &point,
                        const std::pair<std::string, bool> &face_and_whether_open,
                        const unsigned int velocity_slot,
                        const unsigned int mass_slot,
                        const double time,
                        double &lost_mass,
                        RunTotals<dim> &totals) const
  {
    const auto &[face, is_open] = face_and_whether_open;
    AssertThrow(is_open,
                ExcMessage("A point of " + name + " left the box through the closed wall '" + face + "' at (" +
                           number_text(std::vector<double>(point.location.begin_raw(), point.location.end_raw())) +
                           ") m, t = " + Utilities::to_string(time) +
                           " s. Remedies: a smaller 'Courant number', or 'open' (water: 'drained') in subsection "
                           "Boundaries."));
    const double *velocity_of_point = point.properties.data() + velocity_slot;
    const double mass               = point.properties[mass_slot];
    const Tensor<1, dim> velocity(make_array_view(velocity_of_point, velocity_of_point + dim));
    lost_mass += mass;
    totals.lost_momentum += mass * velocity;
    totals.lost_energy += mass * (0.5 * velocity.norm_square() - forcing.gravity() * (point.location - Point<dim>()));
  }


  template <int dim>
  void Scene<dim>::account_for_lost_points(RunTotals<dim> &totals, const double time)
  {
    for (auto &part : water)
      for (const LostPoint<dim> &point : part.points().lost())
        lose("the water",
             point,
             part.own_points() != nullptr ? water_walls->face_crossed(point.location)
                                          : walls.face_crossed(point.location),
             part.layout.velocity,
             part.layout.mass,
             time,
             totals.lost_water_mass,
             totals);
    for (auto &body : bodies)
      {
        for (const LostPoint<dim> &point : body.points.lost())
          lose(body.name,
               point,
               walls.face_crossed(point.location),
               body.layout.velocity,
               body.layout.mass,
               time,
               totals.lost_mass,
               totals);
        totals.n_lost += body.points.lost().size();
        body.points.lost().clear();
      }
    for (auto &part : water)
      part.points().lost().clear();
    for (auto &load : loads)
      load.points().lost().clear();
  }

  template class Scene<2>;
  template class Scene<3>;
} // namespace scree
