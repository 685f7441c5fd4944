// SPDX-License-Identifier: LGPL-2.1-or-later

// What the points hand to the nodes, for every basis and transfer, on one rank and on two: mass and momentum arrive
// whole, and internal forces of any stress cancel, because shape functions sum to one and their gradients to zero. The
// body touches walls and has oblique edges; stress, velocity and affine matrix are random.

#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/transfer/transfer.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

#include "../elastic_soil.h"
#include "../grid_box.h"
#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_transfer_sums
{
using namespace dealii;
using namespace scree;

template <int dim>
void test(const std::string &basis, const std::string &method)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., dim == 2 ? 0.9 : 0.6, 0.1, basis), MPI_COMM_WORLD);

  TransferParameters transfer_parameters;
  transfer_parameters.method = method;
  const bool affine          = transfer_parameters.carries_affine_field();
  const Transfer<dim> transfer(grid, transfer_parameters, StabilisationParameters());

  ElasticSoil<dim> body(grid, "x + 0.7 * y < 0.55", 3, 0., 1000., PropertyLayout<dim>(0, affine));

  RandomNumbers random;
  double points_mass = 0;
  Tensor<1, dim> points_momentum;
  for_each_point(body.points, [&](const auto &point) {
    double *properties = point.properties;
    for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
      properties[body.layout.stress + c] = random.uniform(-1e4, 1e4);
    for (unsigned int c = 0; affine && c < dim * dim; ++c)
      properties[body.layout.affine + c] = random.uniform(-1, 1);
    points_mass += properties[body.layout.mass];
    for (unsigned int a = 0; a < dim; ++a)
      {
        properties[body.layout.velocity + a] = random.uniform(-1, 1);
        points_momentum[a] += properties[body.layout.mass] * properties[body.layout.velocity + a];
      }
  });

  NodalField<dim> field(grid);
  field.clear();
  transfer.to_grid(body, field);
  field.add_contributions();

  double mass = 0, size_of_forces = 0;
  Tensor<1, dim> momentum, force;
  for (const unsigned int node : field.active_nodes())
    {
      const double *values = field[node];
      AssertThrow(values[NodalField<dim>::mass] >= 0., ExcMessage("A node has a negative mass."));
      mass += values[NodalField<dim>::mass];
      for (unsigned int a = 0; a < dim; ++a)
        {
          momentum[a] += values[NodalField<dim>::momentum + a];
          force[a] += values[NodalField<dim>::force + a];
          size_of_forces += std::abs(values[NodalField<dim>::force + a]);
        }
    }
  const auto sum = [](const auto &value) { return Utilities::MPI::sum(value, MPI_COMM_WORLD); };

  // Rounding of sums of some thousand terms; momentum relative to mass times the largest speed.
  const double all_mass       = sum(points_mass);
  const double mass_error     = std::abs(sum(mass) - all_mass) / all_mass;
  const double momentum_error = sum(momentum - points_momentum).norm() / all_mass;
  const double force_error    = sum(force).norm() / sum(size_of_forces);
  AssertThrow(mass_error < 1e-13, ExcMessage("Mass is lost: " + Utilities::to_string(mass_error)));
  AssertThrow(momentum_error < 1e-13, ExcMessage("Momentum is lost: " + Utilities::to_string(momentum_error)));
  AssertThrow(force_error < 1e-13, ExcMessage("Internal forces do not cancel: " + Utilities::to_string(force_error)));
  AssertThrow(sum(size_of_forces) > 100, ExcMessage("There are no internal forces."));
  std::cout << dim << "D " << basis << ' ' << method << ": mass, momentum, force OK" << std::endl;
}


void run()
{
  for (const std::string basis : { "spline", "linear" })
    for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
      {
        test<2>(basis, method);
        test<3>(basis, method);
      }
}

const UnitTest registered("transfer_sums", run);
} // namespace test_transfer_sums


// Output of mpirun=1,2:
// 2D spline FLIP: mass, momentum, force OK
// 3D spline FLIP: mass, momentum, force OK
// 2D spline TPIC: mass, momentum, force OK
// 3D spline TPIC: mass, momentum, force OK
// 2D spline AFLIP: mass, momentum, force OK
// 3D spline AFLIP: mass, momentum, force OK
// 2D linear FLIP: mass, momentum, force OK
// 3D linear FLIP: mass, momentum, force OK
// 2D linear TPIC: mass, momentum, force OK
// 3D linear TPIC: mass, momentum, force OK
// 2D linear AFLIP: mass, momentum, force OK
// 3D linear AFLIP: mass, momentum, force OK
