// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_linear_elastic_h
#define scree_material_linear_elastic_h

#include <scree/material/law.h>

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// Entries of subsection "Linear elastic".
  struct LinearElasticParameters
  {
    double young_modulus = 1e6;
    double poisson_ratio = 0.3;

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws dealii::ExcMessage naming the entry if a value is impossible.
    void check(const std::string &subsection) const;
  };

  /// Hencky elasticity: tau = K tr(eps) I + 2 G dev(eps) of the logarithmic strain eps (Hencky 1928; de Souza Neto,
  /// Peric & Owen 2008, 13.3). Stored energy K/2 tr(eps)^2 + G |dev(eps)|^2.
  class LinearElastic
  {
  public:
    static constexpr unsigned int n_internal_variables = 0;
    static constexpr unsigned int n_output_values      = 0;

    explicit LinearElastic(const LinearElasticParameters &parameters);

    /// No limit: elasticity knows no path.
    double substep_strain() const;

    double shear_modulus() const;
    double bulk_modulus(const double pressure) const;
    double energy(const PrincipalValues &strain) const;
    double initial_porosity() const;

    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    static std::vector<std::string> internal_variable_names();
    static std::vector<std::string> output_names();
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

  private:
    const double shear;
    const double bulk;
  };


  inline Response
  LinearElastic::return_map(PrincipalValues &strain,
                            double *,
                            const double,
                            PrincipalValues &stress,
                            UpdateReport &report) const
  {
    const double volume_strain = strain[0] + strain[1] + strain[2];
    const double volume_part   = (bulk - 2. / 3. * shear) * volume_strain;
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = volume_part + 2 * shear * strain[i];
    report.largest_bulk_modulus = bulk;
    report.largest_pressure     = std::max(report.largest_pressure, -bulk * volume_strain);
    return Response::elastic;
  }
} // namespace scree

#endif
