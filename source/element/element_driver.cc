// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/element/element_driver.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/symmetric_tensor.h>

#include <iomanip>

using namespace dealii;

namespace scree
{
  using Path = ElementParameters::Path;

  double ElementDriver::State::mean_effective_stress() const
  {
    return scree::mean_effective_stress(stress.data());
  }


  double ElementDriver::State::deviatoric_stress() const
  {
    return scree::deviatoric_stress<3>(stress.data());
  }


  double ElementDriver::State::stress_ratio() const
  {
    return scree::stress_ratio<3>(stress.data());
  }


  double ElementDriver::State::mobilised_ratio() const
  {
    return stress[1] < 0 ? stress[3] / -stress[1] : 0;
  }


  ElementDriver::State ElementDriver::start() const
  {
    State state;
    state.internal_variables.resize(material->internal_quantities.size());
    PlaceVariables<3>(material->place_variables, parameters.material.path(""))
        .set(Point<3>(), 0., state.internal_variables.data());
    std::array<double, 6> wanted{};
    set_k0_components(parameters.confining_pressure, parameters.K0, /* axis */ 1, wanted.data());
    material->initialise(
        wanted.data(), state.left_cauchy_green.data(), state.stress.data(), state.internal_variables.data());
    return state;
  }


  ElementDriver::State ElementDriver::advance(const State &state, const double stretch, UpdateReport &report) const
  {
    const double vertical    = std::exp(-strain_step);
    Tensor<2, 3> increment   = unit_symmetric_tensor<3>();
    constexpr unsigned int x = 0, y = 1, z = 2;
    switch (path)
      {
      case Path::drained_triaxial:
        increment[y][y] = vertical;
        increment[x][x] = increment[z][z] = stretch;
        break;
      case Path::undrained_triaxial:
        increment[y][y] = vertical;
        increment[x][x] = increment[z][z] = 1 / std::sqrt(vertical);
        break;
      case Path::isotropic_compression:
        increment *= vertical;
        break;
      case Path::oedometer:
        increment[y][y] = vertical;
        break;
      case Path::simple_shear:
        increment[x][y] = strain_step;
        increment[y][y] = stretch;
        break;
      }

    State next = state;
    next.strain += strain_step;
    next.volume_ratio *= determinant(increment);
    constexpr double one = 1;
    material->update({ 1, 0, next.left_cauchy_green.data(), next.stress.data(), next.internal_variables.data() },
                     { &increment[0][0], &one, &next.volume_ratio, &one },
                     report);
    return next;
  }


  double ElementDriver::held_stress_error(const State &state) const
  {
    const double held = path == Path::simple_shear ? state.stress[1] : state.stress[0] / parameters.K0;
    return 1 + held / parameters.confining_pressure;
  }


  double ElementDriver::find_stretch(const State &state, const double guess) const
  {
    constexpr double tolerance                          = 1e-10;
    constexpr unsigned int largest_number_of_iterations = 50;

    UpdateReport ignored;
    double before = guess, now = guess + 1e-3 * strain_step;
    double error_before = held_stress_error(advance(state, before, ignored));
    for (unsigned int i = 0; i < largest_number_of_iterations; ++i)
      {
        const double error = held_stress_error(advance(state, now, ignored));
        if (std::abs(error) < tolerance)
          return now;
        const double step = -error * (now - before) / (error - error_before);
        before            = now;
        error_before      = error;
        // No more than the strain of the step itself: the stress is exponential in it.
        now += std::clamp(step, -strain_step, strain_step);
      }
    AssertThrow(false,
                ExcMessage("The path \"" + parameters.path_name + "\" cannot hold its stress at strain " +
                           std::to_string(state.strain) + ". Remedy: a larger \"Number of steps\"."));
    return now;
  }


  void ElementDriver::run()
  {
    accepted                  = UpdateReport();
    states                    = { start() };
    const bool stress_is_held = path == Path::drained_triaxial || path == Path::simple_shear;
    double stretch            = 1;
    for (unsigned int step = 0; step < parameters.n_steps; ++step)
      {
        if (stress_is_held)
          stretch = find_stretch(states.back(), stretch);
        states.push_back(advance(states.back(), stretch, accepted));
      }
  }


  void ElementDriver::write_table(std::ostream &out) const
  {
    const std::vector<Quantity> internal_quantities = material->internal_quantities;
    const std::vector<Quantity> derived_quantities  = material->output_quantities;

    out << "strain[-] volume_ratio[-] mean_pressure[Pa] deviator_stress[Pa] stress_ratio[-]";
    for (const std::string component : { "xx", "yy", "zz", "xy", "xz", "yz" })
      out << " stress_" << component << "[Pa]";
    for (const auto &quantities : { internal_quantities, derived_quantities })
      for (const Quantity &quantity : quantities)
        out << ' ' << quantity.name << '[' << quantity.unit << ']';

    out << std::scientific << std::setprecision(9);
    std::vector<double> derived(derived_quantities.size());
    for (const State &state : states)
      {
        out << '\n'
            << state.strain << ' ' << state.volume_ratio << ' ' << state.mean_effective_stress() << ' '
            << state.deviatoric_stress() << ' ' << state.stress_ratio();
        for (const double component : state.stress)
          out << ' ' << component;
        for (const double variable : state.internal_variables)
          out << ' ' << variable;
        material->output(
            state.left_cauchy_green.data(), state.internal_variables.data(), state.volume_ratio, derived.data());
        for (const double value : derived)
          out << ' ' << value;
      }
    out << '\n';
  }


  void ElementDriver::print_summary(std::ostream &out) const
  {
    const auto line = [&](const std::string &name, const double value) {
      out << std::left << std::setw(32) << name << std::right << std::fixed << std::setprecision(6) << value << '\n';
    };
    double peak_ratio = 0, peak_mobilised = 0;
    for (const State &state : states)
      {
        peak_ratio     = std::max(peak_ratio, state.stress_ratio());
        peak_mobilised = std::max(peak_mobilised, state.mobilised_ratio());
      }

    const State &last = states.back();
    out << parameters.path_name << ", " << parameters.material.law << '\n';
    line("strain [-]", last.strain);
    line("peak q/P [-]", peak_ratio);
    line("q/P [-]", last.stress_ratio());
    if (path == Path::simple_shear)
      {
        line("peak shear/vertical stress [-]", peak_mobilised);
        line("shear/vertical stress [-]", last.mobilised_ratio());
      }
    line("P [kPa]", last.mean_effective_stress() / 1000);
    line("J [-]", last.volume_ratio);

    const std::vector<Quantity> quantities = material->output_quantities;
    std::vector<double> derived(quantities.size());
    material->output(last.left_cauchy_green.data(), last.internal_variables.data(), last.volume_ratio, derived.data());
    for (unsigned int i = 0; i < derived.size(); ++i)
      line(quantities[i].name + " [" + quantities[i].unit + "]", derived[i]);
    out << "sub-steps " << accepted.n_substeps << ", fallbacks " << accepted.n_fallbacks << ", vertices "
        << accepted.n_vertices << ", separated " << accepted.n_separated << ", unresolved " << accepted.n_unresolved
        << std::endl;
  }
} // namespace scree
