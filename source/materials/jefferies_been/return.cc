// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/materials/jefferies_been/return.h>

namespace scree
{
  namespace
  {
    /// Where `is_low` ends between `low` and `high`.
    template <typename Function>
    double bisect(const Function &is_low, double low, double high)
    {
      constexpr unsigned int largest_number_of_steps = 200;
      for (unsigned int i = 0; i < largest_number_of_steps; ++i)
        {
          const double middle = 0.5 * (low + high);
          if (middle == low || middle == high)
            break;
          (is_low(middle) ? low : high) = middle;
        }
      return 0.5 * (low + high);
    }


    template <typename Residual>
    double square_of(const Residual &residual)
    {
      return residual.volume * residual.volume + residual.image * residual.image;
    }
  } // namespace


  template <JefferiesBeen::Hardening hardening>
  bool JefferiesBeen::careful_newton(const Trial<double> &trial,
                                     const double X,
                                     const double shear_strain,
                                     Root<double> &root) const
  {
    constexpr unsigned int largest_number_of_iterations = 25, largest_number_of_halvings = 8;
    constexpr double tolerance = 1e-16, largest_part_of_the_way = 0.9;

    Residual<double> now = residual<hardening>(trial, X, shear_strain, root);
    for (unsigned int iteration = 0; iteration < largest_number_of_iterations; ++iteration)
      {
        const double inverse = 1. / (now.volume_p * now.image_r - now.volume_r * now.image_p);
        const double step_p  = (now.volume_r * now.image - now.image_r * now.volume) * inverse;
        const double step_r  = (now.image_p * now.volume - now.volume_p * now.image) * inverse;
        if (!std::isfinite(step_p) || !std::isfinite(step_r))
          return false;
        double part       = 1. / std::max({ 1., std::abs(step_p), std::abs(step_r) });
        const double room = largest_part_of_the_way * (1. - root.log_ratio);
        if (part * step_r > room)
          part = room / step_r;

        const auto after = [&]() {
          return Root<double>{ root.log_pressure + part * step_p, root.log_ratio + part * step_r };
        };
        const double square = square_of(now);
        if (square < tolerance && part == 1.)
          {
            root = after();
            return now.multiplier >= -1e-12 && root.log_ratio <= 1.;
          }
        Residual<double> next = residual<hardening>(trial, X, shear_strain, after());
        for (unsigned int halving = 0; !(square_of(next) < square); ++halving)
          {
            if (halving == largest_number_of_halvings)
              return false;
            part *= 0.5;
            next = residual<hardening>(trial, X, shear_strain, after());
          }
        root = after();
        now  = next;
      }
    return false;
  }


  bool JefferiesBeen::find_vertex(const Trial<double> &trial, Root<double> &root) const
  {
    // q = 0 and r = 1: the multiplier is free, and exceeds the change of elastic shear strain.
    double multiplier    = 0;
    const auto hardening = [&](const double log_pressure) {
      const Image<double> i = image(trial.void_ratio, log_pressure - 1., trial.lode_ratio);
      multiplier            = (trial.X - elastic.opening_at(log_pressure, 0.)) / (elastic.k_n * i.ratio);
      return log_pressure - 1. - trial.log_image -
             trial.hardening * (std::exp(2. + i.limit) - std::exp(1.)) * multiplier;
    };
    const double isotropic = elastic.log_pressure(trial.X, 0.);
    const double low = std::min(trial.log_image + 1., isotropic) - 1e-9, high = isotropic + 1e-9;
    if (!(hardening(low) <= 0. && hardening(high) >= 0.))
      return false;
    root = { bisect([&](const double log_pressure) { return hardening(log_pressure) <= 0.; }, low, high), 1. };
    hardening(root.log_pressure);
    return multiplier >= trial.shear_strain * (1. - 1e-9);
  }


  bool JefferiesBeen::continue_to(const Trial<double> &trial, Root<double> &root) const
  {
    // From the yield surface at the trial pressure, whose root is known.
    constexpr unsigned int most_parts = 256;
    const Image<double> old           = image(trial.void_ratio, trial.log_image, trial.lode_ratio);
    const double r                    = std::min(trial.log_pressure - trial.log_image, 0.99);
    const Root<double> start{ trial.log_image + r, r };
    const double eta = old.ratio * (1. - r), X = elastic.opening_at(start.log_pressure, eta);
    const double shear = elastic.shear_strain(X, eta);
    for (unsigned int parts = 4; parts <= most_parts; parts *= 4)
      {
        root       = start;
        bool holds = true;
        for (unsigned int i = 1; i <= parts && holds; ++i)
          {
            const double part = static_cast<double>(i) / parts;
            holds             = careful_newton<Hardening::law>(
                trial, X + part * (trial.X - X), shear + part * (trial.shear_strain - shear), root);
          }
        if (holds)
          return true;
      }
    return false;
  }


  bool JefferiesBeen::search(const Trial<double> &trial, Root<double> &root) const
  {
    // Where the flow rule holds, p_i is above what the hardening law gives without plastic strain, and below it at
    // r = 1, as there is no root at the vertex.
    Residual<double> now;
    const auto on_flow_rule = [&](const double log_ratio) {
      const auto is_low = [&](const double log_pressure) {
        now = residual<Hardening::law, double>(trial, trial.X, trial.shear_strain, { log_pressure, log_ratio });
        return now.volume > 0.;
      };
      return bisect(is_low, trial.log_pressure - 40., trial.log_pressure + 12.);
    };
    const auto is_inside = [&](const double log_ratio) {
      const Image<double> i = image(trial.void_ratio, trial.log_pressure - log_ratio, trial.lode_ratio);
      return i.ratio * (1. - log_ratio) > trial.eta;
    };
    double low = -1.;
    while (!is_inside(low) && low > -1e6)
      low *= 2.;
    low                 = bisect(is_inside, low, 1.);
    const auto is_above = [&](const double log_ratio) {
      on_flow_rule(log_ratio);
      return now.image > 0.;
    };
    root.log_ratio    = bisect(is_above, low, 1.);
    root.log_pressure = on_flow_rule(root.log_ratio);
    now               = residual<Hardening::law>(trial, trial.X, trial.shear_strain, root);
    return std::isfinite(root.log_pressure) && square_of(now) < 1e-12;
  }


  bool JefferiesBeen::search_cap(const Trial<double> &trial, Root<double> &root) const
  {
    // All is explicit in ln p_i. Below the smallest value there is no stress; that is an answer, too.
    const auto at = [&](const double log_image) {
      const Image<double> i = image(trial.void_ratio, log_image, trial.lode_ratio);
      return Root<double>{ log_image - i.limit, -i.limit };
    };
    const auto is_low = [&](const double log_image) {
      return residual<Hardening::cap>(trial, trial.X, trial.shear_strain, at(log_image)).volume > 0.;
    };
    const double low = log_minimum_pressure - 4., high = std::max(trial.log_pressure, trial.log_image) + 12.;
    root = at(is_low(low) ? bisect(is_low, low, high) : low);
    return std::isfinite(root.log_pressure);
  }


  JefferiesBeen::Root<double> JefferiesBeen::find(const Trial<double> &trial, UpdateReport &report) const
  {
    ++report.n_fallbacks;
    Root<double> root{ trial.log_pressure, std::min(trial.log_pressure - trial.log_image, 0.9) };
    const Root<double> start = root;
    if (!careful_newton<Hardening::law>(trial, trial.X, trial.shear_strain, root))
      {
        if (find_vertex(trial, root))
          {
            ++report.n_vertices;
            return root;
          }
        if (!continue_to(trial, root) && !search(trial, root))
          {
            ++report.n_unresolved;
            return start;
          }
      }
    if (!is_beyond_cap(trial, root))
      return root;
    Root<double> on_cap = root;
    if (careful_newton<Hardening::cap>(trial, trial.X, trial.shear_strain, on_cap) || search_cap(trial, on_cap))
      return on_cap;
    ++report.n_unresolved;
    return root;
  }


  Response JefferiesBeen::return_map(PrincipalValues &strain,
                                     double *internal_variables,
                                     const double volume_ratio,
                                     PrincipalValues &stress,
                                     UpdateReport &report) const
  {
    const PrincipalValues strain_before = strain;
    const double variables_before[2]    = { internal_variables[0], internal_variables[1] };
    VolumeResponse<double> response     = respond<double>(strain, volume_ratio, internal_variables, stress);
    if (response.is_left)
      {
        strain                    = strain_before;
        internal_variables[0]     = variables_before[0];
        internal_variables[1]     = variables_before[1];
        const Trial<double> state = trial(strain, volume_ratio, internal_variables);
        response                  = finish(state, find(state, report), strain, internal_variables, stress);
      }
    report.n_separated += response.is_separated;
    report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, response.bulk_modulus);
    return response.is_plastic ? Response::plastic : Response::elastic;
  }
} // namespace scree
