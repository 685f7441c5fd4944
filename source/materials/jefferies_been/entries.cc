// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/jefferies_been/law.h>

using namespace dealii;

namespace scree
{
  void JefferiesBeenParameters::add_parameters(ParameterHandler &prm)
  {
    const Patterns::Double any, not_negative(0);
    prm.add_parameter(
        "Shear modulus", shear_modulus, "Pa; elastic shear modulus G at the reference pressure.", not_negative);
    prm.add_parameter("Poisson's ratio",
                      poisson_ratio,
                      "Poisson's ratio of the elastic moduli under isotropic stress, from 0 to less than 0.5.",
                      any);
    prm.add_parameter("Modulus exponent",
                      modulus_exponent,
                      "Exponent n from 0 to less than 1: elastic moduli grow with (p/reference pressure)^n.",
                      any);
    prm.add_parameter(
        "Reference pressure", reference_pressure, "Pa; pressure at which \"Shear modulus\" holds.", not_negative);
    add_line(prm);
    prm.add_parameter("Critical stress ratio M",
                      critical_stress_ratio,
                      "Stress ratio M_tc = q/p at critical state in triaxial compression.",
                      any);
    prm.add_parameter("Volumetric coupling N",
                      volumetric_coupling,
                      "N: part of the state parameter's dilatancy by which M_i is below M.",
                      not_negative);
    prm.add_parameter("State dilatancy",
                      state_dilatancy,
                      "chi_tc: largest dilatancy over the state parameter, in triaxial compression.",
                      not_negative);
    prm.add_parameter("Hardening modulus", hardening_modulus, "H_0: plastic hardening modulus at psi = 0.", any);
    prm.add_parameter("Hardening slope",
                      hardening_slope,
                      "H_psi: the plastic hardening modulus is H_0 - H_psi psi, and at least 10.",
                      any);
    prm.add_parameter("Initial void ratio", initial_void_ratio, "Void ratio e_0 at the start.", not_negative);
    prm.add_parameter("Initial overconsolidation ratio",
                      initial_overconsolidation,
                      "Image pressure at the start over that of the yield surface through the stress.",
                      Patterns::Double(1));
    prm.add_parameter("Minimum pressure",
                      minimum_pressure,
                      "Pa; pressure below which the grains separate: the stress is 0, and the gap is stored.",
                      not_negative);
    prm.add_parameter("Substep strain",
                      substep_strain,
                      "Largest component of the strain increment of one return mapping. Backward Euler's error of q in "
                      "a drained triaxial test is about 3 % at 5e-4, and in proportion to it; fits to tests need 2e-4.",
                      Patterns::Double(1e-6, 1));
  }


  void JefferiesBeenParameters::add_line(ParameterHandler &prm)
  {
    const Patterns::Double not_negative(0);
    prm.add_parameter(
        "Critical void ratio", critical_void_ratio, "Void ratio Gamma at critical state and 1 kPa.", not_negative);
    prm.add_parameter("Compression index",
                      compression_index,
                      "Slope lambda of the critical line in ln p (lambda_10/2.303).",
                      not_negative);
  }


  void JefferiesBeenParameters::check_line(const std::string &subsection) const
  {
    constexpr double largest_void_ratio = 5;
    const std::string range             = "write a void ratio above 0 and up to 5.";
    const auto is_void_ratio            = [](const double value) { return value > 0 && value <= largest_void_ratio; };
    require_entry(is_void_ratio(initial_void_ratio), subsection, "Initial void ratio", initial_void_ratio, range);
    require_entry(is_void_ratio(critical_void_ratio), subsection, "Critical void ratio", critical_void_ratio, range);
    require_entry(compression_index > 0, subsection, "Compression index", compression_index, "it must be positive.");
    require_entry(line().slope() * state_dilatancy < 0.9 * critical_stress_ratio,
                  subsection,
                  "State dilatancy",
                  state_dilatancy,
                  "with the slope " + number_text(line().slope()) + " of the critical line it must be below " +
                      number_text(0.9 * critical_stress_ratio / line().slope()) + '.');
  }


  void JefferiesBeenParameters::check(const std::string &subsection) const
  {
    const std::string positive = "it must be positive.";
    require_entry(shear_modulus > 0, subsection, "Shear modulus", shear_modulus, positive);
    require_entry(poisson_ratio >= 0 && poisson_ratio < 0.5,
                  subsection,
                  "Poisson's ratio",
                  poisson_ratio,
                  "write a value from 0 to less than 0.5.");
    require_entry(modulus_exponent >= 0 && modulus_exponent < 1,
                  subsection,
                  "Modulus exponent",
                  modulus_exponent,
                  "write a value from 0 to less than 1; sand has about 0.5.");
    require_entry(reference_pressure > 0, subsection, "Reference pressure", reference_pressure, positive);
    require_entry(critical_stress_ratio > 0 && critical_stress_ratio < 3,
                  subsection,
                  "Critical stress ratio M",
                  critical_stress_ratio,
                  "write a value above 0 and below 3, which would be a friction angle of 90 degrees.");
    require_entry(volumetric_coupling < 1,
                  subsection,
                  "Volumetric coupling N",
                  volumetric_coupling,
                  "write a value from 0 to less than 1; sand has 0.2 to 0.45.");
    require_entry(state_dilatancy > 0, subsection, "State dilatancy", state_dilatancy, positive);
    require_entry(hardening_modulus > 0, subsection, "Hardening modulus", hardening_modulus, positive);
    require_entry(minimum_pressure > 0, subsection, "Minimum pressure", minimum_pressure, positive + " 1 Pa does.");
    check_line(subsection);
  }
} // namespace scree
