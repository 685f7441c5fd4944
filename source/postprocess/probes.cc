// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/columns.h>
#include <scree/postprocess/probes.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> point_of(const std::vector<double> &coordinates)
    {
      Point<dim> point;
      std::copy_n(coordinates.begin(), dim, &point[0]);
      return point;
    }

    /// Places at equal distances from one end of a line to the other.
    template <int dim>
    std::vector<Point<dim>> places_on_line(const NamedPlace &line, const unsigned int n)
    {
      const auto begin = point_of<dim>(line.points[0]), end = point_of<dim>(line.points[1]);
      std::vector<Point<dim>> places;
      for (unsigned int i = 0; i < n; ++i)
        places.push_back(begin + i / (n - 1.) * (end - begin));
      return places;
    }
  } // namespace


  template <int dim>
  Probes<dim>::Probes(const ProbeParameters &parameters,
                      const BackgroundGrid<dim> &grid,
                      const BoundaryConditions<dim> &box_walls,
                      const WaterBoundaryConditions<dim> *water_walls,
                      const bool has_soil,
                      RunFolder &folder)
      : grid(grid)
      , has_soil(has_soil)
      , has_water(water_walls != nullptr)
      , front_thickness(parameters.front_thickness)
      , folder(folder)
  {
    std::vector<Point<dim>> points;
    for (const NamedPlace &place : parameters.list_of_places(dim))
      {
        places.push_back(new_table(place.name, names_of_state()));
        points.push_back(point_of<dim>(place.points[0]));
      }
    place_values = std::make_unique<PlaceValues<dim>>(grid, points);
    std::vector<std::string> of_line{ "Distance (m)", "x (m)", "y (m)" };
    if (dim == 3)
      of_line.push_back("z (m)");
    for (const std::string &name : names_of_state())
      of_line.push_back(name);
    for (const NamedPlace &line : parameters.list_of_lines(dim))
      lines.push_back({ new_table(line.name, of_line), { grid, places_on_line<dim>(line, parameters.places_a_line) } });

    make_columns(parameters);
    if (parameters.wall_forces)
      {
        wall_forces = std::make_unique<WallForces<dim>>(grid, box_walls, water_walls);
        walls       = new_table("walls", wall_forces->names());
      }
  }


  template <int dim>
  void Probes<dim>::make_columns(const ProbeParameters &parameters)
  {
    std::vector<std::string> of_vertical, of_front;
    if (has_soil)
      {
        of_vertical = { "Surface height (m)", "Thickness (m)" };
        of_front    = { "Rear (m)", "Front (m)" };
      }
    if (has_water)
      {
        of_vertical.push_back("Water level (m)");
        of_front.insert(of_front.end(), { "Water rear (m)", "Water front (m)" });
      }
    for (const NamedPlace &vertical : parameters.list_of_verticals(dim))
      {
        verticals.push_back(new_table(vertical.name, of_vertical));
        vertical_places.push_back(vertical.points[0]);
      }
    if (front_thickness > 0)
      front = new_table("front", of_front);
  }


  template <int dim>
  typename Probes<dim>::Table *Probes<dim>::new_table(const std::string &name, const std::vector<std::string> &columns)
  {
    tables.push_back({ TableFile(folder, "probe_" + name), { "Time (s)" } });
    auto &of_table = tables.back().columns;
    of_table.insert(of_table.end(), columns.begin(), columns.end());
    return &tables.back();
  }


  template <int dim>
  std::vector<std::string> Probes<dim>::names_of_state() const
  {
    std::vector<std::string> names;
    if (has_soil)
      names = PlaceValues<dim>::names_of_soil();
    if (has_water)
      for (const std::string &name : PlaceValues<dim>::names_of_water())
        names.push_back(name);
    return names;
  }


  template <int dim>
  void Probes<dim>::append(Table &table, const std::vector<std::vector<double>> &rows)
  {
    table.rows.append(table.columns, rows);
  }


  template <int dim>
  std::vector<std::vector<double>> Probes<dim>::state_at(const PlaceValues<dim> &places,
                                                         const ProbedState<dim> &state) const
  {
    std::vector<std::vector<double>> rows(places.places().size());
    const auto add = [&](const std::vector<std::vector<double>> &values) {
      for (unsigned int i = 0; i < rows.size(); ++i)
        rows[i].insert(rows[i].end(), values[i].begin(), values[i].end());
    };
    if (has_soil)
      add(places.of_soil(state.bodies));
    if (has_water)
      add(places.of_water(state.water));
    return rows;
  }


  template <int dim>
  void Probes<dim>::write_places(const ProbedState<dim> &state)
  {
    auto rows = state_at(*place_values, state);
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        rows[i].insert(rows[i].begin(), state.time);
        append(*places[i], { rows[i] });
      }
  }


  template <int dim>
  void Probes<dim>::write_verticals(const ProbedState<dim> &state)
  {
    std::vector<std::vector<double>> rows(verticals.size(), { state.time });
    if (has_soil)
      {
        const auto columns = ground_columns(lumps_of(state.bodies), vertical_places, grid);
        for (unsigned int i = 0; i < rows.size(); ++i)
          rows[i].insert(rows[i].end(), { columns[i].height, columns[i].thickness });
      }
    if (has_water)
      {
        const auto columns = ground_columns(lumps_of(state.bodies, state.water, grid), vertical_places, grid);
        for (unsigned int i = 0; i < rows.size(); ++i)
          rows[i].push_back(columns[i].height);
      }
    for (unsigned int i = 0; i < rows.size(); ++i)
      append(*verticals[i], { rows[i] });
  }


  template <int dim>
  void Probes<dim>::write_front(const ProbedState<dim> &state)
  {
    std::vector<double> row{ state.time };
    const auto add = [&](const std::vector<Lump<dim>> &lumps) {
      const auto [rear, tip] = rear_and_front(lumps, front_thickness, grid);
      row.insert(row.end(), { rear, tip });
    };
    if (has_soil)
      add(lumps_of(state.bodies));
    if (has_water)
      add(lumps_of(state.bodies, state.water, grid));
    append(*front, { row });
  }


  template <int dim>
  void Probes<dim>::write_rows(const ProbedState<dim> &state)
  {
    if (!places.empty())
      write_places(state);
    if (!verticals.empty())
      write_verticals(state);
    if (front)
      write_front(state);
    if (wall_forces)
      {
        std::vector<double> row = wall_forces->collect(state.totals, state.time, state.view);
        row.insert(row.begin(), state.time);
        append(*walls, { row });
      }
  }


  template <int dim>
  void Probes<dim>::write_lines(const ProbedState<dim> &state)
  {
    for (Line &line : lines)
      {
        auto rows          = state_at(line.values, state);
        const auto &points = line.values.places();
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            std::vector<double> where{ state.time, points[i].distance(points.front()) };
            where.insert(where.end(), &points[i][0], &points[i][0] + dim);
            rows[i].insert(rows[i].begin(), where.begin(), where.end());
          }
        append(*line.table, rows);
      }
  }


  template <int dim>
  void Probes<dim>::sync()
  {
    for (Table &table : tables)
      table.rows.sync();
  }


  template <int dim>
  void Probes<dim>::cut()
  {
    for (Table &table : tables)
      table.rows.cut();
  }


  template <int dim>
  void Probes<dim>::complete()
  {
    for (Table &table : tables)
      table.rows.complete();
  }

  template class Probes<2>;
  template class Probes<3>;
} // namespace scree
