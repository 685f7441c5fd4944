// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/jefferies_been/return.h>
#include <scree/materials/principal_batch_material.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    const char name_of_jefferies_been[] = "Nor-Sand (Jefferies-Been)";

    const RegisterLaw registered_jefferies_been(
        name_of_jefferies_been,
        name_of_jefferies_been,
        std::make_unique<EntriesOf<JefferiesBeenParameters, PrincipalBatchMaterial, JefferiesBeen>>());

    double slope_of_line(const JefferiesBeenParameters &parameters)
    {
      return parameters.line().slope();
    }


    /// chi of the image condition.
    double chi_of_image(const JefferiesBeenParameters &parameters)
    {
      return parameters.state_dilatancy /
             (1. - slope_of_line(parameters) * parameters.state_dilatancy / parameters.critical_stress_ratio);
    }
  } // namespace


  CriticalLine JefferiesBeenParameters::line() const
  {
    constexpr double kilopascal = 1e3;
    return { critical_void_ratio, compression_index, std::log(kilopascal) };
  }


  double JefferiesBeenParameters::sine() const
  {
    return 3. * critical_stress_ratio / (6. + critical_stress_ratio);
  }


  void JefferiesBeenParameters::divide_strength(const double factor)
  {
    critical_stress_ratio /= factor;
  }


  LawEntry JefferiesBeenParameters::modulus() const
  {
    return { "Shear modulus", shear_modulus };
  }


  JefferiesBeen::JefferiesBeen(const JefferiesBeenParameters &parameters)
      : elastic(parameters.shear_modulus,
                parameters.poisson_ratio,
                parameters.modulus_exponent,
                parameters.reference_pressure)
      , parameters(parameters)
      , line(parameters.line())
      , chi(chi_of_image(parameters))
      , log_minimum_pressure(std::log(parameters.minimum_pressure))
      , constant_shear_modulus(elastic.shear_modulus(1e3))
  {
  }


  double JefferiesBeen::substep_strain() const
  {
    return parameters.substep_strain;
  }


  double JefferiesBeen::shear_modulus() const
  {
    return constant_shear_modulus;
  }


  double JefferiesBeen::bulk_modulus(const double pressure) const
  {
    const double log_pressure = std::log(std::max(pressure, parameters.minimum_pressure));
    return std::max(elastic.wave_modulus(log_pressure, 0.) - 4. / 3. * constant_shear_modulus, 0.);
  }


  double JefferiesBeen::energy(const PrincipalValues &strain) const
  {
    const double volume_strain = -(strain[0] + strain[1] + strain[2]);
    double square              = 0;
    for (const double value : strain)
      square += (value + volume_strain / 3) * (value + volume_strain / 3);
    return elastic.energy(volume_strain, std::sqrt(2. / 3. * square));
  }


  double JefferiesBeen::initial_porosity() const
  {
    return parameters.initial_void_ratio / (1. + parameters.initial_void_ratio);
  }


  double JefferiesBeen::plane_friction() const
  {
    // At critical state the flow keeps the volume: the stress across the plane is the mean, theta = 0.
    const double M = parameters.critical_stress_ratio;
    return (M - M * M / (3. + M) * std::sqrt(0.5)) / std::sqrt(3.);
  }


  void JefferiesBeen::initialise(const PrincipalValues &wanted_stress,
                                 PrincipalValues &strain,
                                 PrincipalValues &stress,
                                 double *internal_variables) const
  {
    const double pressure = -(wanted_stress[0] + wanted_stress[1] + wanted_stress[2]) / 3;
    AssertThrow(pressure > -parameters.minimum_pressure,
                ExcMessage("Nor-Sand cannot start under tension, mean stress " + std::to_string(-pressure) +
                           " Pa. Remedy: an initial state in compression."));
    const double e        = parameters.initial_void_ratio;
    internal_variables[1] = 0;
    if (pressure < parameters.minimum_pressure)
      {
        strain.fill(-elastic.volume_strain(elastic.opening_at(log_minimum_pressure, 0.)) / 3.);
        stress.fill(0);
        internal_variables[0] =
            std::exp(log_minimum_pressure + image(e, log_minimum_pressure, parameters.critical_stress_ratio).limit);
        return;
      }

    stress = wanted_stress;
    PrincipalValues deviator;
    double square = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        deviator[i] = stress[i] + pressure;
        square += deviator[i] * deviator[i];
      }
    const double eta = std::sqrt(1.5 * square) / pressure, log_pressure = std::log(pressure);
    for (double &value : deviator)
      value /= pressure;
    const double M_theta = lode_ratio(deviator, square / (pressure * pressure));
    const double X       = elastic.opening_at(log_pressure, eta);
    const double factor  = eta > 0 ? elastic.shear_strain(X, eta) * 1.5 / eta : 0.;
    for (unsigned int i = 0; i < 3; ++i)
      strain[i] = factor * deviator[i] - elastic.volume_strain(X) / 3.;

    // The largest p_i, on the cap, and the one whose yield surface passes through the stress.
    double cap = log_pressure, through = log_pressure;
    for (unsigned int pass = 0; pass < 100; ++pass)
      {
        cap     = log_pressure + image(e, cap, M_theta).limit;
        through = log_pressure - 1. + eta / image(e, through, M_theta).ratio;
      }
    AssertThrow(through <= cap,
                ExcMessage("Nor-Sand cannot bear the initial stress: q/p = " + std::to_string(eta) +
                           " must stay below " +
                           std::to_string(image(e, cap, M_theta).ratio * (1. + cap - log_pressure)) +
                           " at void ratio " + std::to_string(e) + " and pressure " + std::to_string(pressure) +
                           " Pa. Remedy: a K0 closer to 1, or a smaller \"Initial void ratio\"."));
    internal_variables[0] = std::exp(std::min(through + std::log(parameters.initial_overconsolidation), cap));
  }


  std::vector<Quantity> JefferiesBeen::internal_quantities()
  {
    return { { "image_pressure", "Pa" }, { "plastic_shear_strain", "-" } };
  }


  std::vector<Quantity> JefferiesBeen::output_quantities()
  {
    return { { "void_ratio", "-" }, { "state_parameter", "-" } };
  }


  void JefferiesBeen::output(const PrincipalValues &strain,
                             const double *internal_variables,
                             const double volume_ratio,
                             double *values) const
  {
    const Trial<double> now = trial(strain, volume_ratio, internal_variables);
    double slope;
    values[0] = now.void_ratio;
    values[1] = line.state(now.void_ratio, std::max(now.log_pressure, log_minimum_pressure), slope);
  }


  double
  JefferiesBeen::yield(const PrincipalValues &strain, const double *internal_variables, const double volume_ratio) const
  {
    const Trial<double> now = trial(strain, volume_ratio, internal_variables);
    const double log_image  = std::log(internal_variables[0]);
    return now.eta - image(now.void_ratio, log_image, now.lode_ratio).ratio * (1. - now.log_pressure + log_image);
  }


  double JefferiesBeen::beyond_cap(const PrincipalValues &strain,
                                   const double *internal_variables,
                                   const double volume_ratio) const
  {
    const Trial<double> now = trial(strain, volume_ratio, internal_variables);
    const double log_image  = std::log(internal_variables[0]);
    return log_image - now.log_pressure - image(now.void_ratio, log_image, now.lode_ratio).limit;
  }
} // namespace scree
