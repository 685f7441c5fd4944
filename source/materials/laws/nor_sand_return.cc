// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/materials/laws/nor_sand_return.h>

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


  double NorSand::image_residual(const Trial<double> &trial, const double multiplier, const double log_ratio) const
  {
    const double log_pressure =
        trial.log_pressure + multiplier * dilatancy(stress_ratio(log_ratio)) * inverse_swelling_index;
    const double hardening = parameters.hardening_coefficient * multiplier;
    double derivative;
    const double log_limit_pressure = log_pressure + log_limit(log_pressure - log_ratio, trial.volume, derivative);
    return log_pressure - log_ratio + std::log1p(hardening) -
           log_sum(trial.log_image, std::log(hardening) + log_limit_pressure);
  }


  double NorSand::ratio_on_yield(const Trial<double> &trial, const double log_deviator, const double multiplier) const
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


  NorSand::Returned<double> NorSand::search(const Trial<double> &trial, UpdateReport &report) const
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


  NorSand::Returned<double> NorSand::search_vertex(const Trial<double> &trial, UpdateReport &report) const
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
    const double log_pressure = trial.log_pressure + multiplier * dilatancy(0.) * inverse_swelling_index;
    return { log_pressure, std::exp(log_pressure), largest_log_ratio, 0 };
  }


  Response NorSand::plastic_return(const Trial<double> &trial,
                                   PrincipalValues &strain,
                                   double *internal_variables,
                                   PrincipalValues &stress,
                                   UpdateReport &report) const
  {
    Returned<double> returned{ trial.log_pressure, trial.pressure, 0, 0 };
    if (trial.log_pressure >= log_minimum_pressure && !newton(trial, true, returned))
      returned = search(trial, report);

    const InvariantReturn<double> result = finish(trial, returned, internal_variables);
    report.n_separated += result.is_separated;
    const double mean = (strain[0] + strain[1] + strain[2]) / 3;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double elastic_deviator = result.deviator_factor * (strain[i] - mean);
        strain[i]                     = result.volume_strain / 3 + elastic_deviator;
        stress[i]                     = result.mean_stress + 2 * parameters.shear_modulus * elastic_deviator;
      }
    report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, bulk_modulus_at(result.mean_stress));
    return Response::plastic;
  }
} // namespace scree
