// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_probes_h
#define scree_postprocess_probes_h

#include <scree/io/run_folder.h>
#include <scree/postprocess/measures.h>

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
            CellPlace<dim> cell;
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
    /// @param for_each_set calls its argument with each set of points and a function that reads the properties of a
    /// point into its second argument, `n_values` values, and returns the mass, kg
    template <typename ForEachSet>
    std::vector<std::vector<double>> values_at_places(const unsigned int n_values,
                                                      const ForEachSet &for_each_set) const;

    /// Adds a point to the sums of a place, unless it is too far.
    void add(double *sums,
             const unsigned int place,
             const dealii::Point<dim> &x,
             const double mass,
             const std::vector<double> &values) const;

    const BackgroundGrid<dim> &grid;
    std::map<CellPlace<dim>, std::vector<unsigned int>> places_near_cell;
  };

  /// A place, a line or a vertical of a case: its name, which is that of its file, and its one or two points, m.
  struct NamedPlace
  {
    std::string name;                        ///< as the case has it
    std::vector<std::vector<double>> points; ///< coordinates, m: one point, or both ends of a line
  };

  /// Subsection Probes: what is written of places, lines, verticals and the front, and whether of the walls.
  struct ProbeParameters
  {
    std::string places,             ///< NAME: x, y; ...
        lines,                      ///< NAME: x, y to x, y; ...
        verticals;                  ///< NAME: x; ..., in 3D NAME: x, y; ...
    double front_thickness = 0;     ///< m; 0: no front
    bool wall_forces       = false; ///< whether statistics have the forces on the faces of the box

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at what does not read, lies outside the box or has no name of its own.
    void check(const GridParameters &grid, const unsigned int dim) const;

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
    double time;                             ///< s
  };

  /// The files `probe_NAME.csv`: tables like `statistics.csv`, a row a time; those of lines have a row a
  /// place and time.
  template <int dim>
  class Probes
  {
  public:
    /// Grid and folder are kept by reference.
    Probes(const ProbeParameters &parameters,
           const BackgroundGrid<dim> &grid,
           const bool has_soil,
           const bool has_water,
           RunFolder &folder);

    /// Adds a row to the files of places, verticals and front. Collective.
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

    /// Saves or loads the state of the files (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (TableFile &table : tables)
        archive &table;
    }

  private:
    using Rows  = std::vector<std::vector<double>>;
    using State = ProbedState<dim>;

    /// Tables that are written together.
    struct Group
    {
      bool of_pictures; // or of rows of statistics
      std::vector<std::string> columns;
      std::vector<TableFile *> tables;
      std::function<Rows(const State &)> rows; // without the time; one a table; a single table has all of them
    };

    /// @param places a table each
    void add_group(const bool of_pictures,
                   const std::vector<NamedPlace> &places,
                   const std::vector<std::string> &columns,
                   const std::function<Rows(const State &)> &rows);
    void add_places(const std::vector<NamedPlace> &list);
    void add_line(const NamedPlace &line);
    void add_verticals(const std::vector<NamedPlace> &list);
    void add_front(const double thickness);

    /// Those of the phases that there are.
    std::vector<std::string> columns_of(const std::vector<std::string> &of_soil,
                                        const std::vector<std::string> &of_water) const;
    std::vector<std::string> columns_of_state() const
    {
      return columns_of(PlaceValues<dim>::names_of_soil(), PlaceValues<dim>::names_of_water());
    }

    /// Calls `act` with the soil's points as lumps and true, and with the water's and false.
    template <typename Act>
    void for_each_phase(const State &state, const Act &act) const;

    void write(const State &state, const bool of_pictures)
    {
      for (Group &group : groups)
        if (group.of_pictures == of_pictures && !group.tables.empty())
          {
            Rows rows = group.rows(state);
            for (auto &row : rows)
              row.insert(row.begin(), state.time);
            for (unsigned int t = 0; t < group.tables.size(); ++t)
              group.tables[t]->append(group.columns, group.tables.size() == 1 ? rows : Rows{ rows[t] });
          }
    }
    Rows state_at(const PlaceValues<dim> &places, const State &state) const
    {
      Rows rows      = has_soil ? places.of_soil(state.bodies) : Rows(places.places.size());
      const Rows wet = has_water ? places.of_water(state.water) : Rows(rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i].insert(rows[i].end(), wet[i].begin(), wet[i].end());
      return rows;
    }

    const BackgroundGrid<dim> &grid;
    RunFolder &folder;
    const bool has_soil, has_water;
    std::list<TableFile> tables;
    std::vector<Group> groups;
  };
} // namespace scree

#endif
