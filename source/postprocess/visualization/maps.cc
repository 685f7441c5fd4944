// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/postprocess/visualization/maps.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double no_data = -9999.; // as most programs of maps know it
  }


  template <int dim>
  Maps<dim>::Maps(const MapParameters &parameters,
                  const MapFrame &frame,
                  const BackgroundGrid<dim> &grid,
                  const RunFolder &folder)
      : parameters(parameters)
      , frame(frame)
      , grid(grid)
      , folder(folder)
  {
    for (unsigned int a = 0; a < dim; ++a)
      n[a] = std::lround((grid.upper_corner()[a] - grid.lower_corner()[a]) / grid.cell_size());
    if (!parameters.write)
      return;
    std::size_t n_columns = 1;
    for (unsigned int a = 0; a + 1 < dim; ++a)
      n_columns *= n[a];
    for (Map *map : { &thickness, &mass, &largest_thickness, &largest_speed, &largest_pressure })
      map->assign(n_columns, 0.);
    arrival_time.assign(n_columns, -1.);
  }


  template <int dim>
  std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> Maps<dim>::columns_around(const Point<dim> &x) const
  {
    std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> result;
    result.fill({ 0, 1. });
    for (unsigned int a = dim - 1; a-- > 0;)
      {
        // In cells from the middle of the first column.
        const double place = (x[a] - grid.lower_corner()[a]) / grid.cell_size() - 0.5, lower = std::floor(place);
        for (unsigned int i = 0; i < result.size(); ++i)
          {
            const unsigned int side = i >> a & 1;
            result[i].first =
                result[i].first * n[a] + static_cast<std::size_t>(std::clamp(lower + side, 0., n[a] - 1.));
            result[i].second *= side == 1 ? place - lower : 1. - (place - lower);
          }
      }
    return result;
  }


  template <int dim>
  void Maps<dim>::sample(const std::list<SoilBody<dim>> &bodies, const double time)
  {
    if (!parameters.write)
      return;
    constexpr unsigned int n_sums = dim + 2; // volume, mass and momentum of a column
    const std::size_t n_columns   = mass.size();
    std::vector<double> sums(n_sums * n_columns, 0.);
    const bool with_start = bodies.front().layout.has_start; // all bodies have it, or none
    Map at_rest(with_start ? n_columns : 0, 0.);
    for (const auto &body : bodies)
      if (!body.is_rigid)
        for_each_point(body.points, [&](const auto &point) {
          const double *values = point.properties;
          for (const auto &[column, weight] : columns_around(point.location))
            {
              double *of_column = sums.data() + n_sums * column;
              const double m    = weight * values[body.layout.mass];
              of_column[0] += weight * values[body.layout.volume];
              of_column[1] += m;
              for (unsigned int a = 0; a < dim; ++a)
                of_column[2 + a] += m * values[body.layout.velocity + a];
            }
          if (!with_start)
            return;
          const Point<dim> start(vector_of<dim>(values + body.layout.start));
          if (start.distance(point.location) <= grid.cell_size())
            for (const auto &[column, weight] : columns_around(start))
              at_rest[column] += weight * values[body.layout.mass] / body.density;
        });
    Utilities::MPI::sum(sums, grid.triangulation().get_communicator(), sums);
    Utilities::MPI::sum(at_rest, grid.triangulation().get_communicator(), at_rest);

    const double area = Utilities::fixed_power<dim - 1>(grid.cell_size());
    if (scour_depth.empty())
      first_at_rest = at_rest;
    scour_depth.resize(at_rest.size());
    for (std::size_t c = 0; c < at_rest.size(); ++c)
      scour_depth[c] = std::max(0., first_at_rest[c] - at_rest[c]) / area;
    for (std::size_t c = 0; c < n_columns; ++c)
      {
        const double *of_column = sums.data() + n_sums * c;
        thickness[c]            = of_column[0] / area;
        mass[c]                 = of_column[1] / area;
        largest_thickness[c]    = std::max(largest_thickness[c], thickness[c]);
        if (of_column[1] == 0. || thickness[c] < parameters.least_thickness)
          continue;
        const double speed  = vector_of<dim>(of_column + 2).norm() / of_column[1];
        largest_speed[c]    = std::max(largest_speed[c], speed);
        largest_pressure[c] = std::max(largest_pressure[c], of_column[1] / of_column[0] * speed * speed);
        if (arrival_time[c] < 0.)
          arrival_time[c] = time;
      }
    if (first_thickness.empty())
      first_thickness = thickness;
  }


  template <int dim>
  void Maps<dim>::write(const double time) const
  {
    if (!parameters.write || !folder.is_writer())
      return;
    std::filesystem::create_directories(folder.file("maps"));
    Map deposit(mass.size()), arrival(arrival_time);
    for (std::size_t c = 0; c < deposit.size(); ++c)
      deposit[c] = thickness[c] - first_thickness[c];
    std::replace_if(
        arrival.begin(),
        arrival.end(),
        [](const double t) { return t < 0.; },
        dim == 2 ? std::numeric_limits<double>::quiet_NaN() : no_data);
    std::vector<std::pair<std::string, const Map *>> maps{ { "thickness (m)", &thickness },
                                                           { "mass (kg/m^2)", &mass },
                                                           { "deposit (m)", &deposit },
                                                           { "largest thickness (m)", &largest_thickness },
                                                           { "largest speed (m/s)", &largest_speed },
                                                           { "largest impact pressure (Pa)", &largest_pressure },
                                                           { "arrival time (s)", &arrival } };
    if (!scour_depth.empty())
      maps.emplace_back("scour depth (m)", &scour_depth);
    const std::string of_time = '_' + number_text(time) + 's';
    if (dim == 2)
      {
        write_table("profile" + of_time, maps);
        write_table("profile", maps);
        return;
      }
    write_map("thickness" + of_time, thickness);
    for (const auto &[name, map] : maps)
      {
        std::string file = name.substr(0, name.find(" ("));
        std::replace(file.begin(), file.end(), ' ', '_');
        write_map(file, *map);
      }
  }


  template <int dim>
  void Maps<dim>::write_table(const std::string &name,
                              const std::vector<std::pair<std::string, const Map *>> &maps) const
  {
    std::ostringstream text;
    text << "x (m)";
    for (const auto &map : maps)
      text << ", " << map.first;
    text << '\n';
    for (std::size_t c = 0; c < mass.size(); ++c)
      {
        text << std::setprecision(15) << grid.lower_corner()[0] + (c + 0.5) * grid.cell_size() << std::setprecision(9);
        for (const auto &map : maps)
          text << ", " << (*map.second)[c];
        text << '\n';
      }
    folder.write("maps/" + name + ".csv", text.str());
  }


  template <int dim>
  void Maps<dim>::write_map(const std::string &name, const Map &map) const
  {
    std::ostringstream text;
    text << std::setprecision(15) << "ncols " << n[0] << "\nnrows " << n[1] << "\nxllcorner "
         << frame.origin[0] + grid.lower_corner()[0] << "\nyllcorner " << frame.origin[1] + grid.lower_corner()[1]
         << "\ncellsize " << grid.cell_size() << "\nNODATA_value " << no_data << '\n'
         << std::setprecision(9);
    for (std::size_t row = map.size() / n[0]; row-- > 0;) // from the north
      for (std::size_t c = 0; c < n[0]; ++c)
        text << map[row * n[0] + c] << (c + 1 < n[0] ? ' ' : '\n');
    folder.write("maps/" + name + ".asc", text.str());
    if (frame.system.empty()) // Nothing of an earlier run may tell another one.
      std::filesystem::remove(folder.file("maps/" + name + ".prj"));
    else
      folder.write("maps/" + name + ".prj", frame.system);
  }

  template class Maps<2>;
  template class Maps<3>;
} // namespace scree
