// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/material/nor_sand.h>

#include <limits>

namespace scree
{
  namespace
  {
    /// A root of `f` between `positive` and `negative`, named after the sign of f there, to the last digit: false
    /// position with Illinois weights (Dowell & Jarratt 1971), every third step a bisection, which cannot stall.
    template <typename Function>
    double find_root(const Function &f, double positive, double negative)
    {
      double f_positive = f(positive), f_negative = f(negative);
      int last_side = 0;
      for (unsigned int i = 0; i < 200; ++i)
        {
          double x = (positive * f_negative - negative * f_positive) / (f_negative - f_positive);
          if (i % 3 == 2 || !(x > std::min(positive, negative) && x < std::max(positive, negative)))
            x = 0.5 * (positive + negative);
          if (x == positive || x == negative)
            break;
          const double f_x = f(x);
          if (std::abs(f_x) <= 1e-14)
            return x;
          const int side = f_x > 0 ? 1 : -1;
          if (side > 0)
            {
              positive   = x;
              f_positive = f_x;
              f_negative *= side == last_side ? 0.5 : 1;
            }
          else
            {
              negative   = x;
              f_negative = f_x;
              f_positive *= side == last_side ? 0.5 : 1;
            }
          last_side = side;
        }
      return negative;
    }


    /// ln(exp(a) + exp(b)) without overflow.
    double log_sum(const double a, const double b)
    {
      return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
    }
  } // namespace


  DEAL_II_ALWAYS_INLINE inline double
  NorSand::log_limit(const double log_image, const double volume, double &derivative) const
  {
    constexpr double smallest_argument = 0.15; // Below, the limit pressure runs away for very dense sand.

    const double state = volume - parameters.critical_state_specific_volume +
                         parameters.compression_index * (log_image - log_reference_pressure);
    if (exponent == 0) // the limit N -> 0
      {
        const double factor =
            parameters.dilatancy_multiplier * (1 - parameters.potential_constant) / parameters.critical_stress_ratio;
        derivative = factor * parameters.compression_index;
        return factor * state;
      }
    const double argument = 1 - limit_factor * state;
    if (argument <= smallest_argument)
      {
        derivative = 0;
        return -std::log(smallest_argument) * inverse_exponent;
      }
    derivative = limit_factor * parameters.compression_index * inverse_exponent / argument;
    return -std::log(argument) * inverse_exponent;
  }


  DEAL_II_ALWAYS_INLINE inline NorSand::Residual
  NorSand::residual(const Trial &trial, const double multiplier, const double log_ratio) const
  {
    const double M = parameters.critical_stress_ratio, h = parameters.hardening_coefficient;
    const double E = exponent > 0 ? std::exp(exponent * log_ratio) : 1;
    const double eta =
        exponent > 0 ? M / parameters.yield_constant * (1 - (1 - parameters.yield_constant) * E) : M * (1 - log_ratio);
    const double eta_ratio    = -M * E; // d eta/dr
    const double D            = dilatancy(eta);
    const double D_ratio      = eta_ratio / ((1 - parameters.potential_constant) * lode_factor);
    const double log_pressure = trial.log_pressure + multiplier * D * inverse_swelling_index;

    const double log_pressure_gamma = D * inverse_swelling_index;
    const double log_pressure_ratio = multiplier * D_ratio * inverse_swelling_index;
    const double log_image_ratio    = log_pressure_ratio - 1;

    const double compliance     = std::exp(-log_pressure);
    const double deviator_slope = 3 * parameters.shear_modulus * compliance;
    const double deviator_ratio = trial.deviator * compliance - deviator_slope * multiplier; // q/P

    // Pi (1 + h gamma) = Pi_n + h gamma Pi*, over P.
    double limit_slope;
    const double limit       = h * std::exp(log_limit(log_pressure - log_ratio, trial.volume, limit_slope)); // h Pi*/P
    const double old         = trial.image * compliance;
    const double hardening   = 1 + h * multiplier;
    const double sum         = old + multiplier * limit;
    const double inverse_sum = 1 / sum;

    Residual r;
    r.deviator_ratio = trial.deviator * compliance;
    r.yield          = lode_factor * deviator_ratio - eta;
    r.yield_gamma    = -lode_factor * (deviator_slope + deviator_ratio * log_pressure_gamma);
    r.yield_ratio    = -lode_factor * deviator_ratio * log_pressure_ratio - eta_ratio;
    r.image          = std::log(hardening * inverse_sum) - log_ratio;
    r.image_gamma =
        h / hardening - (limit + (multiplier * limit * limit_slope - old) * log_pressure_gamma) * inverse_sum;
    r.image_ratio = -1 - (multiplier * limit * limit_slope * log_image_ratio - old * log_pressure_ratio) * inverse_sum;
    return r;
  }


  NorSand::Residual NorSand::first_residual(const Trial &trial, const double log_ratio) const
  {
    const double compliance = 1 / trial.pressure;
    const double D_slope    = dilatancy(trial.stress_ratio) * inverse_swelling_index;
    double limit_slope;
    const double limit = log_limit(trial.log_image, trial.volume, limit_slope);

    Residual r;
    r.deviator_ratio = trial.deviator * compliance;
    r.yield          = lode_factor * r.deviator_ratio - trial.stress_ratio;
    r.yield_gamma    = -lode_factor * (3 * parameters.shear_modulus * compliance + r.deviator_ratio * D_slope);
    r.yield_ratio    = parameters.critical_stress_ratio - parameters.yield_constant * trial.stress_ratio;
    if (parameters.yield_constant > 0) // M exp(r N/(1-N)), from eta
      r.yield_ratio /= 1 - parameters.yield_constant;
    r.image       = 0;
    r.image_gamma = parameters.hardening_coefficient * (1 - std::exp(log_ratio + limit)) + D_slope;
    r.image_ratio = -1;
    return r;
  }


  bool NorSand::newton(const Trial &trial, Returned &returned) const
  {
    constexpr unsigned int largest_number_of_iterations = 14;
    constexpr unsigned int largest_number_of_halvings   = 6;
    constexpr double tolerance                          = 1e-7; // before the last step, which squares the residual
    constexpr double largest_change_of_ratio            = 1;
    constexpr double largest_part_of_the_way            = 0.9; // to a bound

    const double largest_multiplier = trial.deviator / (3 * parameters.shear_modulus);
    double multiplier               = 0;
    double log_ratio                = std::min(trial.log_pressure - trial.log_image, largest_log_ratio);
    Residual now = log_ratio < largest_log_ratio ? first_residual(trial, log_ratio) : residual(trial, 0, log_ratio);
    for (unsigned int i = 0; i < largest_number_of_iterations; ++i)
      {
        const double inverse_determinant = 1 / (now.yield_gamma * now.image_ratio - now.yield_ratio * now.image_gamma);
        const double step_multiplier =
            (now.yield_ratio * now.image - now.image_ratio * now.yield) * inverse_determinant;
        const double step_ratio = (now.image_gamma * now.yield - now.yield_gamma * now.image) * inverse_determinant;

        // A branch, as it is nearly always taken: minima would hold up the next residual.
        const double room = step_multiplier > 0 ? largest_multiplier - multiplier : multiplier;
        double part       = 1;
        if (!(std::abs(step_ratio) <= largest_change_of_ratio &&
              step_ratio <= largest_part_of_the_way * (largest_log_ratio - log_ratio) &&
              std::abs(step_multiplier) <= largest_part_of_the_way * room))
          part = std::min(std::min(1., largest_change_of_ratio / std::abs(step_ratio)),
                          largest_part_of_the_way *
                              std::min(room / std::abs(step_multiplier),
                                       step_ratio > 0 ? (largest_log_ratio - log_ratio) / step_ratio : 2.));

        if (part == 1 && std::abs(now.yield) <= tolerance * (1 + now.deviator_ratio) &&
            std::abs(now.image) <= tolerance)
          {
            multiplier += step_multiplier;
            log_ratio += step_ratio;
            // P from the flow rule, q from the yield surface: q_tr - 3 G gamma loses digits where gamma is large.
            const double eta      = stress_ratio(log_ratio);
            returned.log_ratio    = log_ratio;
            returned.log_pressure = trial.log_pressure + multiplier * dilatancy(eta) * inverse_swelling_index;
            returned.pressure     = std::exp(returned.log_pressure);
            returned.deviator     = std::min(returned.pressure * eta / lode_factor, trial.deviator);
            return true;
          }

        const double merit = now.yield * now.yield + now.image * now.image;
        for (unsigned int halving = 0;; ++halving, part *= 0.5)
          {
            const Residual next = residual(trial, multiplier + part * step_multiplier, log_ratio + part * step_ratio);
            if (next.yield * next.yield + next.image * next.image < merit)
              {
                now = next;
                break;
              }
            if (halving == largest_number_of_halvings)
              return false;
          }
        multiplier += part * step_multiplier;
        log_ratio += part * step_ratio;
      }
    return false;
  }


  double NorSand::image_residual(const Trial &trial, const double multiplier, const double log_ratio) const
  {
    const double log_pressure =
        trial.log_pressure + multiplier * dilatancy(stress_ratio(log_ratio)) * inverse_swelling_index;
    const double hardening = parameters.hardening_coefficient * multiplier;
    double derivative;
    const double log_limit_pressure = log_pressure + log_limit(log_pressure - log_ratio, trial.volume, derivative);
    return log_pressure - log_ratio + std::log1p(hardening) -
           log_sum(trial.log_image, std::log(hardening) + log_limit_pressure);
  }


  double NorSand::ratio_on_yield(const Trial &trial, const double log_deviator, const double multiplier) const
  {
    // F = 0 in w = ln eta: g(w) = w + a exp(w) - c = 0, rising and convex: Newton from the right cannot miss.
    const double a = inverse_swelling_index * multiplier / ((1 - parameters.potential_constant) * lode_factor);
    const double c = log_deviator + std::log(lode_factor) - trial.log_pressure + a * parameters.critical_stress_ratio;
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


  NorSand::Returned NorSand::search(const Trial &trial, UpdateReport &report) const
  {
    ++report.n_fallbacks;
    const double largest_multiplier = trial.deviator / (3 * parameters.shear_modulus);
    if (image_residual(trial, largest_multiplier, largest_log_ratio) > 0)
      return search_vertex(trial, report);

    // Along F = 0, which has one r for every q but not one q for every r. The image pressure is above its old value
    // or its limit at q = q_tr, below at q = 0.
    const auto multiplier = [&](const double log_deviator) {
      return std::max(trial.deviator - std::exp(log_deviator), 0.) / (3 * parameters.shear_modulus);
    };
    const auto image = [&](const double log_deviator) {
      const double gamma     = multiplier(log_deviator);
      const double log_ratio = ratio_on_yield(trial, log_deviator, gamma);
      return std::isfinite(log_ratio) ? image_residual(trial, gamma, log_ratio) : 1;
    };
    const double high = std::log(trial.deviator);
    double low        = high - 1;
    for (double step = 1; image(low) > 0 && step < 1e4; step *= 2)
      low -= step;

    const double log_deviator = find_root(image, high, low);
    const double gamma        = multiplier(log_deviator);
    const double log_ratio    = ratio_on_yield(trial, log_deviator, gamma);
    if (!(std::abs(image(log_deviator)) < 1e-6))
      ++report.n_unresolved;
    const double log_pressure =
        trial.log_pressure + gamma * dilatancy(stress_ratio(log_ratio)) * inverse_swelling_index;
    return { log_pressure, std::exp(log_pressure), log_ratio, std::exp(log_deviator) };
  }


  NorSand::Returned NorSand::search_vertex(const Trial &trial, UpdateReport &report) const
  {
    ++report.n_vertices;
    const auto image = [&](const double multiplier) { return image_residual(trial, multiplier, largest_log_ratio); };

    const double smallest = trial.deviator / (3 * parameters.shear_modulus);
    double largest        = smallest + parameters.swelling_index;
    for (double step = parameters.swelling_index; image(largest) > 0 && step < 1e9; step *= 2)
      largest += step;

    const double multiplier = find_root(image, smallest, largest);
    if (!(std::abs(image(multiplier)) < 1e-6))
      ++report.n_unresolved;
    const double log_pressure = trial.log_pressure + multiplier * dilatancy(0) * inverse_swelling_index;
    return { log_pressure, std::exp(log_pressure), largest_log_ratio, 0 };
  }


  void NorSand::separate(const double volume_strain,
                         const double volume,
                         PrincipalValues &strain,
                         double *internal_variables,
                         PrincipalValues &stress) const
  {
    double derivative;
    strain.fill(volume_strain / 3);
    stress.fill(0);
    internal_variables[0] = std::exp(log_minimum_pressure + log_limit(log_minimum_pressure, volume, derivative));
  }


  Response NorSand::plastic_return(const Trial &trial,
                                   PrincipalValues &strain,
                                   double *internal_variables,
                                   PrincipalValues &stress,
                                   UpdateReport &report) const
  {
    Returned returned{ trial.log_pressure, trial.pressure, 0, 0 };
    if (trial.log_pressure >= log_minimum_pressure && !newton(trial, returned))
      returned = search(trial, report);

    const double volume_strain = (log_pressure_of(0) - returned.log_pressure) * parameters.swelling_index;
    if (returned.log_pressure < log_minimum_pressure)
      {
        ++report.n_separated;
        separate(volume_strain, trial.volume, strain, internal_variables, stress);
        return Response::plastic;
      }

    const double pressure = returned.pressure;
    const double factor   = trial.deviator > 0 ? returned.deviator / trial.deviator : 0;
    const double mean     = (strain[0] + strain[1] + strain[2]) / 3;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double elastic_deviator = factor * (strain[i] - mean);
        strain[i]                     = volume_strain / 3 + elastic_deviator;
        stress[i]                     = -pressure + 2 * parameters.shear_modulus * elastic_deviator;
      }
    internal_variables[0] = std::exp(returned.log_pressure - returned.log_ratio);
    internal_variables[1] += (trial.deviator - returned.deviator) / (3 * parameters.shear_modulus);
    report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, pressure * inverse_swelling_index);
    return Response::plastic;
  }
} // namespace scree
