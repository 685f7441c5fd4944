// SPDX-License-Identifier: LGPL-2.1-or-later
// The files that a table grows in: names of columns; times in names of files.
#include "../test.h"

#include <scree/io/run_folder.h>
#include <scree/io/output_parameters.h>

namespace test_table_files
{
void test_head()
{
  expect_text(csv_head({ "Time (s)", "Obstacle a, \"b\" force x (N)" }),
              "Time (s),\"Obstacle a, \"\"b\"\" force x (N)\"\n",
              "names with commas and quotes");
}


/// Times of the start, of an interval and of the end in names of files.
void test_label(const double end, const double interval, const std::string &expected)
{
  const TimeLabel label(end, interval);
  expect_text(label(0.) + ' ' + label(interval) + ' ' + label(end), expected, "end " + std::to_string(end));
}


const UnitTest registered_test("table_files", [] {
  test_head();
  test_label(40., 5., "00s 05s 40s");
  test_label(2., 0.05, "0.00s 0.05s 2.00s");
  test_label(1., 1. / 3., "0.000000000s 0.333333333s 1.000000000s");
});
} // namespace test_table_files
