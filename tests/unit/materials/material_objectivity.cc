// SPDX-License-Identifier: LGPL-2.1-or-later

// A path seen by a turning observer: the stress turns along.

#include <scree/materials/table.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/physics/transformations.h>

#include <iostream>

#include "../unit_test.h"

namespace test_material_objectivity
{
using namespace dealii;
using namespace scree;

struct State
{
  double left_cauchy_green[6], stress[6], internal_variables[2];
};


Tensor<2, 3> matrix(const double *t)
{
  Tensor<2, 3> result;
  constexpr unsigned int rows[6] = { 0, 1, 2, 0, 0, 1 }, columns[6] = { 0, 1, 2, 1, 2, 2 };
  for (unsigned int c = 0; c < 6; ++c)
    result[rows[c]][columns[c]] = result[columns[c]][rows[c]] = t[c];
  return result;
}


/// Largest relative difference of the two observers' stresses when the second turns by `angle` a step.
double error(const Material<3> &material, const double angle, const double strain, UpdateReport &report)
{
  const double start[6] = { -7e3, -1e4, -7e3, 0, 0, 0 }, one = 1;
  State still, turning;
  material.initialise(start, still.left_cauchy_green, still.stress, still.internal_variables);
  turning             = still;
  Tensor<2, 3> before = unit_symmetric_tensor<3>();
  double J = 1, largest = 0;
  for (unsigned int step = 1; step <= 500; ++step)
    {
      Tensor<2, 3> increment = unit_symmetric_tensor<3>();
      increment[0][1]        = strain;
      increment[1][1] += 0.02 * strain;
      increment[2][0] = 0.3 * strain;
      const Tensor<2, 3> now =
          Physics::Transformations::Rotations::rotation_matrix_3d(Tensor<1, 3>({ 0.6, 0., 0.8 }), step * angle);
      const Tensor<2, 3> seen = now * increment * transpose(before);
      before                  = now;
      J *= determinant(increment);
      material.update({ 1, 0, still.left_cauchy_green, still.stress, still.internal_variables },
                      { &increment[0][0], nullptr, &J, &one },
                      report);
      material.update({ 1, 0, turning.left_cauchy_green, turning.stress, turning.internal_variables },
                      { &seen[0][0], nullptr, &J, &one },
                      report);
      const Tensor<2, 3> wanted = now * matrix(still.stress) * transpose(now);
      largest                   = std::max(largest, (matrix(turning.stress) - wanted).norm() / wanted.norm());
    }
  return largest;
}


void test(const std::string &name, const double angle, const double strain, const double bound)
{
  MaterialParameters parameters;
  parameters.law = name;
  UpdateReport report;
  const double found = error(*make_material<3>(parameters), angle, strain, report);
  AssertThrow(found < bound, ExcMessage(name + " is not objective: " + std::to_string(found)));
  std::cout << name << ", angle " << angle << ", strain " << strain << " a step: error below " << bound
            << ": OK, sub-steps " << report.n_substeps << std::endl;
}


void run()
{
  for (const std::string name : { "linear elastic", "Mohr-Coulomb", "Nor-Sand" })
    test(name, 7e-4, 2e-4, 1e-9); // one sub-step an update
  for (const std::string name : { "linear elastic", "Mohr-Coulomb" })
    test(name, 0.1, 2e-4, 1e-9);
  // The same number of sub-steps for both observers. Those of the second follow the chord of its turn, not the arc.
  test("Nor-Sand", 4e-4, 2.5e-3, 1e-4);
}

const UnitTest registered("material_objectivity", run);
} // namespace test_material_objectivity


// Output:
// linear elastic, angle 0.0007, strain 0.0002 a step: error below 1e-09: OK, sub-steps 1000
// Mohr-Coulomb, angle 0.0007, strain 0.0002 a step: error below 1e-09: OK, sub-steps 1000
// Nor-Sand, angle 0.0007, strain 0.0002 a step: error below 1e-09: OK, sub-steps 1000
// linear elastic, angle 0.1, strain 0.0002 a step: error below 1e-09: OK, sub-steps 1000
// Mohr-Coulomb, angle 0.1, strain 0.0002 a step: error below 1e-09: OK, sub-steps 1000
// Nor-Sand, angle 0.0004, strain 0.0025 a step: error below 0.0001: OK, sub-steps 3000
