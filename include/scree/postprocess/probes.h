// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_probes_h
#define scree_postprocess_probes_h

#include <scree/boundary/boundary_conditions.h>
#include <scree/io/run_folder.h>
#include <scree/postprocess/measures.h>
#include <scree/step/step_report.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// The state of soil and water at given places: of each quantity a linear fit by least squares to the points around
  /// (@source{lancaster1981}), weighted by mass and by 1 - |distance|/(cell size) along each axis. Exact for
  /// linear fields, at walls and surfaces, too; the same on any number of ranks but for rounding.
  template <int dim>
  class PlaceValues
  {
  public:
    /// Lists the places, m.
    PlaceValues(const BackgroundGrid<dim> &grid, const std::vector<dealii::Point<dim>> &places)
        : places(places)
        , grid(grid)
    {
      for (unsigned int i = 0; i < places.size(); ++i)
        for (unsigned int n = 0; n < dealii::Utilities::fixed_power<dim>(3u); ++n)
          {
            CellPlace cell;
            for (unsigned int a = 0, rest = n; a < dim; ++a, rest /= 3)
              cell[a] = static_cast<int>(std::floor((places[i][a] - grid.lower_corner()[a]) / grid.cell_size())) +
                        static_cast<int>(rest % 3) - 1;
            places_near_cell[cell].push_back(i);
          }
    }

    /// Names with units of the quantities of soil: velocity, effective stress (tension positive), P, porosity.
    static std::vector<std::string> names_of_soil()
    {
      std::vector<std::string> names;
      for (unsigned int a = 0; a < dim; ++a)
        names.push_back(std::string("Velocity ") + "xyz"[a] + " (m/s)");
      for (const std::string component : { "xx", "yy", "zz", "xy", "xz", "yz" })
        if (dim == 3 || (component != "xz" && component != "yz"))
          names.push_back("Effective stress " + component + " (Pa)");
      names.push_back("Mean effective stress (Pa)");
      names.push_back("Porosity (-)");
      return names;
    }

    /// Names with units of the quantities of water: pore pressure, velocity.
    static std::vector<std::string> names_of_water()
    {
      std::vector<std::string> names{ "Pore pressure (Pa)" };
      for (unsigned int a = 0; a < dim; ++a)
        names.push_back(std::string("Water velocity ") + "xyz"[a] + " (m/s)");
      return names;
    }

    /// Their values, a row a place; nan where no such point lies within half a cell along each axis. Collective.
    std::vector<std::vector<double>> of_soil(const std::list<SoilBody<dim>> &bodies) const;

    /// The same of the water.
    std::vector<std::vector<double>> of_water(const std::list<WaterPhase<dim>> &water) const;

    const std::vector<dealii::Point<dim>> places; ///< m, in the order of the rows

  private:
    using CellPlace = std::array<int, dim>; // numbers of a cell along the axes
    struct Sums;

    /// The places whose values the points of a cell touch.
    const std::vector<unsigned int> &near(const ConstCellPoints<dim> &cell) const
    {
      static const std::vector<unsigned int> none;
      CellPlace key;
      for (unsigned int a = 0; a < dim; ++a)
        key[a] = static_cast<int>(std::lround((cell.location_of(0)[a] - grid.lower_corner()[a]) / grid.cell_size() -
                                              cell.reference_location_of(0)[a]));
      const auto found = places_near_cell.find(key);
      return found == places_near_cell.end() ? none : found->second;
    }

    /// Adds a point to the sums of a place, unless it is too far.
    void add(Sums &sums,
             const unsigned int place,
             const dealii::Point<dim> &x,
             const double mass,
             const std::vector<double> &values) const;

    std::vector<std::vector<double>> fit(Sums &sums) const;

    const BackgroundGrid<dim> &grid;
    std::map<CellPlace, std::vector<unsigned int>> places_near_cell;
  };

  /// The mean force of soil and water on each wall of the box between two calls, N (2D: N/m). Walls are the faces that
  /// are closed to soil or water.
  template <int dim>
  class WallForces
  {
  public:
    /// @param water_walls null in a dry scene
    WallForces(const BackgroundGrid<dim> &grid,
               const BoundaryConditions<dim> &walls,
               const BoundaryConditions<dim> *water_walls)
        : grid(grid)
        , is_wet(water_walls != nullptr)
    {
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (!walls.is_open(f) || (is_wet && !water_walls->is_open(f)))
          faces.push_back(f);
    }

    /// Names of the columns of collect(), with their unit.
    std::vector<std::string> names() const
    {
      std::vector<std::string> result;
      const std::vector<std::string> of_face = FaceEntries::names(dim);
      for (const unsigned int face : faces)
        {
          for (const std::string phase : { " soil ", " water " })
            if (is_wet || phase == " soil ")
              for (unsigned int a = 0; a < dim; ++a)
                result.push_back(of_face[face] + phase + "xyz"[a] + " (N)");
          if (is_wet)
            result.push_back(of_face[face] + " pressure " + "xyz"[face / 2] + " (N)");
        }
      return result;
    }

    /// The forces since the last call, nan at the first one: of the soil and of the water (what walls take of their
    /// motion; the soil's is the effective one), and the pore pressure's across the wall at this instant, of its
    /// positive part over the cells that hold water. Collective.
    /// @param totals sums of this rank since the start
    /// @param time s
    /// @param view null in a dry scene
    std::vector<double> collect(const Budget<dim> &totals, const double time, const WaterView<dim> *view);

    /// Saves or loads time and impulses of the last call (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &has_start &last_time &last_impulses;
    }

  private:
    /// Force of the pore pressure on each face, N, of all ranks.
    std::vector<double> pressure_forces(const WaterView<dim> &view) const;

    const BackgroundGrid<dim> &grid;
    const bool is_wet;
    std::vector<unsigned int> faces; // the walls
    bool has_start   = false;
    double last_time = 0;
    std::vector<double> last_impulses; // of all ranks, in the order of impulses()
  };

  /// A place, a line or a vertical of a case: its name, which is that of its file, and its one or two points, m.
  struct NamedPlace
  {
    std::string name;                        ///< as the case has it
    std::vector<std::vector<double>> points; ///< coordinates, m: one point, or both ends of a line
  };

  /// Subsection Probes: what is written of places, lines, verticals, the front and the walls.
  struct ProbeParameters
  {
    std::string places,                 ///< NAME: x, y; ...
        lines,                          ///< NAME: x, y to x, y; ...
        verticals;                      ///< NAME: x; ..., in 3D NAME: x, y; ...
    unsigned int places_a_line = 51;    ///< number of places on each line
    double front_thickness     = 0;     ///< m; 0: no front
    bool wall_forces           = false; ///< whether forces on the faces of the box are written
    bool displacement          = false; ///< of the points of the pictures

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at what does not read, lies outside the box or has no name of its own.
    void check(const GridParameters &grid, const unsigned int dim, const bool has_soil) const;

    /// What entry `Places`, `Lines` or `Verticals` lists; points of verticals have dim - 1 coordinates. Throws
    /// EntryError at what does not read.
    std::vector<NamedPlace> list_of(const std::string &entry, const unsigned int dim) const;
  };

  /// What probes look at.
  template <int dim>
  struct ProbedState
  {
    const std::list<SoilBody<dim>> &bodies;  ///< bodies of soil
    const std::list<WaterPhase<dim>> &water; ///< empty in a dry scene
    const Budget<dim> &totals;               ///< of this rank since the start
    double time;                             ///< s
    const WaterView<dim> *view;              ///< null in a dry scene
  };

  /// The files `probe_NAME` and `probe_NAME.csv`: tables like `statistics`, a row a time; those of lines have a row a
  /// place and time.
  template <int dim>
  class Probes
  {
  public:
    /// @param water_walls null in a dry scene
    Probes(const ProbeParameters &parameters,
           const BackgroundGrid<dim> &grid,
           const BoundaryConditions<dim> &walls,
           const BoundaryConditions<dim> *water_walls,
           const bool has_soil,
           RunFolder &folder);

    /// Adds a row to the files of places, verticals, front and walls. Collective.
    void write_rows(const ProbedState<dim> &state)
    {
      write(state, false);
    }

    /// Adds the rows of a time to the files of lines. Collective.
    void write_lines(const ProbedState<dim> &state)
    {
      write(state, true);
    }

    /// The tables, one a probe: to be synchronised, cut and completed with the others of the run.
    std::list<TableFile> &files()
    {
      return tables;
    }

    /// Saves or loads the state of the files, and that of the wall forces (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (TableFile &table : tables)
        archive &table;
      if (wall_forces)
        archive &*wall_forces;
    }

  private:
    using Rows = std::vector<std::vector<double>>;

    /// Tables that are written together.
    struct Group
    {
      bool of_pictures;                 // or of rows of statistics
      std::vector<std::string> columns; // besides the time
      std::vector<TableFile *> tables;
      std::function<Rows(const ProbedState<dim> &)> rows; // one a table; a single table has all of them
    };

    void write(const ProbedState<dim> &state, const bool of_pictures)
    {
      for (Group &group : groups)
        if (group.of_pictures == of_pictures && !group.tables.empty())
          {
            Rows rows = group.rows(state);
            for (auto &row : rows)
              row.insert(row.begin(), state.time);
            std::vector<std::string> columns{ "Time (s)" };
            columns.insert(columns.end(), group.columns.begin(), group.columns.end());
            for (unsigned int t = 0; t < group.tables.size(); ++t)
              group.tables[t]->append(columns, group.tables.size() == 1 ? rows : Rows{ rows[t] });
          }
    }
    Rows state_at(const PlaceValues<dim> &places, const ProbedState<dim> &state) const
    {
      Rows rows      = has_soil ? places.of_soil(state.bodies) : Rows(places.places.size());
      const Rows wet = has_water ? places.of_water(state.water) : Rows(rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i].insert(rows[i].end(), wet[i].begin(), wet[i].end());
      return rows;
    }

    const bool has_soil, has_water;
    RunFolder &folder;
    std::list<TableFile> tables;
    std::vector<Group> groups;
    std::unique_ptr<WallForces<dim>> wall_forces; // null without that entry
  };
} // namespace scree

#endif
