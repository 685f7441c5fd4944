// SPDX-License-Identifier: LGPL-2.1-or-later

// Nor-Sand against an independent implementation: triaxial compression and simple shear, each number to 1 %.

#include <scree/materials/laws/nor_sand.h>
#include <scree/element/element_driver.h>

#include <iomanip>
#include <iostream>

#include "../unit_test.h"

namespace test_element_targets
{
using namespace dealii;
using namespace scree;

ElementDriver
run(const std::string &path, const double specific_volume, const double confining_pressure, const double final_strain)
{
  ElementParameters parameters;
  parameters.path_name                                                = path;
  parameters.confining_pressure                                       = confining_pressure;
  parameters.final_strain                                             = final_strain;
  parameters.material.of<NorSandParameters>().initial_specific_volume = specific_volume;
  ElementDriver driver(parameters);
  driver.run();
  AssertThrow(driver.report().n_unresolved == 0, ExcMessage("Unresolved returns."));
  return driver;
}


void compare(const std::string &name, const double found, const double wanted)
{
  AssertThrow(std::abs(found / wanted - 1) < 0.01,
              ExcMessage(name + " is " + std::to_string(found) + ", should be " + std::to_string(wanted)));
  std::cout << name << ": " << found << ", target " << wanted << ": OK" << std::endl;
}


void test_drained(const std::string &name,
                  const double specific_volume,
                  const std::array<double, 3> &peaks,
                  const std::array<double, 3> &final_volumes)
{
  const std::array<double, 3> confining_pressures = { { 10e3, 50e3, 100e3 } };
  for (unsigned int i = 0; i < 3; ++i)
    {
      const ElementDriver driver = run("drained triaxial", specific_volume, confining_pressures[i], 0.5);
      double peak                = 0;
      for (const auto &state : driver.history())
        peak = std::max(peak, state.stress_ratio());
      const std::string at =
          name + ", drained, " + std::to_string(static_cast<int>(confining_pressures[i] / 1000)) + " kPa: ";
      compare(at + "peak q/P", peak, peaks[i]);
      compare(at + "v at 50 %", specific_volume * driver.history().back().volume_ratio, final_volumes[i]);
    }
}


void test_undrained(const double specific_volume, const double pressure)
{
  const ElementDriver driver = run("undrained triaxial", specific_volume, 100e3, 0.2);
  compare("v_0 " + std::to_string(specific_volume) + ", undrained: P at 20 %, kPa",
          driver.history().back().mean_effective_stress() / 1000,
          pressure);
}


void test_shear(const std::string &name, const double specific_volume, const double peak, const double end)
{
  const ElementDriver driver = run("simple shear", specific_volume, 20e3, 1);
  double found               = 0;
  for (const auto &state : driver.history())
    found = std::max(found, state.mobilised_ratio());
  compare(name + ", simple shear: peak shear/vertical stress", found, peak);
  compare(name + ", simple shear: shear/vertical stress at the end", driver.history().back().mobilised_ratio(), end);
}


void run()
{
  std::cout << std::fixed << std::setprecision(4);
  test_drained("dense", 1.629, { { 1.089, 1.037, 1.014 } }, { { 1.763, 1.744, 1.735 } });
  test_drained("loose", 1.736, { { 0.803, 0.753, 0.732 } }, { { 1.765, 1.747, 1.738 } });
  test_undrained(1.629, 2381);
  test_undrained(1.736, 141);
  test_undrained(1.76, 25.4);
  test_shear("dense", 1.629, 0.747, 0.413);
  test_shear("loose", 1.736, 0.468, 0.410);
}

const UnitTest registered("element_targets", run);
} // namespace test_element_targets


// Output:
// dense, drained, 10 kPa: peak q/P: 1.0876, target 1.0890: OK
// dense, drained, 10 kPa: v at 50 %: 1.7625, target 1.7630: OK
// dense, drained, 50 kPa: peak q/P: 1.0360, target 1.0370: OK
// dense, drained, 50 kPa: v at 50 %: 1.7435, target 1.7440: OK
// dense, drained, 100 kPa: peak q/P: 1.0138, target 1.0140: OK
// dense, drained, 100 kPa: v at 50 %: 1.7353, target 1.7350: OK
// loose, drained, 10 kPa: peak q/P: 0.8025, target 0.8030: OK
// loose, drained, 10 kPa: v at 50 %: 1.7653, target 1.7650: OK
// loose, drained, 50 kPa: peak q/P: 0.7526, target 0.7530: OK
// loose, drained, 50 kPa: v at 50 %: 1.7465, target 1.7470: OK
// loose, drained, 100 kPa: peak q/P: 0.7315, target 0.7320: OK
// loose, drained, 100 kPa: v at 50 %: 1.7384, target 1.7380: OK
// v_0 1.629000, undrained: P at 20 %, kPa: 2381.1845, target 2381.0000: OK
// v_0 1.736000, undrained: P at 20 %, kPa: 141.0406, target 141.0000: OK
// v_0 1.760000, undrained: P at 20 %, kPa: 25.4441, target 25.4000: OK
// dense, simple shear: peak shear/vertical stress: 0.7460, target 0.7470: OK
// dense, simple shear: shear/vertical stress at the end: 0.4134, target 0.4130: OK
// loose, simple shear: peak shear/vertical stress: 0.4673, target 0.4680: OK
// loose, simple shear: shear/vertical stress at the end: 0.4102, target 0.4100: OK
