// SPDX-License-Identifier: LGPL-2.1-or-later
// Speeds that limit a step: the largest, and a point whose speed is not a number is told in whatever order it comes.
#include "../test.h"

#include <scree/step/step_report.h>

namespace test_step_speeds
{
void run()
{
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double> &of_bodies :
       { std::vector<double>{ 1., 3., 2. }, { no_number, 3., 2. }, { 1., no_number, 2. }, { 1., 3., no_number } })
    {
      Speeds speeds;
      for (const double speed : of_bodies)
        {
          speeds.include_point(speed);
          speeds.include_wave(10. * speed);
        }
      std::cout << "points " << speeds.points << " m/s, waves " << speeds.wave << " m/s" << std::endl;
    }
}

const UnitTest registered("step_speeds", run);
} // namespace test_step_speeds


// Output:
// points 3 m/s, waves 30 m/s
// points nan m/s, waves 30 m/s
// points nan m/s, waves 20 m/s
// points nan m/s, waves 30 m/s
