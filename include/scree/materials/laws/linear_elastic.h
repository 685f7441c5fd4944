// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_linear_elastic_h
#define scree_materials_laws_linear_elastic_h

#include <scree/materials/law_entries.h>

namespace scree
{
  /// Entries of subsection "Linear elastic", and the first ones of laws that add yielding.
  struct LinearElasticParameters : LawEntries
  {
    /// @param young_modulus E, Pa
    /// @param poisson_ratio nu, -
    explicit LinearElasticParameters(const double young_modulus = 1e6, const double poisson_ratio = 0.3)
        : young_modulus(young_modulus)
        , poisson_ratio(poisson_ratio)
    {
    }

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;
    LawEntry modulus() const override
    {
      return { "Young's modulus", young_modulus };
    }

    double young_modulus; ///< E, Pa
    double poisson_ratio; ///< nu, -
  };


  /// Hencky elasticity: tau = K tr(eps) I + 2 G dev(eps) of the logarithmic strain eps (@source{hencky1928};
  /// @source{desouzaneto2008}, 13.3). Stored energy K/2 tr(eps)^2 + G |dev(eps)|^2.
  class LinearElastic : public ConstitutiveLaw
  {
  public:
    static constexpr unsigned int n_internal_variables = 0;    ///< the law has none
    static constexpr bool in_invariants                = true; ///< see ConstitutiveLaw

    /// Computes bulk and shear modulus, Pa, from E and nu.
    explicit LinearElastic(const LinearElasticParameters &parameters)
        : bulk(parameters.young_modulus / (3 * (1 - 2 * parameters.poisson_ratio)))
    {
      shear_modulus = parameters.young_modulus / (2 * (1 + parameters.poisson_ratio));
    }

    /// K, Pa, at any pressure.
    double bulk_modulus(const double) const
    {
      return bulk;
    }

    /// See ConstitutiveLaw.
    template <typename Number>
    InvariantResponse<Number>
    respond(const LawStep<Number> &, const StrainInvariants<Number> &strain, const Number *) const
    {
      InvariantResponse<Number> response{};
      response.bulk_modulus  = simd::broadcast<Number>(bulk);
      response.mean_stress   = bulk * strain.volume;
      response.stress_factor = simd::broadcast<Number>(2. * shear_modulus);
      return response;
    }

    /// J per m^3 of reference volume.
    template <typename Number>
    Number energy(const StrainInvariants<Number> &strain) const
    {
      return 0.5 * bulk * strain.volume * strain.volume + shear_modulus * strain.square;
    }

    /// See Material::initialise().
    void
    initialise(const PrincipalValues &wanted_stress, PrincipalValues &strain, PrincipalValues &stress, double *) const
    {
      stress            = wanted_stress;
      const double mean = (stress[0] + stress[1] + stress[2]) / 3;
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] = mean / (3 * bulk) + (stress[i] - mean) / (2 * shear_modulus);
    }

  private:
    const double bulk; // Pa
  };
} // namespace scree

#endif
