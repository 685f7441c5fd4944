// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of one file: registered here, they are the last ones of each row of the statistics, in order of their names.
#include "../test.h"

#include <scree/io/run_folder.h>
#include <scree/postprocess/statistics.h>

namespace test_registered_column
{
bool is_asked = false; // other tests of this program print all columns

const RegisterColumns registered_mean("Mean velocity", [](const auto &now, StatisticsRow &row) {
  if (is_asked)
    add_value(row, "Mean velocity", "m/s", now.sums.momentum / now.sums.soil_mass);
});

const RegisterColumns registered_cells("Cells", [](const auto &now, StatisticsRow &row) {
  if (is_asked)
    add_value(row, "Cells", "", now.grid.triangulation().n_active_cells());
});


/// The columns behind those of every dry scene.
template <int dim>
void test(const std::vector<std::string> &expected)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 0.4), MPI_COMM_WORLD);
  std::vector<std::string> columns[2];
  for (const bool asks : { false, true })
    {
      is_asked = asks;
      Statistics<dim> statistics(grid, Tensor<1, dim>(), {});
      statistics.collect({}, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
      columns[asks] = statistics.columns();
    }
  is_asked = false;
  require(columns[0].back() == "Mass lost (kg)", "The last column is " + columns[0].back());
  columns[0].insert(columns[0].end(), expected.begin(), expected.end());
  require(columns[1] == columns[0], "The registered columns are not the last ones.");
}


void run()
{
  test<2>({ "Cells", "Mean velocity x (m/s)", "Mean velocity y (m/s)" });
  test<3>({ "Cells", "Mean velocity x (m/s)", "Mean velocity y (m/s)", "Mean velocity z (m/s)" });
}

const UnitTest registered_test("registered_column", run);
} // namespace test_registered_column
