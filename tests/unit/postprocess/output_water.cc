// SPDX-License-Identifier: LGPL-2.1-or-later
// Statistics of soil and water: which columns there are, and fields that move with known velocities.
#include "../soil.h"

#include <scree/postprocess/graphics.h>
#include <scree/postprocess/statistics.h>

#include <map>
#include <sstream>

namespace test_output_water
{
/// Soil on the left that carries water at p = 100 Pa, single-point; 8 x 8 (x 8) cells.
template <int dim>
struct Scene : SoilScene<dim>
{
  using SoilScene<dim>::grid;
  NodalField<dim> soil_field{ grid }, water_field{ grid };

  Scene()
      : SoilScene<dim>(0., 0.8)
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
        const auto x             = point_of<dim>([](const unsigned int a) { return 0.3 + 0.2 * a; });
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

/// The numbers that a row of statistics prints, by column.
template <int dim>
std::map<std::string, double> last_row(const Statistics<dim> &statistics)
{
  std::stringstream row;
  statistics.print_last_row(row);
  std::map<std::string, double> result;
  for (std::string line; std::getline(row, line);)
    result[line.substr(0, line.rfind(": "))] = std::stod(line.substr(line.rfind(": ") + 2));
  return result;
}

/// A load has a column from the first row on, also if it starts to work later.
template <int dim>
void test_statistics()
{
  Scene<dim> scene;
  Tensor<1, dim> gravity;
  gravity[dim - 1] = -10.;
  Statistics<dim> statistics(scene.grid, gravity, { true, false, false });
  RunBalance<dim> totals;
  statistics.collect(scene.bodies, scene.water, totals, 0., 0, 0., UpdateReport());
  const auto columns = statistics.columns();
  require(columns.back() == "Load work (J)" && statistics.values().back() == 0., "The load has the last column.");
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      totals.balance.load_impulse[0]   = 5.;
      totals.balance.load_work         = 7.;
      totals.balance.drag_dissipation  = 3.;
      totals.balance.n_iterations      = 40;
      totals.balance.n_preconditioners = 2;
      totals.lost_water_mass           = 11.;
    }
  statistics.collect(scene.bodies, scene.water, totals, 1., 8, 0.1, UpdateReport());
  totals.balance.n_iterations *= 2.5;
  statistics.collect(scene.bodies, scene.water, totals, 2., 16, 0.1, UpdateReport());
  require(statistics.columns() == columns && statistics.values().size() == columns.size(), "Columns have changed.");

  std::map<std::string, double> expected;
  for (const std::string &column : columns)
    expected[column] = 0.;
  const double n_points = dim == 2 ? 128. : 2048., volume = dim == 2 ? 0.32 : 0.256;
  for (const std::string sort : { "", "Water " })
    for (const std::string part : { "90", "99", "99.5" })
      expected[sort + (sort.empty() ? "Front " : "front ") + part + " % (m)"] = 0.375;
  const std::map<std::string, double> others = { { "Time (s)", 2. },
                                                 { "Step", 16. },
                                                 { "Time step (s)", 0.1 },
                                                 { "Points", n_points },
                                                 { "Mass (kg)", 1000. * volume },
                                                 { "Momentum residual (N s)", 5. },
                                                 { "Potential energy (J)", 5000. * volume },
                                                 { "Numerical dissipation (J)", 4. },
                                                 { "Height (m)", 0.775 },
                                                 { "Water points", n_points },
                                                 { "Water mass (kg)", 250. * volume },
                                                 { "Water lost (kg)", 11. },
                                                 { "Smallest p (Pa)", 100. },
                                                 { "Largest p (Pa)", 100. },
                                                 { "Water tip (m)", 0.375 },
                                                 { "Largest porosity (-)", 0.5 },
                                                 { "Drag dissipation (J)", 3. },
                                                 { "CG iterations per step", 7.5 },
                                                 { "Preconditioners built", 2. },
                                                 { "Load work (J)", 7. } };
  for (const auto &[column, value] : others)
    expected[column] = value;
  expect(expected.size(), dim == 2 ? 59 : 60, 0., "number of columns");
  for (const auto &[column, value] : last_row(statistics))
    expect(value, expected.at(column), 1e-9 * std::max(1., value), column);

  Statistics<dim> dry(scene.grid, gravity, {}), empty(scene.grid, gravity, {});
  dry.collect(scene.bodies, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
  for (const std::string &column : dry.columns())
    require(column.find("ater") == std::string::npos && column.find("Load") == std::string::npos, "dry: " + column);
  empty.collect({}, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
  for (const auto &[column, value] : last_row(empty))
    require(std::isfinite(value), "without points: " + column);
}


template <int dim>
void test()
{
  test_interpolation<dim>();
  test_statistics<dim>();
}


const UnitTest registered("output_water", [] {
  test<2>();
  test<3>();
});
} // namespace test_output_water

// Runs with mpirun=1,2.
