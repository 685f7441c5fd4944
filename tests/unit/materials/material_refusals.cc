// SPDX-License-Identifier: LGPL-2.1-or-later

// Motions, starts and parameters that cannot be: an exception that says why, never a hang or a quiet wrong number.

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/materials/table.h>

#include <deal.II/base/exceptions.h>

#include <functional>
#include <iostream>
#include <limits>

#include "../unit_test.h"

namespace test_material_refusals
{
using namespace dealii;
using namespace scree;

unsigned int n_refusals = 0;

void expect_refusal(const std::string &name, const std::function<void()> &action, const std::string &wanted)
{
  std::string message = "no exception";
  try
    {
      action();
    }
  catch (const std::exception &error)
    {
      message = error.what();
    }
  AssertThrow(message.find(wanted) != std::string::npos, ExcMessage(name + " was not refused: " + message));
  ++n_refusals;
}


template <int dim>
void test_motions(const std::string &law)
{
  MaterialParameters parameters;
  parameters.law        = law;
  const auto material   = make_material<dim>(parameters);
  const double start[6] = { -8e3, -1e4, -8e3, 0, 0, 0 }, one = 1;
  double left_cauchy_green[6], stress[6], internal_variables[2];
  material->initialise(start, left_cauchy_green, stress, internal_variables);

  const auto update = [&](const double component, const double J) {
    Tensor<2, dim> increment;
    for (unsigned int i = 0; i < dim; ++i)
      increment[i][i] = 1;
    increment[0][0] = component;
    UpdateReport report;
    material->update(
        { 1, 0, left_cauchy_green, stress, internal_variables }, { &increment[0][0], &one, &J, &one }, report);
  };
  const std::string name = law + ", " + std::to_string(dim) + "D: ", wanted = "cannot follow";
  expect_refusal(
      name + "not a number", [&]() { update(std::numeric_limits<double>::quiet_NaN(), 1); }, wanted);
  expect_refusal(
      name + "inside out", [&]() { update(-0.1, 1); }, wanted);
  expect_refusal(
      name + "no volume", [&]() { update(1, 0); }, wanted);
  if (law.rfind("Nor-Sand", 0) == 0)
    expect_refusal(
        name + "beyond all sub-steps", [&]() { update(3, 1); }, wanted);
}


void test_starts()
{
  const auto start = [](const std::string &law, const double vertical, const double lateral) {
    MaterialParameters parameters;
    parameters.law         = law;
    const double stress[4] = { lateral, vertical, lateral, 0 };
    double left_cauchy_green[4], found[4], internal_variables[2];
    make_material<2>(parameters)->initialise(stress, left_cauchy_green, found, internal_variables);
  };
  for (const std::string law : { "Nor-Sand", "Nor-Sand (Jefferies-Been)" })
    {
      expect_refusal(
          law + " under tension", [&]() { start(law, 1e3, 1e3); }, "tension");
      expect_refusal(
          law + ", K0 too small", [&]() { start(law, -1e4, -1e2); }, "K0");
    }
  expect_refusal(
      "Mohr-Coulomb, K0 too small", [&]() { start("Mohr-Coulomb", -1e4, -3e3); }, "K0");
}


void test_parameters()
{
  using Change     = std::function<void(MaterialParameters &)>;
  const auto check = [](const std::string &law, const std::string &entry, const Change &change) {
    expect_refusal(
        law + ", " + entry,
        [&]() {
          MaterialParameters parameters;
          parameters.law = law;
          parameters.check("Soil");
          change(parameters);
          parameters.check("Soil");
        },
        "subsection Soil/" + law + ", entry \"" + entry + "\"");
  };
  check("Nor-Sand", "Potential constant N bar", [](auto &p) {
    p.template of<NorSandParameters>().potential_constant = 0.4;
  });
  check("Nor-Sand", "Compression index", [](auto &p) { p.template of<NorSandParameters>().compression_index = 0.001; });
  check("Nor-Sand", "Critical stress ratio M", [](auto &p) {
    p.template of<NorSandParameters>().critical_stress_ratio = 0;
  });
  check("Nor-Sand", "Initial specific volume", [](auto &p) {
    p.template of<NorSandParameters>().initial_specific_volume = 1;
  });
  check("Mohr-Coulomb", "Dilation angle", [](auto &p) { p.template of<MohrCoulombParameters>().dilation_angle = 40; });
  check("Mohr-Coulomb", "Tension cut-off", [](auto &p) { p.template of<MohrCoulombParameters>().tension_cut_off = 1; });
  check("Mohr-Coulomb", "Poisson's ratio", [](auto &p) { p.template of<MohrCoulombParameters>().poisson_ratio = 0.5; });
}


void run()
{
  for (const std::string law : { "linear elastic", "Mohr-Coulomb", "Nor-Sand", "Nor-Sand (Jefferies-Been)" })
    {
      test_motions<2>(law);
      test_motions<3>(law);
    }
  test_starts();
  test_parameters();
  std::cout << n_refusals << " refusals: OK" << std::endl;
}

const UnitTest registered("material_refusals", run);
} // namespace test_material_refusals


// Output:
// 40 refusals: OK
