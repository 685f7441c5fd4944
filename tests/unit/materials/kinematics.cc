// SPDX-License-Identifier: LGPL-2.1-or-later
// What all laws share: principal values, axes and logarithmic strain of b = I + small, also where principal values
// coincide; energy is the potential of the stress; the stress turns with the observer; motions and starts that cannot
// be are refused.
#include "one_point.h"

#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/table.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/physics/transformations.h>

namespace test_kinematics
{
using Physics::Transformations::Rotations::rotation_matrix_3d;

template <int dim>
void test_principal_values(RandomNumbers &random)
{
  for (unsigned int i = 0; i < 200000; ++i)
    {
      const double size = random.log_uniform(1e-12, 1e-1);
      PrincipalValues strain;
      for (double &value : strain)
        value = size * random.uniform(-1, 1);
      if (i % 3 == 0)
        strain[1] = strain[0]; // Coincident.
      if (i % 9 == 0)
        strain[2] = strain[0] + 1e-15;

      Tensor<2, 3> Q = rotation_matrix_3d(Tensor<1, 3>({ 0., 0., 1. }), random.uniform(0, numbers::PI)), b;
      if (dim == 3)
        Q = Q * rotation_matrix_3d(Tensor<1, 3>({ 1., 0., 0. }), random.uniform(0, numbers::PI));
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            b[r][c] += std::exp(2 * strain[k]) * Q[r][k] * Q[c][k];
      const double components[6] = { b[0][0], b[1][1], b[2][2], b[0][1], b[0][2], b[1][2] };

      const PrincipalFrame<dim> frame(components);
      PrincipalValues found = log_strain(frame.values());
      double again[6];
      left_cauchy_green_of(frame, found, again);
      for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
        expect(again[c], components[c], 1e-14, "composition");
      std::sort(found.begin(), found.end());
      std::sort(strain.begin(), strain.end());
      expect(largest_difference(found, strain), 0, 5e-15, "error of the logarithmic strain");
    }
}


template <typename Law>
void test_potential(const std::string &name, const Law &law, const PrincipalValues &mean, RandomNumbers &random)
{
  for (unsigned int i = 0; i < 1000; ++i)
    {
      PrincipalValues strain = mean, stress;
      for (double &value : strain)
        value += 2e-4 * random.uniform(-1, 1);
      double internal[2]          = { 1e9, 0 }; // A yield surface far away.
      PrincipalValues same_strain = strain;
      UpdateReport report;
      require(!return_point(law, same_strain, internal, 1, stress, report), "The state should be elastic.");
      const double scale = std::abs(stress[0]) + std::abs(stress[1]) + std::abs(stress[2]);
      for (unsigned int k = 0; k < 3; ++k)
        expect((energy_slope(law, strain, k, 1e-6) - stress[k]) / scale, 0, 1e-6, name + ": slope less stress");
    }
}


/// A path seen by an observer who turns by `angle` a step.
void test_objectivity(const std::string &law,
                      const double angle,
                      const double strain,
                      const unsigned int n_substeps,
                      const double bound)
{
  PointOfMaterial<3> still(law, -1e4, -7e3), turning(law, -1e4, -7e3);
  Tensor<2, 3> before = unit_symmetric_tensor<3>();
  for (unsigned int step = 1; step <= 500; ++step)
    {
      Tensor<2, 3> increment = unit_symmetric_tensor<3>();
      increment[0][1]        = strain;
      increment[1][1] += 0.02 * strain;
      increment[2][0]        = 0.3 * strain;
      const Tensor<2, 3> now = rotation_matrix_3d(Tensor<1, 3>({ 0.6, 0., 0.8 }), step * angle);
      still.update(increment);
      turning.update(now * increment * transpose(before));
      before                    = now;
      const Tensor<2, 3> wanted = now * SymmetricTensor<2, 3>(still.stress) * transpose(now);
      const Tensor<2, 3> found  = SymmetricTensor<2, 3>(turning.stress);
      expect((found - wanted).norm() / wanted.norm(), 0, bound, law + ": difference of the observers' stresses");
    }
  expect(still.report.n_substeps + turning.report.n_substeps, n_substeps, 0, law + ": number of sub-steps");
}


template <int dim>
void test_motions(const std::string &law)
{
  PointOfMaterial<dim> point(law, -1e4, -8e3);
  const auto refused = [&](const double component, const double J) {
    Tensor<2, dim> increment = unit_symmetric_tensor<dim>();
    increment[0][0]          = component;
    expect_refusal(
        [&] {
          point.J = J / determinant(increment);
          point.update(increment);
        },
        "cannot follow",
        law + " at " + std::to_string(component) + ", " + std::to_string(J));
  };
  refused(std::numeric_limits<double>::quiet_NaN(), 1);
  refused(-0.1, 1); // inside out
  refused(1, 0);    // no volume
  if (law.rfind("Nor-Sand", 0) == 0)
    refused(3, 1); // beyond all sub-steps
}


const UnitTest registered("kinematics", [] {
  RandomNumbers random;
  test_principal_values<2>(random);
  test_principal_values<3>(random);

  const MaterialParameters parameters;
  test_potential(
      "linear elastic", LinearElastic(parameters.of<LinearElasticParameters>()), { { 0.01, -0.02, 0.015 } }, random);
  test_potential(
      "Mohr-Coulomb", MohrCoulomb(parameters.of<MohrCoulombParameters>()), { { -0.01, -0.01, -0.01 } }, random);
  test_potential("Nor-Sand", NorSand(parameters.of<NorSandParameters>()), { { -2e-3, -2e-3, -2e-3 } }, random);

  for (const std::string law : { "linear elastic", "Mohr-Coulomb", "Nor-Sand", "viscoinertial grains" })
    {
      test_objectivity(law, 7e-4, 2e-4, 1000, 1e-9); // one sub-step an update
      if (law != "Nor-Sand")
        test_objectivity(law, 0.1, 2e-4, 1000, 1e-9);
    }
  // The same number of sub-steps for both observers. Those of the second follow the chord of its turn, not the arc.
  test_objectivity("Nor-Sand", 4e-4, 2.5e-3, 3000, 1e-4);

  for (const std::string law : { "linear elastic", "Mohr-Coulomb", "Nor-Sand", "Nor-Sand (Jefferies-Been)" })
    {
      test_motions<2>(law);
      test_motions<3>(law);
    }
  for (const std::string law : { "Nor-Sand", "Nor-Sand (Jefferies-Been)" })
    {
      expect_refusal([&] { PointOfMaterial<2>(law, 1e3, 1e3); }, "tension", law + " under tension");
      expect_refusal([&] { PointOfMaterial<2>(law, -1e4, -1e2); }, "K0", law + " with a small K0");
    }
  expect_refusal([] { PointOfMaterial<2>("Mohr-Coulomb", -1e4, -3e3); }, "K0", "Mohr-Coulomb with a small K0");
});
} // namespace test_kinematics
