// SPDX-License-Identifier: LGPL-2.1-or-later
// Mohr-Coulomb: random returns lie on the yield surface and dilate as the dilation angle says; softening soil does so
// as long as nothing falls, and has the strength of each point; what opens at the vertex or at a cut-off is kept and
// closed without a change of energy. Strength of direct shear, and divided by a factor; pure shear against tau =
// c(gamma - tau/G); steady shear at a given rate against tau/p = mu_s + Delta mu/(1 + I_0/I).
#include "one_point.h"

#include <scree/materials/laws/tresca.h>

#include <fstream>
#include <numeric>

namespace test_mohr_coulomb
{
/// On faces and edges the plastic volume strain is sin psi times the sum of the sizes of the principal plastic strains.
double dilation_error(const PrincipalValues &trial, const PrincipalValues &strain, const double sine)
{
  double volume = 0, size = 0;
  for (unsigned int k = 0; k < 3; ++k)
    {
      volume += trial[k] - strain[k];
      size += std::abs(trial[k] - strain[k]);
    }
  return std::abs(volume - sine * size);
}


/// A point with these variables returns as soil of this strength, over a factor, everywhere.
void test_varying(const double cut_off, RandomNumbers &random)
{
  for (unsigned int i = 0; i < 1000; ++i)
    {
      MohrCoulombParameters soil;
      soil.dilation_angle           = 10;
      soil.tension_cut_off          = cut_off;
      MohrCoulombParameters varying = soil;
      varying.cohesion_of_place     = "1e3 + 100*depth";
      soil.cohesion                 = random.uniform(2 * cut_off, 1e4);
      soil.friction_angle           = random.uniform(12, 40);
      PrincipalValues strain;
      for (double &component : strain)
        component = random.uniform(-0.02, 0.01);
      const double factor   = random.uniform(cut_off > 0 ? 1 : 0.5, 2);
      double of_place[3]    = { 0, soil.cohesion, std::tan(soil.friction_angle * numbers::PI / 180) };
      double of_constant[1] = {};
      varying.divide_strength(factor);
      soil.divide_strength(factor);
      PrincipalValues strain_of_place = strain, stress, stress_of_place;
      UpdateReport report;
      return_point(MohrCoulomb(soil), strain, of_constant, 1, stress, report);
      return_point(VaryingMohrCoulomb(varying), strain_of_place, of_place, 1, stress_of_place, report);
      for (unsigned int k = 0; k < 3; ++k)
        {
          expect(stress_of_place[k], stress[k], 1e-6, "stress of a point with its own strength");
          expect(strain_of_place[k], strain[k], 1e-14, "strain of a point with its own strength");
        }
      expect(of_place[0], of_constant[0], 1e-14, "plastic shear strain of a point with its own strength");
    }
}


/// Depths, tables and rasters; what the law cannot follow is refused with the entry.
void test_places()
{
  MohrCoulombParameters soil;
  soil.cohesion_of_place       = "1e3 + 100*depth + 10*x";
  soil.friction_angle_of_place = "places.csv";
  soil.dilation_angle          = 5;
  std::ofstream("places.csv") << "x, y, phi\n100, 0, 20\n101, 0, 30\n101, 1, 4\n";
  const PlaceVariables<2> values(VaryingMohrCoulomb(soil).place_variables, "Soil/Mohr-Coulomb", Point<2>(100., 0.));
  require(values.has_depth(), "depth is not found");
  double variables[3] = {};
  values.set(Point<2>(0.6, 0.2), 3., variables);
  expect(variables[1], 1306, 1e-9, "cohesion of a place");
  expect(variables[2], std::tan(numbers::PI / 6), 1e-12, "tan(phi) of the nearest place");
  std::string message;
  try
    {
      values.set(Point<2>(1., 0.9), 3., variables);
    }
  catch (const ValueError &error)
    {
      message = error.what();
    }
  require(message.find("\"Friction angle\" = places.csv: the value at 1, 0.9 m is 4. ") != std::string::npos, message);

  std::ofstream("places.asc") << "ncols 2\nnrows 2\nxllcorner 99\nyllcorner 0\ncellsize 2\nNODATA_value -9999\n"
                                 "1e3 2e3\n3e3 -9999\n";
  const PlaceField<3> raster("entry", "places.asc", "Cohesion (Pa)", "", Point<2>(100., 0.));
  expect(raster.value(Point<3>(1., 3., 7.), 0.), 1500, 1e-9, "value between two cells of a raster");
  message = "";
  try
    {
      raster.value(Point<3>(2., 1., 7.), 0.);
    }
  catch (const ValueError &error)
    {
      message = error.what();
    }
  require(message.find("entry = places.asc: there is no value at 2, 1, 7 m.") == 0, message);
}


template <typename Law = MohrCoulomb>
void test_random(const std::string &name, const MohrCoulombParameters &parameters, RandomNumbers &random)
{
  const Law law(parameters);
  const double bulk = law.bulk_modulus(0), shear = law.shear_modulus;
  const double sine      = std::sin(parameters.dilation_angle * numbers::PI / 180);
  unsigned int n_elastic = 0, n_faces = 0, n_vertices = 0;
  UpdateReport report;
  random_returns(
      name,
      law,
      random,
      1000,
      [&](const auto &) { return parameters.cohesion; },
      [&](RandomReturn &point) {
        n_elastic += !point.is_plastic;
        n_vertices += point.is_at_vertex;
        require(law.yield(point.stress, law.own_strength) / point.scale < 1e-10, name + ": yield");
        require(point.internal[0] >= 0, name + ": plastic shear strain is negative");
        if (point.is_at_vertex)
          return;

        // The returned stress is that of the returned strain, open or not, and returns to itself.
        const double largest  = *std::max_element(point.stress.begin(), point.stress.end());
        const bool on_cut_off = largest > parameters.tension_cut_off - 1e-3 * point.scale;
        const double volume   = point.strain[0] + point.strain[1] + point.strain[2];
        for (unsigned int k = 0; k < 3; ++k)
          {
            const double elastic = bulk * volume + 2 * shear * (point.strain[k] - volume / 3);
            const double slope   = on_cut_off ? energy_slope(law, point.strain, k, 1e-4 * point.size) : elastic;
            expect((slope - point.stress[k]) / point.scale, 0, on_cut_off ? 2e-4 : 1e-10, name + ": slope less stress");
          }
        PrincipalValues again = point.strain, again_stress;
        return_point(law, again, point.internal, 1, again_stress, report);
        expect(largest_difference(again_stress, point.stress) / point.scale, 0, 1e-10, name + ": another return");
        if (point.is_plastic && !on_cut_off)
          {
            ++n_faces;
            expect(dilation_error(point.trial, point.strain, sine) / point.size, 0, 1e-10, name + ": dilation");
          }
      });
  require(n_elastic > 1000 && n_faces > 1000 && n_vertices > 1000, name + ": a branch was not visited");
}


/// Soil whose first axis opens and closes again: the stress stays at the cut-off until the opening has closed, then it
/// is that of the start, and so is the energy. Soil that opens further is apart; its gap closes if it is pressed from
/// all sides, and shear does not close it.
template <typename Law>
void test_opening(const std::string &name, const Law &law, const double cut_off)
{
  double internal[4] = { 0, 0, 0, 1e5 }; // the last one is the strength of Tresca's soil
  UpdateReport report;
  PrincipalValues strain = { { -1e-4, -1e-4, -1e-4 } }, stress;
  const auto update      = [&] { return_point(law, strain, internal, 1, stress, report); };
  update();
  const PrincipalValues start = stress;
  const double energy_before = law.energy(strain), opening = 0.8 * MohrCoulomb::largest_opening;
  double energy_of_half = 0, left = 0, left_energy = 0, work_error = 0;
  for (unsigned int wave = 0; wave < 10; ++wave)
    for (const double part : { 1, 1, -1, -1 })
      {
        strain[0] += part * opening / 2;
        update();
        const double energy = law.energy(strain);
        if (strain[0] > opening / 4)
          {
            left = std::max(left, std::abs(stress[0] - cut_off));
            if (strain[0] > 0.75 * opening)
              work_error = std::max(work_error, std::abs(energy - energy_of_half - cut_off * opening / 2));
            energy_of_half = energy;
            continue;
          }
        left        = std::max(left, largest_difference(stress, start));
        left_energy = std::max(left_energy, std::abs(energy - energy_before));
      }
  expect(left, 0, 1e-9 * std::abs(start[0]), name + ": stress left by a wave");
  expect(internal[0], 0, 0, name + ": plastic shear of an opening");
  expect(left_energy, 0, 1e-9 * energy_before, name + ": energy left by a wave");
  expect(work_error, 0, 1e-9 * cut_off, name + ": energy less the work of the cut-off");

  for (const int part : { 1, -1 })
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double change = 0.1 * MohrCoulomb::largest_opening;
        for (unsigned int k = 0; k < 3; ++k)
          strain[k] += part > 0 ? (k == 0 ? change : 0) : -change / 3;
        const bool is_apart = strain[0] + strain[1] + strain[2] > 1.1 * MohrCoulomb::largest_opening;
        strain[1] += is_apart ? change : 0; // Grains apart have no shear stress.
        strain[2] -= is_apart ? change : 0;
        update();
        for (const double value : stress)
          require(!is_apart || value == cut_off, name + ": stress in soil that is apart");
      }
  expect(largest_difference(stress, start), 0, 1e-9 * std::abs(start[0]), name + ": stress left by a gap");
}


void test_openings(const double cut_off)
{
  MohrCoulombParameters parameters;
  parameters.cohesion        = 1e5;
  parameters.tension_cut_off = cut_off;
  test_opening("perfectly plastic", MohrCoulomb(parameters), cut_off);
  parameters.softening.strain   = 0.1;
  parameters.softening.cohesion = 5e4;
  test_opening("softening", SofteningMohrCoulomb(parameters), cut_off);
  TrescaParameters clay;
  clay.tension_cut_off = cut_off;
  test_opening("Tresca", Tresca(clay), cut_off);
}


/// The apex lies at c / tan(phi); an angle of direct shear is phi with associated flow, and tan(phi) takes the place of
/// sin(phi) without dilation (Davis 1968). A factor divides c and tan(phi), of the peak and residual, and nothing else.
void test_strength()
{
  MohrCoulombParameters parameters;
  parameters.friction_angle = 30;
  parameters.cohesion       = 1e3;
  expect(parameters.apex(), 1e3 * std::sqrt(3.), 1e-9, "apex, Pa");
  parameters.angle_kind = "direct shear or repose";
  expect(parameters.sine(), 1. / std::sqrt(3.), 1e-12, "sin(phi) of direct shear, psi = 0");
  parameters.dilation_angle = 30;
  expect(parameters.sine(), 0.5, 1e-12, "sin(phi) of direct shear, psi = phi");

  const auto tangent        = [](const MohrCoulombParameters &law) { return std::tan(std::asin(law.sine())); };
  parameters.dilation_angle = 5;
  for (const std::string kind : { "triaxial", "direct shear or repose" })
    for (const double residual : { -1., 200. })
      for (const double factor : { 0.25, 1., 2. })
        {
          MohrCoulombParameters before = parameters;
          before.angle_kind            = kind;
          if (residual > 0)
            {
              before.softening.strain         = 0.1;
              before.softening.cohesion       = residual;
              before.softening.friction_angle = 25;
              before.softening.dilation_angle = 0;
            }
          MohrCoulombParameters after = before;
          after.divide_strength(factor);
          after.check("Mohr-Coulomb");
          expect(after.cohesion / before.cohesion, 1 / factor, 1e-12, "divided c");
          expect(tangent(after) / tangent(before), 1 / factor, 1e-12, "divided tan(phi)");
          const auto least = after.residual(), least_before = before.residual();
          expect(least.cohesion / least_before.cohesion, 1 / factor, 1e-12, "divided residual c");
          expect(tangent(least) / tangent(least_before), 1 / factor, 1e-12, "divided residual tan(phi)");
          expect(after.dilation_angle, 5, 0, "psi");
        }
}


void test_softening(const std::string &name, const MohrCoulombParameters &parameters, RandomNumbers &random)
{
  const SofteningMohrCoulomb law(parameters);
  const bool is_continuous = parameters.cohesion > 0; // grains apart do not dilate
  double kappa             = 0;
  UpdateReport report;
  random_returns(
      name,
      law,
      random,
      100000,
      [&](RandomReturn &point) {
        point.internal[1] = point.internal[2] = kappa = random.uniform(-0.01, 0.2);
        return parameters.cohesion;
      },
      [&](RandomReturn &point) {
        double *internal = point.internal;
        require(law.yield(point.stress, law.strength(kappa)) / point.scale < 1e-10, name + ": yield");
        // Over the other plastic strain: 1.5 in triaxial, sqrt(3) in plane shear.
        require(internal[1] >= kappa + 1.4999 * internal[0] - 1e-12 &&
                    internal[1] <= kappa + 1.7321 * internal[0] + 1e-12,
                name + ": kappa is not that of the plastic strain");
        require(internal[1] == internal[2], name + ": without averages, kappa sets the strength");
        require(!point.is_at_vertex || internal[1] == kappa, name + ": kappa grows where grains are apart");

        PrincipalValues near = point.trial, near_stress;
        const double shift   = 1e-6 * point.size;
        for (double &value : near)
          value += shift * random.uniform(-1, 1);
        double near_internal[3] = { 0, kappa, kappa };
        return_point(law, near, near_internal, 1, near_stress, report);
        if (is_continuous)
          expect(largest_difference(point.stress, near_stress) / (law.bulk_modulus(0) * shift),
                 0,
                 100,
                 name + ": jump of stress over that of strain");
        if (point.is_at_vertex)
          return;
        PrincipalValues again = point.strain, again_stress;
        internal[2]           = kappa;
        return_point(law, again, internal, 1, again_stress, report);
        expect(largest_difference(again_stress, point.stress) / point.scale, 0, 1e-10, name + ": another return");
      });
}


constexpr double grain_density = 2650, pressure = 1e3; // kg/m^3, Pa
constexpr InertialFrictionParameters friction{ 1e-3, 0.3, 0.26 };

/// Deviation of tau/p from the law after a shear strain of 1 at the rate, 1/s, in steps of this strain.
double inertial_deviation(const Material<2> &material, const double rate, const double strain)
{
  double wanted[4] = { -pressure, -pressure, -pressure, 0 }, b[4], stress[4], internal[3];
  material.initialise(wanted, b, stress, internal);
  UpdateReport report;
  const double increment[4] = { 1, strain, 0, 1 }, one = 1;
  for (unsigned int step = 0; step * strain < 1; ++step)
    material.update(
        { 1, 0, b, stress, internal }, { increment, &one, &one, &one, 1, strain / rate, grain_density }, report);
  expect(double(report.n_unresolved), 0, 0, "unresolved returns");
  const double p      = -(stress[0] + stress[1]) / 2;
  const double shear  = std::sqrt(std::pow((stress[0] - stress[1]) / 2, 2) + stress[3] * stress[3]);
  const double number = rate * friction.grain_diameter * std::sqrt(grain_density / p);
  return shear / p / (0.5 + friction.friction_increase / (1 + friction.reference_number / number)) - 1;
}


/// Steady shear in steps of any size; the part that is kept solves its equation and stays within 0 and 1.
void test_inertial_friction()
{
  MohrCoulombParameters coulomb;
  coulomb.young_modulus     = 1e8;
  coulomb.inertial_friction = friction;
  const HenckyMaterial<2, MohrCoulomb> material{ MohrCoulomb(coulomb) };
  for (const double rate : { 1e-3, 0.1, 10., 300. })
    for (const double strain : { 1e-5, 9e-4, 5e-3 })
      expect(inertial_deviation(material, rate, strain), 0, 1e-3, "deviation of tau/p");

  const InertialFriction law(friction);
  RandomNumbers random;
  for (unsigned int i = 0; i < 100000; ++i)
    {
      const double gamma = random.log_uniform(1e-20, 10), p = random.log_uniform(1e-6, 1e8),
                   step = random.log_uniform(1e-9, 1e3), modulus = random.log_uniform(1e3, 1e11);
      const double part = law.kept_part<double>(gamma, modulus, p, grain_density, step);
      require(part >= 0 && part <= 1, "part " + std::to_string(part));
      // The equation of the part, where numbers do not cancel.
      const double whole = gamma / step * friction.grain_diameter * std::sqrt(grain_density / p);
      if (part > 1e-6 && part < 0.999 && p > 1e-3)
        expect(part * modulus * gamma * (friction.reference_number + (1 - part) * whole) /
                   (friction.friction_increase * p * (1 - part) * whole),
               1,
               1e-6,
               "the equation of the part");
    }
  const double slow = std::numeric_limits<double>::infinity();
  expect(law.kept_part<double>(1e-3, 1e6, 1e3, grain_density, slow), 0, 0, "slow");
  expect(law.kept_part<double>(0., 1e6, 1e3, grain_density, 1e-3), 0, 0, "without strain");
  expect(law.kept_part<double>(1e-3, 1e6, 0., grain_density, 1e-3), 0, 0, "without pressure");
}


const UnitTest registered("mohr_coulomb", [] {
  RandomNumbers random;
  MohrCoulombParameters soil;
  test_random("phi 30, psi 0", soil, random);
  soil.dilation_angle = 10;
  test_random("phi 30, psi 10", soil, random);
  soil.cohesion = 1e3;
  test_random("phi 30, psi 10, c 1 kPa, no tension", soil, random);
  soil.tension_cut_off = 500;
  test_random("phi 30, psi 10, c 1 kPa, cut-off 500 Pa", soil, random);
  MohrCoulombParameters lasting = soil;
  lasting.softening.strain      = 1e30;
  lasting.softening.cohesion    = 0;
  test_random<SofteningMohrCoulomb>("the same with a strength that falls beyond the strains", lasting, random);
  soil.tension_cut_off = 1e3 / std::tan(numbers::PI / 6) * (1 - 1e-14);
  test_random("phi 30, psi 10, c 1 kPa, cut-off at the apex", soil, random);
  soil.friction_angle = soil.dilation_angle = 0;
  soil.tension_cut_off                      = 200;
  test_random("phi 0, c 1 kPa, cut-off 200 Pa", soil, random);
  test_openings(0);
  test_openings(2000);
  test_strength();
  test_varying(0, random);
  test_varying(500, random);
  test_places();

  MohrCoulombParameters falling = softening_clay();
  test_softening("phi 0, c 20 to 5 kPa", falling, random);
  falling.tension_cut_off = 2e3;
  test_softening("phi 0, c 20 to 5 kPa, cut-off 2 kPa", falling, random);
  falling.tension_cut_off          = 0;
  falling.friction_angle           = 35;
  falling.dilation_angle           = 10;
  falling.softening.friction_angle = 25;
  falling.softening.dilation_angle = 0;
  test_softening("phi 35 to 25, psi 10 to 0, c 20 to 5 kPa", falling, random);
  falling.softening.cohesion = 0;
  test_softening("phi 35 to 25, psi 10 to 0, c 20 kPa to 0", falling, random);
  falling.cohesion = 0;
  test_softening("phi 35 to 25, psi 10 to 0, no cohesion", falling, random);
  test_falling_shear(SofteningMohrCoulomb(softening_clay()), 0.3, { 2e4, 5e3, 1 / 0.05 }, 6e-3, 0.2);
  test_inertial_friction();
});
} // namespace test_mohr_coulomb
