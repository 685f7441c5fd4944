// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_probes_h
#define scree_postprocess_probes_h

#include <scree/postprocess/place_values.h>
#include <scree/postprocess/probe_parameters.h>
#include <scree/io/table_file.h>
#include <scree/postprocess/wall_forces.h>

#include <list>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
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
           const WaterBoundaryConditions<dim> *water_walls,
           const bool has_soil,
           RunFolder &folder);

    /// Adds a row to the files of places, verticals, front and walls. Collective.
    void write_rows(const ProbedState<dim> &state);

    /// Adds the rows of a time to the files of lines. Collective.
    void write_lines(const ProbedState<dim> &state);

    /// Brings all rows to the disk, before a checkpoint counts on them.
    void sync();

    /// After the state has been read from a checkpoint: cuts off the rows that were written after it.
    void cut();

    /// Writes rows that the disk did not take. Throws FileError if it still refuses them.
    void complete();

    /// Saves or loads the state of the files, and that of the wall forces (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (Table &table : tables)
        archive &table.rows;
      if (wall_forces)
        archive &*wall_forces;
    }

  private:
    /// A table, with the names of its columns.
    struct Table
    {
      TableFile rows;
      std::vector<std::string> columns;
    };

    /// Values along a line.
    struct Line
    {
      Table *table;
      PlaceValues<dim> values;
    };

    /// Makes the tables of verticals and front.
    void make_columns(const ProbeParameters &parameters);
    Table *new_table(const std::string &name, const std::vector<std::string> &columns);
    std::vector<std::string> names_of_state() const;
    void append(Table &table, const std::vector<std::vector<double>> &rows);
    std::vector<std::vector<double>> state_at(const PlaceValues<dim> &places, const ProbedState<dim> &state) const;
    void write_places(const ProbedState<dim> &state);
    void write_verticals(const ProbedState<dim> &state);
    void write_front(const ProbedState<dim> &state);

    const BackgroundGrid<dim> &grid;
    const bool has_soil, has_water;
    const double front_thickness; // m
    RunFolder &folder;
    std::list<Table> tables;
    std::vector<Table *> places, verticals;
    std::unique_ptr<PlaceValues<dim>> place_values;   // at the places, in their order
    std::vector<std::vector<double>> vertical_places; // in the order of the verticals
    std::list<Line> lines;
    Table *front = nullptr, *walls = nullptr;
    std::unique_ptr<WallForces<dim>> wall_forces; // null without that entry
  };
} // namespace scree

#endif
