// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_parameters_h
#define scree_case_parameters_h

#include <scree/boundary/inflow/inflow_parameters.h>
#include <scree/boundary/rain.h>
#include <scree/contact/contact_parameters.h>
#include <scree/initial/initial_state.h>
#include <scree/input/input_file.h>
#include <scree/io/output_parameters.h>
#include <scree/materials/table.h>
#include <scree/momentum/explicit_update.h>
#include <scree/momentum/surface_load.h>
#include <scree/postprocess/probes.h>
#include <scree/schemes/time_step.h>
#include <scree/seeding/seeding.h>
#include <scree/transfer/transfer_parameters.h>

namespace scree
{
  /// One body of soil: where it is, what it is made of, how it starts. One subsection of the `.prm`, named after the
  /// body.
  struct BodyParameters
  {
    std::string name;                       ///< name of its subsection
    SeedingParameters seeding;              ///< where it is, and its points
    std::string conductivity_text = "auto"; ///< as the entry says
    double conductivity           = 0;      ///< of water, m/s, at the initial porosity; 0: that of subsection Water
    MaterialParameters material;            ///< law and its entries
    InitialStateParameters initial_state;   ///< stress before the first step
    std::string added_by;                   ///< subsection of the stage in which it appears; empty: it starts the case
    bool is_there = true;                   ///< false: a later stage adds it

    /// Declares the body's subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection(name);
      seeding.add_parameters(prm);
      prm.declare_entry(
          "Hydraulic conductivity",
          conductivity_text,
          dealii::Patterns::Anything(),
          "m/s; conductivity (Darcy) of this body at its initial porosity. auto: as in subsection Water.");
      prm.add_action("Hydraulic conductivity", [this](const std::string &text) {
        conductivity_text = text;
        conductivity      = text == "auto" ? 0. : number_of(text);
      });
      material.add_parameters(prm);
      initial_state.add_parameters(prm);
      prm.leave_subsection();
    }

    /// Throws EntryError at impossible combinations of entries.
    /// @param water null in a dry scene
    void check(const std::vector<double> &gravity, const WaterParameters *water) const;

    /// Whether the body keeps its place.
    bool is_rigid() const
    {
      return material.is_rigid();
    }

    /// Volume of pores over total volume, as the entry or the law says.
    double initial_porosity() const
    {
      return seeding.initial_porosity < 0 ? make_material<2>(material)->initial_porosity : seeding.initial_porosity;
    }

    /// Density of the dry body, kg/m^3: grains times (1 - porosity).
    double bulk_density() const
    {
      return seeding.grain_density * (1. - initial_porosity());
    }

    /// Drag of the water in its pores: what subsection Water says, but for a conductivity of the body.
    DragLaw drag_law(WaterParameters water) const
    {
      if (conductivity > 0)
        {
          water.conductivity   = conductivity;
          water.grain_diameter = 0;
        }
      return { water, initial_porosity() };
    }

    /// Horizontal over vertical stress of a K0 start.
    double k0() const
    {
      return initial_state.k0_ratio(material.chosen().sine_of_friction());
    }

    /// Of pressure waves in the dry body at the entry of its pressure, m/s; 0 without stiffness.
    double wave_speed() const
    {
      const auto law = make_material<2>(material);
      return law->wave_speed(law->initial_bulk_modulus(initial_state.pressure), 0., bulk_density());
    }

  private:
    void check_rigid() const
    {
      require_entry(seeding.initial_velocity.empty(),
                    { name, "Initial velocity", seeding.initial_velocity },
                    "\"Material = rigid\" does not move. Remove one of the two.");
      require_entry(initial_state.type == "none",
                    { name + "/Initial state", "Type", initial_state.type },
                    "the stress of \"Material = rigid\" is not known. Remove the entry.");
    }
  };

  /// Subsection Safety: the search of scree --safety, and a strength that is reduced in a run.
  struct SafetyParameters
  {
    double strength_factor = 1;         ///< divides the strength from the release on
    double tolerance       = 0.01;      ///< of the factor
    double displacement    = 0.02;      ///< of a slope that fails, over its height
    std::vector<std::string> unreduced; ///< bodies that keep their strength

    /// Whether a body keeps its strength.
    bool keeps(const std::string &body) const
    {
      return std::find(unreduced.begin(), unreduced.end(), body) != unreduced.end();
    }

    /// Longest duration of a trial, in sqrt(height of the soil/gravity); what moves then fails.
    static constexpr double longest_trial = 40;

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Subsections Stage NAME: what changes when a run goes on from the end of the case, or of the stage before.
  struct StageParameters
  {
    static constexpr const char *prefix = "Stage "; ///< of the names of subsections

    std::string name;          ///< of its subsection, without the prefix; empty: the case itself
    double duration = 0;       ///< s, after its settling
    std::string removed;       ///< expression: where soil and water vanish when it begins; empty: nowhere
    std::string removed_layer; ///< the same as a layer of the drawing
    std::shared_ptr<const SourceMap> removed_areas; ///< of that layer; null without
    std::vector<std::string> adds;                  ///< bodies that appear when it begins

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Its subsection in the case, for messages.
    std::string subsection() const
    {
      return prefix + name;
    }

    /// Entry and value of what vanishes; no value: nothing does.
    std::pair<std::string, std::string> removal() const
    {
      return removed_layer.empty() ? std::make_pair(std::string("Remove"), removed)
                                   : std::make_pair(std::string("Remove layer"), removed_layer);
    }
  };

  /// Everything a `.prm` file says, checked. Each member's own add_parameters() names its entries.
  class Parameters
  {
  public:
    /// Reads and checks `file`. Throws InputError, which names file, subsection, entry, value and remedy.
    /// @param stage name of its subsection: the case as it is in that stage; empty: before its stages
    explicit Parameters(const std::string &file, const std::string &stage = "");

    /// The defaults, as needed to print a template of all entries.
    Parameters();

    std::string case_file;                           ///< path of the file, as given; empty: the defaults
    unsigned int dimension = 2;                      ///< 2 (plane strain) or 3
    double end_time        = 1;                      ///< s
    std::string output_directory{ "results/scree" }; ///< the run folder
    std::vector<double> gravity{ 0., -9.81 };        ///< m/s^2, one number an axis
    std::vector<double> local_origin{ 0., 0. };      ///< on the map, m
    std::string drawing;                             ///< file with the layers of a plane section; empty: none
    std::string coordinate_system;                   ///< of the map, such as EPSG:2056; empty: that of its rasters

    GridParameters grid;                       ///< subsection Mesh
    TimeStepParameters time_step;              ///< subsection Time step
    TransferParameters transfer;               ///< subsection Transfer
    StabilisationParameters stabilisation;     ///< subsection Stabilisation
    BodyForceParameters body_forces;           ///< all kinds of body force
    std::vector<BodyParameters> bodies;        ///< one subsection each
    BoundaryParameters boundaries;             ///< subsection Boundaries, for the soil
    BedParameters bed;                         ///< subsection Bed
    std::vector<ObstacleParameters> obstacles; ///< also those that are not set
    std::vector<InflowParameters> inflows;     ///< subsections Inflow NAME
    RainParameters rain;                       ///< subsection Rain
    std::vector<ContactParameters> contacts;   ///< also those that are not set
    SurfaceLoadParameters surface_load;        ///< subsection Surface load
    SettlingParameters settling;               ///< subsection Settling
    SafetyParameters safety;                   ///< subsection Safety
    StageParameters stage;                     ///< the stage that this is
    std::vector<std::string> stages;           ///< subsections of all stages, in the order of the file
    double later_duration = 0.;                ///< of the stages after this one, s
    OutputParameters output;                   ///< subsection Output
    ProbeParameters probes;                    ///< subsection Probes

    std::string map_system; ///< of the map's coordinates, see system_of_maps(); set once the case is read

    std::string text_of_box; ///< for the log, of a box that follows from the raster; else empty

    std::vector<std::string> remarks; ///< for the log, on the drawing and on subsections of laws that are not chosen

    bool has_water = false;      ///< whether there is a subsection Water; without it, nothing reads the next three
    WaterParameters water;       ///< subsection Water
    PressureParameters pressure; ///< subsection Pressure of Water
    WaterBoundaryParameters water_boundaries; ///< subsection Water of Boundaries

    std::string start_folder; ///< run folder from whose checkpoint a resumed run goes on; empty: its own

    /// Divides the strength of soil and the friction of bases, contacts and walls by a factor, as entry "Strength
    /// factor" does in a case that does not settle. Once only. Throws EntryError if there is no soil that has strength.
    void reduce_strength(const double factor);

    /// Leaves out the stages after the one of this name. Throws EntryError if there is none.
    void end_after_stage(const std::string &name)
    {
      const auto last = std::find(stages.begin(), stages.end(), StageParameters::prefix + name);
      if (last == stages.end())
        throw EntryError("--stage " + name + ": the case has " +
                         (stages.empty() ? "no stages." : "the stages " + boost::algorithm::join(stages, ", ") + '.'));
      stages.erase(last + 1, stages.end());
    }

    /// Changes an entry as if the file had it so; nothing is checked again.
    /// @param subsection its path
    void set(const std::string &subsection, const std::string &entry, const std::string &value);

    /// Where the bodies that are there are at their start, and how porous and heavy.
    std::vector<SoilRegion> soil_regions() const
    {
      std::vector<SoilRegion> regions;
      for (const auto &body : bodies)
        if (body.is_there)
          regions.push_back(
              { body.name, body.seeding.expression(), body.initial_porosity(), body.bulk_density(), body.seeding.map });
      return regions;
    }

    /// Whether the skeleton of the soil is damped: in water, where it may rub against ground or walls.
    bool damps_skeleton() const;

    /// The body of this name; null if there is none.
    const BodyParameters *find_body(const std::string &name) const
    {
      const auto body =
          std::find_if(bodies.begin(), bodies.end(), [&](const BodyParameters &one) { return one.name == name; });
      return body == bodies.end() ? nullptr : &*body;
    }

    /// Points of what an inflow brings, along each axis of a cell.
    unsigned int points_per_cell(const InflowParameters &inflow) const
    {
      const BodyParameters *body = find_body(inflow.body);
      return body == nullptr ? water.points_per_cell : body->seeding.points_per_cell;
    }

    /// The bodies that stick to each other, and which of them slide. Throws EntryError if contacts do not fit.
    ContactGroups contact_groups() const
    {
      std::vector<ContactBody> of_contacts;
      for (const BodyParameters &body : bodies)
        of_contacts.push_back({ body.name, body.is_rigid() });
      return scree::contact_groups(contacts, of_contacts);
    }

    /// Every entry with its value.
    CaseEntries entries() const
    {
      CaseEntries result(handler);
      for (const NamedFile &named : named_files)
        result.set_file(named);
      if (!stage.name.empty())
        result.add({ "Stage", "Name", stage.name });
      return result;
    }

    /// The text of the file as it was read.
    const std::string &original() const
    {
      return file.text();
    }

    /// An error met later, with file and line before its message.
    InputError error(const EntryError &error) const
    {
      return file.error(error.what());
    }

    /// Writes every entry with its value, default and explanation; as JSON also with its pattern.
    void print(std::ostream &out,
               const dealii::ParameterHandler::OutputStyle style = dealii::ParameterHandler::PRM) const
    {
      handler.print_parameters(out, style);
      if (style == dealii::ParameterHandler::PRM && stage.name.empty())
        out << file.left_out_text();
    }

    /// Writes the paths of the subsections, one per line: all of them, or those of and below one.
    void print_sections(const std::string &path, std::ostream &out)
    {
      for (const std::string &one : subsection_paths(handler))
        if (path.empty() || (one + '/').rfind(path + '/', 0) == 0)
          out << one << '\n';
    }

    /// Writes the entries of one subsection as print() does, such as `Soil/Initial state`. Throws InputError if there
    /// is none of that path.
    void print_subsection(const std::string &path, std::ostream &out);

    /// All entries as a case that lies in `folder`: paths of files count from there.
    void print_into(const std::string &folder, std::ostream &out)
    {
      for (const NamedFile &named : named_files)
        set(named.subsection, named.entry, std::filesystem::relative(named.path, folder));
      print(out);
      for (const NamedFile &named : named_files)
        set(named.subsection, named.entry, named.path);
    }

    /// Magnitude of gravity, m/s^2.
    double size_of_gravity() const
    {
      double square = 0;
      for (const double component : gravity)
        square += component * component;
      return std::sqrt(square);
    }

  private:
    void name_bodies();

    /// The subsections with this prefix. Throws EntryError if two differ by case only.
    /// @param kind `obstacle`, for the message
    std::vector<std::string> named_subsections(const std::string &prefix, const std::string &kind) const;
    void declare(dealii::ParameterHandler &prm);
    void declare_water(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Water");
      water.add_parameters(prm);
      pressure.add_parameters(prm);
      prm.leave_subsection();
      water_boundaries.add_parameters(prm);
    }
    /// Without corners in the file, takes the box that a bed's raster asks for: its outline, two cells below the lowest
    /// height, and four cells above the highest soil. Throws EntryError if it cannot be read or has no heights.
    void take_box_from_raster();
    void take_unit_weights();

    /// Takes the entries of the stages up to this one; the end of the case is that of the stage.
    void take_stages(const std::string &last);

    /// Throws InputError if this or another stage is not possible.
    void check_stages() const;
    void read_maps();
    void read_drawing();
    void check_dry() const;

    /// Adds to `remarks`. Throws EntryError if no entry Material chooses the law that is read instead.
    void find_unread_laws(const dealii::ParameterHandler &defaults);

    /// Of the stiffest body, m/s; 0 without bodies.
    double wave_speed() const
    {
      double fastest = 0;
      for (const auto &body : bodies)
        fastest = std::max(fastest, body.wave_speed());
      return fastest;
    }

    /// The remedy for a subsection that is not declared but looks like that of a body; empty if it does not.
    std::string unlisted_body(const std::string &subsection) const;

    InputFile file;
    std::vector<NamedFile> named_files;
    double duration_so_far = 0.;            // of the stages up to this one, s
    std::vector<std::string> layers_in_use; // of the drawing, by others than bodies at the start
    std::vector<std::string> body_names{ "Soil" };
    dealii::ParameterHandler handler;
  };

} // namespace scree

#endif
