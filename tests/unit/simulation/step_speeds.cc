// SPDX-License-Identifier: LGPL-2.1-or-later
// Speeds that limit a step: the largest, and a point whose speed is not a number is told in whatever order it comes;
// largest values and sums over ranks by one message.
#include "../test.h"

#include <scree/step/step_report.h>

namespace test_step_speeds
{
const UnitTest registered("step_speeds", [] {
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
      const bool is_number = of_bodies[0] + of_bodies[1] + of_bodies[2] == 6.;
      require(is_number ? speeds.points == 3. : std::isnan(speeds.points), "speed of the points");
      expect(speeds.wave, std::isnan(of_bodies[1]) ? 20. : 30., 0., "speed of the waves");
    }

  const double rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
               n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  double mass = 1. + rank, loss = -rank;
  std::vector<double> largest{ rank, -rank, 7. };
  NumbersOf{ &mass, &loss }.sum_over_ranks(MPI_COMM_WORLD, largest);
  expect(largest[0], n_ranks - 1., 0., "largest rank");
  expect(largest[1], 0., 0., "least rank");
  expect(largest[2], 7., 0., "largest of equal numbers");
  expect(mass, n_ranks * (n_ranks + 1.) / 2., 0., "sum over ranks");
  expect(loss, -n_ranks * (n_ranks - 1.) / 2., 0., "sum of losses");
});
} // namespace test_step_speeds

// Runs with mpirun=1,2.
