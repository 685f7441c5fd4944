// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/maps.h>
#include <scree/tensor/vector.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void Maps<dim>::sample(const std::list<SoilBody<dim>> &bodies, const double time)
  {
    if (!parameters.write)
      return;
    constexpr unsigned int n_sums = dim + 2; // volume, mass and momentum of a column
    const std::size_t n_columns   = mass.size();
    std::vector<double> sums(n_sums * n_columns, 0.);
    for_each_moving_point(bodies, [&](const auto &body, const auto &point) {
      const double *values = point.properties;
      for (const auto &[column, weight] : columns.around(point.location))
        {
          double *of_column = sums.data() + n_sums * column;
          const double m    = weight * values[body.layout.mass];
          of_column[0] += weight * values[body.layout.volume];
          of_column[1] += m;
          for (unsigned int a = 0; a < dim; ++a)
            of_column[2 + a] += m * values[body.layout.velocity + a];
        }
    });
    Utilities::MPI::sum(sums, grid.communicator(), sums);

    const double area = columns.area();
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
  std::vector<typename Maps<dim>::Sheet> Maps<dim>::sheets() const
  {
    Map deposit(mass.size()), now_or_first(mass.size()), arrival(arrival_time);
    for (std::size_t c = 0; c < mass.size(); ++c)
      {
        deposit[c]      = thickness[c] - first_thickness[c];
        now_or_first[c] = std::max(thickness[c], first_thickness[c]);
      }
    std::replace_if(
        arrival.begin(),
        arrival.end(),
        [](const double t) { return t < 0.; },
        std::numeric_limits<double>::quiet_NaN());
    return { { "thickness", "m", thickness, thickness },
             { "mass", "kg/m^2", mass, thickness },
             { "deposit", "m", deposit, now_or_first },
             { "largest thickness", "m", largest_thickness, largest_thickness },
             { "largest speed", "m/s", largest_speed, largest_thickness },
             { "largest impact pressure", "Pa", largest_pressure, largest_thickness },
             { "arrival time", "s", arrival, largest_thickness } };
  }


  template <int dim>
  void Maps<dim>::write(const std::string &of_time, const std::vector<Sheet> &all) const
  {
    std::filesystem::create_directories(folder.file("maps"));
    if (dim == 2)
      {
        const std::string text = table(all);
        write_whole_files(
            { { folder.file("maps/profile" + of_time + ".csv"), text }, { folder.file("maps/profile.csv"), text } });
        return;
      }
    std::vector<FileContent> files;
    add_map("thickness" + of_time, all.front(), files);
    for (const Sheet &sheet : all)
      {
        std::string file = sheet.name;
        std::replace(file.begin(), file.end(), ' ', '_');
        add_map(file, sheet, files);
      }
    write_whole_files(files);
  }


  template <int dim>
  void Maps<dim>::add_map(const std::string &file, const Sheet &sheet, std::vector<FileContent> &files) const
  {
    const double least = 1e-6 * grid.cell_size(); // less soil comes from rounding
    Raster raster;
    raster.n_columns = columns.box.n[0];
    raster.n_rows    = columns.size() / raster.n_columns;
    raster.spacing   = grid.cell_size();
    raster.x         = frame.origin[0] + grid.lower_corner()[0] + 0.5 * raster.spacing;
    raster.y         = frame.origin[1] + grid.lower_corner()[1] + 0.5 * raster.spacing;
    raster.system    = frame.system;
    raster.values    = sheet.values;
    for (std::size_t c = 0; c < raster.values.size(); ++c)
      if (sheet.soil[c] <= least)
        raster.values[c] = std::numeric_limits<double>::quiet_NaN();
    const std::string path = folder.file("maps/" + file);
    if (parameters.format != "ASCII grid")
      files.emplace_back(path + ".tif", geo_tiff(raster, sheet.name, sheet.unit));
    if (parameters.format == "GeoTIFF")
      return;
    files.emplace_back(path + ".asc", ascii_grid(raster));
    const std::string system = frame.system.empty() ? "" : prj_text(frame.system);
    if (system.empty()) // A file of an earlier run would give another one.
      std::filesystem::remove(path + ".prj");
    else
      files.emplace_back(path + ".prj", system);
  }

  template class Maps<2>;
  template class Maps<3>;
} // namespace scree
