// SPDX-License-Identifier: LGPL-2.1-or-later
// Damping of the skeleton: its stress is the damping time times the rate of the stress that turns with the points, so
// that a rigid rotation has none, and it acts at the nodes as the stress does.
#include "../soil.h"

#include <scree/transfer/transfer.h>

#include <deal.II/base/symmetric_tensor.h>

namespace test_skeleton_damping
{
template <int dim>
void test()
{
  constexpr unsigned int n = n_symmetric_components<dim>;
  const BackgroundGrid<dim> grid(grid_box<dim>(0., 0.6, 0.1, "spline"), MPI_COMM_WORLD);
  ElasticSoil<dim> body(grid, "x + 0.7 * y < 0.45", 2, 0., 1000., PropertyLayout<dim>(0, false, 0, true));
  const unsigned int stress = body.layout.stress, damping = body.layout.damping;

  RandomNumbers random;
  constexpr double rate = 3., angle = 1e-7; // of the damping time over the step; rad
  for (const auto &cell : body.points.cells())
    {
      BlockMotion<dim> motion;
      motion.resize(cell.n_points);
      for (unsigned int p = 0; p < cell.n_points; ++p)
        for (unsigned int c = 0; c < n; ++c)
          cell.properties_of(p)[stress + c] = random.uniform(-1e4, 1e4);
      SkeletonDamping<dim> of_cell;
      of_cell.begin(body, cell, cell.n_points);
      std::vector<double> change;
      for (unsigned int p = 0; p < cell.n_points; ++p)
        {
          Tensor<2, 3> turn = unit_symmetric_tensor<3>();
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i + 1; j < dim; ++j)
              {
                turn[i][j] = angle * random.uniform(-1, 1);
                turn[j][i] = -turn[i][j];
              }
          for (unsigned int i = 0; i < dim * dim; ++i)
            motion.deformation_increment[i * motion.pitch + p] = turn[i / dim][i % dim];
          double *to = cell.properties_of(p) + stress, components[6] = {};
          std::copy_n(to, n, components);
          const auto turned = symmetrize(turn * Tensor<2, 3>(SymmetricTensor<2, 3>(components)) * transpose(turn));
          for (unsigned int c = 0; c < n; ++c)
            {
              change.push_back(random.uniform(-1., 1.));
              to[c] = turned.access_raw_entry(c) + change.back();
            }
        }
      of_cell.finish(body, cell, cell.n_points, motion.material_motion(0, 1., 0.), rate);
      for (unsigned int p = 0; p < cell.n_points; ++p)
        for (unsigned int c = 0; c < n; ++c)
          expect(cell.properties_of(p)[damping + c], rate * change[p * n + c], 1e-9, "damping");
    }

  const Transfer<dim> transfer(grid, TransferParameters(), StabilisationParameters());
  NodalField<dim> damped(grid), stressed(grid);
  damped.clear();
  transfer.to_grid(body, damped);
  for_each_point(body.points, [&](const auto &point) {
    for (unsigned int c = 0; c < n; ++c)
      {
        point.properties[stress + c] += point.properties[damping + c];
        point.properties[damping + c] = 0.;
      }
  });
  stressed.clear();
  transfer.to_grid(body, stressed);
  double difference = 0., size = 0.;
  for (const unsigned int node : damped.active_nodes())
    for (unsigned int a = 0; a < dim; ++a)
      {
        const unsigned int force = NodalField<dim>::force + a;
        difference               = std::max(difference, std::abs(damped[node][force] - stressed[node][force]));
        size                     = std::max(size, std::abs(stressed[node][force]));
      }
  require(difference < 1e-12 * size, "The nodes do not have the stress of the damping.");
}


const UnitTest entry("skeleton_damping", [] {
  test<2>();
  test<3>();
});
} // namespace test_skeleton_damping
