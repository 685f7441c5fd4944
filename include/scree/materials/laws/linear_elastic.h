// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_linear_elastic_h
#define scree_materials_laws_linear_elastic_h

#include <scree/materials/law.h>
#include <scree/materials/law_entries.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <limits>

namespace scree
{
  /// Entries of subsection "Linear elastic".
  struct LinearElasticParameters
  {
    double young_modulus = 1e6; ///< E, Pa
    double poisson_ratio = 0.3; ///< nu, -

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a value is impossible.
    void check(const std::string &subsection) const;

    /// See LawEntries.
    LawEntry modulus() const;
  };

  /// Hencky elasticity: tau = K tr(eps) I + 2 G dev(eps) of the logarithmic strain eps (@source{hencky1928};
  /// @source{desouzaneto2008}, 13.3). Stored energy K/2 tr(eps)^2 + G |dev(eps)|^2.
  class LinearElastic
  {
  public:
    static constexpr unsigned int n_internal_variables = 0;    ///< the law has none
    static constexpr bool is_elastic                   = true; ///< the law has no plastic strain

    /// Computes bulk and shear modulus, Pa, from E and nu.
    explicit LinearElastic(const LinearElasticParameters &parameters);

    /// Largest strain of one return map: no limit, as elasticity has no path.
    double substep_strain() const;

    /// Pa.
    double shear_modulus() const;

    /// Tangent at a mean compressive Kirchhoff stress, Pa.
    double bulk_modulus(const double pressure) const;

    /// The trial state, see law.h.
    template <typename Number>
    struct Trial
    {
      Number volume_strain; ///< tr(eps), elastic
    };

    /// Trial state of a volume strain; the other arguments are not read.
    template <typename Number>
    Trial<Number> trial(const Number &volume_strain, const Number &, const Number &, const Number *) const
    {
      return { volume_strain };
    }

    /// Whether the strain is a number: every state is elastic.
    template <typename Number>
    simd::Mask<Number> is_admissible(const Trial<Number> &trial) const
    {
      return trial.volume_strain == trial.volume_strain;
    }

    /// Mean Kirchhoff stress K tr(eps), Pa, tension positive.
    template <typename Number>
    Number mean_stress(const Trial<Number> &trial) const
    {
      return bulk * trial.volume_strain;
    }

    /// Bulk modulus K, Pa.
    template <typename Number>
    Number bulk_modulus_at(const Number &) const
    {
      return simd::broadcast<Number>(bulk);
    }

    /// Returns no point: the law has no yield surface.
    template <typename Number>
    simd::Mask<Number>
    return_to_surface(const Trial<Number> &, const simd::Mask<Number> &todo, Number *, InvariantReturn<Number> &) const
    {
      return todo & !todo; // has none
    }

    /// J per m^3 of reference volume.
    double energy(const PrincipalValues &strain) const;

    /// Zero: the law has no pores.
    double initial_porosity() const;

    /// From trial to returned `strain` and internal variables, at J = `volume_ratio`; sets `stress`, counts in
    /// `report`.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// See Material::initialise().
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// No internal variables.
    static std::vector<Quantity> internal_quantities();

    /// No derived fields.
    static std::vector<Quantity> output_quantities();

    /// Writes nothing, see output_quantities().
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

  private:
    const double shear; // Pa
    const double bulk;  // Pa
  };


  inline double LinearElastic::substep_strain() const
  {
    return std::numeric_limits<double>::infinity();
  }


  inline Response LinearElastic::return_map(PrincipalValues &strain,
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
    return Response::elastic;
  }
} // namespace scree

#endif
