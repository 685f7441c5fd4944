// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/tensor/invariants.h>

#include <numeric>
#include <set>

namespace scree
{
  using namespace dealii;

  Groups groups_of(const SceneNumbers &scene)
  {
    Groups groups;
    const double H = scene.height, g = scene.gravity, M = scene.constrained_modulus();
    groups.cells_over_height = H / scene.cell_size;
    groups.wave_speed        = scene.mean.speed();
    groups.motion_time       = g > 0 ? std::sqrt(H / g) : groups.wave_speed > 0 ? H / groups.wave_speed : 0.;
    if (!scene.has_soil)
      return groups;
    const double weight       = scene.density() * g * H; // Pa
    groups.own_strain         = weight / M;
    groups.shear_stress_ratio = scene.mean.shear_modulus > 0 ? weight / scene.mean.shear_modulus : 0.;
    groups.mach_number        = std::sqrt(g * H) / groups.wave_speed;
    if (!scene.has_water)
      return groups;
    constexpr double earth_gravity   = 9.81; // m/s^2, at which the conductivity is defined, whatever the scene's
    const double unit_weight         = scene.water_density * earth_gravity; // N/m^3
    groups.consolidation_coefficient = scene.conductivity * M / unit_weight;
    groups.drainage_time             = H * H / groups.consolidation_coefficient;
    groups.drainage                  = groups.motion_time > 0 ? groups.drainage_time / groups.motion_time : 0.;
    groups.time_factor               = scene.end_time / groups.drainage_time;
    const double n = scene.porosity, drag = n * n * unit_weight / scene.conductivity; // N s/m^4
    groups.drag_time = 1. / (drag * (1. / ((1. - n) * scene.grain_density) + 1. / (n * scene.water_density)));
    return groups;
  }


  double conductivity_for(const SceneNumbers &scene, const double drainage)
  {
    const Groups groups = groups_of(scene);
    return scene.conductivity * groups.drainage / drainage;
  }


  namespace
  {
    /// Sums over the points of soil and water, SI units; moduli times volume.
    struct Sums
    {
      double soil_mass = 0, soil_volume = 0, grain_volume = 0, bulk = 0, shear = 0;
      double water_mass = 0, water_volume = 0;
      double height_moment = 0; // kg m
    };


    /// The axis of gravity; without gravity nothing depends on it.
    template <int dim>
    unsigned int axis_of_gravity(const Parameters &parameters)
    {
      unsigned int axis = dim - 1;
      for (unsigned int a = 0; a < dim; ++a)
        if (std::abs(parameters.gravity[a]) > std::abs(parameters.gravity[axis]))
          axis = a;
      return axis;
    }


    /// What the entries say of a scene.
    template <int dim>
    SceneNumbers numbers_of_entries(const Parameters &parameters, const BackgroundGrid<dim> &grid)
    {
      const unsigned int axis = axis_of_gravity<dim>(parameters);
      SceneNumbers scene;
      scene.dim       = dim;
      scene.end_time  = parameters.end_time;
      scene.gravity   = std::sqrt(std::inner_product(
          parameters.gravity.begin(), parameters.gravity.begin() + dim, parameters.gravity.begin(), 0.));
      scene.cell_size = grid.cell_size();
      scene.n_cells   = grid.n_cells_of_box();
      scene.has_soil  = std::any_of(
          parameters.bodies.begin(), parameters.bodies.end(), [](const auto &body) { return !body.is_rigid(); });
      const Wall floor = parameters.boundaries.walls(dim)[2 * axis + (parameters.gravity[axis] > 0)];
      scene.sticks =
          parameters.bed.is_set() ? parameters.bed.type_kind() == BedType::fixed : floor.holds == Wall::Holds::all;
      scene.is_elastic          = scene.has_soil;
      scene.grain_diameter      = scene.has_soil ? std::numeric_limits<double>::max() : 0;
      scene.has_water           = parameters.has_water;
      scene.courant_of_transfer = parameters.transfer.courant_number(parameters.has_water);
      scene.has_changing_forces = parameters.surface_load.changes_with_time() || parameters.body_forces.is_set();
      if (scene.has_water)
        {
          scene.is_single_point  = parameters.water.point_sets_kind() == PointSets::single_point;
          scene.water_fills_soil = parameters.water.is_where_soil_is();
          scene.water_density    = parameters.water.density;
        }
      return scene;
    }


    /// See SceneNumbers::height, m. Collective.
    template <int dim>
    double height_of(const SceneNumbers &scene, const Scene<dim> &run, const Parameters &parameters)
    {
      if (scene.is_layer)
        return scene.cell_size * SoilMotion<dim>(run.grid, Tensor<1, dim>(), run.bed.get())
                                     .look(run.bodies, Tensor<1, 2 * dim>(), 0.)
                                     .thickness;
      // Largest coordinate and minus the smallest, for each axis.
      std::vector<double> ends(2 * dim, -std::numeric_limits<double>::infinity());
      const auto add = [&](const auto &point) {
        for (unsigned int a = 0; a < dim; ++a)
          {
            ends[2 * a]     = std::max(ends[2 * a], point.location[a]);
            ends[2 * a + 1] = std::max(ends[2 * a + 1], -point.location[a]);
          }
      };
      for (const auto &body : run.bodies)
        for_each_point(body.points, add);
      if (!scene.has_soil)
        for (const auto &part : run.water)
          for_each_point(part.points(), add);
      Utilities::MPI::max(ends, communicator_of(run.grid.triangulation()), ends);
      const unsigned int axis = axis_of_gravity<dim>(parameters);
      double length           = 0.; // without points
      for (unsigned int a = 0; a < dim; ++a)
        if (scene.gravity == 0. || a == axis)
          length = std::max(length, ends[2 * a] + ends[2 * a + 1]);
      // Outer points stand half a spacing inside the surface.
      return length + scene.cell_size / (scene.has_soil ? parameters.bodies[0].seeding.points_per_cell
                                                        : parameters.water.points_per_cell);
    }


    /// Adds the points of this rank.
    /// @param height_at of a place above the lowest wall of the box, m
    template <int dim, class HeightAt>
    void add_soil(const SoilBody<dim> &body, const HeightAt &height_at, SceneNumbers &scene, Sums &sums)
    {
      const Material<dim> &law = *body.material;
      scene.is_elastic         = scene.is_elastic && law.is_elastic();
      scene.grain_diameter     = std::min(scene.grain_diameter, law.grain_diameter);
      // Soil without stress gets its first one from its weight.
      const double first_pressure = 2. / 3. * body.density * scene.gravity * scene.height;
      for_each_point(body.points, [&](const auto &point) {
        const double *properties = point.properties;
        const double mass = properties[body.layout.mass], volume = properties[body.layout.volume];
        const double at_start = mean_effective_stress(properties + body.layout.stress);
        const double modulus  = law.initial_bulk_modulus(at_start > 0 ? at_start : first_pressure);
        scene.largest_wave_speed =
            std::max(scene.largest_wave_speed, WaveMedium{ modulus, law.shear_modulus, body.density }.speed());
        ++scene.n_soil_points;
        sums.soil_mass += mass;
        sums.soil_volume += volume;
        sums.grain_volume += mass / body.grain_density;
        sums.bulk += volume * modulus;
        sums.shear += volume * law.shear_modulus;
        sums.height_moment += mass * height_at(point.location);
      });
    }


    template <int dim, class HeightAt>
    void add_water(const WaterPhase<dim> &part, const HeightAt &height_at, SceneNumbers &scene, Sums &sums)
    {
      for_each_point(part.points(), [&](const auto &point) {
        const double mass = point.properties[part.layout.mass];
        scene.n_water_points += part.carrier() == nullptr;
        sums.water_mass += mass;
        sums.water_volume += point.properties[part.layout.volume];
        sums.height_moment += mass * height_at(point.location);
      });
    }


    /// Cells of this rank with points.
    template <int dim>
    double count_occupied(const Scene<dim> &run)
    {
      std::set<unsigned int> occupied;
      const auto add = [&](const PointSet<dim> &points) {
        for (const auto &cell : points.cells())
          occupied.insert(cell.cell);
      };
      for (const auto &body : run.bodies)
        add(body.points);
      for (const auto &part : run.water)
        add(part.points());
      return occupied.size();
    }


    /// The smallest of the bodies that move, at the start, m/s.
    double smallest_conductivity(const Parameters &parameters)
    {
      double smallest = std::numeric_limits<double>::infinity();
      for (const BodyParameters &body : parameters.bodies)
        if (const double porosity = body.initial_porosity(); porosity > 0 && !body.is_rigid())
          smallest = std::min(smallest, body.drag_law(parameters.water).conductivity(porosity));
      return std::isfinite(smallest) ? smallest : parameters.water.conductivity;
    }
  } // namespace


  template <int dim>
  SceneNumbers survey(const Simulation<dim> &simulation, const Parameters &parameters, const MPI_Comm communicator)
  {
    const Scene<dim> &run           = simulation.state_of_scene();
    const BackgroundGrid<dim> &grid = run.grid;
    const unsigned int axis         = axis_of_gravity<dim>(parameters);
    const auto height_at            = [&](const Point<dim> &x) {
      return parameters.gravity[axis] > 0 ? grid.upper_corner()[axis] - x[axis] : x[axis] - grid.lower_corner()[axis];
    };
    SceneNumbers scene = numbers_of_entries(parameters, grid);
    scene.is_layer     = scene.has_soil && run.bed;
    scene.height       = height_of(scene, run, parameters);
    scene.n_occupied   = count_occupied(run);
    Sums sums;
    for (const auto &body : run.bodies)
      if (!body.is_rigid)
        add_soil(body, height_at, scene, sums);
    for (const auto &part : run.water)
      add_water(part, height_at, scene, sums);
    NumbersOf{ &scene.n_soil_points, &scene.n_water_points, &scene.n_occupied,  &sums.soil_mass,
               &sums.soil_volume,    &sums.grain_volume,    &sums.bulk,         &sums.shear,
               &sums.water_mass,     &sums.water_volume,    &sums.height_moment }
        .sum_over_ranks(communicator);
    scene.largest_wave_speed = Utilities::MPI::max(scene.largest_wave_speed, communicator);
    if (scene.has_soil)
      {
        const double volume = sums.soil_volume;
        scene.mean          = { sums.bulk / volume, sums.shear / volume, sums.soil_mass / volume };
        scene.grain_density = sums.soil_mass / sums.grain_volume;
        scene.porosity      = 1. - sums.grain_volume / volume;
        scene.conductivity  = scene.has_water ? smallest_conductivity(parameters) : 0.;
      }
    // Level in the box, soil and the water that finds no room in its pores have their centre at half their height.
    const double box_height = grid.upper_corner()[axis] - grid.lower_corner()[axis];
    const double floor      = scene.n_cells * Utilities::fixed_power<dim>(scene.cell_size) / box_height;
    const double free_water = std::max(0., sums.water_volume - (sums.soil_volume - sums.grain_volume));
    const double level      = (sums.soil_volume + free_water) / floor;
    scene.fall              = std::max(0., sums.height_moment / (sums.soil_mass + sums.water_mass) - 0.5 * level);
    return scene;
  }

  template decltype(survey<2>) survey<2>;
  template decltype(survey<3>) survey<3>;
} // namespace scree
