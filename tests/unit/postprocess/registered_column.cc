// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of one file: registered here, they are the last ones of each row of the statistics, in order of their names.
#include "../test.h"

#include <scree/io/run_folder.h>
#include <scree/postprocess/statistics.h>

#include <sstream>

namespace test_registered_column
{
bool is_asked = false; // other tests of this program print all columns

const auto exists = [](const auto &) { return is_asked; };

const RegisterColumns registered_mean(
    Column{ "Mean velocity", "m/s", [](const auto &now) { return now.sums.momentum / now.sums.soil_mass; }, exists });

const RegisterColumns registered_cells(
    Column{ "Cells", "", [](const auto &now) { return now.grid.triangulation().n_active_cells(); }, exists });


template <int dim>
void print_last_columns(std::ostream &out)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 0.4), MPI_COMM_WORLD);
  Statistics<dim> statistics(grid, Tensor<1, dim>(), {});
  for (const bool asks : { false, true })
    {
      is_asked = asks;
      statistics.collect({}, {}, RunBalance<dim>(), 0., 0, 0., UpdateReport());
      std::istringstream head(table_head(statistics.columns()));
      std::string line;
      while (std::getline(head, line))
        if (line.find("lost") != std::string::npos || line.find("Cells") != std::string::npos ||
            line.find("Mean") != std::string::npos)
          out << line << '\n';
    }
  is_asked = false;
}


void run()
{
  print_last_columns<2>(std::cout);
  print_last_columns<3>(std::cout);
}

const UnitTest registered_test("registered_column", run);
} // namespace test_registered_column


// Output:
// # 15: Points lost
// # 16: Mass lost (kg)
// # 15: Points lost
// # 16: Mass lost (kg)
// # 17: Cells
// # 18: Mean velocity x (m/s)
// # 19: Mean velocity y (m/s)
// # 16: Points lost
// # 17: Mass lost (kg)
// # 16: Points lost
// # 17: Mass lost (kg)
// # 18: Cells
// # 19: Mean velocity x (m/s)
// # 20: Mean velocity y (m/s)
// # 21: Mean velocity z (m/s)
