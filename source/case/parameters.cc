// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/case/parameters.h>
#include <scree/io/progress.h>

#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// How far above the ground's highest place the body may reach, m; of one by an expression this is not known: a
    /// quarter of the relief and ten cells.
    double room_for(const BodyParameters &body,
                    const BedParameters &bed,
                    const double highest,
                    const double relief,
                    const double cell_size)
    {
      const SourceMapParameters &source = body.seeding.source;
      const auto largest                = [&](const std::string &entry, const std::string &file) {
        return read_raster(file, entry_name(body.name, entry), bed.map_origin).range().second;
      };
      if (source.has_one_thickness())
        return number_of(source.thickness);
      if (!source.thickness.empty())
        return largest("Thickness", source.thickness);
      if (!source.upper_surface.empty())
        return std::max(0., largest("Upper surface", source.upper_surface) - highest);
      if (!source.outline.empty() && !body.seeding.has_expression())
        return read_outline(source.outline, entry_name(body.name, "Outline"), bed.map_origin)
            .range_of_thickness()
            .second;
      return 0.25 * relief + 10. * cell_size;
    }


    /// Numbers as they must be written to be the same when they are read again, within 15 digits.
    std::string exact_text(const std::vector<double> &numbers)
    {
      std::vector<std::string> words;
      for (const double number : numbers)
        words.push_back(formatted("%.15g", number));
      return boost::algorithm::join(words, ", ");
    }


    /// The coordinate system of the case's maps, see Raster::system: that of entry `Coordinate system`, else that of
    /// the first raster that has one; empty if none is known. Throws EntryError if the entry is no such system, or if
    /// rasters or outlines have others.
    std::string system_of_maps(const Parameters &parameters)
    {
      if (parameters.dimension != 3)
        return "";
      std::string system = parameters.coordinate_system, source;
      if (!system.empty())
        {
          source = entry_name("", "Coordinate system");
          require_system_in_metres(system, source + " = " + system + ": ");
        }
      // A place of the map.
      const dealii::Point<2> place(parameters.local_origin[0] + parameters.grid.lower_corner[0],
                                   parameters.local_origin[1] + parameters.grid.lower_corner[1]);
      const auto compare =
          [&](const std::string &own, const std::string &entry, const std::string &file, const std::string &remedy) {
            if (!own.empty() && !system.empty() && !is_same_system(system, own, place))
              throw EntryError(entry + " = " + file + ": its coordinate system is " + name_of_system(own) +
                               ", but that of " + source + " is " + name_of_system(system) +
                               ". All maps of a case must have the same one: " + remedy);
          };
      const auto compare_raster =
          [&](const std::string &subsection, const std::string &entry, const std::string &file) {
            if (file.empty() || !std::isnan(number_of(file)))
              return;
            const std::string name = entry_name(subsection, entry), own = read_raster_system(file, name);
            if (system.empty() && !own.empty())
              system = own, source = name + " = " + file;
            compare(own, name, file, "convert the raster with gdalwarp -t_srs.");
          };
      compare_raster(parameters.bed.subsection, "Raster", parameters.bed.raster());
      for (const ObstacleParameters &obstacle : parameters.obstacles)
        compare_raster(obstacle.surface.subsection, "Raster", obstacle.surface.raster());
      for (const BodyParameters &body : parameters.bodies)
        {
          compare_raster(body.name, "Thickness", body.seeding.source.thickness);
          compare_raster(body.name, "Upper surface", body.seeding.source.upper_surface);
        }
      for (const BodyParameters &body : parameters.bodies)
        if (const std::string name = entry_name(body.name, "Outline"), &file = body.seeding.source.outline;
            !file.empty())
          compare(read_outline_system(file, name), name, file, "convert the outline with ogr2ogr -t_srs.");
      if (parameters.output.maps.write && parameters.output.maps.format != "ASCII grid" && !system.empty())
        require_system_in_metres(system, source + ": its coordinate system is " + name_of_system(system) + ": ");
      return system;
    }
  } // namespace


  void BodyParameters::check(const std::vector<double> &gravity, const WaterParameters *water) const
  {
    seeding.check(name, gravity.size());
    require_entry(conductivity_text == "auto" || (conductivity >= 1e-20 && std::isfinite(conductivity)),
                  { name, "Hydraulic conductivity", conductivity_text },
                  "write auto, or a number from 1e-20 on, in m/s; 1e-12 is as good as impermeable.");
    require_entry(water != nullptr || conductivity == 0,
                  { name, "Hydraulic conductivity", conductivity_text },
                  "this entry has no effect, as the file has no subsection Water. Add one, or remove the entry.");
    material.check(name);
    initial_state.check(name, gravity);
    if (initial_state.is_k0() && initial_state.k0 == "auto" && material.law == "Mohr-Coulomb")
      require_entry(material.of<MohrCoulombParameters>().friction_angle_of_place.empty(),
                    { subsection_path(name, "Initial state"), "K0", "auto" },
                    "the friction angle differs from place to place. Write a number.");
    if (is_rigid())
      check_rigid();
  }


  void SafetyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Safety");
    prm.add_parameter("Strength factor",
                      strength_factor,
                      "Factor by which a run divides the strength of the soil, and the friction of bases, contacts and "
                      "walls, from the release on. --safety searches it; there it must be 1.",
                      Patterns::Double(1e-3, 1e3));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "--safety: largest difference between the smallest factor that fails and the largest one that "
                      "rests.",
                      Patterns::Double(1e-4, 1));
    prm.add_parameter("Displacement",
                      displacement,
                      "--safety: the slope fails where 1 % of the soil has moved by more than this, over the height of "
                      "the slope. Write more for soil so soft that it deforms as much without failure. It also bounds "
                      "the displacement while the soil settles.",
                      Patterns::Double(1e-6, 10));
    prm.add_parameter("Bodies not reduced",
                      unreduced,
                      "Bodies that keep their strength, for instance a foundation or a wall whose failure is not asked "
                      "for. The friction of bed, walls, obstacles and contacts is divided all the same.",
                      Patterns::List(Patterns::Anything()));
    prm.leave_subsection();
  }


  void StageParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Stage");
    prm.add_parameter("Duration",
                      duration,
                      "s; from the end of its settling. 0: it ends when the soil has settled.",
                      Patterns::Double(0));
    prm.add_parameter("Remove",
                      removed,
                      "Expression of x, y (and z): soil and water where it holds vanish when the stage begins. Empty: "
                      "nothing vanishes.");
    prm.add_parameter(
        "Remove layer",
        removed_layer,
        "2D. Layer of \"Drawing\": soil and water in its areas vanish, in place of \"Remove\". Empty: none.");
    prm.add_parameter("Add",
                      adds,
                      "Names of \"Bodies\" that are not there before, separated by commas; they appear when the stage "
                      "begins, without stress and with dry pores.",
                      Patterns::List(Patterns::Anything()));
    prm.leave_subsection();
  }


  Parameters::Parameters()
  {
    name_bodies();
    obstacles.emplace_back(ObstacleParameters::prefix + "Wall");
    inflows.emplace_back(InflowParameters::prefix + "Torrent");
    contacts.emplace_back(ContactParameters::prefix + "Base");
    declare(handler);
    declare_water(handler);
    inflows.clear(); // It is there to be printed, and nothing reads entries into it.
  }


  Parameters::Parameters(const std::string &file_name, const std::string &stage_name)
      : case_file(file_name)
      , file(file_name)
  {
    try
      {
        name_bodies();
        take_stages(stage_name);
        for (const std::string &subsection : named_subsections(ObstacleParameters::prefix, "obstacle"))
          obstacles.emplace_back(subsection);
        for (const std::string &subsection : named_subsections(InflowParameters::prefix, "inflow"))
          inflows.emplace_back(subsection);
        for (const std::string &subsection : file.subsections(ContactParameters::prefix))
          contacts.emplace_back(subsection);
        has_water = file.has_subsection("Water");
        // Suggestions include water's entries also where a dry run's list of all entries leaves them out: read again,
        // that list must not make the scene wet.
        ParameterHandler all;
        declare(all);
        declare_water(all);
        file.check(all, "scree --print-parameters lists all of them.", [&](const std::string &subsection) {
          return unlisted_body(subsection);
        });
        if (!has_water)
          check_dry();
        declare(handler);
        if (has_water)
          declare_water(handler);
        named_files = file.named_files(all);
        std::istringstream text(file.statements_text());
        handler.parse_input(text, file_name);
        find_unread_laws(all);
        end_time += duration_so_far;
        bed.map_origin = Point<2>(local_origin[0], local_origin[1]);
        for (ObstacleParameters &obstacle : obstacles)
          obstacle.surface.map_origin = bed.map_origin;
        water.is_fed = rain.is_set();
        for (const InflowParameters &inflow : inflows)
          {
            water.is_fed = water.is_fed || inflow.is_water() || inflow.is_saturated;
            for (BodyParameters &body : bodies)
              body.seeding.is_fed = body.seeding.is_fed || inflow.body == body.name;
          }
        take_box_from_raster();
        take_unit_weights();
        check_stages();
        for (BodyParameters &body : bodies)
          body.material.complete(body.name, has_water);
        check_case(*this);
        map_system = system_of_maps(*this);
        read_maps();
        read_drawing();
        if (has_water)
          water.check_wall_heads(grid.lower_corner, grid.upper_corner);
        water.find_fringe(size_of_gravity());
        // In a case that settles it acts at the release.
        if (safety.strength_factor != 1. && (settling.maximum_time == 0. || !stage.name.empty()))
          reduce_strength(safety.strength_factor);
        time_step.choose(has_water, transfer.courant_number(has_water), size_of_gravity(), grid.cell_size);
        if (damps_skeleton())
          time_step.courant_number = std::min(time_step.courant_number, stabilisation.courant_number());
        transfer.choose_rate(size_of_gravity(), wave_speed(), grid.cell_size);
        if (transfer.rate == "auto")
          transfer.pic_rate /= std::sqrt(time_step.mass_scaling);
      }
    catch (const EntryError &error)
      {
        throw file.error(error.what());
      }
    catch (const ExceptionBase &error)
      {
        throw file.error(plain_text(error));
      }
  }


  void Parameters::name_bodies()
  {
    // The names of the bodies are names of subsections: the declarations need them.
    static const std::set<std::string> taken{ "Mesh",     "Time step",   "Transfer", "Stabilisation", "Boundaries",
                                              "Settling", "Output",      "Water",    "Surface load",  "Probes",
                                              "Bed",      "Base motion", "Safety",   "Stage" };
    const std::string names = file.value("", "Bodies", "Soil");
    if (names == "none")
      return;
    std::set<std::string> seen;
    for (const std::string &name : Utilities::split_string_list(names))
      {
        const bool is_new   = seen.insert(name).second;
        const bool is_taken = taken.count(name) > 0 || name.rfind(ObstacleParameters::prefix, 0) == 0 ||
                              name.rfind(InflowParameters::prefix, 0) == 0 ||
                              name.rfind(ContactParameters::prefix, 0) == 0 ||
                              name.rfind(StageParameters::prefix, 0) == 0;
        require_entry(!name.empty() && is_new && !is_taken && name != "none",
                      { "", "Bodies", names },
                      (name.empty()     ? "a name is missing"
                       : !is_new        ? quoted(name) + " stands there twice"
                       : name == "none" ? "\"none\" stands for no body at all"
                                        : quoted(name) + " is the name of another subsection") +
                          ". Write names of your own, separated by commas.");
        bodies.emplace_back();
        bodies.back().name = name;
      }
  }


  std::vector<std::string> Parameters::named_subsections(const std::string &prefix, const std::string &kind) const
  {
    std::set<std::string> seen;
    const auto subsections = file.subsections(prefix);
    for (const std::string &subsection : subsections)
      if (!seen.insert(lower_case(subsection)).second)
        throw EntryError("subsection " + subsection + ": another " + kind +
                         "'s name differs from it by case only, and so would the columns of the "
                         "statistics. Write another name.");
    return subsections;
  }


  std::string Parameters::unlisted_body(const std::string &subsection) const
  {
    if (subsection + ' ' == ObstacleParameters::prefix)
      return "An obstacle has a name. Write subsection Obstacle Wall, or another name.";
    if (subsection + ' ' == InflowParameters::prefix)
      return "An inflow has a name. Write subsection Inflow Torrent, or another name.";
    if (subsection + ' ' == ContactParameters::prefix)
      return "A contact has a name. Write subsection Contact Base, or another name.";
    if (subsection == "Stage")
      return "A stage has a name. Write subsection Stage Excavation, or another name.";
    if (!(file.sets(subsection, "Region") || file.sets(subsection, "Layer")) ||
        subsection.find('/') != std::string::npos)
      return "";
    return "It is no body either: entry \"Bodies\" lists " + file.value("", "Bodies", "Soil") + ". Add " +
           quoted(subsection) + " there.";
  }


  void Parameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Dimension", dimension, "2 (plane strain) or 3.", Patterns::Integer(2, 3));
    prm.add_parameter("End time", end_time, "s; simulated time at which the run ends.", Patterns::Double(1e-12));
    prm.add_parameter("Output directory",
                      output_directory,
                      "Run folder; created if missing. The path is relative to the working directory. Paths of all "
                      "other files are relative to the folder of the case file.");
    prm.add_parameter("Gravity",
                      gravity,
                      "m/s^2; acceleration of gravity, one component per axis.",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter(
        "Bodies",
        body_names,
        "Names of the soil bodies, separated by commas; each has a subsection of its name. none: no soil.",
        Patterns::List(Patterns::Anything(), 1));
    prm.add_parameter("Local origin",
                      local_origin,
                      "m; 3D. Map coordinates of the place x = 0, y = 0 of the case. Rasters, outlines and written "
                      "maps use map coordinates; everything else is relative to this place.",
                      Patterns::List(Patterns::Double(), 2, 2));
    add_file_entry(prm,
                   "Drawing",
                   drawing,
                   "m; 2D. Section with the layers that \"Layer\" of bodies, \"Phreatic layer\" of Water and \"Remove "
                   "layer\" of stages name: GeoJSON, shapefile, GeoPackage, DXF or CSV. A layer is the attribute name, "
                   "in DXF the layer, or the first column of CSV rows name, x, y.");
    prm.add_parameter("Coordinate system",
                      coordinate_system,
                      "3D. Coordinate system of rasters and written maps, for instance EPSG:2056. Empty: that of the "
                      "rasters, if one of them has a coordinate system or a .prj file.");
    body_forces.add_parameters(prm);
    grid.add_parameters(prm);
    time_step.add_parameters(prm);
    transfer.add_parameters(prm);
    stabilisation.add_parameters(prm);
    for (auto &body : bodies)
      body.add_parameters(prm);
    boundaries.add_parameters(prm);
    bed.add_parameters(prm);
    for (ObstacleParameters &obstacle : obstacles)
      obstacle.add_parameters(prm);
    for (InflowParameters &inflow : inflows)
      inflow.add_parameters(prm);
    rain.add_parameters(prm);
    for (ContactParameters &contact : contacts)
      contact.add_parameters(prm);
    surface_load.add_parameters(prm);
    settling.add_parameters(prm);
    safety.add_parameters(prm);
    if (!stage.name.empty() || case_file.empty())
      stage.add_parameters(prm);
    output.add_parameters(prm);
    probes.add_parameters(prm);
  }


  void Parameters::take_box_from_raster()
  {
    if (bed.raster().empty() || dimension != 3 || file.sets("Mesh", "Lower corner") ||
        file.sets("Mesh", "Upper corner"))
      return;
    const Raster raster          = read_raster(bed.raster(), entry_name(bed.subsection, "Raster"), bed.map_origin);
    const auto [lowest, highest] = raster.range();
    require_entry(lowest <= highest,
                  { bed.subsection, "Raster", bed.raster() },
                  "all its heights are missing (NODATA). Look at the file.");
    double room = 0.;
    for (const BodyParameters &body : bodies)
      room = std::max(room, room_for(body, bed, highest, highest - lowest, grid.cell_size));
    const std::vector<double> lower{ raster.x, raster.y, grid.cell_size * (std::floor(lowest / grid.cell_size) - 2.) };
    std::vector<double> upper{ raster.last_x(), raster.last_y(), highest + room + 4. * grid.cell_size };
    for (unsigned int a = 0; a < 3; ++a)
      {
        // Along the map the ground must cover whole cells; along z there may be more of them.
        const double cells = (upper[a] - lower[a]) / grid.cell_size;
        upper[a]           = lower[a] + grid.cell_size * (a < 2 ? std::floor(cells + 1e-6) : std::ceil(cells - 1e-6));
      }
    text_of_box = "Box from the raster, in whole cells: from " + number_text(lower) + " to " + number_text(upper) +
                  " m; the raster reaches from " + number_text({ raster.x, raster.y }) + " to " +
                  number_text({ raster.last_x(), raster.last_y() }) + " m, its heights from " + number_text(lowest) +
                  " to " + number_text(highest) + " m";
    set("Mesh", "Lower corner", exact_text(lower));
    set("Mesh", "Upper corner", exact_text(upper));
  }


  void Parameters::read_maps()
  {
    std::shared_ptr<const LevelSet<3>> ground; // read once for all bodies
    for (BodyParameters &body : bodies)
      {
        SeedingParameters &seeding = body.seeding;
        seeding.source.check(body.name, dimension, has_water && !water.region_outside(dimension).empty(), bed.is_set());
        if (!seeding.source.is_set() || !seeding.source.layer.empty())
          continue;
        try
          {
            if (!ground)
              ground = make_bed<3>(bed, grid.lower_corner, grid.upper_corner, 1.);
            seeding.map = std::make_shared<const SourceMap>(seeding.source,
                                                            body.name,
                                                            seeding.has_expression(),
                                                            ground,
                                                            bed.map_origin,
                                                            grid.lower_corner,
                                                            grid.upper_corner);
          }
        catch (const ValueError &error) // the bed's expression
          {
            throw EntryError(error.what());
          }
      }
  }


  void Parameters::read_drawing()
  {
    std::vector<EntryValue> of_bodies, others;
    for (const BodyParameters &body : bodies)
      if (const std::string &layer = body.seeding.source.layer; !layer.empty())
        of_bodies.emplace_back(body.name, "Layer", layer);
    if (!water.phreatic_layer.empty())
      others.emplace_back("Water", "Phreatic layer", water.phreatic_layer);
    if (!stage.removed_layer.empty())
      others.emplace_back(stage.subsection(), "Remove layer", stage.removed_layer);
    for (const auto &entries : { of_bodies, others })
      for (const EntryValue &entry : entries)
        require_entry(!drawing.empty(), entry, "it is a layer of a drawing. Write its file as \"Drawing\".");
    if (drawing.empty())
      return;
    require_entry(dimension == 2, { "", "Drawing", drawing }, "drawings are for plane scenes. Write an \"Outline\".");
    const Drawing file(drawing, entry_name("", "Drawing"));
    const auto map_of = [&](const EntryValue &entry) {
      return std::make_shared<const SourceMap>(entry, file.areas(entry), grid.lower_corner, grid.upper_corner);
    };
    std::vector<EntryValue> at_start; // Bodies of stages may take the place of others.
    for (const EntryValue &entry : of_bodies)
      {
        BodyParameters &body =
            *std::find_if(bodies.begin(), bodies.end(), [&](const auto &one) { return one.name == entry.subsection; });
        body.seeding.map = map_of(entry);
        if (body.added_by.empty())
          at_start.push_back(entry);
        else
          layers_in_use.push_back(entry.value);
      }
    for (const EntryValue &entry : others)
      if (layers_in_use.push_back(entry.value); entry.entry == "Remove layer")
        {
          require_entry(stage.removed.empty(), entry, "\"Remove\" is there, too. Keep one of the two.");
          stage.removed_areas = map_of(entry);
        }
      else
        water.phreatic_line = std::make_shared<const Profile>(file.line(entry));
    const auto of_drawing = file.check(at_start, layers_in_use, grid.cell_size);
    remarks.insert(remarks.end(), of_drawing.begin(), of_drawing.end());
  }


  void Parameters::check_dry() const
  {
    require_entry(!bodies.empty(),
                  { "", "Bodies", "none" },
                  "the scene is empty. Name a body of soil, or add a subsection Water.");
    const std::string subsection = "Boundaries/Water";
    for (const auto &face : FaceEntries::names(3))
      require_entry(!file.sets(subsection, face),
                    { subsection, face, file.value(subsection, face, "") },
                    "this entry has no effect, as the file has no subsection Water. Add one, or remove the entry.");
  }


  void Parameters::find_unread_laws(const ParameterHandler &defaults)
  {
    for (const BodyParameters &body : bodies)
      for (const RegisteredLaw &law : registered_laws())
        {
          const std::string path = subsection_path(body.name, law.subsection);
          if (law.subsection.empty() || path == body.material.path(body.name))
            continue;
          const auto [entry, value] = file.changed_entry(path, defaults);
          if (entry.empty())
            continue;
          const std::string text = entry_message({ path, entry, value },
                                                 "this entry has no effect, as \"Material\" is " + body.material.law +
                                                     ". Write \"Material = " + law.name + "\", or remove the entry.");
          if (!file.sets(body.name, "Material")) // a law by default is hardly meant
            throw EntryError(text);
          remarks.push_back("Unusual value: " + text);
        }
  }


  bool Parameters::damps_skeleton() const
  {
    const auto walls = boundaries.walls(dimension);
    return has_water && stabilisation.skeleton_damping > 0. &&
           (bed.friction_coefficient() > 0. ||
            std::any_of(
                obstacles.begin(),
                obstacles.end(),
                [](const ObstacleParameters &obstacle) { return obstacle.surface.friction_coefficient() > 0.; }) ||
            std::any_of(walls.begin(), walls.end(), [](const Wall &wall) { return wall.lets_lift_off; }));
  }


  namespace
  {
    /// The paths whose last names, or which as a whole, are closest to `path`, in words; empty: none is.
    std::string meant_subsections(const std::vector<std::string> &paths, const std::string &path)
    {
      const auto last_name = [](const std::string &one) { return one.substr(one.rfind('/') + 1); };
      std::vector<std::string> last_names;
      for (const std::string &one : paths)
        last_names.push_back(last_name(one));
      std::vector<std::string> close = nearest(paths, path);
      if (close.empty() || lower_case(close.front()) != lower_case(path))
        if (const auto names = nearest(last_names, last_name(path)); !names.empty())
          {
            close.clear();
            for (const std::string &one : paths)
              if (std::find(names.begin(), names.end(), last_name(one)) != names.end())
                close.push_back(one);
          }
      std::string text;
      for (const std::string &one : close)
        text += (text.empty() ? " Did you mean " : " or ") + quoted(one);
      return text.empty() ? "" : text + '?';
    }
  } // namespace


  void Parameters::print_subsection(const std::string &path, std::ostream &out)
  {
    const auto paths    = subsection_paths(handler);
    const bool is_there = std::find(paths.begin(), paths.end(), path) != paths.end();
    if (!is_there && !case_file.empty() && path.rfind("Soil", 0) != 0)
      try
        {
          return Parameters().print_subsection(path, out); // The case does not have it yet: the defaults.
        }
      catch (const InputError &)
        {
        } // No case has it.
    if (!is_there)
      throw InputError("command line: there is no subsection " + quoted(path) + '.' + meant_subsections(paths, path) +
                       (case_file.empty()
                            ? " scree --print-parameters --sections lists all of them; \"Soil\" stands "
                              "for any body. A case file adds its own names."
                            : " scree " + case_file + " --print-parameters --sections lists all of them."));
    std::stringstream all;
    print(all);
    std::vector<std::string> open; // subsections
    for (std::string line; std::getline(all, line);)
      {
        const std::string statement = Utilities::trim(line);
        if (statement.rfind("subsection ", 0) == 0)
          open.push_back(subsection_path(open.empty() ? "" : open.back(), statement.substr(11)));
        if (!open.empty() && (open.back() + '/').rfind(path + '/', 0) == 0)
          out << line << '\n';
        if (statement == "end")
          open.pop_back();
      }
  }


  void Parameters::set(const std::string &path, const std::string &entry, const std::string &value)
  {
    const std::vector<std::string> subsections = Utilities::split_string_list(path, '/');
    for (const std::string &subsection : subsections)
      handler.enter_subsection(subsection);
    handler.set(entry, value);
    for (unsigned int s = 0; s < subsections.size(); ++s)
      handler.leave_subsection();
  }


  void Parameters::take_stages(const std::string &last)
  {
    stages        = named_subsections(StageParameters::prefix, "stage");
    bool is_later = last.empty();
    for (const std::string &subsection : stages)
      {
        if (subsection.find('/') != std::string::npos)
          throw EntryError("subsection " + subsection + ": a \"/\" divides names of subsections. Write another name.");
        for (const std::string &name : Utilities::split_string_list(file.value(subsection, "Add", "")))
          {
            const auto body =
                std::find_if(bodies.begin(), bodies.end(), [&](const BodyParameters &one) { return one.name == name; });
            require_entry(body != bodies.end(),
                          { subsection, "Add", name },
                          "entry \"Bodies\" lists " + file.value("", "Bodies", "Soil") + ". Add the name there.");
            require_entry(body->added_by.empty(),
                          { subsection, "Add", name },
                          "subsection " + body->added_by + " adds this body already. Remove one of the two.");
            body->added_by = subsection;
            body->is_there = !is_later;
          }
        if (const std::string layer = file.value(subsection, "Remove layer", ""); !layer.empty())
          layers_in_use.push_back(layer);
        (is_later ? later_duration : duration_so_far) += number_of(file.value(subsection, "Duration", "0"));
        is_later = is_later || subsection == last;
      }
    // Those that are there come first: regions and bodies are numbered alike.
    const auto turn = [&](const BodyParameters &body) {
      return body.added_by.empty() ? stages.begin() - 1 : std::find(stages.begin(), stages.end(), body.added_by);
    };
    std::stable_sort(bodies.begin(), bodies.end(), [&](const BodyParameters &a, const BodyParameters &b) {
      return turn(a) < turn(b);
    });
    stage.name = last.substr(std::min(last.size(), std::string(StageParameters::prefix).size()));
    file.take_up_to(StageParameters::prefix, last);
  }


  void Parameters::check_stages() const
  {
    for (const BodyParameters &body : bodies)
      require_entry(body.added_by.empty() || body.initial_state.type == "none",
                    { body.name + "/Initial state", "Type", body.initial_state.type },
                    "subsection " + body.added_by +
                        " adds this body, and its weight gives its stress while the stage "
                        "settles. Write none, and a \"Maximum time\" in subsection Settling.");
    if (dimension == 2 && !stage.removed.empty())
      parse_expression<2>(entry_name(stage.subsection(), "Remove"), stage.removed, 1);
    else if (!stage.removed.empty())
      parse_expression<3>(entry_name(stage.subsection(), "Remove"), stage.removed, 1);
    require_entry(stage.adds.empty() || !grid.is_adaptive(),
                  { stage.subsection(), "Add", boost::algorithm::join(stage.adds, ", ") },
                  "the fine cells of a box of more than 20 000 cells are around the points of the start. Write larger "
                  "cells or a smaller box.");
    if (!stage.name.empty())
      return;
    Checkpoint before; // What is wrong in a stage is said before the case runs.
    before.entries = entries();
    for (const std::string &subsection : stages)
      {
        const Parameters of_stage(case_file, subsection);
        try
          {
            notes_on_changes(before, of_stage.entries(), /* begins_stage */ true);
          }
        catch (const EntryError &error)
          {
            throw of_stage.error(error);
          }
        before.entries = of_stage.entries();
      }
  }


  void Parameters::take_unit_weights()
  {
    for (const BodyParameters &body : bodies)
      {
        const SeedingParameters &seeding = body.seeding;
        if (!seeding.has_unit_weights())
          continue;
        UnitWeights given{ seeding.dry_unit_weight,
                           seeding.saturated_unit_weight,
                           seeding.grain_density,
                           file.sets(body.name, "Grain density"),
                           {} };
        if (const double porosity = body.initial_porosity(); porosity > 0 || seeding.initial_porosity >= 0)
          given.porosity = porosity;
        const GrainsAndPores result = grains_and_pores(body.name, given, size_of_gravity(), water.density);
        require_entry(has_water || seeding.dry_unit_weight > 0,
                      { body.name, "Saturated unit weight", seeding.saturated_unit_weight },
                      "the scene is dry, and the soil would weigh less than this. Write \"Dry unit weight\" (in total "
                      "stress the same value), or add subsection Water.");
        set(body.name, "Grain density", exact_text({ result.grain_density }));
        set(body.name, "Initial porosity", exact_text({ result.porosity }));
      }
  }


  void Parameters::reduce_strength(const double factor)
  {
    set("Safety", "Strength factor", exact_text({ factor })); // for the record, and for the bed's raster of angles
    bool has_strength = false;
    for (const std::string &name : safety.unreduced)
      if (const auto names = names_of(bodies); std::find(names.begin(), names.end(), name) == names.end())
        require_entry(false,
                      { "Safety", "Bodies not reduced", name },
                      "there is no such body. Write some of: " + boost::algorithm::join(names, ", ") + '.');
    for (BodyParameters &body : bodies)
      {
        if (safety.keeps(body.name))
          continue;
        if (body.initial_state.is_k0())
          body.initial_state.k0 = exact_text({ body.k0() }); // of the soil as it is
        has_strength = body.material.divide_strength(factor) || has_strength;
        body.material.check(body.name); // The law must be possible with that strength, too.
      }
    require_entry(has_strength,
                  { "Safety", "Strength factor", factor },
                  "no body has a law with strength that could be reduced. Write another \"Material\", or fewer "
                  "\"Bodies not reduced\".");

    const auto reduce = [factor](double &angle) { angle = divided_angle(angle, factor); };
    reduce(bed.friction_angle);
    for (ObstacleParameters &obstacle : obstacles)
      reduce(obstacle.surface.friction_angle);
    for (ContactParameters &contact : contacts)
      reduce(contact.friction_angle);
    for (auto &[face, wall] : boundaries.texts)
      if (const std::string friction = "friction "; wall.rfind(friction, 0) == 0)
        wall = friction + exact_text({ divided_angle(number_of(wall.substr(friction.size())), factor) });
  }
} // namespace scree
