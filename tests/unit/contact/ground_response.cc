// SPDX-License-Identifier: LGPL-2.1-or-later

// What impulses on soil and water at oblique ground do to their velocities there: what the nodes do when the impulses
// are taken from them, symmetric and positive, with drag, absent phases and walls; the same on 1 and 2 ranks.

#include "../expect.h"
#include "../scattered_mixture.h"

#include <scree/contact/cut_cells/delassus_operator.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>

#include "../unit_test.h"

namespace test_ground_response
{
using namespace dealii;
using namespace scree;

template <int dim>
void test(const std::string &ground_expression, std::ostream &out)
{
  constexpr unsigned int mass = NodalField<dim>::mass, velocity = NodalField<dim>::velocity;
  ScatteredMixture<dim> mixture(ground_expression);
  const BackgroundGrid<dim> &grid   = mixture.grid;
  const CutCells<dim> &cut_cells    = mixture.cut_cells;
  const TwoPhaseMomentum<dim> &step = mixture.step;
  const MixtureNodes<dim> &nodes    = mixture.nodes;

  DelassusOperator<dim> response(grid, cut_cells);
  response.begin_step();
  const auto &segments = cut_cells.segments();
  std::vector<Tensor<1, dim>> first, second, of_first, of_second; // N s, and what they do, m/s
  for (unsigned int s = 0; s < segments.size(); ++s)
    for (const Phase phase : { Phase::soil, Phase::water })
      {
        response.add(s, phase);
        const Point<dim> x = mixture.place_of(segments[s]);
        first.push_back(vector_at(x, 10 + 3 * unsigned(phase)));
        second.push_back(vector_at(x, 20 + 3 * unsigned(phase)));
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

  // One contact after the other.
  std::vector<Tensor<1, dim>> nothing(first.size()), so_far;
  response.apply(nothing, so_far);
  for (unsigned int k = 0; k < first.size(); ++k)
    response.change(k, first[k]);
  double apart = 0;
  for (unsigned int k = 0; k < first.size(); ++k)
    apart = std::max(apart, (response.velocity_at(k) - of_first[k]).norm());
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1) // Others do not see what this rank changes.
    expect(apart, 0., 1e-11, "velocities after changes of single impulses");

  // The nodes themselves: absent phases follow the other, but feel no impulse.
  Budget<dim> balance;
  response.take(first, nodes, step, balance);
  mixture.soil.update_ghosts();
  mixture.water.update_ghosts();
  double difference = 0, size = 0;
  for (unsigned int k = 0; k < first.size(); ++k)
    {
      const CutFacet<dim> &segment = segments[k / 2];
      const NodalField<dim> &phase = k % 2 == 0 ? mixture.soil : mixture.water;
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


void run()
{
  std::ostream silent(nullptr);
  std::ostream &out = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : silent;
  test<2>("0.8*y - 0.6*x - 0.05", out);
  test<3>("0.7*z - 0.6*x - 0.38*y - 0.05", out);
}

const UnitTest registered("ground_response", run);
} // namespace test_ground_response
