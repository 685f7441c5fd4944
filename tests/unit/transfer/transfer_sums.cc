// SPDX-License-Identifier: LGPL-2.1-or-later

// What the points hand to the nodes, for every basis and transfer: mass and momentum arrive whole, and internal forces
// of any stress cancel, because shape functions sum to one and their gradients to zero; a linear field of velocity that
// the points have with its gradient arrives as such at each node. The body touches walls and has oblique edges; stress,
// velocity and affine matrix are random.
#include "../soil.h"

#include <scree/transfer/transfer.h>


namespace test_transfer_sums
{
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
      require(values[NodalField<dim>::mass] >= 0., "A node has a negative mass.");
      mass += values[NodalField<dim>::mass];
      for (unsigned int a = 0; a < dim; ++a)
        {
          momentum[a] += values[NodalField<dim>::momentum + a];
          force[a] += values[NodalField<dim>::force + a];
          size_of_forces += std::abs(values[NodalField<dim>::force + a]);
        }
    }
  // Rounding of sums of some thousand terms; momentum relative to mass times the largest speed.
  const double all_mass = sum_of_ranks(points_mass), all_forces = sum_of_ranks(size_of_forces);
  expect(sum_of_ranks(mass) / all_mass, 1., 1e-13, "mass at the nodes over that of the points");
  expect(sum_of_ranks(momentum - points_momentum).norm() / all_mass, 0., 1e-13, "lost momentum");
  expect(sum_of_ranks(force).norm() / all_forces, 0., 1e-13, "sum of internal forces");
  require(all_forces > 100, "There are no internal forces.");
  if (!affine)
    return;

  // a + G x, with a = 1 and G = i + 2 j.
  const auto linear = [](const Point<dim> &x, const unsigned int i) {
    double value = 1.;
    for (unsigned int j = 0; j < dim; ++j)
      value += (i + 2. * j) * x[j];
    return value;
  };
  for_each_point(body.points, [&](const auto &point) {
    for (unsigned int i = 0; i < dim; ++i)
      {
        point.properties[body.layout.velocity + i] = linear(point.location, i);
        for (unsigned int j = 0; j < dim; ++j)
          point.properties[body.layout.affine + i * dim + j] = i + 2. * j;
      }
  });
  field.clear();
  transfer.to_grid(body, field);
  field.add_contributions();
  for (const unsigned int node : field.active_nodes())
    for (unsigned int i = 0; i < dim; ++i)
      expect(field[node][NodalField<dim>::momentum + i],
             field[node][NodalField<dim>::mass] * linear(grid.node_position(node), i),
             1e-12 * all_mass,
             method + ": momentum of a linear field");
}


const UnitTest registered("transfer_sums", [] {
  for (const std::string basis : { "spline", "linear" })
    for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
      {
        test<2>(basis, method);
        test<3>(basis, method);
      }
});
} // namespace test_transfer_sums

// Runs with mpirun=1,2.
