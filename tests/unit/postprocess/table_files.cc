// SPDX-License-Identifier: LGPL-2.1-or-later

// The files that a table grows in: names of columns in a .csv, rows before and after a resume; times in names of files.
#include "../test.h"

#include <scree/io/run_folder.h>
#include <scree/io/output_parameters.h>
#include <scree/io/files.h>

#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>

#include <filesystem>
#include <sstream>

namespace test_table_files
{
void print_names()
{
  for (const std::string column : { "Time (s)",
                                    "Step",
                                    "Momentum x (N s)",
                                    "Front 90 % (m)",
                                    "Front 99.5 % (m)",
                                    "Stress oscillation (-)",
                                    "p oscillation (-)",
                                    "Obstacle Pier-1 moment z (N m)",
                                    "Velocity x (m/s)",
                                    "mass (kg/m^2)",
                                    "Density (kg/m^3)",
                                    "Rate (1/s)",
                                    "Fill (%)" })
    std::cout << column << " -> " << csv_name(column) << '\n';
  std::cout << csv_head({ "Time (s)", "Force A (N)", "Force a (N)" });
}


void print_file(const std::string &file)
{
  std::cout << file << ":\n" << read_whole_file(file);
}


/// A run that writes two rows behind its checkpoint, and is resumed.
void grow()
{
  const std::vector<std::string> columns{ "Time (s)", "Front 90 % (m)", "Step" };
  std::filesystem::remove_all("tables");
  RunFolder folder("tables", false, MPI_COMM_WORLD);
  TableFile before(folder, "table"), after(folder, "table");
  before.append(columns, { { 0., 1. / 3., 0. } });
  std::stringstream checkpoint;
  boost::archive::text_oarchive(checkpoint) << before;
  before.append(columns, { { 0.1, std::numeric_limits<double>::quiet_NaN(), 12. }, { 0.2, 1e-20, 24. } });
  print_file("tables/table.csv");
  boost::archive::text_iarchive(checkpoint) >> after;
  after.cut();
  after.append(columns, { { 0.1, 1e6, 12. } });
  after.sync();
  after.complete();
  print_file("tables/table");
  print_file("tables/table.csv");
}


void print_labels()
{
  for (const auto &[end, interval] :
       std::vector<std::pair<double, double>>{ { 40., 5. }, { 2., 0.05 }, { 1., 1. / 3. } })
    {
      const TimeLabel label(end, interval);
      std::cout << "end " << end << " s, every " << interval << " s: " << label(0.) << ' ' << label(interval) << ' '
                << label(end) << '\n';
    }
}


const UnitTest registered_test("table_files", [] {
  print_names();
  grow();
  print_labels();
});
} // namespace test_table_files


// Output:
// Time (s) -> time_s
// Step -> step
// Momentum x (N s) -> momentum_x_Ns
// Front 90 % (m) -> front_90_m
// Front 99.5 % (m) -> front_99_5_m
// Stress oscillation (-) -> stress_oscillation
// p oscillation (-) -> p_oscillation
// Obstacle Pier-1 moment z (N m) -> obstacle_pier_1_moment_z_Nm
// Velocity x (m/s) -> velocity_x_m_s
// mass (kg/m^2) -> mass_kg_m2
// Density (kg/m^3) -> density_kg_m3
// Rate (1/s) -> rate_1_s
// Fill (%) -> fill_percent
// time_s,force_a_N,force_a_N_2
// tables/table.csv:
// time_s,front_90_m,step
// 0,0.3333333333333,0
// 0.1,nan,12
// 0.2,1e-20,24
// tables/table:
// # 1: Time (s)
// # 2: Front 90 % (m)
// # 3: Step
// 0.000000000000e+00 3.333333333333e-01 0.000000000000e+00
// 1.000000000000e-01 1.000000000000e+06 1.200000000000e+01
// tables/table.csv:
// time_s,front_90_m,step
// 0,0.3333333333333,0
// 0.1,1000000,12
// end 40 s, every 5 s: 00s 05s 40s
// end 2 s, every 0.05 s: 0.00s 0.05s 2.00s
// end 1 s, every 0.333333 s: 0.000000000s 0.333333333s 1.000000000s
