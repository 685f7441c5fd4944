// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/laws/viscoinertial_grains.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    const RegisterLaw registered_grains =
        RegisterLaw::of<ViscoinertialGrains, ViscoinertialGrainsParameters>("viscoinertial grains",
                                                                            "Viscoinertial grains");
  } // namespace


  void ViscoinertialGrainsParameters::add_parameters(ParameterHandler &prm)
  {
    const Patterns::Double not_negative(0), fraction(0, 1);
    LinearElasticParameters::add_parameters(prm);
    prm.add_parameter("Grain diameter",
                      grain_diameter,
                      "m; grain diameter d in the inertial number I. Element tests are slow: friction is mu_1, and "
                      "the solid fraction goes to phi_m.",
                      not_negative);
    prm.add_parameter("Liquid viscosity",
                      liquid_viscosity,
                      "Pa s; viscosity of the liquid in the viscous number I_v; 0: dry grains. The stress of free "
                      "water has an entry of its own in subsection Water.",
                      not_negative);
    prm.add_parameter("Initial solid fraction",
                      initial_fraction,
                      "Solid fraction phi_0 at the start. Below the critical one, grains at rest carry no stress: "
                      "write \"Type = none\" in subsection Initial state.",
                      fraction);
    prm.add_parameter("Critical solid fraction", critical_fraction, "Solid fraction phi_m of slow flow.", fraction);
    prm.add_parameter("Solid fraction coefficient",
                      fraction_slope,
                      "Coefficient a: the solid fraction of steady flow is phi_m/(1 + a I_m).",
                      not_negative);
    prm.add_parameter("Dilatancy coefficient",
                      dilatancy,
                      "Coefficient K: the volume grows by K (phi - phi_eq) per plastic shear strain.",
                      not_negative);
    prm.add_parameter("Static friction", static_friction, "Stress ratio mu_1 = tau/p of slow flow.", not_negative);
    prm.add_parameter("Rapid friction",
                      rapid_friction,
                      "Stress ratio mu_2 of rapid flow, without the viscous stress of the liquid.",
                      not_negative);
    prm.add_parameter("Reference number",
                      reference_number,
                      "Number b: I_m at which friction is halfway between mu_1 and mu_2.",
                      not_negative);
  }


  void ViscoinertialGrainsParameters::check(const std::string &subsection) const
  {
    LinearElasticParameters::check(subsection);
    for (const LawEntry &entry : { LawEntry{ "Static friction", static_friction },
                                   LawEntry{ "Reference number", reference_number },
                                   LawEntry{ "Solid fraction coefficient", fraction_slope },
                                   LawEntry{ "Critical solid fraction", critical_fraction },
                                   LawEntry{ "Initial solid fraction", initial_fraction } })
      require_entry(entry.value > 0, { subsection, entry.name, entry.value }, "it must be positive.");
    require_entry(static_friction < 1,
                  { subsection, "Static friction", static_friction },
                  "write a value below 1, which would be a friction angle of 90 degrees in plane strain.");
    require_entry(rapid_friction >= static_friction,
                  { subsection, "Rapid friction", rapid_friction },
                  "it must be the static friction, here " + number_text(static_friction) + ", or more.");
    require_entry(initial_fraction < 0.75,
                  { subsection, "Initial solid fraction", initial_fraction },
                  "spheres cannot be denser than 0.74; write less.");
  }


  ViscoinertialGrains::ViscoinertialGrains(const ViscoinertialGrainsParameters &parameters)
      : LinearElastic(parameters)
      , of(parameters)
      , friction_range(parameters.rapid_friction - parameters.static_friction)
      , stiff_dilatancy(parameters.dilatancy * bulk_modulus(0))
  {
    initial_porosity    = 1 - parameters.initial_fraction;
    plane_friction      = parameters.static_friction;
    grain_diameter      = parameters.grain_diameter;
    internal_quantities = { { "plastic_shear_strain", "-" } };
    output_quantities   = { { "solid_fraction", "-" } };
  }


  void ViscoinertialGrains::initialise(const PrincipalValues &wanted_stress,
                                       PrincipalValues &strain,
                                       PrincipalValues &stress,
                                       double *internal_variables) const
  {
    PrincipalValues deviator = wanted_stress;
    const auto invariants    = take_invariants<double>(deviator);
    const double pressure = -invariants.volume / 3, shear = std::sqrt(invariants.square / 2);
    const double excess = of.initial_fraction - of.critical_fraction;
    AssertThrow(excess >= 0 || (pressure == 0 && shear == 0),
                ExcMessage("Grains with \"Initial solid fraction\" = " + number_text(of.initial_fraction) +
                           ", below the critical one, " + number_text(of.critical_fraction) +
                           ", carry no stress at rest. Remedy: \"Type = none\" in subsection Initial state."));
    const double strength = (of.static_friction + of.dilatancy * excess) * pressure;
    AssertThrow(shear <= strength + 1e-9 * std::abs(pressure),
                ExcMessage("The initial shear stress " + number_text(shear) + " Pa is beyond the friction, " +
                           number_text(strength) + " Pa. Remedy: a K0 nearer to 1, or a larger \"Static friction\"."));
    LinearElastic::initialise(wanted_stress, strain, stress, nullptr);
    internal_variables[0] = 0;
  }
} // namespace scree
