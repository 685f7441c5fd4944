// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/materials/law_entries.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    struct RigidEntries : LawEntries
    {
      void add_parameters(ParameterHandler &) override
      {
      }
      void check(const std::string &) const override
      {
      }
      LawEntry modulus() const override
      {
        return { "Material", 0. };
      }
    };


    /// Soil that does not move: a filter, a rockfill dam, an obstacle. It carries any stress, which is not computed and
    /// reads 0; no wave runs in it. Its points are not updated.
    struct Rigid : ConstitutiveLaw
    {
      static constexpr unsigned int n_internal_variables = 0;

      explicit Rigid(const RigidEntries &)
      {
      }
      double bulk_modulus(const double) const
      {
        return 0.;
      }
      template <typename Number>
      Number energy(const PrincipalNumbers<Number> &) const
      {
        return simd::broadcast<Number>(0.);
      }
      template <typename Number>
      LawResponse<Number>
      respond(const LawStep<Number> &, PrincipalNumbers<Number> &, Number *, PrincipalNumbers<Number> &stress) const
      {
        Assert(false, ExcMessage("Rigid soil does not move."));
        stress.fill(simd::broadcast<Number>(0.));
        const LawResponse<Number> response{};
        return response;
      }
      void initialise(const PrincipalValues &, PrincipalValues &strain, PrincipalValues &stress, double *) const
      {
        strain.fill(0.);
        stress.fill(0.);
      }
    };

    const RegisterLaw registered_rigid = RegisterLaw::of<Rigid, RigidEntries>("rigid", "");
  } // namespace
} // namespace scree
