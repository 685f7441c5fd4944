// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures and statistics of soil and water, on one rank and on two: which columns there are, and fields that move
// with known velocities.
#include "../soil.h"


#include <scree/io/run_folder.h>
#include <scree/postprocess/graphics.h>
#include <scree/postprocess/statistics.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace test_output_water
{
/// Soil on the left that carries water at p = 100 Pa, single-point; 8 x 8 (x 8) cells.
template <int dim>
struct Scene : SoilScene<dim>
{
  using SoilScene<dim>::grid;
  NodalField<dim> soil_field, water_field;

  Scene()
      : SoilScene<dim>(0., 0.8)
      , soil_field(grid)
      , water_field(grid)
  {
    SoilBody<dim> &soil = this->add_wet_soil("x < 0.4", 0.25);
    const auto &layout  = this->water.back().layout;
    for_each_point(soil.points, [&](const auto &point) { point.properties[layout.pressure] = 100.; });
  }

  /// Soil at 1 m/s everywhere and water at 3 m/s where x > `from`.
  void set_velocities(const double from)
  {
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      {
        soil_field[node][NodalField<dim>::mass]      = 1.;
        soil_field[node][NodalField<dim>::velocity]  = 1.;
        const bool wet                               = grid.node_position(node)[0] > from;
        water_field[node][NodalField<dim>::mass]     = wet;
        water_field[node][NodalField<dim>::velocity] = wet ? 3. : 0.;
      }
    soil_field.update_ghosts();
    water_field.update_ghosts();
  }
};

template <int dim>
void test_interpolation()
{
  Scene<dim> scene;
  scene.set_velocities(0.25);
  for (const auto &cell : scene.grid.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        Point<dim> x;
        for (unsigned int a = 0; a < dim; ++a)
          x[a] = 0.3 + 0.2 * a;
        const unsigned int index = cell->active_cell_index();
        const double at          = cell->vertex(0)[0];
        expect(velocity_at(x, scene.grid, index, scene.soil_field)[0], 1., 1e-12, "velocity of the soil");
        // Nodes of splines reach from a half cell before the cell to a half cell behind it.
        const double relative = relative_velocity_at(x, scene.grid, index, scene.soil_field, scene.water_field)[0];
        if (at > 0.35)
          expect(relative, 2., 1e-12, "relative velocity in the water");
        if (at < 0.05)
          expect(relative, 0., 1e-12, "relative velocity away from the water");

        const auto pressure = [&](const Point<dim> &y) { return 7. + 5. * y[0] - 3. * y[1] + y[0] * y[1]; };
        std::array<double, (1 << dim)> corners;
        for (unsigned int v = 0; v < corners.size(); ++v)
          corners[v] = pressure(GeometryInfo<dim>::unit_cell_vertex(v));
        expect(pressure_at<dim>(x, corners), pressure(x), 1e-12, "bilinear pressure");
      }
}

/// Prints the names of the arrays of a `.pvtu` file.
void print_arrays(const std::string &file)
{
  std::ifstream in(file);
  require(in, "There is no file " + file);
  std::string line;
  while (std::getline(in, line))
    if (const auto begin = line.find("Name=\""); begin != std::string::npos)
      std::cout << ' ' << line.substr(begin + 6, line.find('"', begin + 6) - begin - 6);
  std::cout << std::endl;
}

template <int dim>
void test_graphics()
{
  Scene<dim> scene;
  scene.set_velocities(-1.);
  const std::string folder =
      "run_" + std::to_string(dim) + "_" + std::to_string(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::create_directories(folder + "/solution");
  MPI_Barrier(MPI_COMM_WORLD);
  Graphics<dim> graphics(scene.grid, OutputParameters(), folder);
  const WaterView<dim> view{ scene.water, scene.water_field, [](const unsigned int) {
                              std::array<double, (1 << dim)> corners;
                              corners.fill(100.);
                              return corners;
                            } };
  BackgroundWriter writer(MPI_COMM_WORLD);
  writer.start(graphics.write(scene.bodies, scene.soil_field, 0., &view));
  writer.start(graphics.write({}, scene.soil_field, 1., &view)); // pure water has no series of soil points
  writer.start(graphics.write(scene.bodies, scene.soil_field, 2.));
  writer.finish();
  MPI_Barrier(MPI_COMM_WORLD);
  for (const std::string file :
       { "points_00000", "water_00000", "grid_00000", "points_00001", "water_00001", "grid_00002" })
    {
      std::cout << dim << "D " << file << ':';
      print_arrays(folder + "/solution/" + file + ".pvtu");
    }
  require(!std::filesystem::exists(folder + "/solution/water_00002.pvtu"), "A dry picture wrote water.");
}

/// A load has a column from the first row on, also if it starts to work later. Prints the lines of the last row that
/// are not in `said`.
template <int dim>
void test_statistics(std::set<std::string> &said)
{
  Scene<dim> scene;
  Tensor<1, dim> gravity;
  gravity[dim - 1] = -10.;
  Statistics<dim> statistics(scene.grid, gravity, { true, false, false });
  RunBalance<dim> totals;
  const bool first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  statistics.collect(scene.bodies, scene.water, totals, 0., 0, 0., UpdateReport());
  std::string file = table_head(statistics.columns()) + table_row(statistics.values());
  if (first)
    {
      totals.balance.load_impulse[0]   = 5.;
      totals.balance.load_work         = 7.;
      totals.balance.drag_dissipation  = 3.;
      totals.balance.n_iterations      = 40;
      totals.balance.n_preconditioners = 2;
      totals.lost_water_mass           = 11.;
    }
  statistics.collect(scene.bodies, scene.water, totals, 1., 8, 0.1, UpdateReport());
  file += table_row(statistics.values());
  totals.balance.n_iterations *= 2.5;
  statistics.collect(scene.bodies, scene.water, totals, 2., 16, 0.1, UpdateReport());
  file += table_row(statistics.values());
  std::cout << dim << "D statistics:" << std::endl;
  std::stringstream row;
  statistics.print_last_row(row);
  for (std::string line; std::getline(row, line);)
    if (said.insert(line).second)
      std::cout << line << std::endl;
  std::ostringstream dry, empty;
  Statistics<dim> dry_statistics(scene.grid, gravity, {}), water_statistics(scene.grid, gravity, {});
  dry_statistics.collect(scene.bodies, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
  dry_statistics.print_last_row(dry);
  require(dry.str().find("ater") == std::string::npos && dry.str().find("Load") == std::string::npos,
          "A dry scene has columns of water.");
  water_statistics.collect({}, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
  water_statistics.print_last_row(empty);
  require(empty.str().find("nan") == std::string::npos && empty.str().find("inf") == std::string::npos,
          "Nothing divides by zero.");

  std::istringstream in(first ? file : "");
  std::string line;
  while (std::getline(in, line))
    if (line.find("Load work") != std::string::npos)
      std::cout << line << std::endl;
    else if (line[0] != '#')
      std::cout << "last column: " << line.substr(line.find_last_of(' ', line.find_last_not_of(' ')) + 1) << std::endl;
}


void run()
{
  test_interpolation<2>();
  test_interpolation<3>();
  test_graphics<2>();
  test_graphics<3>();
  std::set<std::string> said; // In space the row is that of the plane but for what is printed.
  test_statistics<2>(said);
  test_statistics<3>(said);
}

const UnitTest registered("output_water", run);
} // namespace test_output_water
