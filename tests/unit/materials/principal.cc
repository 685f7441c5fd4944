// SPDX-License-Identifier: LGPL-2.1-or-later

// Principal values, axes and logarithmic strain of b = I + small, also where principal values coincide.

#include <scree/tensor/hencky.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_principal
{
using namespace dealii;
using namespace scree;

template <int dim>
void test(RandomNumbers &random)
{
  double strain_error = 0, composition_error = 0;
  for (unsigned int i = 0; i < 200000; ++i)
    {
      const double size      = random.log_uniform(1e-12, 1e-1);
      PrincipalValues strain = {
        { size * random.uniform(-1, 1), size * random.uniform(-1, 1), size * random.uniform(-1, 1) }
      };
      if (i % 3 == 0)
        strain[1] = strain[0]; // Coincident.
      if (i % 9 == 0)
        strain[2] = strain[0] + 1e-15;

      Tensor<2, 3> Q = Physics::Transformations::Rotations::rotation_matrix_3d(Tensor<1, 3>({ 0., 0., 1. }),
                                                                               random.uniform(0, numbers::PI));
      if (dim == 3)
        Q = Q * Physics::Transformations::Rotations::rotation_matrix_3d(Tensor<1, 3>({ 1., 0., 0. }),
                                                                        random.uniform(0, numbers::PI));
      Tensor<2, 3> b;
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
        composition_error = std::max(composition_error, std::abs(again[c] - components[c]));

      std::sort(found.begin(), found.end());
      std::sort(strain.begin(), strain.end());
      for (unsigned int k = 0; k < 3; ++k)
        strain_error = std::max(strain_error, std::abs(found[k] - strain[k]));
    }
  AssertThrow(strain_error < 5e-15,
              ExcMessage("Logarithmic strain is wrong by " + std::to_string(strain_error * 1e15) + "e-15."));
  AssertThrow(composition_error < 1e-14,
              ExcMessage("Composition is wrong by " + std::to_string(composition_error * 1e15) + "e-15."));
  std::cout << dim << "D: logarithmic strain to 5e-15, composition to 1e-14: OK" << std::endl;
}


void run()
{
  RandomNumbers random;
  test<2>(random);
  test<3>(random);
}

const UnitTest registered("principal", run);
} // namespace test_principal


// Output:
// 2D: logarithmic strain to 5e-15, composition to 1e-14: OK
// 3D: logarithmic strain to 5e-15, composition to 1e-14: OK
