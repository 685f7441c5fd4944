// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/seeding/seeding.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    void check_type_for_water(const Parameters &parameters, const BedParameters &surface)
    {
      const auto require = [&](const bool possible, const std::string &remedy) {
        require_entry(
            possible || !surface.no_slip(), { surface.subsection, "Type for water", surface.for_water }, remedy);
      };
      require(parameters.has_water, "this entry has no effect, as there is no subsection Water. Remove it.");
      require(
          parameters.water.viscosity > 0.,
          "water without viscosity slips along anything. Write a \"Viscosity\" in subsection Water, or impermeable.");
    }


    void check_place(const Parameters &parameters, const BedParameters &surface, const bool has_to_be_in_box)
    {
      const GridParameters &grid = parameters.grid;
      const auto &lower = grid.lower_corner, &upper = grid.upper_corner;
      try
        {
          parameters.dimension == 2 ? surface.check_place<2>(lower, upper, grid.cell_size, has_to_be_in_box)
                                    : surface.check_place<3>(lower, upper, grid.cell_size, has_to_be_in_box);
        }
      catch (const ValueError &error) // its expression
        {
          throw EntryError(error.what());
        }
    }


    void check_inflow(const Parameters &parameters, const InflowParameters &inflow)
    {
      const BodyParameters *body     = parameters.find_body(inflow.body);
      std::vector<std::string> names = names_of(parameters.bodies);
      if (parameters.has_water)
        names.push_back("Water");
      require_entry(body != nullptr || (inflow.is_water() && parameters.has_water),
                    { inflow.subsection, "Body", inflow.body },
                    inflow.is_water() ? "there is no subsection Water. Add one, or write the name of a body."
                                      : "write what enters: " + boost::algorithm::join(names, ", ") + ".");
      require_entry(body == nullptr || !body->is_rigid(),
                    { inflow.subsection, "Body", inflow.body },
                    "a body of \"Material = rigid\" does not move. Write another one.");
      require_entry(!parameters.has_water || parameters.water.point_sets_kind() == PointSets::double_point,
                    { "Water", "Point sets", parameters.water.point_sets },
                    "with subsection " + inflow.subsection +
                        " water needs points of its own. Write double, or remove the inflow.");
      if (inflow.is_saturated)
        {
          const auto require = [&](const bool possible, const std::string &remedy) {
            require_entry(possible, { inflow.subsection, "Saturated", "true" }, remedy);
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
          { "Water", "Points per cell", water.points_per_cell },
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


    void check_skeleton_damping(const Parameters &parameters)
    {
      const double damping = parameters.stabilisation.skeleton_damping;
      require_entry(damping == 0. || damping == StabilisationParameters().skeleton_damping ||
                        parameters.damps_skeleton(),
                    { "Stabilisation", "Skeleton damping", damping },
                    "this entry has no effect without water, or where ground and walls have no friction. Remove it.");
    }


    void check_contacts(const Parameters &parameters)
    {
      parameters.contact_groups();
      for (const ContactParameters &contact : parameters.contacts)
        {
          const auto require = [&contact](const bool possible, const std::string &what) {
            require_entry(possible || !contact.is_set(),
                          { contact.subsection, "Bodies", contact.bodies },
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
      for (const Wall &wall : parameters.water_boundaries.walls(parameters.dimension))
        require_entry(wall.holds != Wall::Holds::nothing || wall.pressure >= parameters.pressure.cavitation_pressure,
                      { "Water/Pressure", "Cavitation pressure", parameters.pressure.cavitation_pressure },
                      "a drained wall in subsection Boundaries/Water prescribes less: " + number_text(wall.pressure) +
                          " Pa. Water cavitates there. Write a lower number, or a higher pressure at the wall.");
      if (parameters.water.is_where_soil_is())
        for (const SoilRegion &body : parameters.soil_regions())
          require_pores(body);
    }


    void check_without_soil(const Parameters &parameters)
    {
      const std::string no_soil = "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it";
      for (const auto &[face, wall] : parameters.boundaries.texts)
        require_entry(wall == BoundaryParameters().texts.at(face),
                      { "Boundaries", face, wall },
                      no_soil + ", or move it to subsection Water of subsection Boundaries.");
      require_entry(!parameters.surface_load.is_set(),
                    { "Surface load", "Traction", parameters.surface_load.traction },
                    no_soil + '.');
      require_entry(parameters.settling.maximum_time == 0,
                    { "Settling", "Maximum time", parameters.settling.maximum_time },
                    no_soil + '.');
    }


    /// What depends on the true inertia.
    void check_mass_scaling(const Parameters &parameters)
    {
      const auto require = [&](const bool possible, const std::string &what) {
        require_entry(possible || parameters.time_step.mass_scaling == 1.,
                      { "Time step", "Mass scaling", parameters.time_step.mass_scaling },
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


    void check_absorbing_walls(const Parameters &parameters)
    {
      const auto walls  = parameters.boundaries.walls(parameters.dimension);
      const auto names  = FaceEntries::names(parameters.dimension);
      const auto varies = [](const auto &forces) {
        return std::any_of(forces.begin(), forces.end(), [](const auto &force) { return !force->is_uniform(); });
      };
      for (unsigned int face = 0; face < walls.size(); ++face)
        {
          const auto require = [&](const bool possible, const std::string &remedy) {
            require_entry(possible || !walls[face].absorbs, { "Boundaries", names[face], "absorbing" }, remedy);
          };
          const auto require_without = [&](const bool possible, const std::string &what) {
            require(possible,
                    "it is not possible with " + what + " yet. Remove that, or write " +
                        BoundaryParameters().texts.at(names[face]) + '.');
          };
          require(names[face] != "Top", "no ground goes on above the soil. Write open.");
          require_without(!parameters.has_water, "subsection Water, whose pressure waves it would reflect,");
          require_without(parameters.contact_groups().n == 1, "bodies that slide");
          require_without(parameters.time_step.mass_scaling == 1., "\"Mass scaling\"");
          require_without(!(parameters.dimension == 2 ? varies(parameters.body_forces.make<2>())
                                                      : varies(parameters.body_forces.make<3>())),
                          "\"Body force\"");
          for (const InflowParameters &inflow : parameters.inflows)
            require_without(inflow.face_number(parameters.dimension) != face,
                            "subsection " + inflow.subsection + " at this wall");
        }
    }
  } // namespace


  void check_case(const Parameters &parameters)
  {
    require_entry(parameters.gravity.size() == parameters.dimension,
                  { "", "Gravity", number_text(parameters.gravity) },
                  "entry \"Dimension\" is " + std::to_string(parameters.dimension) + ". Write " +
                      std::to_string(parameters.dimension) + " components in m/s^2, separated by commas.");
    require_entry(parameters.dimension == 3 || (parameters.local_origin[0] == 0. && parameters.local_origin[1] == 0.),
                  { "", "Local origin", number_text(parameters.local_origin) },
                  "a scene in the plane has no map. Remove it.");
    require_entry(parameters.dimension == 3 || parameters.coordinate_system.empty(),
                  { "", "Coordinate system", parameters.coordinate_system },
                  "a scene in the plane has no map. Remove it.");
    require_entry(!parameters.output_directory.empty(),
                  { "", "Output directory", "" },
                  "name a folder, for instance results/slope");
    parameters.grid.check(parameters.dimension);
    parameters.time_step.check();
    parameters.transfer.check();
    parameters.output.check(parameters.end_time);
    parameters.output.maps.check(!parameters.bodies.empty(), parameters.dimension);
    parameters.boundaries.check(parameters.dimension);
    parameters.bed.check(parameters.dimension);
    check_type_for_water(parameters, parameters.bed);
    if (parameters.bed.geometry().first == "Level set expression") // Others have ground down to the bottom.
      check_place(parameters, parameters.bed, false);
    for (const ObstacleParameters &obstacle : parameters.obstacles)
      {
        obstacle.check(parameters.dimension);
        check_type_for_water(parameters, obstacle.surface);
        if (obstacle.surface.is_set())
          check_place(parameters, obstacle.surface, !obstacle.is_moving()); // What moves may come in later.
      }
    check_what_enters(parameters);
    parameters.surface_load.check(parameters.grid, parameters.dimension);
    parameters.body_forces.check(parameters.dimension);
    parameters.settling.check(parameters.gravity);
    parameters.probes.check(parameters.grid, parameters.dimension);
    for (const auto &body : parameters.bodies)
      body.check(parameters.gravity, parameters.has_water ? &parameters.water : nullptr);
    check_contacts(parameters);
    check_mass_scaling(parameters);
    check_absorbing_walls(parameters);
    check_points_of_water(parameters);
    check_skeleton_damping(parameters);
    require_entry(parameters.bed.turbulent_friction == 0. || !parameters.has_water,
                  { "Bed", "Turbulent friction", parameters.bed.turbulent_friction },
                  "it acts on dry soil only. Remove it, or subsection Water.");
    if (parameters.has_water)
      check_water(parameters);
    if (parameters.bodies.empty())
      check_without_soil(parameters);
  }


  namespace
  {
    /// Bodies that shear within themselves before they slide on a base of this friction coefficient.
    void add_stronger_base(const Parameters &parameters,
                           const std::string &subsection,
                           const std::string &entry,
                           const double friction,
                           std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1.005; // an angle with three digits
      for (const BodyParameters &body : parameters.bodies)
        if (const double inside = make_material<2>(body.material)->plane_friction; friction > rounding * inside)
          remarks.push_back(
              "Base stronger than the soil: " +
              entry_message(
                  { subsection, entry, number_text(std::atan(friction) * 180 / dealii::numbers::PI) + " degrees" },
                  body.name + " shears on a plane at " + number_text(std::atan(inside) * 180 / dealii::numbers::PI) +
                      " degrees. It does not slide on this base, and its lowest cells shear as on a fixed "
                      "one. An angle of repose is \"Friction angle kind = direct shear or repose\"."));
    }


    /// Shear bands of a length that the cells do not resolve.
    void add_unresolved_length(const BodyParameters &body, const double cell_size, std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1e-9;
      const double length       = make_material<2>(body.material)->nonlocal_variable.length;
      if (length > 0 && cell_size > length / 2 * (1 + rounding))
        remarks.push_back("Unusual value: " +
                          entry_message({ body.material.path(body.name), "Nonlocal length", number_text(length) },
                                        "shear bands depend on cells wider than half of it, here " +
                                            number_text(cell_size) + " m. Use cells of at most " +
                                            number_text(length / 2) + " m."));
    }


    /// Cohesion without a tensile strength in water.
    void add_opening_soil(const BodyParameters &body, std::vector<std::string> &remarks)
    {
      if (body.material.law != "Mohr-Coulomb")
        return;
      const auto &law = body.material.of<MohrCoulombParameters>();
      if ((law.cohesion > 0. || !law.cohesion_of_place.empty()) && law.tension_cut_off == 0. && law.cut_off != "auto")
        remarks.push_back(
            "Unusual value: " +
            entry_message(
                { body.material.path(body.name), "Tension cut-off", "0" },
                "with cohesion, here " +
                    (law.cohesion_of_place.empty() ? number_text(law.cohesion) + " Pa" : law.cohesion_of_place) +
                    ", soil in water opens as soon as it shears, and the suction of the pores slows it. "
                    "Write auto, or a cut-off above 0, such as the cohesion."));
    }


    /// A water table more than a cell above the ground, where no free water stands. Collective.
    template <int dim>
    void add_table_above_ground(const Parameters &parameters,
                                const std::list<SoilBody<dim>> &bodies,
                                const MPI_Comm communicator,
                                std::vector<std::string> &remarks)
    {
      const auto [entry, value] = parameters.water.place();
      if (entry.rfind("Phreatic", 0) != 0 || !parameters.water.reservoir_level.empty())
        return;
      const Region<dim> wet(entry_name("Water", entry),
                            parameters.water.without_fringe().region_in_soil(dim),
                            nullptr,
                            parameters.water.without_fringe().table<dim>());
      const double none        = std::numeric_limits<double>::lowest();
      const auto &lower        = parameters.grid.lower_corner;
      const double h           = parameters.grid.cell_size;
      const unsigned int n     = std::ceil(parameters.grid.lengths()[0] / h);
      const unsigned int n_all = dim == 2 ? n : n * std::ceil(parameters.grid.lengths()[1] / h);
      std::vector<double> ground(n_all, none); // of columns of cells, m
      for (const auto &body : bodies)
        for_each_point(body.points, [&](const auto &point) {
          const Point<dim> &x       = point.location;
          const unsigned int column = int((x[0] - lower[0]) / h) + (dim == 2 ? 0 : n * int((x[1] - lower[1]) / h));
          ground[column]            = std::max(ground[column], x[dim - 1]);
        });
      Utilities::MPI::max(ground, communicator, ground);
      const double top = lower[dim - 1] + parameters.grid.lengths()[dim - 1];
      double highest = h, first = -none, last = none;
      std::string place;
      for (unsigned int column = 0; column < n_all; ++column)
        {
          if (ground[column] == none)
            continue;
          Point<dim> x(dim == 2 ? Point<dim>() : (lower[1] + (column / n + 0.5) * h) * Point<dim>::unit_vector(1));
          x[0]       = lower[0] + (column % n + 0.5) * h;
          x[dim - 1] = ground[column];
          while (x[dim - 1] < top && wet.contains(x + 0.25 * h * Point<dim>::unit_vector(dim - 1)))
            x[dim - 1] += 0.25 * h;
          const double above = x[dim - 1] - ground[column];
          if (above <= h)
            continue;
          first = std::min(first, x[0] - 0.5 * h);
          last  = std::max(last, x[0] + 0.5 * h);
          if (above > highest)
            place = number_text(highest = above) + " m at x = " + number_text(x[0]) +
                    (dim == 2 ? "" : ", y = " + number_text(x[1]));
        }
      if (!place.empty())
        remarks.push_back("Unusual value: " +
                          entry_message({ "Water", entry, value },
                                        "it lies above the ground from x = " + number_text(first) + " to " +
                                            number_text(last) + " m, up to " + place +
                                            " m. No water stands outside the soil: its pores are full, and p is 0 at "
                                            "the ground. Check unit (m) and datum; write a \"Reservoir level\" for "
                                            "water above the ground."));
    }
  } // namespace


  template <int dim>
  std::vector<std::string> remarks_on(const Parameters &parameters,
                                      const std::list<SoilBody<dim>> &bodies,
                                      const std::list<WaterPhase<dim>> &water,
                                      const LevelSet<dim> *ground,
                                      const MPI_Comm communicator)
  {
    std::vector<std::string> remarks = parameters.remarks;
    add_unusual_values(parameters, bodies, water, ground, communicator, remarks);
    for (const BodyParameters &body : parameters.bodies)
      add_unresolved_length(body, parameters.grid.cell_size, remarks);
    const auto walls = parameters.boundaries.walls(3);
    const auto names = FaceEntries::names(3);
    for (unsigned int face = 0; face < walls.size(); ++face)
      if (names[face] == "Bottom")
        add_stronger_base(parameters, "Boundaries", names[face], walls[face].friction_coefficient, remarks);
    if (parameters.bed.type_kind() == BedType::friction)
      add_stronger_base(parameters, "Bed", "Friction angle", parameters.bed.friction_coefficient(), remarks);
    if (parameters.has_water)
      {
        for (const BodyParameters &body : parameters.bodies)
          add_opening_soil(body, remarks);
        add_table_above_ground(parameters, bodies, communicator, remarks);
      }
    return remarks;
  }

  template decltype(remarks_on<2>) remarks_on<2>;
  template decltype(remarks_on<3>) remarks_on<3>;


  namespace
  {
    /// What --resume does with an entry that has changed.
    enum class Change
    {
      free,             ///< goes on
      noted,            ///< goes on, and the log says so
      noted_at_release, ///< the same from the checkpoint of the release, refused from later ones
      refused           ///< stops
    };

    /// Points carry an affine field of velocity with some methods only.
    bool methods_of_same_points(const std::string &before, const std::string &now)
    {
      TransferParameters one, other;
      one.method   = before;
      other.method = now;
      return one.carries_affine_field() == other.carries_affine_field();
    }

    struct Rule
    {
      std::string subsection, name; // no name: all entries of the subsection
      Change change;
      bool (*holds_for)(const std::string &before, const std::string &now) = nullptr; ///< null: for any values
    };

    /// Entries without a rule must not change.
    const std::vector<Rule> rules{ { "", "End time", Change::free },
                                   { "", "Output directory", Change::free },
                                   { "", "Coordinate system", Change::free },
                                   { "Output", "", Change::free },
                                   { "Output/Maps", "Format", Change::free },
                                   { "Time step", "Mass scaling", Change::refused },
                                   { "Time step", "", Change::noted },
                                   { "Safety", "Strength factor", Change::noted_at_release },
                                   { "Safety", "", Change::noted },
                                   { "Transfer", "Method", Change::noted, methods_of_same_points },
                                   { "Transfer", "PIC rate", Change::noted },
                                   { "Water/Pressure", "Relative tolerance", Change::noted },
                                   { "Water/Pressure", "Maximum iterations", Change::noted } };

    /// What the first step of a stage reads anew.
    const std::vector<Rule> rules_of_stages{ { "Stage", "", Change::free },
                                             { "Boundaries", "", Change::noted },
                                             { "Boundaries/Water", "", Change::noted },
                                             { "Bed", "Friction angle", Change::noted },
                                             { "Settling", "", Change::free },
                                             { "Safety", "", Change::noted } };

    /// Entries of laws that a stage may change: strengths, which the points do not have from the start on.
    const std::set<std::string> strengths{
      "Friction angle",          "Dilation angle",          "Cohesion",          "Tension cut-off", "Softening strain",
      "Residual friction angle", "Residual dilation angle", "Residual cohesion", "Consistency",     "Flow index"
    };

    /// Whether points have the strength of the law of this subsection from their place.
    bool varies(const CaseEntries &entries, const std::string &subsection)
    {
      const auto is_text = [&](const std::string &name) {
        const CaseEntry *entry = entries.find(subsection, name);
        return entry && std::isnan(number_of(entry->value));
      };
      return is_text("Cohesion") || is_text("Friction angle");
    }


    Change kind_of(const CaseEntry &entry, const CaseEntry *before, const CaseEntry *now, const bool begins_stage)
    {
      if (begins_stage)
        for (const Rule &rule : rules_of_stages)
          if (rule.subsection == entry.subsection && (rule.name.empty() || rule.name == entry.name))
            return rule.change;
      if (begins_stage && before && now && strengths.count(entry.name) > 0)
        return Change::noted;
      for (const Rule &rule : rules)
        if (rule.subsection == entry.subsection && (rule.name.empty() || rule.name == entry.name))
          return rule.change == Change::free ||
                         (before && now && (!rule.holds_for || rule.holds_for(before->value, now->value)))
                     ? rule.change
                     : Change::refused;
      return Change::refused;
    }


    std::string value_text(const CaseEntry *entry)
    {
      return !entry ? "no such entry" : entry->value.empty() ? "(empty)" : entry->value;
    }
  } // namespace


  std::vector<std::string>
  notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &now, const bool begins_stage)
  {
    struct Refused
    {
      std::string name;   // of entry or subsection, as messages begin
      std::string now;    // ` = 3`; of a subsection nothing
      std::string before; // `2`; of a subsection whether there was one
    };
    const CaseEntries &before = checkpoint.entries;
    std::vector<std::string> notes;
    std::vector<Refused> refused;
    std::map<std::string, std::string> subsections; // that one of the cases has, and whether there was one
    const auto compare = [&](const CaseEntry &entry, const CaseEntry *was, const CaseEntry *is, const bool in_both) {
      if (was && is && same_value(*was, *is))
        return;
      Change kind = kind_of(entry, was, is, begins_stage);
      if ((entry.name == "Cohesion" || entry.name == "Friction angle") && kind == Change::noted &&
          (varies(before, entry.subsection) || varies(now, entry.subsection)))
        kind = Change::refused; // Points have it from the start on.
      if (kind == Change::noted_at_release)
        kind = checkpoint.step > 0 ? Change::refused : Change::noted;
      const bool are_files = was && is && !was->checksum.empty() && !is->checksum.empty();
      const Refused change{ entry_name(entry.subsection, entry.name),
                            " = " + value_text(is),
                            value_text(was) + (are_files ? " with other contents" : "") };
      if (kind == Change::refused && in_both)
        refused.push_back(change);
      else if (kind == Change::refused)
        subsections[entry.subsection] = is ? "none" : "one";
      else if (kind == Change::noted && in_both)
        notes.push_back("Changed from here on: " + change.name + change.now + ", before " + change.before + '.');
    };
    for (const CaseEntry &entry : now.all())
      compare(entry, before.find(entry.subsection, entry.name), &entry, before.has_subsection(entry.subsection));
    for (const CaseEntry &entry : before.all())
      if (!now.find(entry.subsection, entry.name))
        compare(entry, &entry, nullptr, now.has_subsection(entry.subsection));
    // Whole subsections come last, at the top first: they say what has happened.
    for (const bool at_top : { true, false })
      for (const auto &[path, was] : subsections)
        if (at_top == (path.find('/') == std::string::npos))
          refused.push_back({ "subsection " + path, "", was });
    if (refused.empty())
      return notes;
    constexpr unsigned int most_names = 4;
    std::string others;
    for (unsigned int d = 1; d < std::min<std::size_t>(refused.size(), most_names); ++d)
      others += (others.empty() ? " Changed, too: " : "; ") + refused[d].name;
    if (refused.size() > most_names)
      others += "; and " + std::to_string(refused.size() - most_names) + " more";
    const Refused &first = refused.front();
    throw EntryError(
        first.name + first.now + ": " +
        (begins_stage ? "before this stage the case has " : "the run that wrote " + checkpoint.folder + " had ") +
        first.before +
        (begins_stage ? ", and a stage cannot change that. Write it as it was."
                      : ", and --resume cannot change that. Write it as it was, or run without --resume "
                        "in another \"Output directory\".") +
        (first.name == entry_name("Safety", "Strength factor")
             ? " A copy of the run folder with no checkpoint but step-0 goes on from the release."
             : "") +
        others + (others.empty() ? "" : "."));
  }
} // namespace scree
