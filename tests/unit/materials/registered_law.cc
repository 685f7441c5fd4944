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
  std::ostream &out = std::cout;
  MaterialParameters parameters;
  ParameterHandler prm;
  parameters.add_parameters(prm);
  prm.parse_input_from_string(
      "set Material = Moduli\nsubsection Moduli\n set Shear modulus = 3e6\n set Bulk modulus = 5e6\nend");
  parameters.check("Soil");
  for (const RegisteredLaw &law : registered_laws())
    out << law.name << "; ";
  const auto plane = make_material<2>(parameters);
  const auto solid = make_material<3>(parameters);
  out << '\n' << parameters.modulus_text("Soil") << '\n';
  out << 1e-6 * plane->shear_modulus << ' ' << 1e-6 * solid->shear_modulus << ' '
      << 1e-6 * solid->initial_bulk_modulus(0.) << '\n';
  prm.parse_input_from_string("subsection Moduli\n set Bulk modulus = 0\nend");
  try
    {
      parameters.check("Soil");
    }
  catch (const EntryError &error)
    {
      out << error.what() << '\n';
    }
}

const UnitTest registered_test("registered_law", run);
} // namespace test_registered_law


// Output:
// Herschel-Bulkley; linear elastic; Moduli; Mohr-Coulomb; Nor-Sand; Nor-Sand (Jefferies-Been); rigid; Tresca;
// subsection Soil/Moduli, entry "Shear modulus" = 3e+06
// 3 3 5
// subsection Soil/Moduli, entry "Bulk modulus" = 0: a positive modulus is needed.
