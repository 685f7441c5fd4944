// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/bodies/suspension.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  void SuspensionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Suspension");
    prm.add_parameter("Law",
                      law,
                      "Viscosity of water with grains that have lost contact. none: that of the water. Einstein: "
                      "\"Viscosity\" (1 + 5/2 phi). Krieger-Dougherty: \"Viscosity\" (1 - phi/phi_m)^(-5/2 phi_m). phi "
                      "is the volume fraction of the grains.",
                      Patterns::Selection("none|Einstein|Krieger-Dougherty"));
    prm.add_parameter("Densest packing",
                      densest_packing,
                      "Volume fraction phi_m of the law of Krieger and Dougherty, at which grains do not flow.",
                      Patterns::Double(0.01, 1));
    prm.add_parameter("Contact pressure",
                      contact_pressure,
                      "Pa; mean effective stress from which soil is no suspension. Below it, the suspended part of the "
                      "soil increases linearly to 1 at 0 Pa.",
                      Patterns::Double(0));
    prm.leave_subsection();
  }


  void SuspensionParameters::check(const double viscosity, const unsigned int n_bodies) const
  {
    const SuspensionParameters defaults;
    const std::string where = "Water/Suspension";
    if (law_kind() != SuspensionLaw::krieger_dougherty)
      require_entry(densest_packing == defaults.densest_packing,
                    where,
                    "Densest packing",
                    densest_packing,
                    "this entry has no effect, as \"Law = " + law +
                        "\". Remove it, or write \"Law = Krieger-Dougherty\".");
    if (law_kind() == SuspensionLaw::none)
      {
        require_entry(contact_pressure == defaults.contact_pressure,
                      where,
                      "Contact pressure",
                      contact_pressure,
                      "this entry has no effect, as \"Law = none\". Remove it, or write another law.");
        return;
      }
    require_entry(n_bodies > 0, where, "Law", law, "there is no soil, as entry \"Bodies\" is none. Remove it.");
    require_entry(viscosity > 0,
                  "Water",
                  "Viscosity",
                  viscosity,
                  "\"Law = " + law + "\" of subsection Suspension multiplies it. Write 1e-3 for water.");
  }


  SuspensionLaw SuspensionParameters::law_kind() const
  {
    return law == "Einstein"            ? SuspensionLaw::einstein
           : law == "Krieger-Dougherty" ? SuspensionLaw::krieger_dougherty
                                        : SuspensionLaw::none;
  }


  Suspension::Suspension(const SuspensionParameters &parameters, const double water_viscosity)
      : law(parameters.law_kind())
      , water_viscosity(water_viscosity)
      , densest_packing(parameters.densest_packing)
      , contact_pressure(parameters.contact_pressure)
  {
  }


  double Suspension::viscosity(const double grain_fraction) const
  {
    constexpr double intrinsic = 2.5; // of spheres
    constexpr double densest   = 0.99;
    switch (law)
      {
      case SuspensionLaw::einstein:
        return water_viscosity * (1. + intrinsic * grain_fraction);
      case SuspensionLaw::krieger_dougherty:
        return water_viscosity *
               std::pow(1. - std::min(densest, grain_fraction / densest_packing), -intrinsic * densest_packing);
      default:
        return water_viscosity;
      }
  }


  double Suspension::suspended_part(const double pressure) const
  {
    if (pressure <= 0)
      return 1.;
    return pressure < contact_pressure ? 1. - pressure / contact_pressure : 0.;
  }
} // namespace scree
