// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_jefferies_been_return_h
#define scree_materials_jefferies_been_return_h

#include <scree/materials/jefferies_been/law.h>

namespace scree
{
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline JefferiesBeen::Image<Number>
  JefferiesBeen::image(const Number &void_ratio, const Number &log_image, const Number &lode_ratio) const
  {
    constexpr double rounding   = 1e-3; // of |psi|
    constexpr double least_part = 0.2;  // of M that is left to M_i
    // Without the first bound no stress ratio would be left to very loose sand at the cap, where r = -L.
    constexpr double least_limit = -0.9, largest_limit = 3;
    const double M = parameters.critical_stress_ratio, coupling = parameters.volumetric_coupling * chi / M;

    Number slope;
    Image<Number> image;
    image.state       = line.state(void_ratio, log_image, slope);
    const Number size = simd::sqrt<Number>(image.state * image.state + rounding * rounding);
    const Number part = 1. - coupling * (size - rounding), zero = simd::broadcast<Number>(0.);
    const Number used  = simd::max<Number>(part, simd::broadcast<Number>(least_part));
    const Number part_ = simd::select<Number>(part > least_part, -coupling * image.state * slope / size, zero);
    image.ratio        = lode_ratio * used;
    image.ratio_       = lode_ratio * part_;

    const Number inverse = 1. / used, limit = (-chi / M) * image.state * inverse;
    image.limit  = simd::min<Number>(simd::max<Number>(limit, simd::broadcast<Number>(least_limit)),
                                    simd::broadcast<Number>(largest_limit));
    image.limit_ = simd::select<Number>(limit == image.limit, ((-chi / M) * slope - limit * part_) * inverse, zero);
    return image;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number JefferiesBeen::lode_ratio(const PrincipalNumbers<Number> &s,
                                                                const Number &square) const
  {
    // With x = sin(3 theta), 1 in triaxial compression, cos(3 theta/2 + pi/4) = sqrt((1 - x)/2). There the root would
    // make 1e-8 of rounding.
    constexpr double rounding = 1e-12;
    const double M            = parameters.critical_stress_ratio;
    const Number inverse      = 1. / simd::sqrt<Number>(square + 1e-60);
    const Number x            = -7.3484692283495345 * (s[0] * inverse) * (s[1] * inverse) * (s[2] * inverse);
    const Number half         = simd::max<Number>(0.5 - rounding - 0.5 * x, simd::broadcast<Number>(0.));
    const Number part         = simd::select<Number>(square > 1e-30, half, simd::broadcast<Number>(0.));
    return M - M * M / (3. + M) * simd::sqrt<Number>(part);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline JefferiesBeen::Trial<Number> JefferiesBeen::trial(const PrincipalNumbers<Number> &strain,
                                                                                 const Number &volume_ratio,
                                                                                 const Number *internal_variables) const
  {
    constexpr double least_hardening = 10; // H of very loose sand

    Trial<Number> trial;
    trial.volume_strain = -(strain[0] + strain[1] + strain[2]);
    Number square       = simd::broadcast<Number>(0.);
    for (unsigned int i = 0; i < 3; ++i)
      {
        trial.deviator[i] = strain[i] + trial.volume_strain * (1. / 3.);
        square += trial.deviator[i] * trial.deviator[i];
      }
    trial.shear_strain = simd::sqrt<Number>(2. / 3. * square);
    trial.lode_ratio   = lode_ratio(trial.deviator, square);
    trial.void_ratio   = (1. + parameters.initial_void_ratio) * volume_ratio - 1.;
    trial.log_image    = simd::log<Number>(internal_variables[0]);

    const Number least = simd::broadcast<Number>(1e-12), X = elastic.opening(trial.volume_strain);
    trial.X            = simd::max<Number>(X, least);
    trial.eta          = 3. * elastic.g * trial.shear_strain / trial.X;
    trial.log_pressure = elastic.log_pressure(trial.X, trial.eta);
    trial.is_apart     = !((X > least) & (trial.log_pressure >= log_minimum_pressure));

    // The cap first where the state is elastic: on a plastic trial state it would depend on the size of the step.
    Image<Number> now         = image(trial.void_ratio, trial.log_image, trial.lode_ratio);
    const auto is_outside     = [&]() { return trial.eta > now.ratio * (1. - trial.log_pressure + trial.log_image); };
    simd::Mask<Number> yields = is_outside();
    const simd::Mask<Number> stays = !(trial.is_apart | yields);
    trial.is_capped                = stays & (trial.log_image > trial.log_pressure + now.limit);
    if (simd::any(trial.is_capped))
      {
        for (unsigned int pass = 0; pass < 2; ++pass) // L is at p_i
          {
            const Number cap = simd::min<Number>(trial.log_image, trial.log_pressure + now.limit);
            trial.log_image  = simd::select<Number>(trial.is_capped, cap, trial.log_image);
            now              = image(trial.void_ratio, trial.log_image, trial.lode_ratio);
          }
        yields = is_outside();
      }
    trial.is_plastic = yields & !trial.is_apart;
    trial.hardening  = simd::max<Number>(parameters.hardening_modulus - parameters.hardening_slope * now.state,
                                        simd::broadcast<Number>(least_hardening)) *
                      trial.lode_ratio * (1. / parameters.critical_stress_ratio);
    return trial;
  }


  template <JefferiesBeen::Hardening hardening, typename Number>
  DEAL_II_ALWAYS_INLINE inline JefferiesBeen::Residual<Number> JefferiesBeen::residual(const Trial<Number> &trial,
                                                                                       const Number &X,
                                                                                       const Number &shear_strain,
                                                                                       const Root<Number> &root) const
  {
    const Number &r = root.log_ratio, log_image = root.log_pressure - r;
    const Image<Number> i = image(trial.void_ratio, log_image, trial.lode_ratio);
    const double n = elastic.n, to_shear = 1. / (3. * elastic.g);

    // Of the yield surface: eta, elastic X and e_s, with derivatives in ln p and r.
    const Number rest = 1. - r, eta = i.ratio * rest, eta_p = i.ratio_ * rest, eta_r = -1. * eta_p - i.ratio;
    const Number square = 1. + elastic.a * eta * eta;
    const Number Y =
        simd::exp<Number>((1. - n) * (root.log_pressure - elastic.log_p_r) - (0.5 * n) * simd::log<Number>(square));
    const Number Y_eta = -n * elastic.a * eta / square; // d ln Y/d eta
    const Number Y_p = Y * ((1. - n) + Y_eta * eta_p), Y_r = Y * (Y_eta * eta_r);
    const Number e_s = to_shear * (eta * Y), e_s_p = to_shear * (eta_p * Y + eta * Y_p),
                 e_s_r = to_shear * (eta_r * Y + eta * Y_r);
    const Number gamma = shear_strain - e_s, D = i.ratio * r, D_p = i.ratio_ * r, D_r = i.ratio - D_p;

    // X - k_n gamma D = Y, over Y
    Residual<Number> result;
    const Number inverse = 1. / Y, part = (X - elastic.k_n * (gamma * D)) * inverse;
    result.multiplier = gamma;
    result.volume     = part - 1.;
    result.volume_p   = inverse * (-elastic.k_n * (gamma * D_p - e_s_p * D) - part * Y_p);
    result.volume_r   = inverse * (-elastic.k_n * (gamma * D_r - e_s_r * D) - part * Y_r);
    if constexpr (hardening == Hardening::cap)
      {
        result.image   = r + i.limit;
        result.image_p = i.limit_;
        result.image_r = 1. - i.limit_;
      }
    else
      {
        const Number B = simd::exp<Number>(r), A = B * B * simd::exp<Number>(i.limit), f = A - B;
        const Number f_p = A * i.limit_, f_r = A * (2. - i.limit_) - B, h = trial.hardening;
        result.image   = log_image - trial.log_image - h * f * gamma;
        result.image_p = 1. - h * (f_p * gamma - f * e_s_p);
        result.image_r = -1. - h * (f_r * gamma - f * e_s_r);
      }
    return result;
  }


  template <JefferiesBeen::Hardening hardening, typename Number>
  __attribute__((noinline)) simd::Mask<Number>
  JefferiesBeen::newton(const Trial<Number> &trial, simd::Mask<Number> todo, Root<Number> &root) const
  {
    constexpr unsigned int largest_number_of_iterations = 12;
    constexpr double tolerance                          = 1e-16; // of the squares before the last step
    constexpr double largest_part_of_the_way            = 0.9;   // to the vertex
    const Number one                                    = simd::broadcast<Number>(1.);

    simd::Mask<Number> converged = todo & !todo;
    for (unsigned int iteration = 0; iteration < largest_number_of_iterations; ++iteration)
      {
        const Residual<Number> now = residual<hardening>(trial, trial.X, trial.shear_strain, root);
        const Number inverse       = 1. / (now.volume_p * now.image_r - now.volume_r * now.image_p);
        const Number step_p        = (now.volume_r * now.image - now.image_r * now.volume) * inverse;
        const Number step_r        = (now.image_p * now.volume - now.volume_p * now.image) * inverse;
        Number part =
            1. / simd::max<Number>(one, simd::max<Number>(simd::abs<Number>(step_p), simd::abs<Number>(step_r)));
        const Number room = largest_part_of_the_way * (1. - root.log_ratio);
        part              = simd::select<Number>(part * step_r > room, room / step_r, part);

        const auto is_last = todo & (part == 1.) & (now.multiplier >= -1e-12) &
                             (now.volume * now.volume + now.image * now.image < tolerance);
        root.log_pressure = simd::select<Number>(todo, root.log_pressure + part * step_p, root.log_pressure);
        root.log_ratio    = simd::select<Number>(todo, root.log_ratio + part * step_r, root.log_ratio);
        converged         = converged | is_last;
        todo              = todo & !is_last & (simd::abs<Number>(step_p) < 1e3);
        if (!simd::any(todo))
          break;
      }
    constexpr double largest_log_pressure = 60;
    return converged & (simd::abs<Number>(root.log_pressure) < largest_log_pressure) & (root.log_ratio <= 1.);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline simd::Mask<Number> JefferiesBeen::is_beyond_cap(const Trial<Number> &trial,
                                                                               const Root<Number> &root) const
  {
    const Image<Number> i = image<Number>(trial.void_ratio, root.log_pressure - root.log_ratio, trial.lode_ratio);
    return root.log_ratio + i.limit < -1e-12;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline VolumeResponse<Number> JefferiesBeen::finish(const Trial<Number> &trial,
                                                                            const Root<Number> &root,
                                                                            PrincipalNumbers<Number> &strain,
                                                                            Number *internal_variables,
                                                                            PrincipalNumbers<Number> &stress) const
  {
    const Number zero = simd::broadcast<Number>(0.);
    Number log_p = trial.log_pressure, eta = trial.eta, volume = trial.volume_strain, shear = trial.shear_strain;
    Number image_pressure               = internal_variables[0];
    simd::Mask<Number> is_apart         = trial.is_apart;
    const simd::Mask<Number> is_plastic = trial.is_plastic;
    if (simd::any(is_plastic | trial.is_capped))
      {
        const Number log_image = root.log_pressure - root.log_ratio;
        const Image<Number> i  = image(trial.void_ratio, log_image, trial.lode_ratio);
        log_p                  = simd::select<Number>(is_plastic, root.log_pressure, log_p);
        eta            = simd::select<Number>(is_plastic, i.ratio * simd::max<Number>(1. - root.log_ratio, zero), eta);
        const Number Y = elastic.opening_at(log_p, eta);
        volume         = simd::select<Number>(is_plastic, elastic.volume_strain(Y), volume);
        shear          = simd::select<Number>(is_plastic, elastic.shear_strain(Y, eta), shear);
        is_apart       = is_apart | (is_plastic & (log_p < log_minimum_pressure));
        image_pressure =
            simd::select<Number>(is_plastic | trial.is_capped,
                                 simd::exp<Number>(simd::select<Number>(is_plastic, log_image, trial.log_image)),
                                 image_pressure);
      }
    Number p = simd::exp<Number>(log_p), plastic_shear = simd::max<Number>(trial.shear_strain - shear, zero);
    if (simd::any(is_apart))
      {
        const Number least = simd::broadcast<Number>(log_minimum_pressure);
        const Image<Number> i =
            image<Number>(trial.void_ratio, least, simd::broadcast<Number>(parameters.critical_stress_ratio));
        image_pressure =
            simd::select<Number>(is_apart, simd::exp<Number>(log_minimum_pressure + i.limit), image_pressure);
        p             = simd::select<Number>(is_apart, zero, p);
        shear         = simd::select<Number>(is_apart, zero, shear);
        plastic_shear = simd::select<Number>(is_apart, zero, plastic_shear);
      }
    internal_variables[0] = image_pressure;
    internal_variables[1] += plastic_shear;

    const Number inverse = 1. / simd::max<Number>(trial.shear_strain, simd::broadcast<Number>(1e-300));
    const Number factor = shear * inverse, slope = (2. / 3.) * p * eta * inverse;
    const auto changes = is_plastic | is_apart;
    for (unsigned int i = 0; i < 3; ++i)
      {
        strain[i] = simd::select<Number>(changes, factor * trial.deviator[i] - volume * (1. / 3.), strain[i]);
        stress[i] = slope * trial.deviator[i] - p;
      }
    VolumeResponse<Number> response;
    response.is_plastic   = changes | trial.is_capped;
    response.is_separated = is_apart;
    response.is_vertex = response.is_unresolved = response.is_left = is_apart & !is_apart;
    response.bulk_modulus =
        simd::select<Number>(is_apart, zero, elastic.wave_modulus(log_p, eta) - 4. / 3. * constant_shear_modulus);
    return response;
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline VolumeResponse<Number> JefferiesBeen::respond(PrincipalNumbers<Number> &strain,
                                                                             const Number &volume_ratio,
                                                                             Number *internal_variables,
                                                                             PrincipalNumbers<Number> &stress) const
  {
    constexpr double largest_first_ratio = 0.9; // towards the vertex
    const Trial<Number> state            = trial(strain, volume_ratio, internal_variables);
    Root<Number> root{ state.log_pressure,
                       simd::min<Number>(state.log_pressure - state.log_image,
                                         simd::broadcast<Number>(largest_first_ratio)) };
    simd::Mask<Number> is_served = !state.is_plastic;
    if (simd::any(state.is_plastic))
      {
        simd::Mask<Number> converged    = newton<Hardening::law>(state, state.is_plastic, root);
        const simd::Mask<Number> to_cap = converged & is_beyond_cap(state, root);
        if (simd::any(to_cap))
          converged = converged & (newton<Hardening::cap>(state, to_cap, root) | !to_cap);
        is_served = is_served | converged;
      }
    VolumeResponse<Number> response = finish(state, root, strain, internal_variables, stress);
    response.is_left                = !is_served;
    return response;
  }
} // namespace scree

#endif
