// SPDX-License-Identifier: LGPL-2.1-or-later
// A law of one file: registered here, it is a value of entry "Material" with a subsection of its own, which is checked,
// questioned and made like those of source/materials/laws.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/materials/laws/linear_elastic.h>
#include <scree/materials/table.h>

namespace test_registered_law
{
/// Hencky elasticity by its moduli.
struct ModuliParameters : LawEntries
{
  double bulk_modulus  = 2e6;
  double shear_modulus = 1e6;

  void add_parameters(ParameterHandler &prm) override
  {
    prm.add_parameter("Bulk modulus", bulk_modulus, "K, Pa.", Patterns::Double(0));
    prm.add_parameter("Shear modulus", shear_modulus, "G, Pa.", Patterns::Double(0));
  }
  void check(const std::string &subsection) const override
  {
    require_entry(bulk_modulus > 0, { subsection, "Bulk modulus", bulk_modulus }, "a positive modulus is needed.");
  }
  LawEntry modulus() const override
  {
    return { "Shear modulus", shear_modulus };
  }
  LawEntry stiffest() const override
  {
    return { "Bulk modulus", bulk_modulus };
  }
};

struct Moduli : LinearElastic
{
  explicit Moduli(const ModuliParameters &p)
      : LinearElastic(LinearElasticParameters(
            9 * p.bulk_modulus * p.shear_modulus / (3 * p.bulk_modulus + p.shear_modulus),
            (3 * p.bulk_modulus - 2 * p.shear_modulus) / (6 * p.bulk_modulus + 2 * p.shear_modulus)))
  {
  }
};

const RegisterLaw registered = RegisterLaw::of<Moduli, ModuliParameters>("Moduli", "Moduli");


void run()
{
  MaterialParameters parameters;
  ParameterHandler prm;
  parameters.add_parameters(prm);
  prm.parse_input_from_string(
      "set Material = Moduli\nsubsection Moduli\n set Shear modulus = 3e6\n set Bulk modulus = 5e6\nend");
  parameters.check("Soil");
  std::string names;
  for (const RegisteredLaw &law : registered_laws())
    names += law.name + "; ";
  expect_text(
      names,
      "Herschel-Bulkley; linear elastic; Moduli; Mohr-Coulomb; Nor-Sand; Nor-Sand (Jefferies-Been); rigid; Tresca; "
      "viscoinertial grains; ",
      "list of laws");
  expect_text(parameters.modulus_text("Soil"), "subsection Soil/Moduli, entry \"Shear modulus\" = 3e+06", "modulus");
  const auto plane = make_material<2>(parameters);
  const auto solid = make_material<3>(parameters);
  expect(plane->shear_modulus, 3e6, 1e-3, "G, plane");
  expect(solid->shear_modulus, 3e6, 1e-3, "G");
  expect(solid->initial_bulk_modulus(0.), 5e6, 1e-2, "K");
  prm.parse_input_from_string("subsection Moduli\n set Bulk modulus = 0\nend");
  expect_refusal([&] { parameters.check("Soil"); },
                 "subsection Soil/Moduli, entry \"Bulk modulus\" = 0: a positive modulus is needed.",
                 "a bulk modulus of 0");
}

const UnitTest registered_test("registered_law", run);
} // namespace test_registered_law
