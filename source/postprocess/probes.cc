// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/graphics.h>
#include <scree/postprocess/probes.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cctype>

namespace scree
{
  using namespace dealii;

  /// For each place, in cell sizes from there: the number of points that are close; the moments of the weights, 1, x
  /// and x x^T; and of each quantity its sum and its moment.
  template <int dim>
  struct PlaceValues<dim>::Sums
  {
    static constexpr unsigned int n_monomials = dim + 1;
    static constexpr unsigned int first_value = 1 + n_monomials * n_monomials;

    const unsigned int n_values, stride;
    std::vector<double> all;

    Sums(const unsigned int n_places, const unsigned int n_values)
        : n_values(n_values)
        , stride(first_value + n_monomials * n_values)
        , all(n_places * stride, 0.)
    {
    }

    double *of(const unsigned int place)
    {
      return all.data() + place * stride;
    }
  };


  template <int dim>
  void PlaceValues<dim>::add(Sums &sums,
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
    double *sum = sums.of(place);
    *sum++ += is_close;
    for (const double m : monomials)
      for (const double n : monomials)
        *sum++ += weight * m * n;
    for (const double value : values)
      for (const double m : monomials)
        *sum++ += weight * m * value;
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::fit(Sums &sums) const
  {
    // Of the weights along an axis, in cell sizes squared: below it, points lie too close together for a slope.
    constexpr double smallest_spread = 0.02;
    constexpr unsigned int n         = dim + 1;
    Utilities::MPI::sum(sums.all, grid.communicator(), sums.all);
    std::vector<std::vector<double>> table(
        places.size(), std::vector<double>(sums.n_values, std::numeric_limits<double>::quiet_NaN()));
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        if (sums.of(i)[0] == 0.)
          continue;
        const double *matrix = sums.of(i) + 1, weight = matrix[0];
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
        for (unsigned int v = 0; v < sums.n_values; ++v)
          {
            const double *moments = sums.of(i) + Sums::first_value + v * n;
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
    std::vector<double> values(names_of_soil().size());
    Sums sums(places.size(), values.size());
    for (const auto &body : bodies)
      for (const auto &cell : body.points.cells())
        for (const unsigned int place : near(cell))
          for_each_point(cell, [&](const auto &point) {
            const double *properties = point.properties, *stress = properties + body.layout.stress;
            auto next = std::copy_n(properties + body.layout.velocity, dim, values.begin());
            next      = std::copy_n(stress, n_symmetric_components<dim>, next);
            *next++   = mean_effective_stress(stress);
            *next++   = body.porosity(properties);
            add(sums, place, point.location, properties[body.layout.mass], values);
          });
    return fit(sums);
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::of_water(const std::list<WaterPhase<dim>> &water) const
  {
    std::vector<double> values(names_of_water().size());
    Sums sums(places.size(), values.size());
    for (const auto &one : water)
      for (const auto &cell : one.points().cells())
        for (const unsigned int place : near(cell))
          for_each_point(cell, [&](const auto &point) {
            const double *properties = point.properties;
            values[0]                = properties[one.layout.pressure];
            std::copy_n(properties + one.layout.velocity, dim, values.begin() + 1);
            add(sums, place, point.location, properties[one.layout.mass], values);
          });
    return fit(sums);
  }

  template class PlaceValues<2>;
  template class PlaceValues<3>;


  template <int dim>
  std::vector<double> WallForces<dim>::pressure_forces(const WaterView<dim> &view) const
  {
    constexpr unsigned int n = 8; // places along each axis of a cell's face: p has a kink where it is cut off at 0
    const double area        = Utilities::fixed_power<dim - 1>(grid.cell_size() / n);
    std::vector<double> forces(2 * dim, 0.);
    std::set<unsigned int> wet_cells;
    for (const auto &water : view.water)
      for (const auto &cell : water.points().cells())
        wet_cells.insert(cell.cell);
    for (const unsigned int cell : wet_cells)
      if (const std::uint8_t walls = grid.open_knots(cell); walls != 0 && grid.numbering().has_nodes(cell))
        {
          const auto corners = view.pressure_of_cell(cell);
          for (const unsigned int face : GeometryInfo<dim>::face_indices())
            if ((walls >> face) & 1)
              for (unsigned int i = 0; i < Utilities::fixed_power<dim - 1>(n); ++i)
                {
                  Point<dim> x;
                  for (unsigned int a = 0, rest = i; a < dim; ++a)
                    if (a == face / 2)
                      x[a] = face % 2;
                    else
                      {
                        x[a] = (rest % n + 0.5) / n;
                        rest /= n;
                      }
                  forces[face] += (face % 2 == 0 ? -1. : 1.) * area * std::max(0., pressure_at<dim>(x, corners));
                }
        }
    Utilities::MPI::sum(forces, grid.communicator(), forces);
    return forces;
  }


  template <int dim>
  std::vector<double> WallForces<dim>::collect(const Budget<dim> &totals, const double time, const WaterView<dim> *view)
  {
    std::vector<double> impulses; // face by face: soil, water
    for (const unsigned int face : faces)
      for (const WallImpulses<dim> *walls : { &totals.soil_walls, &totals.water_walls })
        for (unsigned int a = 0; a < dim; ++a)
          impulses.push_back(walls->of_face[face][a]);
    Utilities::MPI::sum(impulses, grid.communicator(), impulses);
    const std::vector<double> pressure = view ? pressure_forces(*view) : std::vector<double>(2 * dim, 0.);

    std::vector<double> forces;
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        for (unsigned int c = 2 * dim * i; c < 2 * dim * i + (is_wet ? 2 : 1) * dim; ++c)
          forces.push_back(has_start && time > last_time
                               ? (last_impulses[c] - impulses[c]) / (time - last_time) // on the wall
                               : std::numeric_limits<double>::quiet_NaN());
        if (is_wet)
          forces.push_back(pressure[faces[i]]);
      }
    has_start     = true;
    last_time     = time;
    last_impulses = impulses;
    return forces;
  }

  template class WallForces<2>;
  template class WallForces<3>;


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

    bool is_file_name(const std::string &name)
    {
      return !name.empty() && std::all_of(name.begin(), name.end(), [](const unsigned char letter) {
        return std::isalnum(letter) || letter == '_' || letter == '-';
      });
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
            is_file_name(place.name) && place.points.size() == kind.n_points &&
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
        "m; lines along which the state is written with each graphics output. Format: NAME: x, y to x, y; ...");
    prm.add_parameter("Places a line",
                      places_a_line,
                      "Number of places on each line, equally spaced, ends included.",
                      Patterns::Integer(2, 100000));
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
        "Wall forces", wall_forces, "true: the force on each face of the box is written with each row of statistics.");
    prm.add_parameter("Displacement",
                      displacement,
                      "true: the graphics output has the displacement of the soil points since the start. It is always "
                      "there if the soil settles.");
    prm.leave_subsection();
  }


  void ProbeParameters::check(const GridParameters &grid, const unsigned int dim, const bool has_soil) const
  {
    std::set<std::string> names{ "front", "walls" };
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
    require_entry(has_soil || !displacement,
                  { subsection, "Displacement", "true" },
                  "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it.");
  }


  namespace
  {
    /// Places at equal distances from one end of a line to the other.
    template <int dim>
    std::vector<Point<dim>> places_on_line(const NamedPlace &line, const unsigned int n)
    {
      const Point<dim> begin(vector_of<dim>(line.points[0].data())), end(vector_of<dim>(line.points[1].data()));
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
                      const BoundaryConditions<dim> *water_walls,
                      const bool has_soil,
                      RunFolder &folder)
      : has_soil(has_soil)
      , has_water(water_walls != nullptr)
      , folder(folder)
  {
    std::vector<std::string> names = has_soil ? PlaceValues<dim>::names_of_soil() : std::vector<std::string>();
    if (has_water)
      for (const std::string &name : PlaceValues<dim>::names_of_water())
        names.push_back(name);
    const auto new_group = [&](const bool of_pictures, const std::vector<NamedPlace> &places) -> Group & {
      Group &group = groups.emplace_back(Group{ of_pictures, {}, {}, {} });
      for (const NamedPlace &place : places)
        group.tables.push_back(&tables.emplace_back(folder, "probe_" + place.name));
      return group;
    };

    const std::vector<NamedPlace> list_of_places = parameters.list_of("Places", dim);
    std::vector<Point<dim>> points;
    for (const NamedPlace &place : list_of_places)
      points.emplace_back(vector_of<dim>(place.points[0].data()));
    Group &places  = new_group(false, list_of_places);
    places.columns = names;
    places.rows    = [this, values = PlaceValues<dim>(grid, points)](const auto &state) {
      return state_at(values, state);
    };

    for (const NamedPlace &line : parameters.list_of("Lines", dim))
      {
        Group &group  = new_group(true, { line });
        group.columns = { "Distance (m)", "x (m)", "y (m)" };
        if (dim == 3)
          group.columns.push_back("z (m)");
        group.columns.insert(group.columns.end(), names.begin(), names.end());
        group.rows = [this, values = PlaceValues<dim>(grid, places_on_line<dim>(line, parameters.places_a_line))](
                         const auto &state) {
          Rows rows        = state_at(values, state);
          const auto &from = values.places;
          for (unsigned int i = 0; i < rows.size(); ++i)
            {
              rows[i].insert(rows[i].begin(), &from[i][0], &from[i][0] + dim);
              rows[i].insert(rows[i].begin(), from[i].distance(from.front()));
            }
          return rows;
        };
      }

    const std::vector<NamedPlace> list_of_verticals = parameters.list_of("Verticals", dim);
    Group &verticals                                = new_group(false, list_of_verticals);
    if (has_soil)
      verticals.columns = { "Surface height (m)", "Thickness (m)" };
    if (has_water)
      verticals.columns.push_back("Water level (m)");
    Rows feet;
    for (const NamedPlace &vertical : list_of_verticals)
      feet.push_back(vertical.points[0]);
    verticals.rows = [this, feet, &grid](const auto &state) {
      Rows rows(feet.size());
      if (this->has_soil)
        {
          const auto columns = ground_columns(point_volumes(state.bodies), feet, grid);
          for (unsigned int i = 0; i < rows.size(); ++i)
            rows[i] = { columns[i].height, columns[i].thickness };
        }
      if (has_water)
        {
          const auto columns = ground_columns(point_volumes(state.bodies, state.water, grid), feet, grid);
          for (unsigned int i = 0; i < rows.size(); ++i)
            rows[i].push_back(columns[i].height);
        }
      return rows;
    };

    if (parameters.front_thickness > 0)
      {
        Group &front = new_group(false, { { "front", {} } });
        if (has_soil)
          front.columns = { "Rear (m)", "Front (m)" };
        if (has_water)
          front.columns.insert(front.columns.end(), { "Water rear (m)", "Water front (m)" });
        front.rows = [this, &grid, thickness = parameters.front_thickness](const auto &state) {
          std::vector<double> row;
          const auto add = [&](const std::vector<PointVolume<dim>> &lumps) {
            const auto [rear, tip] = rear_and_front(lumps, thickness, grid);
            row.insert(row.end(), { rear, tip });
          };
          if (this->has_soil)
            add(point_volumes(state.bodies));
          if (has_water)
            add(point_volumes(state.bodies, state.water, grid));
          return Rows{ row };
        };
      }

    if (parameters.wall_forces)
      {
        wall_forces   = std::make_unique<WallForces<dim>>(grid, box_walls, water_walls);
        Group &walls  = new_group(false, { { "walls", {} } });
        walls.columns = wall_forces->names();
        walls.rows    = [this](const auto &state) {
          return Rows{ wall_forces->collect(state.totals, state.time, state.view) };
        };
      }
  }


  template class Probes<2>;
  template class Probes<3>;
} // namespace scree
