// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/laws/nor_sand.h>

#include <boost/math/tools/toms748_solve.hpp>

using namespace dealii;

namespace scree
{
  namespace
  {
    const RegisterLaw registered_nor_sand = RegisterLaw::of<NorSand, NorSandParameters>("Nor-Sand", "Nor-Sand");
    const RegisterLaw registered_jefferies_been =
        RegisterLaw::of<JefferiesBeen, JefferiesBeenParameters>("Nor-Sand (Jefferies-Been)",
                                                                "Nor-Sand (Jefferies-Been)");
  } // namespace


  void SandParameters::add_substeps(ParameterHandler &prm, const std::string &text)
  {
    prm.add_parameter("Substep strain",
                      substep_strain,
                      "Largest component of the strain increment of one return mapping." + text,
                      Patterns::Double(1e-6, 1));
  }


  void SandParameters::check_positive(const std::string &subsection, const std::vector<LawEntry> &entries) const
  {
    for (const LawEntry &entry : entries)
      require_entry(entry.value > 0, { subsection, entry.name, entry.value }, "it must be positive.");
  }


  void NorSandParameters::add_parameters(ParameterHandler &prm)
  {
    const Patterns::Double not_negative(0);
    prm.add_parameter("Shear modulus", shear_modulus, "Pa; elastic shear modulus G.", not_negative);
    prm.add_parameter("Swelling index", swelling_index, "Elastic compressibility kappa in ln P.", not_negative);
    prm.add_parameter(
        "Compression index", compression_index, "Slope lambda of the critical state line in ln P.", not_negative);
    prm.add_parameter(
        "Critical state specific volume",
        critical_state_specific_volume,
        "Specific volume v_c0 of the critical state line at 1 Pa: Gamma + lambda ln(1000) of its value Gamma "
        "at 1 kPa.",
        Patterns::Double(1));
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
    add_substeps(prm, "");
  }


  void NorSandParameters::check(const std::string &subsection) const
  {
    check_positive(subsection,
                   { modulus(),
                     { "Swelling index", swelling_index },
                     { "Critical stress ratio M", critical_stress_ratio },
                     { "Hardening coefficient", hardening_coefficient } });
    require_entry(compression_index > swelling_index,
                  { subsection, "Compression index", compression_index },
                  "it must exceed the swelling index, here " + number_text(swelling_index) + '.');
    require_entry(potential_constant <= yield_constant,
                  { subsection, "Potential constant N bar", potential_constant },
                  "beyond the yield constant N, here " + number_text(yield_constant) +
                      ", plastic flow would create energy; lower it.");
    for (const LawEntry &volume : { LawEntry{ "Initial specific volume", initial_specific_volume },
                                    LawEntry{ "Critical state specific volume", critical_state_specific_volume } })
      require_entry(volume.value > 1,
                    { subsection, volume.name, volume.value },
                    "1 is rock without pores; sand lies between 1.3 and 2.");
  }


  LawEntry NorSandParameters::stiffest() const
  {
    constexpr double pressure = 1e5; // Pa, of a few metres of soil
    return shear_modulus > pressure / swelling_index ? modulus() : LawEntry{ "Swelling index", swelling_index };
  }


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
    prm.add_parameter(
        "Critical void ratio", critical_void_ratio, "Void ratio Gamma at critical state and 1 kPa.", not_negative);
    prm.add_parameter("Compression index",
                      compression_index,
                      "Slope lambda of the critical line in ln p (lambda_10/2.303).",
                      not_negative);
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
    add_substeps(
        prm,
        " Backward Euler's error of q in a drained triaxial test is about 3 % at 5e-4, and in proportion to it; "
        "fits to tests need 2e-4.");
  }


  void JefferiesBeenParameters::check(const std::string &subsection) const
  {
    check_positive(subsection,
                   { modulus(),
                     { "Reference pressure", reference_pressure },
                     { "State dilatancy", state_dilatancy },
                     { "Hardening modulus", hardening_modulus },
                     { "Compression index", compression_index } });
    require_entry(poisson_ratio >= 0 && poisson_ratio < 0.5,
                  { subsection, "Poisson's ratio", poisson_ratio },
                  "write a value from 0 to less than 0.5.");
    require_entry(modulus_exponent >= 0 && modulus_exponent < 1,
                  { subsection, "Modulus exponent", modulus_exponent },
                  "write a value from 0 to less than 1; sand has about 0.5.");
    require_entry(critical_stress_ratio > 0 && critical_stress_ratio < 3,
                  { subsection, "Critical stress ratio M", critical_stress_ratio },
                  "write a value above 0 and below 3, which would be a friction angle of 90 degrees.");
    require_entry(volumetric_coupling < 1,
                  { subsection, "Volumetric coupling N", volumetric_coupling },
                  "write a value from 0 to less than 1; sand has 0.2 to 0.45.");
    for (const LawEntry &ratio : { LawEntry{ "Initial void ratio", initial_void_ratio },
                                   LawEntry{ "Critical void ratio", critical_void_ratio } })
      require_entry(ratio.value > 0 && ratio.value <= 5,
                    { subsection, ratio.name, ratio.value },
                    "write a void ratio above 0 and up to 5.");
    require_entry(compression_index * state_dilatancy < 0.9 * critical_stress_ratio,
                  { subsection, "State dilatancy", state_dilatancy },
                  "with the slope " + number_text(compression_index) + " of the critical line it must be below " +
                      number_text(0.9 * critical_stress_ratio / compression_index) + '.');
  }


  template <typename Form, typename Elasticity>
  SandLaw<Form, Elasticity>::SandLaw(const SandParameters &parameters,
                                     const Elasticity &elastic,
                                     const CriticalLine &line,
                                     const double initial_volume,
                                     const std::string &volume_name)
      : elastic(elastic)
      , line(line)
      , log_minimum_pressure(std::log(parameters.minimum_pressure))
      , initial_volume(initial_volume)
  {
    substep_strain      = parameters.substep_strain;
    initial_porosity    = 1 - 1 / initial_volume;
    internal_quantities = { { "image_pressure", "Pa" }, { "plastic_shear_strain", "-" } };
    output_quantities   = { { volume_name, "-" }, { "state_parameter", "-" } };
  }


  template <typename Form, typename Elasticity>
  void SandLaw<Form, Elasticity>::initialise(const PrincipalValues &wanted_stress,
                                             PrincipalValues &strain,
                                             PrincipalValues &stress,
                                             double *internal_variables) const
  {
    const double pressure = -(wanted_stress[0] + wanted_stress[1] + wanted_stress[2]) / 3;
    const double least    = std::exp(log_minimum_pressure);
    AssertThrow(pressure > -least,
                ExcMessage("Nor-Sand cannot start under tension, mean stress " + std::to_string(-pressure) +
                           " Pa. Remedy: an initial state in compression."));
    double volume, shear;
    internal_variables[1] = 0;
    if (pressure < least)
      {
        elastic.strain_of(log_minimum_pressure, least, 0., volume, shear);
        strain.fill(-volume / 3);
        stress.fill(0);
        internal_variables[0] = std::exp(log_minimum_pressure + form().limit_at(initial_volume, log_minimum_pressure));
        return;
      }

    stress                   = wanted_stress;
    PrincipalValues deviator = wanted_stress;
    const auto of_stress     = take_invariants<double>(deviator);
    const double eta = std::sqrt(1.5 * of_stress.square) / pressure, log_pressure = std::log(pressure);
    elastic.strain_of(log_pressure, pressure, eta, volume, shear);
    const double factor = eta > 0 ? 1.5 * shear / (eta * pressure) : 0.;
    for (unsigned int i = 0; i < 3; ++i)
      strain[i] = factor * deviator[i] - volume / 3;
    internal_variables[0] = std::exp(form().image_through(
        { 0, of_stress.square / (pressure * pressure), of_stress.third / (pressure * pressure * pressure) },
        log_pressure,
        eta));
  }


  template <typename Form, typename Elasticity>
  void SandLaw<Form, Elasticity>::output(const PrincipalValues &strain,
                                         const double *internal_variables,
                                         const double volume_ratio,
                                         double *values) const
  {
    const auto now = trial_of(strain, volume_ratio, internal_variables);
    values[0]      = now.volume - Form::volume_zero;
    values[1]      = line.state(now.volume, std::max(now.log_pressure, log_minimum_pressure));
  }


  namespace
  {
    /// A root of `f` between `a` and `b`, to the last digit (@source{alefeld1995}); `b` if f does not change its sign.
    template <typename Function>
    double find_root(const Function &f, const double a, const double b)
    {
      std::uintmax_t most_steps = 200;
      const double low = std::min(a, b), high = std::max(a, b), f_low = f(low), f_high = f(high);
      if (!(std::min(f_low, f_high) <= 0. && std::max(f_low, f_high) >= 0.))
        return b;
      const auto root = boost::math::tools::toms748_solve(
          f, low, high, f_low, f_high, boost::math::tools::eps_tolerance<double>(), most_steps);
      return 0.5 * (root.first + root.second);
    }


    /// ln(exp(a) + exp(b)) without overflow.
    double log_sum(const double a, const double b)
    {
      return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
    }

  } // namespace


  NorSand::NorSand(const NorSandParameters &parameters)
      : SandLaw(parameters,
                { parameters.swelling_index, parameters.shear_modulus },
                { parameters.critical_state_specific_volume, parameters.compression_index, 0. /* ln of 1 Pa */ },
                parameters.initial_specific_volume,
                "specific_volume")
      , parameters(parameters)
      , exponent(parameters.yield_constant / (1 - parameters.yield_constant))
      , inverse_exponent(exponent > 0 ? 1 / exponent : 0)
      , dilatancy_factor(1 / (1 - parameters.potential_constant))
      , largest_log_ratio(exponent > 0 ? -std::log(1 - parameters.yield_constant) / exponent : 1)
      , limit_factor(parameters.dilatancy_multiplier * (1 - parameters.potential_constant) /
                     (1 - parameters.yield_constant) * parameters.yield_constant / parameters.critical_stress_ratio)
  {
    shear_modulus  = parameters.shear_modulus;
    plane_friction = parameters.critical_stress_ratio / std::sqrt(3.);
  }


  double NorSand::image_residual(const Trial<double> &trial, const double multiplier, const double log_ratio) const
  {
    const double log_pressure =
        trial.log_pressure + multiplier * dilatancy(stress_ratio(log_ratio)) * (1 / elastic.kappa);
    const double hardening = parameters.hardening_coefficient * multiplier;
    double derivative;
    const double log_limit_pressure = log_pressure + log_limit(log_pressure - log_ratio, trial.volume, derivative);
    return log_pressure - log_ratio + std::log1p(hardening) -
           log_sum(trial.log_image, std::log(hardening) + log_limit_pressure);
  }


  double NorSand::ratio_on_yield(const Trial<double> &trial, const double log_deviator, const double multiplier) const
  {
    // F = 0 in w = ln eta: g(w) = w + a exp(w) - c = 0, rising and convex: Newton from the right cannot miss.
    const double a = multiplier * dilatancy_factor / elastic.kappa;
    const double c = log_deviator - trial.log_pressure + a * parameters.critical_stress_ratio;
    double w       = c > 0 ? std::min(c, std::max(0., std::log(c / a))) : c;

    constexpr unsigned int largest_number_of_iterations = 100;
    for (unsigned int i = 0; i < largest_number_of_iterations; ++i)
      {
        const double slope = a * std::exp(w);
        const double step  = (w + slope - c) / (1 + slope);
        w -= step;
        if (std::abs(step) <= 1e-15 * (1 + std::abs(w)))
          break;
      }
    const double N = parameters.yield_constant, M = parameters.critical_stress_ratio;
    const double eta = std::exp(w);
    if (N == 0)
      return 1 - eta / M;
    const double argument = 1 - N / M * eta;
    return argument > 0 ? std::log(argument / (1 - N)) / exponent : -std::numeric_limits<double>::infinity();
  }


  NorSand::Returned<double> NorSand::search(const Trial<double> &trial, LawResponse<double> &response) const
  {
    if (image_residual(trial, trial.shear_strain, largest_log_ratio) > 0)
      {
        response.is_vertex = true;
        const auto image   = [&](const double multiplier) {
          return image_residual(trial, multiplier, largest_log_ratio);
        };

        double largest = trial.shear_strain + elastic.kappa;
        for (double step = elastic.kappa; image(largest) > 0 && step < 1e9; step *= 2)
          largest += step;

        const double multiplier   = find_root(image, trial.shear_strain, largest);
        response.is_unresolved    = !(std::abs(image(multiplier)) < 1e-6);
        const double log_pressure = trial.log_pressure + multiplier * dilatancy(0.) / elastic.kappa;
        return { log_pressure, largest_log_ratio, 0 };
      }

    // Along F = 0, which has one r for every q but not one q for every r. The image pressure is above its old value
    // or its limit at q = q_tr, below at q = 0.
    const auto multiplier = [&](const double log_deviator) {
      return std::max(trial.shear_strain - std::exp(log_deviator) / (3 * parameters.shear_modulus), 0.);
    };
    const auto image = [&](const double log_deviator) {
      const double gamma     = multiplier(log_deviator);
      const double log_ratio = ratio_on_yield(trial, log_deviator, gamma);
      return std::isfinite(log_ratio) ? image_residual(trial, gamma, log_ratio) : 1;
    };
    const double high = std::log(3 * parameters.shear_modulus * trial.shear_strain);
    double low        = high - 1;
    for (double step = 1; image(low) > 0 && step < 1e4; step *= 2)
      low -= step;

    const double log_deviator = find_root(image, high, low);
    const double gamma        = multiplier(log_deviator);
    const double log_ratio    = ratio_on_yield(trial, log_deviator, gamma);
    response.is_unresolved    = !(std::abs(image(log_deviator)) < 1e-6);
    const double log_pressure = trial.log_pressure + gamma * dilatancy(stress_ratio(log_ratio)) / elastic.kappa;
    return { log_pressure, log_ratio, std::exp(log_deviator - log_pressure) };
  }


  double NorSand::image_through(const StrainInvariants<double> &, const double log_pressure, const double eta) const
  {
    const double N = parameters.yield_constant, M = parameters.critical_stress_ratio;
    AssertThrow(N * eta < M,
                ExcMessage("Nor-Sand cannot bear the initial stress: q/P = " + std::to_string(eta) +
                           " must stay below M/N = " + std::to_string(M / N) + ". Remedy: a K0 closer to 1."));
    const double log_ratio = N > 0 ? std::log((1 - N * eta / M) / (1 - N)) / exponent : 1 - eta / M;
    return log_pressure - log_ratio;
  }


  JefferiesBeen::JefferiesBeen(const JefferiesBeenParameters &parameters)
      : SandLaw(parameters,
                { parameters.shear_modulus,
                  parameters.poisson_ratio,
                  parameters.modulus_exponent,
                  parameters.reference_pressure },
                { 1 + parameters.critical_void_ratio, parameters.compression_index, std::log(1e3) },
                1 + parameters.initial_void_ratio,
                "void_ratio")
      , parameters(parameters)
      , chi(parameters.state_dilatancy /
            (1. - parameters.compression_index * parameters.state_dilatancy / parameters.critical_stress_ratio))
  {
    // The constant part of the modulus of waves, see bulk_modulus().
    shear_modulus = elastic.constant_shear;
    // With M of theta = 0: the flow keeps the volume there, and the stress across the plane is the mean.
    const double M = parameters.critical_stress_ratio;
    plane_friction = (M - M * M / (3. + M) * std::sqrt(0.5)) / std::sqrt(3.);
  }


  bool JefferiesBeen::find_vertex(const Trial<double> &trial, Returned<double> &root) const
  {
    // q = 0 and r = 1: the multiplier is free, and exceeds the change of elastic shear strain.
    double multiplier    = 0;
    const auto hardening = [&](const double log_pressure) {
      const Image<double> i = image(trial.volume, log_pressure - 1., trial.lode_ratio);
      multiplier            = (trial.X - elastic.opening_at(log_pressure, 0.)) / (elastic.k_n * i.ratio);
      return log_pressure - 1. - trial.log_image -
             trial.hardening * (std::exp(2. + i.limit) - std::exp(1.)) * multiplier;
    };
    const double isotropic = elastic.log_pressure(trial.X, 0.);
    const double low = std::min(trial.log_image + 1., isotropic) - 1e-9, high = isotropic + 1e-9;
    if (!(hardening(low) <= 0. && hardening(high) >= 0.))
      return false;
    root = { find_root(hardening, low, high), 1., 0. };
    hardening(root.log_pressure);
    return multiplier >= trial.shear_strain * (1. - 1e-9);
  }


  bool JefferiesBeen::continue_to(const Trial<double> &trial, Returned<double> &root) const
  {
    // From the yield surface at the trial pressure, whose root is known.
    constexpr unsigned int most_parts = 1 << 16;
    const Image<double> old           = image(trial.volume, trial.log_image, trial.lode_ratio);
    const double r                    = std::min(trial.log_pressure - trial.log_image, 0.99);
    const Returned<double> start{ trial.log_image + r, r, 0. };
    const double eta = old.ratio * (1. - r), X = elastic.opening_at(start.log_pressure, eta);
    const double shear = eta * X / (3. * elastic.g);
    for (unsigned int parts = 4; parts <= most_parts; parts *= 4)
      {
        root       = start;
        bool holds = true;
        for (unsigned int i = 1; i <= parts && holds; ++i)
          {
            const double part = static_cast<double>(i) / parts;
            holds             = newton_to<Hardening::law, double>(
                trial, X + part * (trial.X - X), shear + part * (trial.shear_strain - shear), true, root);
          }
        if (holds)
          return true;
      }
    return false;
  }


  JefferiesBeen::Returned<double> JefferiesBeen::on_cap(const Trial<double> &trial) const
  {
    // All is explicit in ln p_i. Below the smallest value there is no stress; that is an answer, too.
    const auto at = [&](const double log_image) {
      const double limit = image(trial.volume, log_image, trial.lode_ratio).limit;
      return Returned<double>{ log_image - limit, -limit, 0. };
    };
    const auto beyond = [&](const double log_image) {
      const Returned<double> cap = at(log_image);
      return residual<Hardening::cap, double>(trial, trial.X, trial.shear_strain, cap.log_pressure, cap.log_ratio)
          .first;
    };
    const double low = log_minimum_pressure - 4., high = std::max(trial.log_pressure, trial.log_image) + 12.;
    return at(beyond(low) > 0. ? find_root(beyond, low, high) : low);
  }


  JefferiesBeen::Returned<double> JefferiesBeen::search(const Trial<double> &trial, LawResponse<double> &response) const
  {
    Returned<double> root;
    response.is_vertex     = find_vertex(trial, root);
    response.is_unresolved = !response.is_vertex && !continue_to(trial, root);
    if (response.is_unresolved)
      root = { trial.log_pressure, std::min(trial.log_pressure - trial.log_image, 0.9), 0. };
    else if (!response.is_vertex && is_beyond_cap(trial, root))
      root = on_cap(trial);
    return with_ratio(trial, root);
  }


  double JefferiesBeen::image_through(const StrainInvariants<double> &strain,
                                      const double log_pressure,
                                      const double eta) const
  {
    // The largest p_i, on the cap, and the one whose yield surface passes through the stress.
    const double M = lode_ratio(strain), volume = 1 + parameters.initial_void_ratio;
    double cap = log_pressure, through = log_pressure;
    for (unsigned int pass = 0; pass < 100; ++pass)
      {
        cap     = log_pressure + image(volume, cap, M).limit;
        through = log_pressure - 1. + eta / image(volume, through, M).ratio;
      }
    AssertThrow(through <= cap,
                ExcMessage("Nor-Sand cannot bear the initial stress: q/p = " + std::to_string(eta) +
                           " must stay below " +
                           std::to_string(image(volume, cap, M).ratio * (1. + cap - log_pressure)) + " at void ratio " +
                           std::to_string(parameters.initial_void_ratio) + " and pressure " +
                           std::to_string(std::exp(log_pressure)) +
                           " Pa. Remedy: a K0 closer to 1, or a smaller \"Initial void ratio\"."));
    return through;
  }

  template class SandLaw<NorSand, ConstantShear>;
  template class SandLaw<JefferiesBeen, PressureElasticity>;
} // namespace scree
