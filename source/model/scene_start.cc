// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/initial/steady_seepage.h>
#include <scree/initial/water_start.h>
#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/seeding/water_seeding.h>
#include <scree/model/scene.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/principal.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

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
    if (parameters.has_water && water_at_start.seepage_start.is_steady)
      {
        seepage = SteadySeepage<dim>(grid, seepage_survey()).solve(forcing.gravity().norm());
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
                            parameters.table<dim>());
      const double top = grid.upper_corner()[dim - 1], bottom = grid.lower_corner()[dim - 1];
      const double rounding = 1e-6 * grid.cell_size();
      on_all_ranks(grid.communicator(), [&] {
        for (const SoilBody<dim> &body : bodies)
          for_each_point(body.points, [&](const auto &point) {
            Point<dim> above = point.location, below = point.location;
            above[dim - 1]     = top + rounding;
            below[dim - 1]     = bottom - rounding;
            const bool is_high = wet.contains(above);
            if (is_high || !(wet.contains(below) || parameters.table<dim>()))
              throw ValueError(entry_message("Water",
                                             entry,
                                             value,
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
      require_apart(soil, points_per_cell().second, grid.triangulation(), grid.cell_size());
    auto entries = parameters.bodies.begin();
    for (auto &body : bodies)
      seed(body, (entries++)->seeding, grid.triangulation(), grid.cell_size(), ground.get(), parameters.has_water);
    if (parameters.has_water)
      require_phreatic_surface(parameters.water, bodies, grid);
    for (auto &part : water)
      seed_water(part, water_at_start, soil, grid.triangulation(), grid.cell_size(), ground_of_water());
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
        const auto place = (entries++)->seeding.place();
        for (const Obstacle<dim> &obstacle : obstacles)
          {
            std::string fault;
            for_each_point(body.points, [&](const auto &point) {
              if (fault.empty() && obstacle.contains(point.location))
                fault = entry_message(body.name,
                                      place.first,
                                      place.second,
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
                        InflowParameters::prefix + inflow.name,
                        "Region",
                        inflow.region,
                        "points would enter in " + quoted(ObstacleParameters::prefix + obstacle.name) +
                            ", for instance at " + number_text(place.location) +
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


  namespace
  {
    /// Gives the points of a body what its law has from the place, with the depth along the last axis below the soil's
    /// surface. `subsection` is the law's.
    template <int dim>
    void set_place_values(SoilBody<dim> &body,
                          const std::string &subsection,
                          const std::vector<SoilRegion> &soil,
                          const BackgroundGrid<dim> &grid)
    {
      const PlaceVariable variable = body.material->place_variable();
      if (variable.expression.empty())
        return;
      const PlaceVariableValues<dim> values(variable, subsection);
      std::vector<typename Overburden<dim>::Layer> layers;
      for (const SoilRegion &part : soil)
        layers.emplace_back(part.template places<dim>(), 1.); // a weight per depth of 1
      Tensor<1, dim> down;
      down[dim - 1] = -1.;
      Overburden<dim> depth(grid, std::move(layers), down, grid.cell_size() / 4);
      on_all_ranks(grid.communicator(), [&] {
        for_each_point(body.points, [&](const auto &point) {
          values.set(point.location,
                     variable.gradient > 0 ? depth.weight_above(point.location) : 0.,
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
        const std::string modulus           = entries.material.modulus_text(body.name);
        const double k0                     = entries.k0();
        set_place_values(body, entries.material.path(body.name), soil, grid);
        if (state.stress_kind() != InitialStress::k0)
          {
            set_isotropic_stress(
                body, state.stress_kind() == InitialStress::isotropic ? state.pressure : 0., modulus, communicator);
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
    else if (!water.empty() && parameters.water.initial_pressure_kind() == InitialPressure::hydrostatic &&
             forcing.gravity().norm() > 0)
      {
        Overburden<dim> water_above(
            grid, water_layers<dim>(parameters.water, soil), forcing.gravity(), grid.cell_size() / 4);
        for (auto &part : water)
          set_hydrostatic_pressure(
              part, water_above, suction, parameters.water.has_levels() ? 1e-2 * grid.cell_size() : 0.);
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
                  step.maximum,
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
          std::copy_n(&point.location[0], dim, point.properties + body.layout.start);
        });
  }

  template class Scene<2>;
  template class Scene<3>;
} // namespace scree
