// SPDX-License-Identifier: LGPL-2.1-or-later

// Free flight: an elastic body turns, stretches and flies obliquely across the cells, far from walls, without gravity.
//
// Every transfer keeps linear momentum, because shape functions sum to one and their gradients to zero; the bound is
// rounding over the steps.
//
// Angular momentum is not kept; what is lost of this motion is compared with what they lost before, not with rounding.
// TPIC and AFLIP carry the gradient G: its spin is that of G D, where D is a quarter of the squared cell size. FLIP
// carries no spin at all.

#include <scree/materials/laws/linear_elastic.h>
#include <scree/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

#include "../unit_test.h"

namespace test_transfer_conservation
{
using namespace dealii;
using namespace scree;

template <int dim>
struct Momenta
{
  Tensor<1, dim> linear; // N s
  Tensor<1, 3> angular;  // N m s
  double linear_size;    // sum of m |v|
  double angular_size;   // sum of m |x x v|
};

/// Sums over all points; the affine matrix times `spin` is B.
template <int dim>
Momenta<dim> momenta(const Simulation<dim> &simulation, const double spin)
{
  std::vector<double> sums(dim + 5, 0.);
  for (const auto &body : simulation.state_of_scene().bodies)
    for_each_point(body.points, [&](const auto &point) {
      const double *properties = point.properties;
      const double mass        = properties[body.layout.mass];
      Tensor<1, 3> x, v;
      Tensor<2, 3> affine;
      for (unsigned int a = 0; a < dim; ++a)
        {
          x[a] = point.location[a];
          v[a] = properties[body.layout.velocity + a];
          sums[a] += mass * v[a];
          if (spin > 0)
            for (unsigned int b = 0; b < dim; ++b)
              affine[a][b] = spin * properties[body.layout.affine + a * dim + b];
        }
      const Tensor<1, 3> orbit = cross_product_3d(x, v);
      for (unsigned int a = 0; a < 3; ++a)
        sums[dim + a] += mass * (orbit[a] + affine[(a + 2) % 3][(a + 1) % 3] - affine[(a + 1) % 3][(a + 2) % 3]);
      sums[dim + 3] += mass * v.norm();
      sums[dim + 4] += mass * orbit.norm();
    });
  Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
  Momenta<dim> result;
  for (unsigned int a = 0; a < dim; ++a)
    result.linear[a] = sums[a];
  for (unsigned int a = 0; a < 3; ++a)
    result.angular[a] = sums[dim + a];
  result.linear_size  = sums[dim + 3];
  result.angular_size = sums[dim + 4];
  return result;
}

/// Flies for `n_steps`; returns the largest relative drifts of linear and of angular momentum.
template <int dim>
std::pair<double, double> fly(const std::string &method, const unsigned int n_steps)
{
  Parameters parameters;
  parameters.dimension        = dim;
  parameters.output_directory = "results";
  parameters.output.graphics  = "none";
  parameters.output.screen    = "nothing";
  parameters.gravity.assign(dim, 0.);
  parameters.grid.lower_corner.assign(dim, 0.);
  parameters.grid.upper_corner = { 3., 2.4 };
  if (dim == 3)
    parameters.grid.upper_corner = { 2.1, 2.1, 1.6 };
  parameters.transfer.method     = method;
  parameters.transfer.pic_rate   = 0;
  parameters.stabilisation.f_bar = "none";

  auto &body                                                = parameters.bodies[0];
  body.material.law                                         = "linear elastic";
  body.material.of<LinearElasticParameters>().young_modulus = 1e5;
  body.seeding.grain_density                                = 1000;
  body.seeding.points_per_cell                              = dim == 2 ? 3 : 2;
  const std::string in_2d                                   = "(x - 0.7)^2 + (y - 0.6)^2";
  body.seeding.region = dim == 2 ? in_2d + " < 0.3^2" : in_2d + " + (z - 0.6)^2 < 0.25^2";
  // A flight of 1.2 m or more, linear stretching, two turns a second.
  body.seeding.initial_velocity = "3 - 12 * (y - 0.6) + x - 0.7; 2 + 12 * (x - 0.7) - 0.5 * (y - 0.6)";
  if (dim == 3)
    body.seeding.initial_velocity =
        "2 - 12 * (y - 0.6) + x - 0.7; 2 + 12 * (x - 0.7) - 5 * (z - 0.6); 0.7 + 5 * (y - 0.6)";

  Simulation<dim> simulation(parameters, Start::fresh, MPI_COMM_WORLD);
  const double cell_size   = parameters.grid.cell_size;
  const double spin        = method == "TPIC" || method == "AFLIP" ? 0.25 * cell_size * cell_size : 0.;
  const Momenta<dim> start = momenta(simulation, spin);
  double linear = 0, angular = 0;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      simulation.advance(0.003);
      const Momenta<dim> now = momenta(simulation, spin);
      linear                 = std::max(linear, (now.linear - start.linear).norm() / start.linear_size);
      angular                = std::max(angular, (now.angular - start.angular).norm() / start.angular_size);
    }
  return { linear, angular };
}

template <int dim>
void test()
{
  for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
    {
      const auto [linear, angular] = fly<dim>(method, 120);
      AssertThrow(linear < 1e-12, ExcMessage(method + " loses momentum: " + Utilities::to_string(linear)));
      std::cout << dim << "D spline " << method << ": linear momentum OK, angular momentum drifts by " << angular
                << std::endl;
    }
}


void run()
{
  test<2>();
  test<3>();
}

const UnitTest registered("transfer_conservation", run);
} // namespace test_transfer_conservation


// Output of mpirun=1,2:
// 2D spline FLIP: linear momentum OK, angular momentum drifts by 0.0338662
// 2D spline TPIC: linear momentum OK, angular momentum drifts by 0.000223433
// 2D spline AFLIP: linear momentum OK, angular momentum drifts by 0.00674874
// 3D spline FLIP: linear momentum OK, angular momentum drifts by 0.0252322
// 3D spline TPIC: linear momentum OK, angular momentum drifts by 0.000167692
// 3D spline AFLIP: linear momentum OK, angular momentum drifts by 0.00475995
