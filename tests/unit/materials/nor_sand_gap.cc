// SPDX-License-Identifier: LGPL-2.1-or-later

// Sand pulled apart bears nothing until the gap is closed again, to the volume where it came apart.

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/table.h>

#include <deal.II/base/exceptions.h>

#include <iostream>

#include "../unit_test.h"

namespace test_nor_sand_gap
{
using namespace dealii;
using namespace scree;

void run()
{
  MaterialParameters parameters;
  const auto material = make_material<2>(parameters);

  constexpr double pressure = 1e4, step = 5e-5, one = 1;
  const double start[4] = { -pressure, -pressure, -pressure, 0 };
  double left_cauchy_green[4], stress[4], internal_variables[2];
  material->initialise(start, left_cauchy_green, stress, internal_variables);

  UpdateReport report;
  double volume_strain = 0; // ln J
  const auto stretch   = [&](const double strain) {
    Tensor<2, 2> increment;
    increment[0][0] = increment[1][1] = std::exp(strain);
    const double out_of_plane         = std::exp(strain);
    volume_strain += 3 * strain;
    const double J = std::exp(volume_strain);
    material->update(
        { 1, 0, left_cauchy_green, stress, internal_variables }, { &increment[0][0], &out_of_plane, &J, &one }, report);
  };

  // From 10 kPa to the minimum pressure the sand swells by kappa ln(10 kPa/1 Pa).
  const double contact = parameters.of<NorSandParameters>().swelling_index *
                         std::log(pressure / parameters.of<NorSandParameters>().minimum_pressure);
  for (unsigned int i = 0; i < 400; ++i)
    {
      stretch(step);
      AssertThrow((stress[0] < 0) == (volume_strain < contact), ExcMessage("Wrong contact on the way out."));
    }
  AssertThrow(report.n_separated > 0 && material->elastic_energy(left_cauchy_green) < 1e-2,
              ExcMessage("The sand should be apart and store nothing."));
  // A wide step is taken in many sub-steps, yet the point is apart once.
  const UpdateReport before = report;
  stretch(0.01);
  std::cout << "pulled on in several sub-steps (" << (report.n_substeps > before.n_substeps + 5)
            << "): points apart: " << report.n_separated - before.n_separated << std::endl;
  stretch(-0.01);
  while (volume_strain > 1e-9)
    {
      stretch(-step);
      AssertThrow((stress[0] < 0) == (volume_strain < contact), ExcMessage("Wrong contact on the way back."));
    }
  AssertThrow(report.n_unresolved == 0, ExcMessage("Unresolved returns."));
  AssertThrow(-stress[0] < pressure, ExcMessage("A bounce must not gain pressure."));
  std::cout << "gap opened at ln J = " << contact << " and closed there: OK" << std::endl;
  std::cout << "pressure before and after, kPa: " << pressure / 1000 << ' ' << -stress[0] / 1000 << std::endl;
}

const UnitTest registered("nor_sand_gap", run);
} // namespace test_nor_sand_gap


// Output:
// pulled on in several sub-steps (1): points apart: 1
// gap opened at ln J = 0.0184207 and closed there: OK
// pressure before and after, kPa: 10 1.97818
