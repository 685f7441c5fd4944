// SPDX-License-Identifier: LGPL-2.1-or-later
// Nor-Sand (Jefferies-Been) in laboratory tests: undrained limit, peak of a drained test, cyclic shear towards the
// critical void ratio.
#include <scree/element/element_driver.h>
#include <scree/materials/laws/nor_sand.h>

#include <iomanip>
#include <iostream>

#include "../expect.h"

#include "../unit_test.h"

namespace test_jefferies_been_targets
{
using namespace dealii;
using namespace scree;

/// A set that lies near the Erksak tests.
JefferiesBeenParameters erksak(const double void_ratio)
{
  JefferiesBeenParameters parameters;
  parameters.critical_stress_ratio = 1.17;
  parameters.volumetric_coupling   = 0.066;
  parameters.state_dilatancy       = 4.28;
  parameters.hardening_modulus     = 77;
  parameters.hardening_slope       = 688;
  parameters.initial_void_ratio    = void_ratio;
  return parameters;
}


ElementDriver run(const std::string &path,
                  const JefferiesBeenParameters &law,
                  const double pressure,
                  const double strain,
                  const unsigned int n_steps)
{
  ElementParameters parameters;
  parameters.path_name                              = path;
  parameters.confining_pressure                     = pressure;
  parameters.K0                                     = 1;
  parameters.final_strain                           = strain;
  parameters.n_steps                                = n_steps;
  parameters.material.law                           = "Nor-Sand (Jefferies-Been)";
  parameters.material.of<JefferiesBeenParameters>() = law;
  ElementDriver driver(parameters);
  driver.run();
  AssertThrow(driver.report().n_unresolved == 0, ExcMessage("Unresolved returns."));
  return driver;
}


void compare(const std::string &name, const double found, const double wanted, const double bound)
{
  expect(found / wanted, 1, bound, name + ", over " + std::to_string(wanted));
  std::cout << name << ": " << found << ", target " << wanted << ": OK" << std::endl;
}


/// Static liquefaction: p' = exp((Gamma - e)/lambda), q = M p' in the end.
void test_undrained()
{
  const JefferiesBeenParameters law = erksak(0.8);
  const ElementDriver driver        = run("undrained triaxial", law, 500e3, 0.2, 20000);
  double peak = 0, at = 0;
  for (const auto &state : driver.history())
    if (state.deviatoric_stress() > peak)
      {
        peak = state.deviatoric_stress();
        at   = state.strain;
      }
  const auto q = [&](const double strain) {
    return driver.history()[static_cast<unsigned int>(std::lround(strain * 1e5))].deviatoric_stress() / 1e3;
  };
  compare("undrained, largest q, kPa", peak / 1e3, 216.0, 0.01);
  compare("undrained, strain there, %", at * 100, 0.27, 0.04); // of two digits
  compare("undrained, q at 1 %, kPa", q(0.01), 38.1, 0.02);
  compare("undrained, q at 2 %, kPa", q(0.02), 4.14, 0.02);
  compare("undrained, q at 5 %, kPa", q(0.05), 3.4, 0.02);
  const auto &end       = driver.history().back();
  const double pressure = 1e3 * std::exp((law.critical_void_ratio - 0.8) / law.compression_index);
  compare("undrained, p at critical state, kPa", end.mean_effective_stress() / 1e3, pressure / 1e3, 1e-3);
  compare("undrained, q/p there", end.stress_ratio(), law.critical_stress_ratio, 1e-3);
}


/// At the largest q/p of a drained test, eta = M_i - chi psi.
void test_drained_peak(const double void_ratio, const double pressure)
{
  const JefferiesBeenParameters parameters = erksak(void_ratio);
  const ElementDriver driver               = run("drained triaxial", parameters, pressure, 0.3, 3000);
  const ElementDriver::State *peak         = &driver.history().front();
  for (const auto &state : driver.history())
    if (state.stress_ratio() > peak->stress_ratio())
      peak = &state;
  const JefferiesBeen law(parameters);
  const double v   = (1 + void_ratio) * peak->volume_ratio;
  const auto image = law.image(v, std::log(peak->internal_variables[0]), parameters.critical_stress_ratio);
  const double chi = parameters.state_dilatancy /
                     (1 - parameters.compression_index * parameters.state_dilatancy / parameters.critical_stress_ratio);
  compare("drained, e_0 " + std::to_string(void_ratio) + ": largest q/p",
          peak->stress_ratio(),
          image.ratio - chi * image.state,
          2e-3);
}


/// Cycles of simple shear of +-1 % in plane strain under constant vertical stress; the void ratio after ten of them.
double cyclic_void_ratio(const JefferiesBeenParameters &parameters, const double pressure)
{
  MaterialParameters law;
  law.law                           = "Nor-Sand (Jefferies-Been)";
  law.of<JefferiesBeenParameters>() = parameters;
  const auto material               = make_material<2>(law);
  struct State
  {
    double b[4], stress[4] = {}, internal[2], J = 1;
  } state;
  UpdateReport report;
  const double start[4] = { -pressure, -pressure, -pressure, 0 }, one = 1;
  material->initialise(start, state.b, state.stress, state.internal);
  const auto sheared = [&](const double shear, const double stretch) {
    State next               = state;
    const double increment[] = { 1, shear, 0, 1 + stretch };
    next.J *= 1 + stretch;
    material->update({ 1, 0, next.b, next.stress, next.internal }, { increment, &one, &next.J, &one }, report);
    return next;
  };
  double stretch = 0;
  for (unsigned int step = 0; step < 40000; ++step)
    {
      const double shear = (step % 4000 < 1000 || step % 4000 >= 3000 ? 1 : -1) * 1e-5;
      const auto error   = [&](const double y) { return sheared(shear, y).stress[1] / pressure + 1; };
      double before = stretch - 1e-7, error_before = error(before), error_now = error(stretch);
      for (unsigned int i = 0; i < 40 && std::abs(error_now) > 1e-8 && error_now != error_before; ++i)
        {
          const double next =
              stretch - std::clamp(error_now * (stretch - before) / (error_now - error_before), -1e-5, 1e-5);
          before       = stretch;
          error_before = error_now;
          stretch      = next;
          error_now    = error(stretch);
        }
      state = sheared(shear, stretch);
    }
  AssertThrow(report.n_unresolved == 0, ExcMessage("Unresolved returns."));
  return (1 + parameters.initial_void_ratio) * state.J - 1;
}


void test_cyclic(const double from, const double to)
{
  compare("cyclic shear, void ratio from " + std::to_string(from), cyclic_void_ratio(erksak(from), 100e3), to, 0.004);
}


void run()
{
  std::cout << std::fixed << std::setprecision(4);
  test_undrained();
  test_drained_peak(0.587, 130e3);
  test_drained_peak(0.65, 100e3);
  test_cyclic(0.79, 0.750);
  test_cyclic(0.65, 0.709);
}

const UnitTest registered("jefferies_been_targets", run);
} // namespace test_jefferies_been_targets


// Output:
// undrained, largest q, kPa: 216.0225, target 216.0000: OK
// undrained, strain there, %: 0.2700, target 0.2700: OK
// undrained, q at 1 %, kPa: 38.0678, target 38.1000: OK
// undrained, q at 2 %, kPa: 4.1400, target 4.1400: OK
// undrained, q at 5 %, kPa: 3.3996, target 3.4000: OK
// undrained, p at critical state, kPa: 2.9057, target 2.9057: OK
// undrained, q/p there: 1.1700, target 1.1700: OK
// drained, e_0 0.587000: largest q/p: 1.6590, target 1.6614: OK
// drained, e_0 0.650000: largest q/p: 1.4695, target 1.4713: OK
// cyclic shear, void ratio from 0.790000: 0.7498, target 0.7500: OK
// cyclic shear, void ratio from 0.650000: 0.7085, target 0.7090: OK
