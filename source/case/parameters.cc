// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/box_of_raster.h>
#include <scree/case/case_checks.h>
#include <scree/case/map_system.h>
#include <scree/case/removed_entries.h>
#include <scree/case/parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace scree
{
  using namespace dealii;

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


  Parameters::Parameters(const std::string &file_name)
      : case_file(file_name)
      , file(file_name)
  {
    try
      {
        name_bodies();
        name_obstacles();
        name_inflows();
        name_contacts();
        has_water = file.has_subsection("Water");
        // Suggestions include water's entries also where a dry run's list of all entries leaves them out: read again,
        // that list must not make the scene wet.
        ParameterHandler all;
        declare(all);
        declare_water(all);
        file.check(
            all,
            "scree --print-parameters lists all of them.",
            [&](const std::string &subsection) {
              const std::string removed = removed_entry_remedy("", subsection, "");
              return removed.empty() ? unlisted_body(subsection) : removed;
            },
            removed_entry_remedy);
        if (!has_water)
          check_dry();
        declare(handler);
        if (has_water)
          declare_water(handler);
        named_files = file.named_files(all);
        std::istringstream text(file.statements_text());
        handler.parse_input(text, file_name);
        find_unread_laws(all);
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
        check_case(*this);
        map_system = system_of_maps(*this);
        read_maps();
        if (has_water)
          water.seepage_start.check_heads(grid.lower_corner, grid.upper_corner);
        water.find_fringe(size_of_gravity());
        if (safety.strength_factor != 1. && settling.maximum_time == 0.) // or else it acts at the release
          reduce_strength(safety.strength_factor);
        time_step.choose(has_water, transfer.courant_number(has_water), size_of_gravity(), grid.cell_size);
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
                                              "Bed",      "Base motion", "Safety" };
    const std::string names = file.value("", "Bodies", "Soil");
    if (names == "none")
      return;
    std::set<std::string> seen;
    for (const std::string &name : Utilities::split_string_list(names))
      {
        const bool is_new   = seen.insert(name).second;
        const bool is_taken = taken.count(name) > 0 || name.rfind(ObstacleParameters::prefix, 0) == 0 ||
                              name.rfind(InflowParameters::prefix, 0) == 0 ||
                              name.rfind(ContactParameters::prefix, 0) == 0;
        require_entry(!name.empty() && is_new && !is_taken && name != "none",
                      "",
                      "Bodies",
                      names,
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
      {
        if (!seen.insert(lower_case(subsection)).second)
          throw EntryError("subsection " + subsection + ": another " + kind +
                           "'s name differs from it by case only, and so would the columns of the "
                           "statistics. Write another name.");
      }
    return subsections;
  }


  void Parameters::name_obstacles()
  {
    for (const std::string &subsection : named_subsections(ObstacleParameters::prefix, "obstacle"))
      obstacles.emplace_back(subsection);
  }


  void Parameters::name_inflows()
  {
    for (const std::string &subsection : named_subsections(InflowParameters::prefix, "inflow"))
      inflows.emplace_back(subsection);
  }


  void Parameters::name_contacts()
  {
    for (const std::string &subsection : file.subsections(ContactParameters::prefix))
      contacts.emplace_back(subsection);
  }


  std::string Parameters::unlisted_body(const std::string &subsection) const
  {
    if (subsection + ' ' == ObstacleParameters::prefix)
      return "An obstacle has a name. Write subsection Obstacle Wall, or another name.";
    if (subsection + ' ' == InflowParameters::prefix)
      return "An inflow has a name. Write subsection Inflow Torrent, or another name.";
    if (subsection + ' ' == ContactParameters::prefix)
      return "A contact has a name. Write subsection Contact Base, or another name.";
    if (!file.sets(subsection, "Region") || subsection.find('/') != std::string::npos)
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
                      "other files are relative to the folder of the case file.",
                      Patterns::Anything());
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
    prm.add_parameter("Coordinate system",
                      coordinate_system,
                      "3D. Coordinate system of rasters and written maps, for instance EPSG:2056. Empty: that of the "
                      "rasters, if one of them has a coordinate system or a .prj file.",
                      Patterns::Anything());
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
    output.add_parameters(prm);
    probes.add_parameters(prm);
  }


  void Parameters::declare_water(ParameterHandler &prm)
  {
    prm.enter_subsection("Water");
    water.add_parameters(prm);
    pressure.add_parameters(prm);
    prm.leave_subsection();
    water_boundaries.add_parameters(prm);
  }


  const BodyParameters *Parameters::find_body(const std::string &name) const
  {
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const BodyParameters &one) { return one.name == name; });
    return body == bodies.end() ? nullptr : &*body;
  }


  unsigned int Parameters::points_per_cell(const InflowParameters &inflow) const
  {
    const BodyParameters *body = find_body(inflow.body);
    return body == nullptr ? water.points_per_cell : body->seeding.points_per_cell;
  }


  ContactGroups Parameters::contact_groups() const
  {
    std::vector<ContactBody> of_contacts;
    for (const BodyParameters &body : bodies)
      of_contacts.push_back({ body.name, body.is_rigid() });
    return scree::contact_groups(contacts, of_contacts);
  }


  void Parameters::take_box_from_raster()
  {
    if (bed.raster().empty() || dimension != 3 || file.sets("Mesh", "Lower corner") ||
        file.sets("Mesh", "Upper corner"))
      return;
    const BoxOfRaster box     = box_of_raster(bed, bodies, grid.cell_size);
    std::vector<double> upper = box.upper;
    for (unsigned int a = 0; a < 3; ++a)
      {
        // Along the map the ground must cover whole cells; along z there may be more of them.
        const double cells = (upper[a] - box.lower[a]) / grid.cell_size;
        upper[a] = box.lower[a] + grid.cell_size * (a < 2 ? std::floor(cells + 1e-6) : std::ceil(cells - 1e-6));
      }
    text_of_box = "Box from the raster, in whole cells: from " + number_text(box.lower) + " to " + number_text(upper) +
                  " m; the raster reaches from " + number_text({ box.lower[0], box.lower[1] }) + " to " +
                  number_text({ box.upper[0], box.upper[1] }) + " m, its heights from " + number_text(box.lowest) +
                  " to " + number_text(box.highest) + " m";
    handler.enter_subsection("Mesh");
    handler.set("Lower corner", exact_text(box.lower));
    handler.set("Upper corner", exact_text(upper));
    handler.leave_subsection();
  }


  void Parameters::read_maps()
  {
    std::shared_ptr<const LevelSet<3>> ground; // read once for all bodies
    for (BodyParameters &body : bodies)
      {
        SeedingParameters &seeding = body.seeding;
        seeding.source.check(
            body.name, dimension, has_water && !(water.has_levels() && water.reservoir_level.empty()), bed.is_set());
        if (!seeding.source.is_set())
          continue;
        try
          {
            if (!ground)
              ground = make_bed<3>(bed, grid.lower_corner, grid.upper_corner, 1.);
            seeding.map = std::make_shared<const SourceMap>(
                seeding.source, body.name, ground, bed.map_origin, grid.lower_corner, grid.upper_corner);
          }
        catch (const ValueError &error) // the bed's expression
          {
            throw EntryError(error.what());
          }
      }
  }


  void Parameters::check_dry() const
  {
    require_entry(
        !bodies.empty(), "", "Bodies", "none", "the scene is empty. Name a body of soil, or add a subsection Water.");
    const std::string subsection = "Boundaries/Water";
    for (const auto &face : FaceEntries::names(3))
      require_entry(!file.sets(subsection, face),
                    subsection,
                    face,
                    file.value(subsection, face, ""),
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
          const std::string text = entry_message(path,
                                                 entry,
                                                 value,
                                                 "this entry has no effect, as \"Material\" is " + body.material.law +
                                                     ". Write \"Material = " + law.name + "\", or remove the entry.");
          if (!file.sets(body.name, "Material")) // a law by default is hardly meant
            throw EntryError(text);
          unread_laws.push_back("Unusual value: " + text);
        }
  }


  std::vector<SoilRegion> Parameters::soil_regions() const
  {
    std::vector<SoilRegion> regions;
    for (const auto &body : bodies)
      regions.push_back(
          { body.name, body.seeding.expression(), body.initial_porosity(), body.bulk_density(), body.seeding.map });
    return regions;
  }


  unsigned int Parameters::n_rigid_surfaces() const
  {
    return bed.is_set() + std::count_if(obstacles.begin(), obstacles.end(), [](const ObstacleParameters &obstacle) {
             return obstacle.surface.is_set();
           });
  }


  double Parameters::size_of_gravity() const
  {
    double square = 0;
    for (const double component : gravity)
      square += component * component;
    return std::sqrt(square);
  }


  double Parameters::wave_speed() const
  {
    double fastest = 0;
    for (const auto &body : bodies)
      fastest = std::max(fastest, body.wave_speed());
    return fastest;
  }


  CaseEntries Parameters::entries() const
  {
    CaseEntries result(handler);
    for (const NamedFile &named : named_files)
      result.set_file(named);
    return result;
  }


  const std::string &Parameters::original() const
  {
    return file.text();
  }


  InputError Parameters::error(const EntryError &error) const
  {
    return file.error(error.what());
  }
} // namespace scree
