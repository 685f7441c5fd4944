// SPDX-License-Identifier: LGPL-2.1-or-later
// Grains in a liquid: steady shear at fixed pressure against mu(I_m) and phi_eq(I_m); shear at fixed volume; grains
// that part and close; random returns against the equations of the law.
#include "one_point.h"

#include <scree/materials/laws/viscoinertial_grains.h>

namespace test_viscoinertial_grains
{
constexpr double grain_density = 2500; // kg/m^3

ViscoinertialGrainsParameters beads(const double initial_fraction, const double viscosity = 0.012)
{
  ViscoinertialGrainsParameters parameters;
  parameters.young_modulus    = 1e6;
  parameters.grain_diameter   = 225e-6;
  parameters.liquid_viscosity = viscosity;
  parameters.initial_fraction = initial_fraction;
  return parameters;
}


/// Friction and solid fraction of steady flow.
struct Steady
{
  Steady(const ViscoinertialGrainsParameters &p, const double rate, const double pressure, const double phi)
  {
    const double viscous = p.liquid_viscosity * rate / pressure;
    const double inertia = rate * p.grain_diameter * std::sqrt(grain_density / pressure);
    number               = std::sqrt(inertia * inertia + 2 * viscous);
    fraction             = p.critical_fraction / (1 + p.fraction_slope * number);
    friction = p.static_friction + (p.rapid_friction - p.static_friction) / (1 + p.reference_number / number) +
               2.5 * phi * viscous / (p.fraction_slope * number);
  }

  double number, fraction, friction;
};


/// A point in plane strain under pressure `p` without shear, at a solid fraction.
struct Grains
{
  Grains(const ViscoinertialGrainsParameters &parameters, const double p)
      : law(parameters)
      , material(law)
      , fraction(parameters.initial_fraction)
  {
    const double strain = -p / (3 * law.bulk_modulus(0));
    for (unsigned int c = 0; c < 6; ++c)
      left_cauchy_green[c] = c < 3 ? std::exp(2 * strain) : 0;
  }

  void update(const Tensor<2, 2> &increment, const double time_step, const double stretch = 1)
  {
    const double one = 1;
    J *= stretch * determinant(increment);
    material.update({ 1, 0, left_cauchy_green, stress, internal },
                    { &increment[0][0], &stretch, &J, &one, 1, time_step, grain_density },
                    report);
  }

  /// A step of simple shear with a change of area.
  void shear(const double gamma, const double area, const double time_step)
  {
    Tensor<2, 2> increment = (1 + area / 2) * unit_symmetric_tensor<2>();
    increment[0][1]        = gamma;
    update(increment, time_step);
  }

  double pressure() const
  {
    return -(stress[0] + stress[1] + stress[2]) / 3;
  }

  double shear_stress() const
  {
    double square = 2 * stress[3] * stress[3];
    for (unsigned int i = 0; i < 3; ++i)
      square += (stress[i] + pressure()) * (stress[i] + pressure());
    return std::sqrt(square / 2);
  }

  double phi() const
  {
    return fraction / J;
  }

  const ViscoinertialGrains law;
  const HenckyMaterial<2, ViscoinertialGrains> material;
  const double fraction;
  double left_cauchy_green[6], stress[6] = {}, internal[1] = {}, J = 1;
  UpdateReport report;
};


/// Shear at fixed pressure from loose and dense to steady flow, over four decades of I_v or I^2.
void test_steady(const double viscosity, const std::string &name)
{
  constexpr double pressure = 100, step_of_shear = 2e-3;
  for (const double initial_fraction : { 0.5, 0.55, 0.6 })
    for (const double number : { 1e-5, 1e-4, 1e-3, 1e-2, 1e-1 })
      {
        const auto parameters = beads(initial_fraction, viscosity);
        const double rate     = viscosity > 0 ? number * pressure / viscosity
                                              : std::sqrt(number * pressure / grain_density) / parameters.grain_diameter;
        Grains grains(parameters, pressure);
        for (unsigned int i = 0; i < 10000; ++i)
          {
            const double missing = (grains.pressure() - pressure) / grains.law.bulk_modulus(0);
            grains.shear(step_of_shear, std::max(-0.01, std::min(0.01, missing)), step_of_shear / rate);
          }
        const Steady steady(parameters, rate, grains.pressure(), grains.phi());
        expect(grains.pressure() / pressure, 1, 0.03, name + ": pressure");
        expect(grains.phi() / steady.fraction, 1, 2e-3, name + ": solid fraction");
        expect(grains.shear_stress() / grains.pressure() / steady.friction, 1, 2e-3, name + ": friction");
      }
}


/// Slow shear at fixed volume: beyond the first strain, the pressure of dense grains grows by c (phi - phi_m) per
/// plastic shear. Loose ones in a liquid lose theirs, but for that of a suspension.
void test_fixed_volume()
{
  constexpr double pressure = 1000, gamma = 1e-5, rate = 0.01;
  constexpr unsigned int first = 200, last = 300;
  const auto dense = beads(0.6, 0);
  Grains grains(dense, pressure);
  double before = 0;
  for (unsigned int i = 0; i < last; ++i)
    {
      if (i == first)
        before = grains.pressure();
      grains.shear(gamma, 0, std::numeric_limits<double>::infinity());
    }
  const double beta = dense.dilatancy * (0.6 - dense.critical_fraction), gain = grains.law.bulk_modulus(0) * beta;
  const double slope = gain / (1 + (dense.static_friction + beta) * gain / grains.law.shear_modulus); // elastic shear
  expect((grains.pressure() - before) / (gamma * (last - first)) / slope, 1, 2e-3, "change of p of dense grains");
  require(before > pressure, "Dense grains lose pressure.");

  for (const double fraction : { 0.5, 0.55, 0.58 })
    {
      const auto loose = beads(fraction);
      Grains suspension(loose, pressure);
      for (unsigned int i = 0; i < 20000; ++i)
        suspension.shear(1e-4, 0, 1e-4 / rate);
      const double factor = loose.fraction_slope * fraction / (loose.critical_fraction - fraction);
      require(suspension.pressure() < pressure, "Loose grains gain pressure.");
      expect(suspension.pressure() / (factor * factor * 2 * loose.liquid_viscosity * rate),
             1,
             1e-3,
             "pressure of suspension");
    }
}


/// Grains that part have no stress; they gain pressure again once they are dense.
void test_parting()
{
  Grains grains(beads(0.6), 100.);
  const auto change = [&](const double volume) {
    grains.update((1 + volume / 3) * unit_symmetric_tensor<2>(), 1e-3, 1 + volume / 3);
  };
  change(0.2);
  for (const double value : grains.stress)
    expect(value, 0, 0, "stress of grains apart");
  expect(grains.report.n_separated, 1, 0, "points apart");
  double last = grains.phi();
  while (grains.pressure() < 1e-3 && grains.phi() < 0.65)
    {
      last = grains.phi();
      change(-1e-4);
    }
  expect(last, beads(0.6).critical_fraction, 1e-4, "solid fraction at contact");
  ViscoinertialGrains loose(beads(0.53));
  PrincipalValues strain, stress;
  expect_refusal(
      [&] {
        loose.initialise({ { -1., -1., -1. } }, strain, stress, grains.internal);
      },
      "carry no stress at rest",
      "stress of loose grains");
}


/// Every return meets the law.
void test_random(const double fraction, RandomNumbers &random)
{
  const auto parameters = beads(fraction);
  const ViscoinertialGrains law(parameters);
  const std::string name = "solid fraction " + std::to_string(fraction);
  const double bulk      = law.bulk_modulus(0);
  unsigned int n_flows   = 0;
  const double factor    = parameters.fraction_slope * fraction / (parameters.critical_fraction - fraction);
  random_returns(
      name,
      law,
      random,
      100000,
      [&](RandomReturn &point) {
        point.time_step = random.log_uniform(1e-7, 1e3);
        return 0.;
      },
      [&](const RandomReturn &point) {
        PrincipalValues deviator = point.stress, trial = point.trial;
        const auto found = take_invariants<double>(deviator), before = take_invariants<double>(trial);
        const double p = -found.volume / 3, tau = std::sqrt(found.square / 2);
        require(p >= 0, name + ": tension");
        if (!point.is_plastic || p == 0)
          return;
        ++n_flows;
        const double gamma    = point.internal[0] * std::sqrt(3.);
        const double viscous  = parameters.liquid_viscosity * gamma / point.time_step;
        const double number   = std::sqrt(2 * viscous / p);
        const double excess   = fraction - parameters.critical_fraction / (1 + parameters.fraction_slope * number);
        const double friction = parameters.static_friction + (parameters.rapid_friction - parameters.static_friction) *
                                                                 number / (number + parameters.reference_number);
        const bool is_suspension = fraction < parameters.critical_fraction;
        const double beta        = parameters.dilatancy * (is_suspension ? std::max(excess, 0.) : excess);
        // Plastic shear is a difference of strains, which bounds what is known of it.
        const double scale = law.shear_modulus * std::sqrt(2 * before.square);
        const double flow =
            (friction + beta) * p + (number > 0 ? 2.5 * fraction * viscous / (parameters.fraction_slope * number) : 0.);
        require(std::abs(tau - flow) <= 1e-6 * (scale + std::abs(before.volume) * bulk), name + ": friction");
        const double change = p + bulk * before.volume - bulk * beta * gamma;
        require(change <= 1e-6 * (scale + std::abs(before.volume) * bulk), name + ": volume");
        if (is_suspension)
          require(p <= factor * factor * 2 * viscous * (1 + 1e-6) + 1e-9 * scale, name + ": denser than equilibrium");
        else
          require(change >= -1e-6 * (scale + std::abs(before.volume) * bulk), name + ": compaction of dense grains");
      });
  require(n_flows > 100000, name + ": flow was not visited");
}


const UnitTest registered("viscoinertial_grains", [] {
  RandomNumbers random;
  for (const double fraction : { 0.2, 0.55, 0.584, 0.585, 0.6, 0.64 })
    test_random(fraction, random);
  test_steady(0.012, "viscous");
  test_steady(0, "inertial");
  test_fixed_volume();
  test_parting();
});
} // namespace test_viscoinertial_grains
