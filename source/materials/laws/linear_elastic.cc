// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/batch_material.h>
#include <scree/materials/laws/linear_elastic.h>

using namespace dealii;

namespace scree
{
  void LinearElasticParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Young's modulus", young_modulus, "Pa; Young's modulus.", Patterns::Double(0));
    prm.add_parameter("Poisson's ratio", poisson_ratio, "Poisson's ratio.", Patterns::Double(-1, 0.5));
  }


  void LinearElasticParameters::check(const std::string &subsection) const
  {
    require_entry(young_modulus > 0, subsection, "Young's modulus", young_modulus, "a positive modulus is needed.");
    require_entry(poisson_ratio > -1 && poisson_ratio < 0.5,
                  subsection,
                  "Poisson's ratio",
                  poisson_ratio,
                  "it must lie between -1 and 0.5, both excluded; 0.49 is nearly incompressible.");
  }


  LawEntry LinearElasticParameters::modulus() const
  {
    return { "Young's modulus", young_modulus };
  }


  namespace
  {
    const RegisterLaw
        registered_linear_elastic("linear elastic",
                                  "Linear elastic",
                                  std::make_unique<EntriesOf<LinearElasticParameters, BatchMaterial, LinearElastic>>());
  } // namespace


  LinearElastic::LinearElastic(const LinearElasticParameters &parameters)
      : shear(parameters.young_modulus / (2 * (1 + parameters.poisson_ratio)))
      , bulk(parameters.young_modulus / (3 * (1 - 2 * parameters.poisson_ratio)))
  {
  }


  double LinearElastic::shear_modulus() const
  {
    return shear;
  }


  double LinearElastic::bulk_modulus(const double) const
  {
    return bulk;
  }


  double LinearElastic::energy(const PrincipalValues &strain) const
  {
    const double volume_strain = strain[0] + strain[1] + strain[2];
    double energy              = 0.5 * bulk * volume_strain * volume_strain;
    for (const double value : strain)
      energy += shear * (value - volume_strain / 3) * (value - volume_strain / 3);
    return energy;
  }


  double LinearElastic::initial_porosity() const
  {
    return 0;
  }


  void LinearElastic::initialise(const PrincipalValues &wanted_stress,
                                 PrincipalValues &strain,
                                 PrincipalValues &stress,
                                 double *) const
  {
    stress            = wanted_stress;
    const double mean = (stress[0] + stress[1] + stress[2]) / 3;
    for (unsigned int i = 0; i < 3; ++i)
      strain[i] = mean / (3 * bulk) + (stress[i] - mean) / (2 * shear);
  }


  std::vector<Quantity> LinearElastic::internal_quantities()
  {
    return {};
  }


  std::vector<Quantity> LinearElastic::output_quantities()
  {
    return {};
  }


  void LinearElastic::output(const PrincipalValues &, const double *, const double, double *) const
  {
  }
} // namespace scree
