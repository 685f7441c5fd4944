// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/model/scene.h>
#include <scree/schemes/two_phase_scheme.h>
#include <scree/seeding/seeding.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/geometry_info.h>

#include <numeric>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Where the case puts points at the start. Refers to the parameters.
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
        for (auto &part : water_parts<dim>(parameters.water, soil))
          parts->push_back({ std::move(part.region), parameters.water.points_per_cell });
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
        return parameters.surface_load.touches_cell(&cell[0], parameters.grid, dim);
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

  } // namespace


  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters, const MPI_Comm communicator)
      : parameters(parameters)
      , expected_memory(require_memory<dim>(parameters, communicator))
      , grid(parameters.grid, places_of_points<dim>(parameters), communicator)
      , walls(grid, parameters.boundaries)
      , water_walls(parameters.has_water ? std::make_unique<BoundaryConditions<dim>>(grid,
                                                                                     parameters.water_boundaries,
                                                                                     parameters.water.density *
                                                                                         parameters.size_of_gravity())
                                         : nullptr)
      , forcing(grid, parameters.gravity, parameters.body_forces, parameters.time_step.mass_scaling)
      , water_at_start(parameters.water)
      , groups(parameters.contact_groups())
      , communicator(communicator)
  {
    make_bodies();
    constraints.emplace_back(grid, walls, water_walls.get());
    if (groups.n > 1 &&
        std::any_of(bodies.begin(), bodies.end(), [](const SoilBody<dim> &body) { return body.is_rigid; }))
      constraints.emplace_back(grid, walls, water_walls.get());
    ground = make_bed<dim>(
        parameters.bed, parameters.grid.lower_corner, parameters.grid.upper_corner, parameters.grid.cell_size);
    if (ground)
      bed = std::make_unique<DiscreteLevelSet<dim>>(grid, *ground);
    for (const ObstacleParameters &obstacle : parameters.obstacles)
      if (obstacle.surface.is_set())
        obstacles.emplace_back(obstacle, parameters.grid, grid);
    join_ground();
    for (const InflowParameters &inflow : parameters.inflows)
      {
        const BodyParameters *body = parameters.find_body(inflow.body);
        inflows.emplace_back(inflow,
                             grid,
                             parameters.grid.cell_size / parameters.points_per_cell(inflow),
                             body == nullptr ? 1. : body->initial_porosity(),
                             parameters.has_water ? ground_of_water() : ground.get());
      }
    hold_at_inflows();
    if (parameters.rain.is_set())
      {
        RainedSoil soil{ parameters.grid.cell_size / points_per_cell().first, 1. };
        for (const SoilBody<dim> &body : bodies) // the least porosity of those that take water
          if (const double porosity = parameters.find_body(body.name)->initial_porosity(); !body.is_rigid && body.drag)
            soil.porosity = std::min(soil.porosity, std::max(porosity, 0.1));
        rain.emplace(parameters.rain, grid, parameters.grid.cell_size / parameters.water.points_per_cell, soil);
      }
    if (parameters.surface_load.is_set())
      loads.emplace_back(grid, parameters.surface_load, points_per_cell().second);
  }


  template <int dim>
  void Scene<dim>::join_ground()
  {
    std::vector<const LevelSet<dim> *> all;
    if (ground)
      all.push_back(ground.get());
    for (const Obstacle<dim> &obstacle : obstacles)
      all.push_back(&obstacle.shape());
    if (all.empty())
      return;
    std::vector<GroundPart<dim>> parts; // Each by itself: where two meet, each has its own normal and friction.
    for (const RigidSurface<dim> &surface : rigid_surfaces())
      parts.push_back({ surface.samples,
                        surface.obstacle && surface.obstacle->is_moving ? &surface.obstacle->velocity() : nullptr });
    if (!obstacles.empty())
      union_level_set = std::make_unique<JoinedSurface<dim>>(all);
    rigid_ground = std::make_unique<RigidBoundary<dim>>(parts);
    if (!parameters.has_water)
      {
        cut_cells = std::make_unique<CutCells<dim>>(grid, *rigid_ground, 0., CutCells<dim>::Content::segments);
        return;
      }
    // Between a half and the whole of the points' spacing; doc/developer/development_log.md, "Moving obstacles in
    // water", has what others do.
    constexpr double thinnest = 0.75;
    const unsigned int points = parameters.water.point_sets_kind() == PointSets::double_point
                                    ? parameters.water.points_per_cell
                                    : points_per_cell().first;
    cut_cells                 = std::make_unique<CutCells<dim>>(grid, *rigid_ground, thinnest / points);
  }


  template <int dim>
  void Scene<dim>::make_bodies()
  {
    // The one place that depends on whose points carry the water.
    const bool affine      = parameters.transfer.carries_affine_field();
    const bool with_energy = parameters.transfer.has_affine_energy();
    const bool water_rides = parameters.has_water && parameters.water.point_sets_kind() == PointSets::single_point;
    for (const BodyParameters &body : parameters.bodies)
      {
        auto material = make_material<dim>(body.material);
        const PropertyLayout<dim> layout(material->internal_quantities.size(),
                                         affine,
                                         water_rides ? WaterLayout<dim>(0, affine).n_properties() : 0,
                                         parameters.damps_skeleton());
        bodies.emplace_back(body.name,
                            body.bulk_density(),
                            body.seeding.grain_density,
                            std::move(material),
                            layout,
                            grid.triangulation(),
                            grid.mapping());
        bodies.back().is_rigid          = body.is_rigid();
        bodies.back().group             = groups.of_body[bodies.size() - 1];
        bodies.back().spacing           = grid.cell_size() / body.seeding.points_per_cell;
        bodies.back().has_affine_energy = with_energy;
        if (parameters.has_water)
          bodies.back().drag.emplace(body.drag_law(parameters.water));
        if (water_rides)
          water.emplace_back(parameters.water.density, affine, bodies.back());
      }
    if (parameters.has_water && !water_rides)
      water.emplace_back(parameters.water.density, affine, grid.triangulation(), grid.mapping());
    for (auto &part : water)
      part.has_affine_energy = with_energy;
  }


  template <int dim>
  std::unique_ptr<Scheme<dim>> Scene<dim>::make_scheme(TimerOutput &timer)
  {
    std::vector<Constraints<dim> *> constraints_of_groups; // of bodies that stick to each other
    for (unsigned int g = 0; g < groups.n; ++g)
      {
        const bool sticks_to_rigid = std::any_of(
            bodies.begin(), bodies.end(), [g](const SoilBody<dim> &body) { return body.is_rigid && body.group == g; });
        constraints_of_groups.push_back(sticks_to_rigid ? &constraints.front() : &constraints.back());
      }
    const Model<dim> model{ grid,
                            forcing,
                            parameters.transfer,
                            parameters.stabilisation,
                            bodies,
                            loads,
                            rigid_surfaces(),
                            constraints_of_groups,
                            groups.pairs,
                            water,
                            parameters.water,
                            parameters.pressure,
                            water_walls.get(),
                            inflows,
                            rigid_ground.get(),
                            cut_cells.get(),
                            points_per_cell().first };
    if (parameters.has_water)
      return std::make_unique<TwoPhaseScheme<dim>>(model, timer);
    return std::make_unique<ExplicitScheme<dim>>(model, timer);
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
    if (cut_cells)
      cut_cells->reinit();
    hold_at_inflows();
  }


  template <int dim>
  std::vector<RigidSurface<dim>> Scene<dim>::rigid_surfaces() const
  {
    std::vector<RigidSurface<dim>> surfaces;
    if (bed)
      {
        surfaces.push_back({ bed.get(), parameters.bed.friction_coefficient(), parameters.bed.no_slip() });
        surfaces.back().turbulent_friction = parameters.bed.turbulent_friction;
      }
    for (const Obstacle<dim> &obstacle : obstacles)
      surfaces.push_back({ &obstacle.surface, obstacle.friction_coefficient, obstacle.no_slip, &obstacle });
    return surfaces;
  }


  template <int dim>
  void Scene<dim>::begin_step(const double time, const double time_step)
  {
    forcing.set_step(time, time_step);
    if (water_walls)
      water_walls->set_time(time + time_step);
    for (Obstacle<dim> &obstacle : obstacles)
      obstacle.begin_step(time, time_step);
    bool has_changed = false;
    if (!inflows.empty())
      on_all_ranks(communicator, [&] {
        for (Inflow<dim> &inflow : inflows)
          {
            has_changed = has_changed || inflow.is_open != inflow.lasts(time);
            inflow.begin_step(time, time_step);
          }
      });
    if (has_changed)
      hold_at_inflows();
    unsigned int number = 0;
    for (const Inflow<dim> &inflow : inflows)
      constraints.front().set_inflow_velocity(number++, inflow.velocity());

    // Walls do not act where obstacles that move cover them.
    if (std::none_of(obstacles.begin(), obstacles.end(), [](const auto &obstacle) { return obstacle.is_moving; }))
      return;
    std::vector<std::pair<unsigned int, std::uint8_t>> covered;
    for (const Obstacle<dim> &obstacle : obstacles)
      if (obstacle.is_moving)
        obstacle.add_covered_nodes(covered);
    for (Constraints<dim> &of_nodes : constraints)
      of_nodes.cover(covered);
  }


  namespace
  {
    /// Adds the block of a place `x` and those on a way of the length of `path`, m, from there in the box: straight on,
    /// but along the ground where that is near.
    /// @param ground may be null
    template <int dim>
    void append_way(const Point<dim> &x,
                    Tensor<1, dim> path,
                    const LevelSet<dim> *ground,
                    const BackgroundGrid<dim> &grid,
                    Blocks &blocks)
    {
      blocks.push_back(grid.block_at(x));
      const double block = 2. * grid.cell_size(), length = path.norm();
      if (!(length > block) || !std::isfinite(length))
        return;
      const double reach = 1.5 * block, height = ground == nullptr ? 0. : ground->view(x, reach).distance;
      const double end = std::min(length, (grid.upper_corner() - grid.lower_corner()).norm());
      Point<dim> place = x;
      path *= block / length;
      for (double way = 0.; way < end; way += block)
        {
          Point<dim> next = place + path;
          if (ground != nullptr)
            {
              const SurfaceView<dim> view = ground->view(next, reach);
              next -= (view.distance - height) * view.normal;
            }
          for (unsigned int a = 0; a < dim; ++a)
            if (!(next[a] > grid.lower_corner()[a] && next[a] < grid.upper_corner()[a]))
              return;
          blocks.push_back(grid.block_at(next));
          path = next - place;
          path *= block / std::max(path.norm(), 1e-3 * block);
          place = next;
        }
    }
  } // namespace


  template <int dim>
  Blocks Scene<dim>::blocks_of_points(const double time) const
  {
    Blocks blocks;
    const LevelSet<dim> *along = ground.get();
    const auto append          = [&](const PointSet<dim> &points, const unsigned int velocity) {
      CellPlace<dim> last;
      last.fill(-1);
      for_each_point(points, [&](const auto &point) {
        const CellPlace<dim> cell = grid.fine_cells().box().place_near(point.location);
        if (cell != last) // One point of a cell stands for the others.
          append_way(point.location, time * vector_of<dim>(point.properties + velocity), along, grid, blocks);
        last = cell;
      });
    };
    on_all_ranks(communicator, [&] { // An expression of the ground may be no number somewhere.
      for (const auto &body : bodies)
        append(body.points, body.layout.velocity);
      for (const auto &part : water)
        append(part.points(), part.layout.velocity);
    });
    for (const auto &inflow : inflows)
      if (inflow.is_open)
        blocks.insert(blocks.end(), inflow.blocks().begin(), inflow.blocks().end());
    for (const auto &load : loads)
      for_each_point(load.points(), [&](const auto &point) { blocks.push_back(grid.block_at(point.location)); });
    make_unique(blocks);
    return blocks;
  }


  template <int dim>
  void Scene<dim>::hold_rigid_nodes()
  {
    std::vector<char> is_rigid; // by node; empty: none
    if (std::any_of(bodies.begin(), bodies.end(), [](const auto &body) { return body.is_rigid; }))
      {
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
        is_rigid.resize(grid.numbering().n_local());
        for (unsigned int node = 0; node < is_rigid.size(); ++node)
          is_rigid[node] = field[node][NodalField<dim>::mass] > 0.;
      }
    constraints.front().hold_soil(is_rigid);
    if (constraints.size() > 1)
      constraints.back().reinit();
  }


  // What enters a scene.

  namespace
  {
    /// The body of this name, which is there.
    template <int dim>
    SoilBody<dim> &body_named(const std::string &name, std::list<SoilBody<dim>> &bodies)
    {
      return *std::find_if(bodies.begin(), bodies.end(), [&](const SoilBody<dim> &one) { return one.name == name; });
    }
  } // namespace


  template <int dim>
  void Scene<dim>::let_in(const double time,
                          const double time_step,
                          const PressureOfCell<dim> &pressure,
                          RunBalance<dim> &totals)
  {
    const Tensor<1, dim> before = totals.entered_momentum;
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.water_share > 0.)
        totals.entered_energy += time_step * inflow.power_of_pressure(pressure);
    for (Inflow<dim> &inflow : inflows)
      if (const unsigned int n_layers = inflow.end_step(); n_layers > 0)
        {
          unsigned int n_points = 0;
          const auto count      = [&](const std::vector<int> &is_here) {
            n_points += std::accumulate(is_here.begin(), is_here.end(), 0);
          };
          for (unsigned int back = n_layers; back-- > 0;)
            {
              std::vector<Point<dim>> locations;
              for (const auto &place : inflow.places())
                locations.push_back(place.location + inflow.advance_of(back) * inflow.inward());
              if (inflow.brings_soil)
                count(add_soil(inflow, locations, totals));
              if (inflow.water_share > 0.)
                count(add_points(
                    water.front().points(),
                    water.front().layout,
                    locations,
                    inflow.velocity(),
                    [&](const Entrant &entrant, std::vector<double> &properties) {
                      const double volume = inflow.places()[entrant.number].volume * inflow.water_share;
                      fill_with_water(entrant, volume, pressure(entrant.cell), properties, totals);
                    },
                    totals));
            }
          const unsigned int n_sets = inflow.brings_soil + (inflow.water_share > 0.);
          AssertThrow(Utilities::MPI::sum(n_points, communicator) == n_sets * n_layers * inflow.places().size(),
                      ExcInternalError("Points entered beyond the cells of the section."));
        }
    if (rain)
      let_rain(time, time_step, pressure, totals);
    // As at the start of a run: the velocity is that of half a step before the place.
    totals.entered_energy += 0.5 * time_step * (forcing.gravity() * (totals.entered_momentum - before));
  }


  template <int dim>
  typename Rain<dim>::Columns Scene<dim>::columns_of_rain()
  {
    typename Rain<dim>::Columns columns = rain->no_columns();
    const PointSet<dim> &of_water       = water.front().points();
    for (const SoilBody<dim> &body : bodies)
      for_each_point(body.points, [&](const auto &point) { rain->find_top(point.location, columns.soil); });
    for_each_point(of_water, [&](const auto &point) { rain->find_top(point.location, columns.water); });
    Utilities::MPI::max(columns.soil, communicator, columns.soil);
    Utilities::MPI::max(columns.water, communicator, columns.water);

    for (const SoilBody<dim> &body : bodies)
      if (!body.is_rigid)
        for_each_point(body.points, [&](const auto &point) { rain->fill_with_soil(point.location, columns); });
    const unsigned int volume = water.front().layout.volume;
    for_each_point(
        of_water, [&](const auto &point) { rain->fill_with_water(point.location, point.properties[volume], columns); });
    Utilities::MPI::max(columns.has_soil, communicator, columns.has_soil);
    Utilities::MPI::sum(columns.filled, communicator, columns.filled);
    return columns;
  }


  template <int dim>
  void Scene<dim>::let_rain(const double time,
                            const double time_step,
                            const PressureOfCell<dim> &pressure,
                            RunBalance<dim> &totals)
  {
    if (!rain->count(time, time_step))
      return;
    const auto drops = rain->drops(columns_of_rain());
    std::vector<Point<dim>> locations;
    for (const auto &drop : drops)
      locations.push_back(drop.location);
    std::vector<int> has_cell = add_points(
        water.front().points(),
        water.front().layout,
        locations,
        Tensor<1, dim>(),
        [&](const Entrant &entrant, std::vector<double> &properties) {
          fill_with_water(entrant, rain->volume(), pressure(entrant.cell), properties, totals);
        },
        totals);
    Utilities::MPI::max(has_cell, communicator, has_cell);
    for (unsigned int i = 0; i < drops.size(); ++i)
      if (!has_cell[i])
        rain->postpone(drops[i]);
  }


  template <int dim>
  template <typename Layout, typename Fill>
  std::vector<int> Scene<dim>::add_points(PointSet<dim> &points,
                                          const Layout &layout,
                                          const std::vector<Point<dim>> &locations,
                                          const Tensor<1, dim> &velocity,
                                          const Fill &fill,
                                          RunBalance<dim> &totals) const
  {
    std::vector<double> properties(points.stride());
    std::vector<int> is_here(locations.size(), 0);
    for (unsigned int i = 0; i < locations.size(); ++i)
      if (const auto *cell = grid.fine_cells().own_cell_at(locations[i]))
        {
          const Point<dim> &x = locations[i];
          std::fill(properties.begin(), properties.end(), 0.);
          fill(Entrant{ i, x, cell->index, grid.fine_cells().place_in(*cell, x) }, properties);
          std::copy_n(&velocity[0], dim, properties.begin() + layout.velocity);
          const double mass = properties[layout.mass];
          totals.entered_momentum += mass * velocity;
          totals.entered_energy += mass * (0.5 * velocity.norm_square() - forcing.gravity() * (x - Point<dim>()));
          points.add(cell->in_mesh, x, points.next_id + i, properties);
          is_here[i] = 1;
        }
    points.next_id += locations.size();
    points.finish_adding();
    return is_here;
  }


  template <int dim>
  std::vector<int>
  Scene<dim>::add_soil(const Inflow<dim> &inflow, const std::vector<Point<dim>> &locations, RunBalance<dim> &totals)
  {
    SoilBody<dim> &body           = body_named(inflow.body, bodies);
    const auto &layout            = body.layout;
    const BodyParameters &entries = *parameters.find_body(body.name);
    const PlaceVariables<dim> &of_place =
        places_of_inflows
            .try_emplace(
                body.name, body.material->place_variables, entries.material.path(body.name), parameters.bed.map_origin)
            .first->second;
    double stress[n_symmetric_components<dim>] = {};
    if (entries.initial_state.is_isotropic())
      std::fill_n(stress, 3, -entries.initial_state.pressure);
    return add_points(
        body.points,
        layout,
        locations,
        inflow.velocity(),
        [&](const Entrant &entrant, std::vector<double> &properties) {
          const double volume       = inflow.places()[entrant.number].volume;
          properties[layout.mass]   = body.density * volume;
          properties[layout.volume] = volume;
          std::copy_n(&entrant.location[0], dim, properties.begin() + layout.start);
          double *variables = properties.data() + layout.internal_variables;
          double *strain    = properties.data() + layout.left_cauchy_green;
          of_place.set(entrant.location, 0., variables);
          body.material->initialise(stress, strain, properties.data() + layout.stress, variables);
          ++totals.n_entered;
          totals.entered_mass += properties[layout.mass];
          totals.entered_energy += volume * body.material->elastic_energy(strain);
        },
        totals);
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


  // What a scene starts from.

  template <int dim>
  std::pair<unsigned int, unsigned int> Scene<dim>::points_per_cell() const
  {
    std::pair<unsigned int, unsigned int> range(numbers::invalid_unsigned_int, 1);
    for (const BodyParameters &body : parameters.bodies)
      {
        range.first  = std::min(range.first, body.seeding.points_per_cell);
        range.second = std::max(range.second, body.seeding.points_per_cell);
      }
    return range;
  }


  template <int dim>
  void Scene<dim>::fill()
  {
    if (parameters.has_water && water_at_start.is_steady)
      {
        seepage = solve_seepage(seepage_survey(), forcing.gravity().norm());
        water_at_start.set_table<dim>(seepage);
      }
    fill_with_points();
    hold_rigid_nodes();
    hold_at_inflows();
    set_initial_state();
  }


  template <int dim>
  SeepageSurvey<dim> Scene<dim>::seepage_survey() const
  {
    SeepageSoil soil{ parameters.soil_regions(), {} };
    auto body = bodies.begin();
    for (const SoilRegion &region : soil.bodies)
      soil.conductivities.push_back(region.porosity > 0. ? (body++)->drag->conductivity(region.porosity)
                                                         : (++body, 0.));
    return SeepageSurvey<dim>(
        grid, soil, water_at_start, *water_walls, water_at_start.density * forcing.gravity().norm(), ground_of_water());
  }


  namespace
  {
    /// Throws EntryError unless the phreatic surface is in the box above and below each point of soil. Collective.
    template <int dim>
    void require_phreatic_surface(const WaterParameters &parameters,
                                  const std::list<SoilBody<dim>> &bodies,
                                  const BackgroundGrid<dim> &grid)
    {
      const auto place         = parameters.place(); // not taken apart: clang 14 hands no part of it to a lambda
      const std::string &entry = place.first, &value = place.second;
      if (entry.rfind("Phreatic", 0) != 0)
        return;
      const Region<dim> wet(entry_name("Water", entry),
                            parameters.without_fringe().region_in_soil(dim),
                            nullptr,
                            parameters.without_fringe().table<dim>());
      const double top = grid.upper_corner()[dim - 1], bottom = grid.lower_corner()[dim - 1];
      const double rounding = 1e-6 * grid.cell_size();
      on_all_ranks(grid.communicator(), [&] {
        for (const SoilBody<dim> &body : bodies)
          for_each_point(body.points, [&](const auto &point) {
            Point<dim> above = point.location, below = point.location;
            above[dim - 1]     = top + rounding;
            below[dim - 1]     = bottom - rounding;
            const bool is_high = wet.contains(above);
            if (is_high || !wet.contains(below))
              throw ValueError(entry_message({ "Water", entry, value },
                                             std::string("it leaves the box of subsection Mesh ") +
                                                 (is_high ? "through its top" : "through its bottom") + " at " +
                                                 number_text(point.location) +
                                                 " m. Write a larger box, or an elevation from " + number_text(bottom) +
                                                 " (dry) to " + number_text(top) + " m."));
          });
      });
    }
  } // namespace


  template <int dim>
  void Scene<dim>::fill_with_points()
  {
    const auto soil = parameters.soil_regions();
    if (soil.size() > 1)
      require_apart<dim>(soil, points_per_cell().second, { grid.triangulation(), grid.cell_size() });
    auto entries = parameters.bodies.begin();
    for (auto &body : bodies)
      if (const BodyParameters &of_case = *entries++; of_case.is_there)
        seed(body, of_case.seeding, lattice_of_soil());
    if (parameters.has_water)
      require_phreatic_surface(parameters.water, bodies, grid);
    for (auto &part : water)
      seed_water(part, water_at_start, soil, { grid.triangulation(), grid.cell_size(), ground_of_water(), true });
    for (const auto &load : loads)
      load.require_soil(bodies, communicator);
    // Points that keep their velocity would give a gradient of the first step to the nodes on top of it.
    if (parameters.transfer.transfer_method() == TransferMethod::aflip)
      set_velocity_gradients();
    require_points_outside_obstacles();
  }


  template <int dim>
  void Scene<dim>::require_points_outside_obstacles() const
  {
    auto entries = parameters.bodies.begin();
    for (const auto &body : bodies)
      {
        const auto place = (entries++)->seeding.place();
        for (const Obstacle<dim> &obstacle : obstacles)
          {
            std::string fault;
            for_each_point(body.points, [&](const auto &point) {
              if (fault.empty() && obstacle.contains(point.location))
                fault = entry_message({ body.name, place.first, place.second },
                                      "it reaches into " + quoted(ObstacleParameters::prefix + obstacle.name) +
                                          ", for instance at " + number_text(point.location) +
                                          " m. Let it end where the obstacle begins.");
            });
            throw_on_all_ranks(fault, communicator);
          }
      }
    for (const Inflow<dim> &inflow : inflows)
      for (const Obstacle<dim> &obstacle : obstacles)
        for (const auto &place : inflow.places())
          require_entry(!obstacle.contains(place.location),
                        { InflowParameters::prefix + inflow.name, "Region", inflow.region },
                        "points would enter in " + quoted(ObstacleParameters::prefix + obstacle.name) +
                            ", for instance at " + number_text(place.location) +
                            " m. Let it end where the obstacle begins.");
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


  namespace
  {
    /// Gives the points of a body what its law has from the place, where depth is that of soil above it, along the last
    /// axis. `subsection` is the law's, `origin` that of PlaceField.
    template <int dim>
    void set_place_values(SoilBody<dim> &body,
                          const std::string &subsection,
                          const Point<2> &origin,
                          const std::vector<SoilRegion> &soil,
                          const BackgroundGrid<dim> &grid)
    {
      if (body.material->place_variables.empty())
        return;
      const PlaceVariables<dim> values(body.material->place_variables, subsection, origin);
      std::vector<typename Overburden<dim>::Layer> layers;
      for (const SoilRegion &part : soil)
        layers.emplace_back(part.template places<dim>(), 1.); // a weight per depth of 1
      Tensor<1, dim> down;
      down[dim - 1] = -1.;
      Overburden<dim> depth(grid, std::move(layers), down, grid.cell_size() / 4);
      const bool has_depth = values.has_depth();
      on_all_ranks(grid.communicator(), [&] {
        for_each_point(body.points, [&](const auto &point) {
          values.set(point.location,
                     has_depth ? depth.weight_above(point.location) : 0.,
                     point.properties + body.layout.internal_variables);
        });
      });
    }
  } // namespace


  template <int dim>
  void Scene<dim>::set_initial_state()
  {
    const auto soil = parameters.soil_regions();
    std::unique_ptr<Overburden<dim>> overburden; // made when the first body asks for it
    const WaterParameters *wet = parameters.has_water ? &water_at_start : nullptr;
    const auto suction         = suction_at_start(wet, seepage, grid, soil, forcing.gravity());
    for (auto &body : bodies)
      {
        const BodyParameters &entries       = *parameters.find_body(body.name);
        const InitialStateParameters &state = entries.initial_state;
        if (!entries.is_there)
          continue;
        const std::string modulus = entries.material.modulus_text(body.name);
        const double k0           = entries.k0();
        set_place_values(body, entries.material.path(body.name), parameters.bed.map_origin, soil, grid);
        if (!state.is_k0())
          {
            set_isotropic_stress(body, state.is_isotropic() ? state.pressure : 0., modulus, communicator);
            continue;
          }
        if (!overburden)
          overburden = std::make_unique<Overburden<dim>>(
              grid, effective_weight_layers<dim>(soil, wet), forcing.gravity(), grid.cell_size() / 4);
        set_k0_stress(body, *overburden, k0, modulus, suction);
      }
    if (seepage)
      for (auto &part : water)
        set_seepage_pressure(part, *seepage, seepage_survey(), forcing.gravity().norm(), communicator);
    else if (!water.empty() && parameters.water.starts_hydrostatic() && forcing.gravity().norm() > 0)
      {
        Overburden<dim> water_above(
            grid, water_layers<dim>(parameters.water, soil), forcing.gravity(), grid.cell_size() / 4);
        for (auto &part : water)
          set_hydrostatic_pressure(
              part, water_above, suction, parameters.water.has_levels() ? 1e-2 * grid.cell_size() : 0.);
      }
  }


  template <int dim>
  StageMasses Scene<dim>::begin_stage()
  {
    const StageParameters &stage = parameters.stage;
    StageMasses masses;
    if (const auto [entry, value] = stage.removal(); !value.empty())
      {
        const Region<dim> region(
            entry_name(stage.subsection(), entry), stage.removed_areas ? "1" : value, stage.removed_areas);
        const Point<dim> beyond = grid.upper_corner() + (grid.upper_corner() - grid.lower_corner());
        const auto remove       = [&](PointSet<dim> &points) { // beside the mesh they leave the set
          on_all_ranks(communicator, [&] {
            for_each_point(points, [&](const auto &point) {
              if (region.contains(point.location))
                point.location = beyond;
            });
          });
          points.sort();
          points.lost().clear();
        };
        const auto mass_in_region = [&](const PointSet<dim> &points, const unsigned int slot) {
          double mass = 0.;
          for_each_point(points, [&](const auto &point) {
            mass += region.contains(point.location) ? point.properties[slot] : 0.;
          });
          return mass;
        };
        on_all_ranks(communicator, [&] {
          for (const auto &body : bodies)
            masses.removed_soil += mass_in_region(body.points, body.layout.mass);
          for (const auto &part : water)
            masses.removed_water += mass_in_region(part.points(), part.layout.mass);
        });
        for (auto &body : bodies)
          remove(body.points);
        for (auto &part : water)
          if (part.carrier() == nullptr)
            remove(part.points());
      }
    for (const std::string &name : stage.adds)
      {
        SoilBody<dim> &body           = body_named(name, bodies);
        const BodyParameters &entries = *parameters.find_body(name);
        const SoilRegion region{ name, entries.seeding.expression(), 0., 0., entries.seeding.map };
        const Region<dim> places = region.template places<dim>();
        double taken             = 0.; // by other soil, m^3
        on_all_ranks(communicator, [&] {
          for (const SoilBody<dim> &other : bodies)
            for_each_point(other.points, [&](const auto &point) {
              taken += places.contains(point.location) ? point.properties[other.layout.volume] : 0.;
            });
        });
        seed(body, entries.seeding, lattice_of_soil());
        double volume = 0.;
        for_each_point(body.points, [&](const auto &point) { volume += point.properties[body.layout.volume]; });
        constexpr double by_settling = 0.1; // part that ground which has moved may take
        require_entry(Utilities::MPI::sum(taken, communicator) <=
                          by_settling * Utilities::MPI::sum(volume, communicator),
                      { name, entries.seeding.place().first, entries.seeding.place().second },
                      "more than a tenth of it is full of other soil when \"" + entries.added_by +
                          "\" begins. Let it begin at the ground.");
        set_place_values(body, entries.material.path(name), parameters.bed.map_origin, { region }, grid);
        set_isotropic_stress(body, 0., entries.material.modulus_text(name), communicator);
        masses.added_soil += body.density * volume;
      }
    require_points_outside_obstacles();
    mark_start();
    std::vector<double> sums{ masses.removed_soil, masses.removed_water, masses.added_soil };
    Utilities::MPI::sum(sums, communicator, sums);
    return { sums[0], sums[1], sums[2] };
  }


  template <int dim>
  Speeds Scene<dim>::speeds() const
  {
    Speeds largest;
    const auto include_point = [&](const double *velocity) { largest.include_point(vector_of<dim>(velocity).norm()); };
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
  void Scene<dim>::require_steps(const double stable_step, const Speeds &speeds) const
  {
    constexpr double most_stress = 1e10; // beyond, rounding of the velocities outweighs all other forces
    const double stress =
        parameters.water.viscosity / parameters.water.density * stable_step / (grid.cell_size() * grid.cell_size());
    require_entry(!parameters.has_water || stress <= most_stress,
                  { "Water", "Viscosity", parameters.water.viscosity },
                  "in a step of " + number_text(stable_step) + " s it would spread momentum over " +
                      number_text(std::sqrt(stress)) + " cells, and at most 1e5 are possible. Write a smaller one.");
    constexpr double most_steps = 1e10; // months, even of the smallest mesh
    const double time           = std::max(parameters.end_time, parameters.settling.maximum_time);
    if (time / stable_step <= most_steps)
      return;
    const std::string remedy = "the step is " + number_text(stable_step) + " s, so that a run of " + number_text(time) +
                               " s would take " + number_text(time / stable_step) +
                               " steps, and at most 1e10 are possible.";
    const TimeStepParameters &step = parameters.time_step;
    require_entry(stable_step < step.maximum_time_step,
                  { "Time step", "Maximum time step", step.maximum },
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
                    { body.name, "Initial velocity", body.seeding.initial_velocity },
                    "points move at " + c + remedy + " Write slower ones.");
    require_entry(
        false, { "Water", "Initial velocity", parameters.water.initial_velocity }, "points move at " + c + remedy);
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
      for_each_point(body.points, [&](const auto &point) {
        std::copy_n(&point.location[0], dim, point.properties + body.layout.start);
      });
  }

  template class Scene<2>;
  template class Scene<3>;
} // namespace scree
