// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/laws/nor_sand_return.h>
#include <scree/materials/batch_material.h>

using namespace dealii;

namespace scree
{
  void NorSandParameters::add_parameters(ParameterHandler &prm)
  {
    const Patterns::Double not_negative(0);
    prm.add_parameter("Shear modulus", shear_modulus, "Pa; elastic shear modulus G.", not_negative);
    prm.add_parameter("Swelling index", swelling_index, "Elastic compressibility kappa in ln P.", not_negative);
    prm.add_parameter(
        "Compression index", compression_index, "Slope lambda of the critical state line in ln P.", not_negative);
    prm.add_parameter("Critical state specific volume",
                      critical_state_specific_volume,
                      "Specific volume v_c0 of the critical state line at the reference pressure.",
                      Patterns::Double(1));
    prm.add_parameter("Reference pressure", reference_pressure, "Pa; pressure at which v_c0 holds.", not_negative);
    prm.add_parameter("Critical stress ratio M",
                      critical_stress_ratio,
                      "Stress ratio q/P at critical state; 6 sin(phi)/(3 - sin(phi)) of a friction angle phi.",
                      not_negative);
    prm.add_parameter("Yield constant N",
                      yield_constant,
                      "Curvature N of the yield surface; 0: original Cam-Clay.",
                      Patterns::Double(0, 0.99));
    prm.add_parameter("Potential constant N bar",
                      potential_constant,
                      "Curvature of the plastic potential, at most N.",
                      Patterns::Double(0, 0.99));
    prm.add_parameter("Hardening coefficient", hardening_coefficient, "Hardening coefficient h.", not_negative);
    prm.add_parameter("Dilatancy multiplier",
                      dilatancy_multiplier,
                      "Multiplier alpha: largest dilatancy over state parameter; negative.",
                      Patterns::Double(-100, 0));
    prm.add_parameter("Initial specific volume",
                      initial_specific_volume,
                      "Specific volume v_0 = 1 + void ratio at the start.",
                      Patterns::Double(1));
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
                      "Largest component of the strain increment of one return mapping.",
                      Patterns::Double(1e-6, 1));
  }


  double NorSandParameters::sine() const
  {
    return 3 * critical_stress_ratio / (6 + critical_stress_ratio);
  }


  void NorSandParameters::check(const std::string &subsection) const
  {
    const std::string positive = "it must be positive.";
    require_entry(shear_modulus > 0, subsection, "Shear modulus", shear_modulus, positive);
    require_entry(swelling_index > 0, subsection, "Swelling index", swelling_index, positive);
    require_entry(compression_index > swelling_index,
                  subsection,
                  "Compression index",
                  compression_index,
                  "it must exceed the swelling index, here " + number_text(swelling_index) + '.');
    require_entry(reference_pressure > 0, subsection, "Reference pressure", reference_pressure, positive);
    require_entry(critical_stress_ratio > 0, subsection, "Critical stress ratio M", critical_stress_ratio, positive);
    require_entry(potential_constant <= yield_constant,
                  subsection,
                  "Potential constant N bar",
                  potential_constant,
                  "beyond the yield constant N, here " + number_text(yield_constant) +
                      ", plastic flow would create energy; lower it.");
    require_entry(hardening_coefficient > 0, subsection, "Hardening coefficient", hardening_coefficient, positive);
    require_entry(initial_specific_volume > 1,
                  subsection,
                  "Initial specific volume",
                  initial_specific_volume,
                  "1 is rock without pores; sand lies between 1.3 and 2.");
    require_entry(critical_state_specific_volume > 1,
                  subsection,
                  "Critical state specific volume",
                  critical_state_specific_volume,
                  "1 is rock without pores; sand lies between 1.3 and 2.");
    require_entry(minimum_pressure > 0, subsection, "Minimum pressure", minimum_pressure, positive + " 1 Pa does.");
  }


  void NorSandParameters::divide_strength(const double factor)
  {
    critical_stress_ratio /= factor;
  }


  LawEntry NorSandParameters::modulus() const
  {
    return { "Shear modulus", shear_modulus };
  }


  LawEntry NorSandParameters::stiffest() const
  {
    constexpr double pressure = 1e5; // Pa, of a few metres of soil
    return shear_modulus > pressure / swelling_index ? modulus() : LawEntry{ "Swelling index", swelling_index };
  }


  namespace
  {
    const RegisterLaw registered_nor_sand("Nor-Sand",
                                          "Nor-Sand",
                                          std::make_unique<EntriesOf<NorSandParameters, BatchMaterial, NorSand>>());
  } // namespace


  NorSand::NorSand(const NorSandParameters &parameters)
      : parameters(parameters)
      , inverse_swelling_index(1 / parameters.swelling_index)
      , log_minimum_pressure(std::log(parameters.minimum_pressure))
      , log_reference_pressure(std::log(parameters.reference_pressure))
      , exponent(parameters.yield_constant / (1 - parameters.yield_constant))
      , inverse_exponent(exponent > 0 ? 1 / exponent : 0)
      , dilatancy_factor(1 / ((1 - parameters.potential_constant) * lode_factor))
      , largest_log_ratio(exponent > 0 ? -std::log(1 - parameters.yield_constant) / exponent : 1)
      , limit_factor(parameters.dilatancy_multiplier * (1 - parameters.potential_constant) /
                     (1 - parameters.yield_constant) * parameters.yield_constant / parameters.critical_stress_ratio)
  {
  }


  double NorSand::shear_modulus() const
  {
    return parameters.shear_modulus;
  }


  double NorSand::bulk_modulus(const double pressure) const
  {
    return std::max(pressure, parameters.minimum_pressure) * inverse_swelling_index;
  }


  double NorSand::energy(const PrincipalValues &strain) const
  {
    const double volume_strain = strain[0] + strain[1] + strain[2];
    double energy              = parameters.swelling_index * std::exp(log_pressure_of(volume_strain));
    for (const double value : strain) // 3/2 eps_s^2 = |dev eps|^2
      energy += parameters.shear_modulus * (value - volume_strain / 3) * (value - volume_strain / 3);
    return energy;
  }


  double NorSand::plane_friction() const
  {
    return parameters.critical_stress_ratio / std::sqrt(3.);
  }


  double NorSand::initial_porosity() const
  {
    return 1 - 1 / parameters.initial_specific_volume;
  }


  double NorSand::yield(const PrincipalValues &strain, const double image_pressure) const
  {
    const double volume_strain = strain[0] + strain[1] + strain[2];
    double deviator_square     = 0;
    for (const double value : strain)
      deviator_square += (value - volume_strain / 3) * (value - volume_strain / 3);
    const double log_pressure = log_pressure_of(volume_strain);
    return 3 * parameters.shear_modulus * std::sqrt(2. / 3. * deviator_square) * std::exp(-log_pressure) -
           stress_ratio(log_pressure - std::log(image_pressure));
  }


  void NorSand::initialise(const PrincipalValues &wanted_stress,
                           PrincipalValues &strain,
                           PrincipalValues &stress,
                           double *internal_variables) const
  {
    const double pressure = -(wanted_stress[0] + wanted_stress[1] + wanted_stress[2]) / 3;
    AssertThrow(pressure > -parameters.minimum_pressure,
                ExcMessage("Nor-Sand cannot start under tension, mean stress " + std::to_string(-pressure) +
                           " Pa. Remedy: an initial state in compression."));
    internal_variables[1] = 0;
    if (pressure < parameters.minimum_pressure)
      {
        const double volume_strain = (log_pressure_of(0.) - log_minimum_pressure) * parameters.swelling_index;
        strain.fill(volume_strain / 3);
        stress.fill(0);
        internal_variables[0] = image_of_separated(parameters.initial_specific_volume);
        return;
      }

    stress                     = wanted_stress;
    const double volume_strain = (log_pressure_of(0.) - std::log(pressure)) * parameters.swelling_index;
    double deviator_square     = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double deviator = stress[i] + pressure;
        strain[i]             = volume_strain / 3 + deviator / (2 * parameters.shear_modulus);
        deviator_square += deviator * deviator;
      }

    const double N = parameters.yield_constant, M = parameters.critical_stress_ratio;
    const double ratio = std::sqrt(1.5 * deviator_square) / pressure; // q/P
    AssertThrow(N * ratio < M,
                ExcMessage("Nor-Sand cannot bear the initial stress: q/P = " + std::to_string(ratio) +
                           " must stay below M/N = " + std::to_string(M / N) + ". Remedy: a K0 closer to 1."));
    const double log_ratio = N > 0 ? std::log((1 - N * ratio / M) / (1 - N)) / exponent : 1 - ratio / M;
    internal_variables[0]  = parameters.initial_overconsolidation * pressure * std::exp(-log_ratio);
  }


  std::vector<Quantity> NorSand::internal_quantities()
  {
    return { { "image_pressure", "Pa" }, { "plastic_shear_strain", "-" } };
  }


  std::vector<Quantity> NorSand::output_quantities()
  {
    return { { "specific_volume", "-" }, { "state_parameter", "-" } };
  }


  void NorSand::output(const PrincipalValues &strain, const double *, const double volume_ratio, double *values) const
  {
    const double log_pressure = std::max(log_pressure_of(strain[0] + strain[1] + strain[2]), log_minimum_pressure);
    values[0]                 = parameters.initial_specific_volume * volume_ratio;
    values[1]                 = values[0] - parameters.critical_state_specific_volume +
                parameters.compression_index * (log_pressure - log_reference_pressure);
  }
} // namespace scree
