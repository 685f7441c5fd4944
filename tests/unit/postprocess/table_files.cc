// SPDX-License-Identifier: LGPL-2.1-or-later
// The files that a table grows in: names of columns in a .csv; times in names of files.
#include "../test.h"

#include <scree/io/run_folder.h>
#include <scree/io/output_parameters.h>

#include <map>

namespace test_table_files
{
void test_names()
{
  for (const auto &[column, name] :
       std::map<std::string, std::string>{ { "Time (s)", "time_s" },
                                           { "Step", "step" },
                                           { "Momentum x (N s)", "momentum_x_Ns" },
                                           { "Front 90 % (m)", "front_90_m" },
                                           { "Front 99.5 % (m)", "front_99_5_m" },
                                           { "Stress oscillation (-)", "stress_oscillation" },
                                           { "p oscillation (-)", "p_oscillation" },
                                           { "Obstacle Pier-1 moment z (N m)", "obstacle_pier_1_moment_z_Nm" },
                                           { "Velocity x (m/s)", "velocity_x_m_s" },
                                           { "mass (kg/m^2)", "mass_kg_m2" },
                                           { "Density (kg/m^3)", "density_kg_m3" },
                                           { "Rate (1/s)", "rate_1_s" },
                                           { "Fill (%)", "fill_percent" } })
    expect_text(csv_name(column), name, column);
  expect_text(
      csv_head({ "Time (s)", "Force A (N)", "Force a (N)" }), "time_s,force_a_N,force_a_N_2\n", "names by case");
}


/// Times of the start, of an interval and of the end in names of files.
void test_label(const double end, const double interval, const std::string &expected)
{
  const TimeLabel label(end, interval);
  expect_text(label(0.) + ' ' + label(interval) + ' ' + label(end), expected, "end " + std::to_string(end));
}


const UnitTest registered_test("table_files", [] {
  test_names();
  test_label(40., 5., "00s 05s 40s");
  test_label(2., 0.05, "0.00s 0.05s 2.00s");
  test_label(1., 1. / 3., "0.000000000s 0.333333333s 1.000000000s");
});
} // namespace test_table_files
