// SPDX-License-Identifier: LGPL-2.1-or-later

// Energy is the potential of the stress; plane strain is three dimensions without the third.

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/materials/laws/linear_elastic.h>
#include <scree/materials/table.h>

#include <deal.II/base/exceptions.h>

#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"
#include "one_point.h"

namespace test_hencky_elasticity
{
using namespace dealii;
using namespace scree;

template <typename Law>
void test_potential(const std::string &name, const Law &law, const PrincipalValues &mean, RandomNumbers &random)
{
  constexpr double difference = 1e-6;
  double largest_error        = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      PrincipalValues strain = mean;
      for (double &value : strain)
        value += 2e-4 * random.uniform(-1, 1);

      double internal_variables[2] = { 1e9, 0 }; // A yield surface far away.
      PrincipalValues stress, same_strain = strain;
      UpdateReport report;
      const bool is_plastic = return_point(law, same_strain, internal_variables, 1, stress, report);
      AssertThrow(!is_plastic, ExcMessage("The state should be elastic."));
      for (unsigned int k = 0; k < 3; ++k)
        {
          PrincipalValues more = strain, less = strain;
          more[k] += difference;
          less[k] -= difference;
          const double slope = (law.energy(more) - law.energy(less)) / (2 * difference);
          const double scale = std::abs(stress[0]) + std::abs(stress[1]) + std::abs(stress[2]);
          largest_error      = std::max(largest_error, std::abs(slope - stress[k]) / scale);
        }
    }
  AssertThrow(largest_error < 1e-6, ExcMessage(name + ": energy is no potential, " + std::to_string(largest_error)));
  std::cout << name << ": stress is the derivative of the energy: OK" << std::endl;
}


void test_plane_strain(const std::string &name, RandomNumbers &random)
{
  MaterialParameters parameters;
  parameters.law   = name;
  const auto plane = make_material<2>(parameters);
  const auto solid = make_material<3>(parameters);

  double plane_b[4], plane_stress[4], plane_internal[2], solid_b[6], solid_stress[6], solid_internal[2];
  const double start[6] = { -8e3, -1e4, -9e3, 0, 0, 0 };
  plane->initialise(start, plane_b, plane_stress, plane_internal);
  solid->initialise(start, solid_b, solid_stress, solid_internal);
  double J = 1, largest_error = 0;
  UpdateReport plane_report, solid_report;
  for (unsigned int step = 0; step < 1000; ++step)
    {
      Tensor<2, 2> in_plane;
      Tensor<2, 3> full;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          full[i][j] = in_plane[i][j] = (i == j ? 1 : 0) + 3e-3 * random.uniform(-1, 1) + (i < j ? 1e-3 : 0);
      const double stretch = 1 + 1e-3 * random.uniform(-1, 1), one = 1;
      full[2][2] = stretch;
      J *= determinant(full);
      plane->update(
          { 1, 0, plane_b, plane_stress, plane_internal }, { &in_plane[0][0], &stretch, &J, &one }, plane_report);
      solid->update({ 1, 0, solid_b, solid_stress, solid_internal }, { &full[0][0], nullptr, &J, &one }, solid_report);
      double scale = 1;
      for (unsigned int c = 0; c < 4; ++c)
        scale = std::max(scale, std::abs(plane_stress[c]));
      for (unsigned int c = 0; c < 4; ++c)
        largest_error = std::max(largest_error, std::abs(plane_stress[c] - solid_stress[c]) / scale);
    }
  AssertThrow(plane_report.n_substeps == solid_report.n_substeps, ExcMessage("Sub-steps differ."));
  AssertThrow(largest_error < 1e-8, ExcMessage("Plane strain is not 3D: " + std::to_string(largest_error)));
  std::cout << name << ": plane strain is 3D: OK, " << plane_report.n_substeps << " sub-steps" << std::endl;
}


void run()
{
  RandomNumbers random;
  const MaterialParameters parameters;
  test_potential(
      "linear elastic", LinearElastic(parameters.of<LinearElasticParameters>()), { { 0.01, -0.02, 0.015 } }, random);
  test_potential(
      "Mohr-Coulomb", MohrCoulomb(parameters.of<MohrCoulombParameters>()), { { -0.01, -0.01, -0.01 } }, random);
  test_potential("Nor-Sand", NorSand(parameters.of<NorSandParameters>()), { { -2e-3, -2e-3, -2e-3 } }, random);
  for (const std::string name : { "linear elastic", "Mohr-Coulomb", "Nor-Sand" })
    test_plane_strain(name, random);
}

const UnitTest registered("hencky_elasticity", run);
} // namespace test_hencky_elasticity


// Output:
// linear elastic: stress is the derivative of the energy: OK
// Mohr-Coulomb: stress is the derivative of the energy: OK
// Nor-Sand: stress is the derivative of the energy: OK
// linear elastic: plane strain is 3D: OK, 1000 sub-steps
// Mohr-Coulomb: plane strain is 3D: OK, 1000 sub-steps
// Nor-Sand: plane strain is 3D: OK, 2946 sub-steps
