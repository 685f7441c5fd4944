// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_parameters_h
#define scree_case_parameters_h

#include <scree/bodies/water_parameters.h>
#include <scree/boundary/boundary_conditions.h>
#include <scree/boundary/inflow/inflow_parameters.h>
#include <scree/boundary/rain.h>
#include <scree/boundary/water_walls.h>
#include <scree/contact/contact_parameters.h>
#include <scree/geometry/bed_parameters.h>
#include <scree/initial/initial_state.h>
#include <scree/input/case_entries.h>
#include <scree/input/input_file.h>
#include <scree/io/output_parameters.h>
#include <scree/materials/table.h>
#include <scree/mesh/background_grid.h>
#include <scree/momentum/explicit_update.h>
#include <scree/momentum/surface_load.h>
#include <scree/postprocess/probes.h>
#include <scree/schemes/time_step.h>
#include <scree/seeding/seeding.h>
#include <scree/transfer/transfer_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// One body of soil: where it is, what it is made of, how it starts. One subsection of the `.prm`, named after the
  /// body.
  struct BodyParameters
  {
    std::string name;                     ///< name of its subsection
    SeedingParameters seeding;            ///< where it is, and its points
    SeepageParameters seepage;            ///< hydraulic conductivity
    MaterialParameters material;          ///< law and its entries
    InitialStateParameters initial_state; ///< stress before the first step

    /// Declares the body's subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations of entries.
    /// @param water null in a dry scene
    void check(const std::vector<double> &gravity, const WaterParameters *water) const;

    /// Whether the body keeps its place.
    bool is_rigid() const;

    /// Volume of pores over total volume, as the entry or the law says.
    double initial_porosity() const;

    /// Density of the dry body, kg/m^3: grains times (1 - porosity).
    double bulk_density() const;

    /// Horizontal over vertical stress of a K0 start.
    double k0() const;

    /// Of pressure waves in the dry body at the entry of its pressure, m/s; 0 without stiffness.
    double wave_speed() const;

  private:
    void check_rigid() const;
  };

  /// Subsection Safety: the search of scree --safety, and a strength that is reduced in a run.
  struct SafetyParameters
  {
    double strength_factor = 1;    ///< divides the strength from the release on
    double lower           = 0.5;  ///< smallest factor that is tried
    double upper           = 5;    ///< largest factor that is tried
    double tolerance       = 0.01; ///< of the factor
    double displacement    = 0.02; ///< of a slope that fails, over its height

    /// Longest duration of a trial, in sqrt(height of the soil/gravity); what moves then fails.
    static constexpr double longest_trial = 40;

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check() const;
  };

  /// Everything a `.prm` file says, checked. Each member's own add_parameters() names its entries.
  class Parameters
  {
  public:
    /// Reads and checks `file`. Throws InputError, which names file, subsection, entry, value and remedy.
    explicit Parameters(const std::string &file);

    /// The defaults, as needed to print a template of all entries.
    Parameters();

    std::string case_file;                           ///< path of the file, as given; empty: the defaults
    unsigned int dimension = 2;                      ///< 2 (plane strain) or 3
    double end_time        = 1;                      ///< s
    std::string output_directory{ "results/scree" }; ///< the run folder
    std::vector<double> gravity{ 0., -9.81 };        ///< m/s^2, one number an axis
    std::vector<double> local_origin{ 0., 0. };      ///< on the map, m
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
    OutputParameters output;                   ///< subsection Output
    ProbeParameters probes;                    ///< subsection Probes

    std::string map_system; ///< of the map's coordinates, see system_of_maps(); set once the case is read

    std::string text_of_box; ///< for the log, of a box that follows from the raster; else empty

    std::vector<std::string> unread_laws; ///< for the log, of subsections of laws that are not chosen

    bool has_water = false;      ///< whether there is a subsection Water; without it, nothing reads the next three
    WaterParameters water;       ///< subsection Water
    PressureParameters pressure; ///< subsection Pressure of Water
    WaterBoundaryParameters water_boundaries; ///< subsection Water of Boundaries

    std::string start_folder; ///< run folder from whose checkpoint a resumed run goes on; empty: its own

    /// Divides the strength of soil and the friction of bases, contacts and walls by a factor, as entry "Strength
    /// factor" does in a case that does not settle. Once only. Throws EntryError if there is no soil that has strength.
    void reduce_strength(const double factor);

    /// Changes an entry as if the file had it so; nothing is checked again.
    /// @param subsection its path
    void set(const std::string &subsection, const std::string &entry, const std::string &value);

    /// Where the bodies are, and how porous and heavy.
    std::vector<SoilRegion> soil_regions() const;

    /// The bed, and the obstacles that are set.
    unsigned int n_rigid_surfaces() const;

    /// The body of this name; null if there is none.
    const BodyParameters *find_body(const std::string &name) const;

    /// Points of what an inflow brings, along each axis of a cell.
    unsigned int points_per_cell(const InflowParameters &inflow) const;

    /// The bodies that stick to each other, and which of them slide. Throws EntryError if contacts do not fit.
    ContactGroups contact_groups() const;

    /// Every entry with its value.
    CaseEntries entries() const;

    /// The text of the file as it was read.
    const std::string &original() const;

    /// An error met later, with file and line before its message.
    InputError error(const EntryError &error) const;

    /// Writes every entry with its value, default and explanation.
    void print(std::ostream &out);

    /// All entries in the order of their declaration, with patterns, as JSON.
    void print_json(std::ostream &out);

    /// Writes the paths of the subsections, one per line: all of them, or those of and below one.
    void print_sections(const std::string &path, std::ostream &out);

    /// Writes the entries of one subsection as print() does, such as `Soil/Initial state`. Throws InputError if there
    /// is none of that path.
    void print_subsection(const std::string &path, std::ostream &out);

    /// All entries as a case that lies in `folder`: paths of files count from there.
    void print_into(const std::string &folder, std::ostream &out);

  private:
    void name_bodies();

    /// The subsections with this prefix. Throws EntryError if two differ by case only.
    /// @param kind `obstacle`, for the message
    std::vector<std::string> named_subsections(const std::string &prefix, const std::string &kind) const;
    void declare(dealii::ParameterHandler &prm);
    void declare_water(dealii::ParameterHandler &prm);
    void take_box_from_raster();
    void take_unit_weights();
    void read_maps();
    void check_dry() const;

    /// Fills `unread_laws`. Throws EntryError if no entry Material chooses the law that is read instead.
    void find_unread_laws(const dealii::ParameterHandler &defaults);

    double size_of_gravity() const; // m/s^2
    double wave_speed() const;      // of the stiffest body, m/s; 0 without bodies

    /// The remedy for a subsection that is not declared but looks like that of a body; empty if it does not.
    std::string unlisted_body(const std::string &subsection) const;

    InputFile file;
    std::vector<NamedFile> named_files;
    std::vector<std::string> body_names{ "Soil" };
    dealii::ParameterHandler handler;
  };

} // namespace scree

#endif
