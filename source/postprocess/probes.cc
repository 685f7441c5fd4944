// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/probes.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/symmetric_tensor.h>

#include <regex>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void PlaceValues<dim>::add(double *sums,
                             const unsigned int place,
                             const Point<dim> &x,
                             const double mass,
                             const std::vector<double> &values) const
  {
    constexpr double half = 0.5 * (1 + 1e-6); // rounding must not decide about points on the edge
    const auto distance   = (x - places[place]) / grid.cell_size();
    double weight         = mass;
    bool is_close         = true;
    for (unsigned int a = 0; a < dim; ++a)
      {
        weight *= std::max(0., 1. - std::abs(distance[a]));
        is_close = is_close && std::abs(distance[a]) <= half;
      }
    if (weight <= 0.)
      return;
    std::array<double, dim + 1> monomials{ { 1. } };
    for (unsigned int a = 0; a < dim; ++a)
      monomials[a + 1] = distance[a];
    *sums++ += is_close;
    for (const double m : monomials)
      for (const double n : monomials)
        *sums++ += weight * m * n;
    for (const double value : values)
      for (const double m : monomials)
        *sums++ += weight * m * value;
  }


  template <int dim>
  template <typename ForEachSet>
  std::vector<std::vector<double>> PlaceValues<dim>::values_at_places(const unsigned int n_values,
                                                                      const ForEachSet &for_each_set) const
  {
    // For each place, in cell sizes from there: the number of points that are close; the moments of the weights, 1, x
    // and x x^T; and of each quantity its sum and its moment.
    constexpr unsigned int n = dim + 1, first_value = 1 + n * n;
    const unsigned int stride = first_value + n * n_values;
    std::vector<double> sums(places.size() * stride, 0.), values(n_values);
    const FineCells<dim> &fine = grid.fine_cells();
    for_each_set([&](const PointSet<dim> &points, const auto &read) {
      for (const auto &cell : points.cells())
        if (const auto near = places_near_cell.find(fine.cells()[fine.of_index(cell.cell)].place);
            near != places_near_cell.end())
          for (const unsigned int place : near->second)
            for_each_point(cell, [&](const auto &point) {
              const double mass = read(point.properties, values);
              add(sums.data() + place * stride, place, point.location, mass, values);
            });
    });
    Utilities::MPI::sum(sums, grid.communicator(), sums);

    // Of the weights along an axis, in cell sizes squared: below it, points lie too close together for a slope.
    constexpr double smallest_spread = 0.02;
    std::vector<std::vector<double>> table(places.size(),
                                           std::vector<double>(n_values, std::numeric_limits<double>::quiet_NaN()));
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        const double *of_place = sums.data() + i * stride, *matrix = of_place + 1, weight = matrix[0];
        if (of_place[0] == 0.)
          continue;
        Tensor<1, dim> mean;
        for (unsigned int a = 0; a < dim; ++a)
          mean[a] = matrix[a + 1] / weight;
        SymmetricTensor<2, dim> spread;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a; b < dim; ++b)
            spread[a][b] = matrix[(a + 1) * n + b + 1] / weight - mean[a] * mean[b];
        // The fit at the place itself is the mean minus mean . spread^-1 . covariance.
        Tensor<1, dim> to_place;
        for (const auto &[value, axis] : eigenvectors(spread))
          if (value > smallest_spread)
            to_place -= (mean * axis) / value * axis;
        for (unsigned int v = 0; v < n_values; ++v)
          {
            const double *moments = of_place + first_value + v * n;
            table[i][v]           = moments[0] / weight;
            for (unsigned int a = 0; a < dim; ++a)
              table[i][v] += to_place[a] * (moments[a + 1] / weight - mean[a] * moments[0] / weight);
          }
      }
    return table;
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::of_soil(const std::list<SoilBody<dim>> &bodies) const
  {
    return values_at_places(names_of_soil().size(), [&](const auto &act) {
      for (const auto &body : bodies)
        act(body.points, [&](const double *properties, std::vector<double> &values) {
          const double *stress = properties + body.layout.stress;
          auto next            = std::copy_n(properties + body.layout.velocity, dim, values.begin());
          next                 = std::copy_n(stress, n_symmetric_components<dim>, next);
          *next++              = mean_effective_stress(stress);
          *next++              = body.porosity(properties);
          return properties[body.layout.mass];
        });
    });
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::of_water(const std::list<WaterPhase<dim>> &water) const
  {
    return values_at_places(names_of_water().size(), [&](const auto &act) {
      for (const auto &part : water)
        act(part.points(), [&](const double *properties, std::vector<double> &values) {
          values[0] = properties[part.layout.pressure];
          std::copy_n(properties + part.layout.velocity, dim, values.begin() + 1);
          return properties[part.layout.mass];
        });
    });
  }

  template class PlaceValues<2>;
  template class PlaceValues<3>;


  namespace
  {
    constexpr char subsection[] = "Probes";

    /// The coordinates of a point; none if the text is no list of `n` numbers.
    std::vector<double> coordinates(const std::string &text, const unsigned int n)
    {
      std::vector<double> numbers;
      for (const std::string &word : Utilities::split_string_list(text))
        if (numbers.push_back(number_of(word)); !std::isfinite(numbers.back()))
          return {};
      return numbers.size() == n ? numbers : std::vector<double>();
    }

    /// An entry that lists places, and how it is written.
    struct PlaceEntry
    {
      const char *name;
      std::string ProbeParameters::*text;
      unsigned int n_points, n_axes_less; // points of a place, and how many coordinates they have less than the scene
      const char *shape[2];               // of a place, in 2D and 3D
    };
    const PlaceEntry place_entries[] = {
      { "Places", &ProbeParameters::places, 1, 0, { "NAME: x, y", "NAME: x, y, z" } },
      { "Lines", &ProbeParameters::lines, 2, 0, { "NAME: x, y to x, y", "NAME: x, y, z to x, y, z" } },
      { "Verticals", &ProbeParameters::verticals, 1, 1, { "NAME: x", "NAME: x, y" } }
    };
  } // namespace


  std::vector<NamedPlace> ProbeParameters::list_of(const std::string &entry, const unsigned int dim) const
  {
    constexpr std::size_t longest = 200; // Names of files have 255 bytes at most.
    const PlaceEntry &kind        = *std::find_if(
        std::begin(place_entries), std::end(place_entries), [&](const PlaceEntry &one) { return one.name == entry; });
    const std::string &text = this->*kind.text;
    std::vector<NamedPlace> list;
    if (text.empty())
      return list;
    for (const std::string &part : Utilities::split_string_list(text, ';'))
      {
        const std::size_t colon = part.find(':');
        NamedPlace place{ Utilities::trim(part.substr(0, colon)), {} };
        if (colon != std::string::npos)
          for (const std::string &point : Utilities::split_string_list(part.substr(colon + 1), " to "))
            place.points.push_back(coordinates(point, dim - kind.n_axes_less));
        const bool reads =
            std::regex_match(place.name, std::regex("[A-Za-z0-9_-]+")) && place.points.size() == kind.n_points &&
            std::none_of(place.points.begin(), place.points.end(), [](const auto &point) { return point.empty(); });
        require_entry(reads,
                      { subsection, entry, text },
                      quoted(part) + " does not read. Write " + kind.shape[dim - 2] +
                          " in m, with a name of letters, digits, _ and -; separate several by semicolons.");
        require_entry(place.name.size() <= longest,
                      { subsection, entry, text },
                      scree::quoted(place.name) + " has " + std::to_string(place.name.size()) +
                          " letters, and the name of a probe, which is that of its file, at most " +
                          std::to_string(longest) + ". Write a shorter name.");
        list.push_back(place);
      }
    return list;
  }


  void ProbeParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    prm.add_parameter(
        "Places",
        places,
        "m; places whose state is written with each row of statistics. Format: NAME: x, y; NAME: x, y; ...");
    prm.add_parameter(
        "Lines",
        lines,
        "m; lines along which the state is written with each graphics output, at places of equal spacing, half a cell, "
        "ends included. Format: NAME: x, y to x, y; ...");
    prm.add_parameter("Verticals",
                      verticals,
                      "m; places on the ground above which the height of the soil surface and the water level are "
                      "written with each row of statistics. Format: NAME: x; ... (3D: NAME: x, y; ...).");
    prm.add_parameter("Front thickness",
                      front_thickness,
                      "m; thickness that defines the fronts. The smallest and largest x at which soil and water are "
                      "this thick are written with each row of statistics. 0: none.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Wall forces", wall_forces, "true: the force on each face of the box is in each row of statistics.");
    prm.leave_subsection();
  }


  void ProbeParameters::check(const GridParameters &grid, const unsigned int dim) const
  {
    std::set<std::string> names{ "front" };
    for (const PlaceEntry &kind : place_entries)
      for (const NamedPlace &place : list_of(kind.name, dim))
        {
          const EntryValue entry(subsection, kind.name, this->*kind.text);
          for (const auto &point : place.points)
            for (unsigned int a = 0; a < point.size(); ++a)
              require_entry(point[a] >= grid.lower_corner[a] && point[a] <= grid.upper_corner[a],
                            entry,
                            quoted(place.name) + " lies outside the box of subsection Mesh, from " +
                                number_text(grid.lower_corner) + " to " + number_text(grid.upper_corner) +
                                ". Move it, or a corner of the box.");
          require_entry(names.insert(place.name).second,
                        entry,
                        quoted(place.name) + " is the name of another probe. Each has a file of its own name: write "
                                             "another one.");
          require_entry(place.points.size() < 2 || place.points[0] != place.points[1],
                        entry,
                        "both ends of " + quoted(place.name) +
                            " are the same. Move one, or write it among the \"Places\".");
        }
  }


  template <int dim>
  Probes<dim>::Probes(const ProbeParameters &parameters,
                      const BackgroundGrid<dim> &grid,
                      const bool has_soil,
                      const bool has_water,
                      RunFolder &folder)
      : grid(grid)
      , folder(folder)
      , has_soil(has_soil)
      , has_water(has_water)
  {
    add_places(parameters.list_of("Places", dim));
    for (const NamedPlace &line : parameters.list_of("Lines", dim))
      add_line(line);
    add_verticals(parameters.list_of("Verticals", dim));
    if (parameters.front_thickness > 0)
      add_front(parameters.front_thickness);
  }


  template <int dim>
  void Probes<dim>::add_group(const bool of_pictures,
                              const std::vector<NamedPlace> &places,
                              const std::vector<std::string> &columns,
                              const std::function<Rows(const State &)> &rows)
  {
    Group &group = groups.emplace_back(Group{ of_pictures, { "Time (s)" }, {}, rows });
    group.columns.insert(group.columns.end(), columns.begin(), columns.end());
    for (const NamedPlace &place : places)
      group.tables.push_back(&tables.emplace_back(folder, "probe_" + place.name));
  }


  template <int dim>
  std::vector<std::string> Probes<dim>::columns_of(const std::vector<std::string> &of_soil,
                                                   const std::vector<std::string> &of_water) const
  {
    std::vector<std::string> columns = has_soil ? of_soil : std::vector<std::string>();
    if (has_water)
      columns.insert(columns.end(), of_water.begin(), of_water.end());
    return columns;
  }


  template <int dim>
  void Probes<dim>::add_places(const std::vector<NamedPlace> &list)
  {
    std::vector<Point<dim>> points;
    for (const NamedPlace &place : list)
      points.emplace_back(vector_of<dim>(place.points[0].data()));
    add_group(false, list, columns_of_state(), [this, values = PlaceValues<dim>(grid, points)](const State &state) {
      return state_at(values, state);
    });
  }


  template <int dim>
  void Probes<dim>::add_line(const NamedPlace &line)
  {
    const Point<dim> begin(vector_of<dim>(line.points[0].data())), end(vector_of<dim>(line.points[1].data()));
    std::vector<Point<dim>> places;
    const double n_parts = std::max(1., std::round(begin.distance(end) / (0.5 * grid.cell_size())));
    for (double i = 0; i <= n_parts; ++i)
      places.push_back(begin + i / n_parts * (end - begin));
    std::vector<std::string> columns{ "Distance (m)", "x (m)", "y (m)", "z (m)" };
    columns.resize(1 + dim);
    const std::vector<std::string> names = columns_of_state();
    columns.insert(columns.end(), names.begin(), names.end());
    add_group(true, { line }, columns, [this, values = PlaceValues<dim>(grid, places)](const State &state) {
      Rows rows        = state_at(values, state);
      const auto &from = values.places;
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          rows[i].insert(rows[i].begin(), &from[i][0], &from[i][0] + dim);
          rows[i].insert(rows[i].begin(), from[i].distance(from.front()));
        }
      return rows;
    });
  }


  template <int dim>
  template <typename Act>
  void Probes<dim>::for_each_phase(const State &state, const Act &act) const
  {
    if (has_soil)
      act(point_volumes(state.bodies), true);
    if (has_water)
      act(point_volumes(state.bodies, state.water, grid), false);
  }


  template <int dim>
  void Probes<dim>::add_verticals(const std::vector<NamedPlace> &list)
  {
    Rows feet;
    for (const NamedPlace &vertical : list)
      feet.push_back(vertical.points[0]);
    const auto names = columns_of({ "Surface height (m)", "Thickness (m)" }, { "Water level (m)" });
    add_group(false, list, names, [this, feet](const State &state) {
      Rows rows(feet.size());
      for_each_phase(state, [&](const auto &lumps, const bool is_soil) {
        const auto columns = ground_columns(lumps, feet, grid);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            rows[i].push_back(columns[i].height);
            if (is_soil)
              rows[i].push_back(columns[i].thickness);
          }
      });
      return rows;
    });
  }


  template <int dim>
  void Probes<dim>::add_front(const double thickness)
  {
    const auto names = columns_of({ "Rear (m)", "Front (m)" }, { "Water rear (m)", "Water front (m)" });
    add_group(false, { { "front", {} } }, names, [this, thickness](const State &state) {
      Rows rows(1);
      for_each_phase(state, [&](const auto &lumps, const bool) {
        const auto [rear, tip] = rear_and_front(lumps, thickness, grid);
        rows[0].insert(rows[0].end(), { rear, tip });
      });
      return rows;
    });
  }


  template class Probes<2>;
  template class Probes<3>;
} // namespace scree
