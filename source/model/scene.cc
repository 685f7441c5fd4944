// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/joined_surface.h>
#include <scree/model/places_of_points.h>
#include <scree/model/scene.h>
#include <scree/schemes/two_phase_scheme.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters, const MPI_Comm communicator)
      : expected_memory(require_memory<dim>(parameters, communicator))
      , grid(parameters.grid, places_of_points<dim>(parameters), communicator)
      , walls(grid, parameters.boundaries)
      , water_walls(parameters.has_water
                        ? std::make_unique<WaterBoundaryConditions<dim>>(grid, parameters.water_boundaries)
                        : nullptr)
      , constraints(grid, walls, water_walls.get())
      , forcing(grid, parameters.gravity, parameters.body_forces, parameters.time_step.mass_scaling)
      , parameters(parameters)
      , water_at_start(parameters.water)
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
      bed = std::make_unique<DiscreteLevelSet<dim>>(grid, *ground);
    for (const ObstacleParameters &obstacle : parameters.obstacles)
      if (obstacle.surface.is_set())
        obstacles.emplace_back(obstacle, parameters.grid, grid);
    if (parameters.has_water)
      join_ground();
    for (const InflowParameters &inflow : parameters.inflows)
      {
        const BodyParameters *body = parameters.find_body(inflow.body);
        inflows.emplace_back(inflow,
                             grid,
                             parameters.grid.cell_size / parameters.points_per_cell(inflow),
                             body == nullptr ? 1. : body->initial_porosity(),
                             ground_of_water());
      }
    hold_at_inflows();
    if (parameters.rain.is_set())
      rain.emplace(parameters.rain, grid, parameters.grid.cell_size / parameters.water.points_per_cell, rained_soil());
    if (parameters.surface_load.is_set())
      loads.emplace_back(grid, parameters.surface_load, points_per_cell().second);
  }


  template <int dim>
  void Scene<dim>::join_ground()
  {
    std::vector<const LevelSet<dim> *> all, at_rest;
    std::vector<GroundPart<dim>> parts;
    if (ground)
      all.push_back(ground.get());
    at_rest = all;
    for (const Obstacle<dim> &obstacle : obstacles)
      {
        all.push_back(&obstacle.shape());
        if (obstacle.is_moving)
          parts.push_back({ &obstacle.surface, &obstacle.velocity() });
        else
          at_rest.push_back(&obstacle.shape());
      }
    if (all.empty())
      return;
    if (!obstacles.empty())
      union_level_set = std::make_unique<JoinedSurface<dim>>(all);
    if (at_rest.size() > (ground ? 1 : 0))
      {
        joined_at_rest = std::make_unique<JoinedSurface<dim>>(at_rest);
        joined_samples = std::make_unique<DiscreteLevelSet<dim>>(grid, *joined_at_rest);
      }
    if (!at_rest.empty())
      parts.insert(parts.begin(), { joined_samples ? joined_samples.get() : bed.get() });
    wet_ground = std::make_unique<RigidBoundary<dim>>(parts);
    // Between a half and the whole of the points' spacing; doc/developer/development_log.md, "Moving obstacles in
    // water", has what others do.
    constexpr double thinnest = 0.75;
    const unsigned int points = parameters.water.point_sets_kind() == PointSets::double_point
                                    ? parameters.water.points_per_cell
                                    : points_per_cell().first;
    cut_cells                 = std::make_unique<CutCells<dim>>(grid, *wet_ground, thinnest / points);
  }


  template <int dim>
  void Scene<dim>::make_bodies()
  {
    // The one place that depends on whose points carry the water.
    const bool affine      = parameters.transfer.carries_affine_field();
    const double inertia   = parameters.transfer.affine_inertia(grid.cell_size());
    const bool water_rides = parameters.has_water && parameters.water.point_sets_kind() == PointSets::single_point;
    for (const BodyParameters &body : parameters.bodies)
      {
        auto material = make_material<dim>(body.material);
        const PropertyLayout<dim> layout(material->internal_quantities().size(),
                                         affine,
                                         water_rides ? WaterLayout<dim>(0, affine).n_properties() : 0,
                                         parameters.probes.displacement || parameters.settling.maximum_time > 0.,
                                         parameters.has_water ? 0 : parameters.n_rigid_surfaces());
        bodies.emplace_back(body.name,
                            body.bulk_density(),
                            body.seeding.grain_density,
                            std::move(material),
                            layout,
                            grid.triangulation(),
                            grid.mapping());
        bodies.back().is_rigid       = body.is_rigid();
        bodies.back().group          = groups.of_body[bodies.size() - 1];
        bodies.back().spacing        = grid.cell_size() / body.seeding.points_per_cell;
        bodies.back().affine_inertia = inertia;
        if (parameters.has_water)
          bodies.back().drag.emplace(body.seepage.in_place_of(parameters.water), body.initial_porosity());
        if (water_rides)
          water.emplace_back(parameters.water.density, affine, bodies.back());
      }
    if (parameters.has_water && !water_rides)
      water.emplace_back(parameters.water.density, affine, grid.triangulation(), grid.mapping());
    for (auto &part : water)
      part.affine_inertia = inertia;
  }


  template <int dim>
  std::unique_ptr<Scheme<dim>> Scene<dim>::make_scheme(TimerOutput &timer)
  {
    const Model<dim> model{ grid,
                            forcing,
                            parameters.transfer,
                            parameters.stabilisation,
                            bodies,
                            loads,
                            rigid_surfaces(),
                            constraints_of_groups(),
                            groups.pairs,
                            water,
                            parameters.water,
                            parameters.pressure,
                            water_walls.get(),
                            inflows,
                            wet_ground.get(),
                            cut_cells.get(),
                            points_per_cell().first };
    if (parameters.has_water)
      return std::make_unique<TwoPhaseScheme<dim>>(model, timer);
    return std::make_unique<ExplicitScheme<dim>>(model, timer);
  }


  template <int dim>
  std::vector<Constraints<dim> *> Scene<dim>::constraints_of_groups()
  {
    std::vector<Constraints<dim> *> result;
    for (unsigned int g = 0; g < groups.n; ++g)
      {
        const bool sticks_to_rigid = std::any_of(
            bodies.begin(), bodies.end(), [g](const SoilBody<dim> &body) { return body.is_rigid && body.group == g; });
        result.push_back(walls_alone && !sticks_to_rigid ? walls_alone.get() : &constraints);
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
    if (cut_cells)
      cut_cells->reinit();
    for (Inflow<dim> &inflow : inflows)
      inflow.reinit();
    if (rain)
      rain->reinit();
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
      constraints.set_inflow_velocity(number++, inflow.velocity());
    uncover_walls();
  }


  template <int dim>
  void Scene<dim>::uncover_walls()
  {
    if (std::none_of(obstacles.begin(), obstacles.end(), [](const auto &obstacle) { return obstacle.is_moving; }))
      return;
    std::vector<std::pair<unsigned int, std::uint8_t>> covered;
    for (const Obstacle<dim> &obstacle : obstacles)
      if (obstacle.is_moving)
        obstacle.add_covered_nodes(covered);
    constraints.cover(covered);
    if (walls_alone)
      walls_alone->cover(covered);
  }


  template <int dim>
  void Scene<dim>::move_obstacles(const double time_step)
  {
    for (Obstacle<dim> &obstacle : obstacles)
      obstacle.end_step(time_step);
  }


  template <int dim>
  void Scene<dim>::include_obstacles(Speeds &speeds, const double time) const
  {
    for (const Obstacle<dim> &obstacle : obstacles)
      speeds.include_point(obstacle.velocity_at(time).norm());
  }


  namespace
  {
    /// Adds the blocks on the way of a point at `x`, as long as `path`, m, in the box: straight on, but along the
    /// ground where that is near.
    template <int dim>
    void append_way(const Point<dim> &x,
                    Tensor<1, dim> path,
                    const LevelSet<dim> &ground,
                    const BackgroundGrid<dim> &grid,
                    Blocks &blocks)
    {
      const std::size_t n_before = blocks.size();
      grid.append_blocks(x, Tensor<1, dim>(), blocks);
      const double block = 2. * grid.cell_size(), length = path.norm();
      if (blocks.size() == n_before || !(length > block) || !std::isfinite(length))
        return;
      const std::uint64_t own = blocks.back();
      const double reach = 1.5 * block, height = ground.view(x, reach).distance;
      const double end = std::min(length, (grid.upper_corner() - grid.lower_corner()).norm());
      Point<dim> place = x;
      path *= block / length;
      for (double way = 0.; way < end; way += block)
        {
          Point<dim> next             = place + path;
          const SurfaceView<dim> view = ground.view(next, reach);
          next -= (view.distance - height) * view.normal;
          bool is_in_box = true;
          for (unsigned int a = 0; a < dim; ++a)
            is_in_box = is_in_box && next[a] > grid.lower_corner()[a] && next[a] < grid.upper_corner()[a];
          if (!is_in_box)
            break;
          grid.append_blocks(next, Tensor<1, dim>(), blocks);
          path = next - place;
          path *= block / std::max(path.norm(), 1e-3 * block);
          place = next;
        }
      blocks.push_back(own); // so that append_blocks() skips the next point of the same block
    }
  } // namespace


  template <int dim>
  Blocks Scene<dim>::blocks_of_points(const double time) const
  {
    Blocks blocks;
    const auto append = [&](const PointSet<dim> &points, const unsigned int velocity) {
      for_each_point(points, [&](const auto &point) {
        const double *v           = point.properties + velocity;
        const Tensor<1, dim> path = time * Tensor<1, dim>(make_array_view(v, v + dim));
        if (ground)
          append_way(point.location, path, *ground, grid, blocks);
        else
          grid.append_blocks(point.location, path, blocks);
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

  template class Scene<2>;
  template class Scene<3>;
} // namespace scree
