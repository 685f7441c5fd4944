// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/seeding/water_seeding.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    void check_type_for_water(const Parameters &parameters, const BedParameters &surface)
    {
      const auto require = [&](const bool possible, const std::string &remedy) {
        require_entry(possible || !surface.no_slip(), surface.subsection, "Type for water", surface.for_water, remedy);
      };
      require(parameters.has_water, "this entry has no effect, as there is no subsection Water. Remove it.");
      require(
          parameters.water.viscosity > 0.,
          "water without viscosity slips along anything. Write a \"Viscosity\" in subsection Water, or impermeable.");
    }


    void check_inflow(const Parameters &parameters, const InflowParameters &inflow)
    {
      const BodyParameters *body = parameters.find_body(inflow.body);
      std::string names;
      for (const BodyParameters &one : parameters.bodies)
        names += (names.empty() ? "" : ", ") + one.name;
      if (parameters.has_water)
        names += (names.empty() ? "" : ", ") + std::string("Water");
      require_entry(body != nullptr || (inflow.is_water() && parameters.has_water),
                    inflow.subsection,
                    "Body",
                    inflow.body,
                    inflow.is_water() ? "there is no subsection Water. Add one, or write the name of a body."
                                      : "write what enters: " + names + ".");
      require_entry(body == nullptr || !body->is_rigid(),
                    inflow.subsection,
                    "Body",
                    inflow.body,
                    "a body of \"Material = rigid\" does not move. Write another one.");
      require_entry(!parameters.has_water || parameters.water.point_sets_kind() == PointSets::double_point,
                    "Water",
                    "Point sets",
                    parameters.water.point_sets,
                    "with subsection " + inflow.subsection +
                        " water needs points of its own. Write double, or remove the inflow.");
      if (inflow.is_saturated)
        {
          const auto require = [&](const bool possible, const std::string &remedy) {
            require_entry(possible, inflow.subsection, "Saturated", "true", remedy);
          };
          require(parameters.has_water && body != nullptr,
                  "it is said of soil in a scene with water. Remove the entry, or add subsection Water.");
          require(body->initial_porosity() > 0,
                  "the body has no pores. Write an \"Initial porosity\" above 0 in subsection " + body->name + '.');
          require(
              parameters.water.points_per_cell == body->seeding.points_per_cell,
              "water enters on a point for each one of the soil. Write the same \"Points per cell\" in subsections " +
                  body->name + " and Water.");
        }
      inflow.check(parameters.grid, parameters.dimension, parameters.points_per_cell(inflow));
    }


    /// Points of single-point water are those of the soil: the entry has no effect.
    void check_points_of_water(const Parameters &parameters)
    {
      const WaterParameters &water = parameters.water;
      if (!parameters.has_water || water.point_sets_kind() == PointSets::double_point)
        return;
      const bool are_those_of_soil =
          std::any_of(parameters.bodies.begin(), parameters.bodies.end(), [&](const BodyParameters &body) {
            return body.seeding.points_per_cell == water.points_per_cell;
          });
      require_entry(
          are_those_of_soil || water.points_per_cell == WaterParameters().points_per_cell,
          "Water",
          "Points per cell",
          water.points_per_cell,
          "this entry has no effect, as the soil points carry single-point water. Remove it, or write \"Point "
          "sets = double\".");
    }


    void check_what_enters(const Parameters &parameters)
    {
      for (const InflowParameters &inflow : parameters.inflows)
        check_inflow(parameters, inflow);
      const bool has_own_points = parameters.has_water && parameters.water.point_sets_kind() == PointSets::double_point;
      parameters.rain.check(
          parameters.gravity, has_own_points, parameters.water.air_entry_pressure, parameters.bodies.size());
    }


    void check_contacts(const Parameters &parameters)
    {
      parameters.contact_groups();
      for (const ContactParameters &contact : parameters.contacts)
        {
          const auto require = [&contact](const bool possible, const std::string &what) {
            require_entry(possible || !contact.is_set(),
                          contact.subsection,
                          "Bodies",
                          contact.bodies,
                          "bodies that slide are not possible with " + what +
                              " yet. Remove one of the two subsections.");
          };
          require(!parameters.has_water, "subsection Water");
          require(!parameters.surface_load.is_set(), "subsection Surface load");
          require(parameters.inflows.empty(), "subsection Inflow");
        }
    }


    void check_water(const Parameters &parameters)
    {
      parameters.water.check(parameters.gravity, parameters.bodies.size());
      parameters.water_boundaries.check(parameters.dimension);
      for (const WaterWall &wall : parameters.water_boundaries.walls(parameters.dimension))
        require_entry(wall.type != WaterWallType::drained || wall.pressure >= parameters.pressure.cavitation_pressure,
                      "Water/Pressure",
                      "Cavitation pressure",
                      parameters.pressure.cavitation_pressure,
                      "a drained wall in subsection Boundaries/Water prescribes less: " + number_text(wall.pressure) +
                          " Pa. Water cavitates there. Write a lower number, or a higher pressure at the wall.");
      if (parameters.water.is_where_soil_is())
        for (const SoilRegion &body : parameters.soil_regions())
          require_pores(body);
    }


    void check_without_soil(const Parameters &parameters)
    {
      const std::string no_soil = "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it";
      const auto walls = parameters.boundaries.texts(3), defaults = BoundaryParameters().texts(3);
      for (unsigned int f = 0; f < walls.size(); ++f)
        require_entry(walls[f] == defaults[f],
                      "Boundaries",
                      FaceEntries::names(3)[f],
                      walls[f],
                      no_soil + ", or move it to subsection Water of subsection Boundaries.");
      require_entry(!parameters.surface_load.is_set(),
                    "Surface load",
                    "Traction",
                    parameters.surface_load.traction,
                    no_soil + '.');
      require_entry(parameters.settling.maximum_time == 0,
                    "Settling",
                    "Maximum time",
                    parameters.settling.maximum_time,
                    no_soil + '.');
    }


    /// What depends on the true inertia.
    void check_mass_scaling(const Parameters &parameters)
    {
      const auto require = [&](const bool possible, const std::string &what) {
        require_entry(possible || parameters.time_step.mass_scaling == 1.,
                      "Time step",
                      "Mass scaling",
                      parameters.time_step.mass_scaling,
                      "it is for slow motion, and " + what + " depends on the true inertia. Write 1, or remove that.");
      };
      require(!parameters.body_forces.is_set(), "a base motion or body force");
      require(parameters.inflows.empty(), "what an inflow brings");
      require(!parameters.rain.is_set(), "rain, as it falls on the soil,");
      require(parameters.bed.turbulent_friction == 0., "\"Turbulent friction\" of the bed");
      require(parameters.water.initial_velocity.empty(), "\"Initial velocity\" of the water");
      for (const BodyParameters &body : parameters.bodies)
        require(body.seeding.initial_velocity.empty(), "\"Initial velocity\" of " + quoted(body.name));
    }
  } // namespace


  void check_case(const Parameters &parameters)
  {
    require_entry(parameters.gravity.size() == parameters.dimension,
                  "",
                  "Gravity",
                  number_text(parameters.gravity),
                  "entry \"Dimension\" is " + std::to_string(parameters.dimension) + ". Write " +
                      std::to_string(parameters.dimension) + " components in m/s^2, separated by commas.");
    require_entry(parameters.dimension == 3 || (parameters.local_origin[0] == 0. && parameters.local_origin[1] == 0.),
                  "",
                  "Local origin",
                  number_text(parameters.local_origin),
                  "a scene in the plane has no map. Remove it.");
    require_entry(parameters.dimension == 3 || parameters.coordinate_system.empty(),
                  "",
                  "Coordinate system",
                  parameters.coordinate_system,
                  "a scene in the plane has no map. Remove it.");
    require_entry(
        !parameters.output_directory.empty(), "", "Output directory", "", "name a folder, for instance results/slope");
    parameters.grid.check(parameters.dimension);
    parameters.time_step.check();
    parameters.transfer.check();
    parameters.output.check(parameters.end_time);
    parameters.output.maps.check(!parameters.bodies.empty(), parameters.dimension);
    parameters.boundaries.check(parameters.dimension);
    parameters.bed.check(parameters.dimension);
    check_type_for_water(parameters, parameters.bed);
    for (const ObstacleParameters &obstacle : parameters.obstacles)
      {
        obstacle.check(parameters.dimension);
        check_type_for_water(parameters, obstacle.surface);
      }
    check_what_enters(parameters);
    parameters.surface_load.check(parameters.grid, parameters.dimension);
    parameters.body_forces.check(parameters.dimension);
    parameters.settling.check(parameters.gravity);
    parameters.safety.check();
    parameters.probes.check(parameters.grid, parameters.dimension, !parameters.bodies.empty());
    for (const auto &body : parameters.bodies)
      body.check(parameters.gravity, parameters.has_water ? &parameters.water : nullptr);
    check_contacts(parameters);
    check_mass_scaling(parameters);
    check_points_of_water(parameters);
    require_entry(parameters.bed.turbulent_friction == 0. || !parameters.has_water,
                  "Bed",
                  "Turbulent friction",
                  parameters.bed.turbulent_friction,
                  "it acts on dry soil only. Remove it, or subsection Water.");
    if (parameters.has_water)
      check_water(parameters);
    if (parameters.bodies.empty())
      check_without_soil(parameters);
  }
} // namespace scree
