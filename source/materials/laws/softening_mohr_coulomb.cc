// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/materials/laws/softening_mohr_coulomb.h>

namespace scree
{
  namespace
  {
    double tangent_of_angle(const MohrCoulombParameters &parameters)
    {
      const double sine = parameters.sine();
      return sine / std::sqrt(1 - sine * sine);
    }


    double tangent_of_dilation(const MohrCoulombParameters &parameters)
    {
      return std::tan(radians(parameters.dilation_angle));
    }
  } // namespace


  SofteningMohrCoulomb::SofteningMohrCoulomb(const MohrCoulombParameters &parameters)
      : MohrCoulomb(parameters)
      , softening_strain(parameters.softening.strain)
      , nonlocal_length(parameters.softening.nonlocal_length)
      , residual_plane_friction(MohrCoulomb(parameters.residual()).plane_friction())
      , least_limit(1e-9 * parameters.cohesion) // Exponential decay ends there.
  {
    const MohrCoulombParameters last = parameters.residual();
    const auto between = [](const double residual, const double peak) { return Falling{ residual, peak - residual }; };
    tangent            = between(tangent_of_angle(last), tangent_of_angle(parameters));
    dilation_tangent   = between(tangent_of_dilation(last), tangent_of_dilation(parameters));
    cohesion           = between(last.cohesion, parameters.cohesion);
  }


  double SofteningMohrCoulomb::plane_friction() const
  {
    return residual_plane_friction;
  }


  Response SofteningMohrCoulomb::return_map(PrincipalValues &strain,
                                            double *internal_variables,
                                            const double,
                                            PrincipalValues &stress,
                                            UpdateReport &report) const
  {
    return count(respond<double>(strain, internal_variables, stress), report);
  }


  void SofteningMohrCoulomb::initialise(const PrincipalValues &wanted_stress,
                                        PrincipalValues &strain,
                                        PrincipalValues &stress,
                                        double *internal_variables) const
  {
    MohrCoulomb::initialise(wanted_stress, strain, stress, internal_variables);
    internal_variables[own_kappa] = internal_variables[acting_kappa] = 0;
  }


  std::vector<Quantity> SofteningMohrCoulomb::internal_quantities()
  {
    return { { "plastic_shear_strain", "-" }, { "softening_strain", "-" }, { "nonlocal_softening_strain", "-" } };
  }


  NonlocalVariable SofteningMohrCoulomb::nonlocal_variable() const
  {
    return { nonlocal_length, own_kappa, acting_kappa };
  }
} // namespace scree
