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
    const Tensor<1, dim> velocity = random.point<dim>(-1, 1);
    set_vector(properties, body.layout.velocity, velocity);
    points_mass += properties[body.layout.mass];
    points_momentum += properties[body.layout.mass] * velocity;
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
      momentum += vector_of<dim>(values, NodalField<dim>::momentum);
      force += vector_of<dim>(values, NodalField<dim>::force);
      size_of_forces += vector_of<dim>(values, NodalField<dim>::force).norm();
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
  Tensor<1, dim> constant;
  Tensor<2, dim> gradient;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        constant[i]    = 1.;
        gradient[i][j] = i + 2. * j;
      }
  for_each_point(body.points, [&](const auto &point) {
    set_vector<dim>(point.properties, body.layout.velocity, constant + gradient * point.location);
    for (unsigned int i = 0; i < dim; ++i)
      set_vector(point.properties, body.layout.affine + i * dim, gradient[i]);
  });
  field.clear();
  transfer.to_grid(body, field);
  field.add_contributions();
  for (const unsigned int node : field.active_nodes())
    {
      const Tensor<1, dim> expected = constant + gradient * grid.node_position(node);
      const auto momentum_of_node   = vector_of<dim>(field[node], NodalField<dim>::momentum);
      expect((momentum_of_node - field[node][NodalField<dim>::mass] * expected).norm(),
             0.,
             1e-12 * all_mass,
             method + ": error of the momentum of a linear field");
    }
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
