// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_nor_sand_return_h
#define scree_materials_laws_nor_sand_return_h

#include <scree/materials/laws/nor_sand.h>

namespace scree
{
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number
  NorSand::log_limit(const Number &log_image, const Number &volume, Number &derivative) const
  {
    constexpr double smallest_argument = 0.15; // Below, the limit pressure runs away for very dense sand.

    const Number state = volume - parameters.critical_state_specific_volume +
                         parameters.compression_index * (log_image - log_reference_pressure);
    if (exponent == 0) // the limit N -> 0
      {
        const double factor =
            parameters.dilatancy_multiplier * (1 - parameters.potential_constant) / parameters.critical_stress_ratio;
        derivative = simd::broadcast<Number>(factor * parameters.compression_index);
        return factor * state;
      }
    const Number argument = 1. - limit_factor * state;
    const Number used     = simd::max<Number>(argument, simd::broadcast<Number>(smallest_argument));
    derivative            = simd::select<Number>(argument > smallest_argument,
                                      limit_factor * parameters.compression_index * inverse_exponent / used,
                                      simd::broadcast<Number>(0.));
    return -simd::log<Number>(used) * inverse_exponent;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline NorSand::Residual<Number>
  NorSand::residual(const Trial<Number> &trial, const Number &multiplier, const Number &log_ratio) const
  {
    const double M = parameters.critical_stress_ratio, h = parameters.hardening_coefficient;
    const Number E = exponent > 0 ? simd::exp<Number>(exponent * log_ratio) : simd::broadcast<Number>(1.);
    Number eta     = M * (1. - log_ratio);
    if (exponent > 0)
      eta = M / parameters.yield_constant * (1. - (1. - parameters.yield_constant) * E);
    const Number eta_ratio    = -M * E; // d eta/dr
    const Number D            = dilatancy(eta);
    const Number D_ratio      = eta_ratio * dilatancy_factor;
    const Number log_pressure = trial.log_pressure + multiplier * D * inverse_swelling_index;

    const Number log_pressure_gamma = D * inverse_swelling_index;
    const Number log_pressure_ratio = multiplier * D_ratio * inverse_swelling_index;
    const Number log_image_ratio    = log_pressure_ratio - 1.;

    const Number compliance     = simd::exp<Number>(-log_pressure);
    const Number deviator_slope = 3 * parameters.shear_modulus * compliance;
    const Number deviator_ratio = trial.deviator * compliance - deviator_slope * multiplier; // q/P

    // Pi (1 + h gamma) = Pi_n + h gamma Pi*, over P.
    Number limit_slope;
    const Number limit = h * simd::exp<Number>(log_limit<Number>(log_pressure - log_ratio, trial.volume, limit_slope));
    const Number old   = trial.image * compliance;
    const Number hardening   = 1. + h * multiplier;
    const Number sum         = old + multiplier * limit;
    const Number inverse_sum = 1. / sum;

    Residual<Number> r;
    r.deviator_ratio = trial.deviator * compliance;
    r.yield          = lode_factor * deviator_ratio - eta;
    r.yield_gamma    = -lode_factor * (deviator_slope + deviator_ratio * log_pressure_gamma);
    r.yield_ratio    = -lode_factor * deviator_ratio * log_pressure_ratio - eta_ratio;
    r.image          = simd::log<Number>(hardening * inverse_sum) - log_ratio;
    r.image_gamma =
        h / hardening - (limit + (multiplier * limit * limit_slope - old) * log_pressure_gamma) * inverse_sum;
    r.image_ratio = -1. - (multiplier * limit * limit_slope * log_image_ratio - old * log_pressure_ratio) * inverse_sum;
    return r;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline NorSand::Residual<Number> NorSand::first_residual(const Trial<Number> &trial,
                                                                                 const Number &log_ratio) const
  {
    const Number compliance = 1. / trial.pressure;
    const Number D_slope    = dilatancy(trial.stress_ratio) * inverse_swelling_index;
    Number limit_slope;
    const Number limit = log_limit(trial.log_image, trial.volume, limit_slope);

    Residual<Number> r;
    r.deviator_ratio = trial.deviator * compliance;
    r.yield          = lode_factor * r.deviator_ratio - trial.stress_ratio;
    r.yield_gamma    = -lode_factor * (3 * parameters.shear_modulus * compliance + r.deviator_ratio * D_slope);
    r.yield_ratio    = parameters.critical_stress_ratio - parameters.yield_constant * trial.stress_ratio;
    if (parameters.yield_constant > 0) // M exp(r N/(1-N)), from eta
      r.yield_ratio *= 1. / (1. - parameters.yield_constant);
    r.image       = simd::broadcast<Number>(0.);
    r.image_gamma = parameters.hardening_coefficient * (1. - simd::exp<Number>(log_ratio + limit)) + D_slope;
    r.image_ratio = simd::broadcast<Number>(-1.);
    return r;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline NorSand::NewtonStep<Number> NorSand::newton_step(const Residual<Number> &now,
                                                                                const Number &multiplier,
                                                                                const Number &log_ratio,
                                                                                const Number &largest_multiplier) const
  {
    constexpr double largest_change_of_ratio = 1;
    constexpr double largest_part_of_the_way = 0.9; // to a bound
    const Number one                         = simd::broadcast<Number>(1.);

    const Number inverse_determinant = 1. / (now.yield_gamma * now.image_ratio - now.yield_ratio * now.image_gamma);
    NewtonStep<Number> step;
    step.multiplier = (now.yield_ratio * now.image - now.image_ratio * now.yield) * inverse_determinant;
    step.log_ratio  = (now.image_gamma * now.yield - now.yield_gamma * now.image) * inverse_determinant;
    step.part       = one;

    // A branch, as it is nearly always taken: minima would hold up the next residual.
    const Number room  = simd::select<Number>(step.multiplier > 0., largest_multiplier - multiplier, multiplier);
    const Number ahead = largest_log_ratio - log_ratio;
    const auto is_full = (simd::abs<Number>(step.log_ratio) <= largest_change_of_ratio) &
                         (step.log_ratio <= largest_part_of_the_way * ahead) &
                         (simd::abs<Number>(step.multiplier) <= largest_part_of_the_way * room);
    if (simd::any(!is_full))
      {
        const Number to_bound = simd::select<Number>(step.log_ratio > 0., ahead / step.log_ratio, 2. * one);
        const Number part     = simd::min<Number>(
            simd::min<Number>(one, largest_change_of_ratio / simd::abs<Number>(step.log_ratio)),
            largest_part_of_the_way * simd::min<Number>(room / simd::abs<Number>(step.multiplier), to_bound));
        step.part = simd::select<Number>(is_full, one, part);
      }
    return step;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline NorSand::Residual<Number> NorSand::residual_after(NewtonStep<Number> &step,
                                                                                 const Trial<Number> &trial,
                                                                                 const Number &multiplier,
                                                                                 const Number &log_ratio,
                                                                                 const Residual<Number> &now,
                                                                                 simd::Mask<Number> &todo) const
  {
    constexpr unsigned int largest_number_of_halvings = 6;

    const Number merit = now.yield * now.yield + now.image * now.image;
    for (unsigned int halving = 0;; ++halving)
      {
        const Residual<Number> next =
            residual<Number>(trial, multiplier + step.part * step.multiplier, log_ratio + step.part * step.log_ratio);
        const simd::Mask<Number> falls = next.yield * next.yield + next.image * next.image < merit;
        if (halving == largest_number_of_halvings)
          todo = todo & falls;
        if (!simd::any(todo & !falls))
          return next;
        step.part = simd::select<Number>(falls, step.part, 0.5 * step.part);
      }
  }


  template <typename Number>
  __attribute__((noinline)) simd::Mask<Number>
  NorSand::newton(const Trial<Number> &trial, simd::Mask<Number> todo, Returned<Number> &returned) const
  {
    constexpr unsigned int largest_number_of_iterations = 14;
    constexpr double tolerance                          = 1e-7; // before the last step, which squares the residual

    const Number largest_multiplier = trial.deviator * (1. / (3 * parameters.shear_modulus));
    const Number bound              = simd::broadcast<Number>(largest_log_ratio);
    Number multiplier               = simd::broadcast<Number>(0.);
    Number log_ratio                = simd::min<Number>(trial.log_pressure - trial.log_image, bound);
    Residual<Number> now            = first_residual(trial, log_ratio);
    const auto is_vertex            = todo & !(log_ratio < largest_log_ratio);
    if (simd::any(is_vertex))
      {
        const Residual<Number> vertex = residual(trial, multiplier, log_ratio);
        for (auto member : { &Residual<Number>::deviator_ratio,
                             &Residual<Number>::yield,
                             &Residual<Number>::yield_gamma,
                             &Residual<Number>::yield_ratio,
                             &Residual<Number>::image,
                             &Residual<Number>::image_gamma,
                             &Residual<Number>::image_ratio })
          now.*member = simd::select<Number>(is_vertex, vertex.*member, now.*member);
      }

    simd::Mask<Number> converged = todo & !todo;
    for (unsigned int i = 0; i < largest_number_of_iterations; ++i)
      {
        NewtonStep<Number> step = newton_step(now, multiplier, log_ratio, largest_multiplier);
        const auto is_last      = todo & (step.part == 1.) &
                             (simd::abs<Number>(now.yield) <= tolerance * (1. + now.deviator_ratio)) &
                             (simd::abs<Number>(now.image) <= tolerance);
        converged  = converged | is_last;
        multiplier = simd::select<Number>(is_last, multiplier + step.multiplier, multiplier);
        log_ratio  = simd::select<Number>(is_last, log_ratio + step.log_ratio, log_ratio);
        todo       = todo & !is_last;
        if (!simd::any(todo))
          break;
        now        = residual_after(step, trial, multiplier, log_ratio, now, todo);
        multiplier = simd::select<Number>(todo, multiplier + step.part * step.multiplier, multiplier);
        log_ratio  = simd::select<Number>(todo, log_ratio + step.part * step.log_ratio, log_ratio);
      }
    // P from the flow rule, q from the yield surface: q_tr - 3 G gamma loses digits where gamma is large.
    const Number eta      = stress_ratio<Number>(log_ratio);
    returned.log_ratio    = log_ratio;
    returned.log_pressure = trial.log_pressure + multiplier * dilatancy(eta) * inverse_swelling_index;
    returned.pressure     = simd::exp<Number>(returned.log_pressure);
    returned.deviator     = simd::min<Number>(returned.pressure * eta * (1. / lode_factor), trial.deviator);
    return converged;
  }


  template <typename Number>
  Number NorSand::image_of_separated(const Number &volume) const
  {
    Number derivative;
    const Number log_pressure = simd::broadcast<Number>(log_minimum_pressure);
    return simd::exp<Number>(log_minimum_pressure + log_limit(log_pressure, volume, derivative));
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline InvariantReturn<Number>
  NorSand::finish(const Trial<Number> &trial, const Returned<Number> &returned, Number *internal_variables) const
  {
    const Number zero = simd::broadcast<Number>(0.);
    InvariantReturn<Number> result;
    result.volume_strain   = (log_pressure_of(zero) - returned.log_pressure) * parameters.swelling_index;
    result.is_separated    = returned.log_pressure < log_minimum_pressure;
    result.deviator_factor = simd::select<Number>(trial.deviator > 0., returned.deviator / trial.deviator, zero);
    result.mean_stress     = -returned.pressure;
    Number image           = simd::exp<Number>(returned.log_pressure - returned.log_ratio);
    Number plastic_shear   = (trial.deviator - returned.deviator) * (1. / (3 * parameters.shear_modulus));
    if (simd::any(result.is_separated))
      {
        result.deviator_factor = simd::select<Number>(result.is_separated, zero, result.deviator_factor);
        result.mean_stress     = simd::select<Number>(result.is_separated, zero, result.mean_stress);
        image                  = simd::select<Number>(result.is_separated, image_of_separated(trial.volume), image);
        plastic_shear          = simd::select<Number>(result.is_separated, zero, plastic_shear);
      }
    internal_variables[0] = image;
    internal_variables[1] += plastic_shear;
    return result;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline simd::Mask<Number> NorSand::return_to_surface(const Trial<Number> &trial,
                                                                             const simd::Mask<Number> &todo,
                                                                             Number *internal_variables,
                                                                             InvariantReturn<Number> &result) const
  {
    const simd::Mask<Number> is_apart = !(trial.log_pressure >= log_minimum_pressure);
    Trial<Number> bearing             = trial;
    if (simd::any(is_apart)) // so that the numbers of these lanes stay within bounds
      {
        bearing.log_pressure =
            simd::select<Number>(is_apart, simd::broadcast<Number>(log_minimum_pressure), trial.log_pressure);
        bearing.pressure =
            simd::select<Number>(is_apart, simd::broadcast<Number>(parameters.minimum_pressure), trial.pressure);
      }
    Returned<Number> returned;
    const simd::Mask<Number> converged = newton<Number>(bearing, todo & !is_apart, returned);
    returned.log_pressure              = simd::select<Number>(is_apart, trial.log_pressure, returned.log_pressure);

    result = finish(trial, returned, internal_variables);
    return converged | (todo & is_apart);
  }
} // namespace scree

#endif
