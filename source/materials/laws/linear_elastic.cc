// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/laws/linear_elastic.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    const RegisterLaw registered_linear_elastic =
        RegisterLaw::of<LinearElastic, LinearElasticParameters>("linear elastic", "Linear elastic");
  } // namespace


  void LinearElasticParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Young's modulus", young_modulus, "Pa; Young's modulus.", Patterns::Double(0));
    prm.add_parameter("Poisson's ratio", poisson_ratio, "Poisson's ratio.", Patterns::Double(-1, 0.5));
  }


  void LinearElasticParameters::check(const std::string &subsection) const
  {
    require_entry(young_modulus > 0, { subsection, "Young's modulus", young_modulus }, "a positive modulus is needed.");
    require_entry(poisson_ratio > -1 && poisson_ratio < 0.5,
                  { subsection, "Poisson's ratio", poisson_ratio },
                  "it must lie between -1 and 0.5, both excluded; 0.49 is nearly incompressible.");
  }
} // namespace scree
