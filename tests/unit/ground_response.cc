// SPDX-License-Identifier: LGPL-2.1-or-later

// What impulses on soil and water at oblique ground do to their velocities there: what the nodes do when the impulses
// are taken from them, symmetric and positive, with drag, absent phases and walls; the same on 1 and 2 ranks.

#include "expect.h"

#include <scree/geometry/expression_surface.h>
#include <scree/scheme/ground_response.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace dealii;
using namespace scree;

/// Any number from 0 to 1 that follows from a place and a seed: the same on all ranks.
template <int dim>
double number_at(const Point<dim> &x, const unsigned int seed)
{
  double sum = 0.7 * seed;
  for (unsigned int a = 0; a < dim; ++a)
    sum += (31. + 7. * a) * x[a];
  const double scattered = 1e3 * std::sin(sum);
  return scattered - std::floor(scattered);
}


template <int dim>
void test(const std::string &ground_expression, std::ostream &out)
{
  GridParameters grid_parameters;
  grid_parameters.lower_corner.assign(dim, 0.);
  grid_parameters.upper_corner.assign(dim, 1.);
  grid_parameters.cell_size = 0.25;
  const BackgroundGrid<dim> grid(grid_parameters, MPI_COMM_WORLD);
  const ExpressionSurface<dim> surface("", ground_expression, grid.cell_size());
  const SampledSurface<dim> samples(grid, surface);
  const RigidGround<dim> ground({ { &samples } });
  const OpenCells<dim> open_cells(grid, ground);

  const BoundaryConditions<dim> walls(grid, BoundaryParameters());
  const WaterBoundaryConditions<dim> water_walls(grid, WaterBoundaryParameters());
  const Constraints<dim> constraints(grid, walls, &water_walls);
  const Forcing<dim> forcing(grid, std::vector<double>(dim, 0.), BodyForceParameters(), BaseMotionParameters());
  const MixtureStep<dim> step(grid, constraints, forcing, 1000., Splitting());

  // Soil, water or both at the nodes, tied by little to much drag.
  NodalField<dim> soil(grid), water(grid);
  PoreField<dim> pores(grid);
  const MixtureNodes<dim> nodes{ soil, water, pores };
  constexpr unsigned int mass = NodalField<dim>::mass, velocity = NodalField<dim>::velocity;
  for (unsigned int i = 0; i < grid.n_owned_nodes(); ++i)
    {
      const Point<dim> x = grid.node_position(i);
      soil[i][mass]      = number_at(x, 1) < 0.2 ? 0. : 0.1 + number_at(x, 2);
      water[i][mass]     = number_at(x, 3) < 0.2 ? 0. : 0.1 + number_at(x, 4);
      if (soil[i][mass] > 0. && water[i][mass] > 0.)
        pores[i][PoreField<dim>::drag] = std::pow(10., 8. * number_at(x, 5) - 4.);
    }
  soil.update_ghosts();
  water.update_ghosts();

  GroundResponse<dim> response(grid, open_cells);
  response.clear();
  const auto &segments = open_cells.segments();
  std::vector<Tensor<1, dim>> first, second, of_first, of_second; // N s, and what they do, m/s
  for (unsigned int s = 0; s < segments.size(); ++s)
    for (const Phase phase : { Phase::soil, Phase::water })
      {
        response.add(s, phase);
        const Point<dim> x = grid.node_position(grid.nodes(segments[s].cell)[0]);
        Tensor<1, dim> a, b;
        for (unsigned int c = 0; c < dim; ++c)
          {
            a[c] = number_at(x, 10 + 3 * unsigned(phase) + c) - 0.5;
            b[c] = number_at(x, 20 + 3 * unsigned(phase) + c) - 0.5;
          }
        first.push_back(a);
        second.push_back(b);
      }
  response.start(nodes, step);
  response.apply(first, of_first);
  response.apply(second, of_second);

  const auto product = [](const std::vector<Tensor<1, dim>> &impulses, const std::vector<Tensor<1, dim>> &velocities) {
    double sum = 0;
    for (unsigned int k = 0; k < impulses.size(); ++k)
      sum += impulses[k] * velocities[k];
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  };
  const double work = product(first, of_first), mixed = product(first, of_second);
  expect(product(second, of_first), mixed, 1e-12 * work, "the response's other half");
  expect(work > 0., true, 0., "whether impulses do work");

  // The nodes themselves: absent phases follow the other, but feel no impulse.
  StepBalance<dim> balance;
  response.take(first, nodes, step, balance);
  soil.update_ghosts();
  water.update_ghosts();
  double difference = 0, size = 0;
  for (unsigned int k = 0; k < first.size(); ++k)
    {
      const GroundSegment<dim> &segment = segments[k / 2];
      const NodalField<dim> &phase      = k % 2 == 0 ? soil : water;
      Tensor<1, dim> mean;
      for (unsigned int i = 0; i < segment.shapes.size(); ++i)
        if (const double *node = phase[grid.nodes(segment.cell)[i]]; node[mass] > 0.)
          for (unsigned int c = 0; c < dim; ++c)
            mean[c] += segment.shapes[i] * node[velocity + c];
      difference = std::max(difference, (mean + of_first[k]).norm());
      size       = std::max(size, mean.norm());
    }
  expect(Utilities::MPI::max(difference, MPI_COMM_WORLD),
         0.,
         1e-12 * Utilities::MPI::max(size, MPI_COMM_WORLD),
         "velocity of the nodes at the ground");
  out << dim << "D: " << Utilities::MPI::sum(segments.size(), MPI_COMM_WORLD) << " segments, products "
      << std::setprecision(10) << work << ", " << mixed << std::endl;
}


int main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ostream silent(nullptr);
  std::ostream &out = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : silent;
  test<2>("0.8*y - 0.6*x - 0.05", out);
  test<3>("0.7*z - 0.6*x - 0.38*y - 0.05", out);
}
