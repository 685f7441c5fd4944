// SPDX-License-Identifier: LGPL-2.1-or-later

// Soil in water that is pulled open at the tension cut-off and closed again bears what it bore before: the opening is no
// plastic strain. The same law in dry soil forgets it.

#include <scree/material/mohr_coulomb_opening.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/tensor.h>

#include <cmath>
#include <iostream>

using namespace dealii;
using namespace scree;

/// Stress along the stretch after a cycle of `n` openings, over that before.
template <int dim>
double stress_after(const Material<dim> &material, const unsigned int n)
{
  const double start[6] = { -1e4, -1e4, -1e4, 0, 0, 0 }, one = 1;
  constexpr unsigned int n_steps = 100;
  const double stretch = std::pow(1.001, 1. / n_steps);
  double J             = 1;
  double left_cauchy_green[6], stress[6], internal_variables[2];
  material.initialise(start, left_cauchy_green, stress, internal_variables);
  for (unsigned int i = 0; i < 2 * n * n_steps; ++i)
    {
      const double factor = i / n_steps % 2 == 0 ? stretch : 1 / stretch;
      J *= factor;
      Tensor<2, dim> increment;
      for (unsigned int d = 0; d < dim; ++d)
        increment[d][d] = d == 0 ? factor : 1;
      UpdateReport report;
      material.update(
          { 1, 0, left_cauchy_green, stress, internal_variables }, { &increment[0][0], &one, &J, &one }, report);
    }
  return stress[0] / start[0];
}


template <int dim>
void test()
{
  MaterialParameters parameters;
  parameters.law                         = "Mohr-Coulomb";
  parameters.mohr_coulomb.young_modulus  = 1e7;
  parameters.mohr_coulomb.friction_angle = 25;
  parameters.mohr_coulomb.cohesion       = 2e4;
  const auto dry = make_material<dim>(parameters), wet = make_material_in_water<dim>(parameters);
  for (const unsigned int n : { 1, 5 })
    std::cout << dim << "D, stress after " << n << " openings over that before: dry " << stress_after(*dry, n)
              << ", in water " << stress_after(*wet, n) << std::endl;
  parameters.mohr_coulomb.cohesion = 0;
  AssertThrow(make_material_in_water<dim>(parameters)->internal_quantities().size() == 1,
              ExcMessage("Soil without cohesion opens at the vertex, where the strain keeps the gap."));
}


int main()
{
  test<2>();
  test<3>();
}
