// SPDX-License-Identifier: LGPL-2.1-or-later
// What the lines `Checks` of a run say of mass, momentum and energy, against hand calculation, and how they are laid
// out. (Masses that are scaled: scenes/terzaghi_days; energy in the middle of steps: falling_water.)
#include "../soil.h"

#include <scree/postprocess/measures.h>
#include <scree/postprocess/checks.h>

namespace test_balance_checks
{
/// Lets checks look at a scene with these totals.
struct Watched
{
  SoilScene<2> scene{ 0., 0.8 };
  BodyForces<2> forces;
  BalanceChecks<2> checks{ scene.grid, forces };
  Statistics<2> statistics;

  Watched()
      : forces(scene.grid, { 0., -10. }, BodyForceParameters())
      , statistics(scene.grid, forces.gravity(), {})
  {
    scene.add_soil("x < 0.4 && y < 0.4");
  }

  void look(const RunBalance<2> &totals, const double time)
  {
    checks.look(statistics.collect(scene.bodies, scene.water, totals, time, 0, 0., UpdateReport()).balance());
  }
};


template <int dim>
void set_velocity(SoilScene<dim> &scene, const double along_last_axis)
{
  for (auto &body : scene.bodies)
    for_each_point(body.points,
                   [&](const auto &point) { point.properties[body.layout.velocity + dim - 1] = along_last_axis; });
}


/// A block that is in motion at the start: its energy there is that of half the first step before.
void check_first_step()
{
  BalanceStart<2> start{ true, Tensor<1, 2>(), 100., false };
  start.begin(0.1, 40., 3.);
  start.begin(0.2, 40., -5.);
  expect(start.energy, 102., 1e-12, "energy of the start");
  expect(start.least_averaging_work, -5., 1e-12, "least work of the averaging");
}


/// A block of 160 kg, at rest, that a load of 100 J sets in motion, 80 J, and walls stop again.
const UnitTest balance_checks_test("balance_checks", [] {
  Watched watched;
  auto &[scene, forces, checks, statistics] = watched;
  std::cout << "nothing known: " << checks.results().size() << " results\n";

  RunBalance<2> totals;
  watched.look(totals, 0.);
  std::cout << "at rest\n" << verdict(checks.results()) << '\n';

  set_velocity(scene, -1.);
  totals.balance.body_impulse = PointSums<2>(scene.bodies, scene.water, forces.gravity(), scene.grid).momentum;
  totals.balance.load_work    = 100.;
  watched.look(totals, 0.);
  std::cout << "in motion: 20 J are missing\n" << verdict(checks.results()) << '\n';

  set_velocity(scene, 0.);
  totals.balance.wall_impulse         = -totals.balance.body_impulse;
  totals.material.plastic_dissipation = 79.5;
  watched.look(totals, 0.);
  totals.material.plastic_dissipation = 81.5; // 2 J more than there were
  watched.look(totals, 0.);
  std::cout << "stopped, with a gain of 2 J\n" << verdict(checks.results()) << '\n';

  totals.balance.bed_dissipation = -3.; // turned into heat elsewhere: the numerical dissipation does not fall
  totals.material.plastic_dissipation += 3.;
  for (unsigned int step = 0; step < 20; ++step) // Channels are looked at every 20 steps.
    watched.look(totals, 0.);
  std::cout << "a bed that gives 3 J\n" << verdict(checks.results()) << '\n';
  totals.balance.bed_dissipation = 0.;
  totals.material.plastic_dissipation -= 3.;

  totals.lost_mass = 1.6;
  totals.balance.wall_impulse[0] += 0.16;
  watched.look(totals, 0.);
  std::cout << "1.6 kg and 0.16 N s too much\n" << verdict(checks.results()) << '\n';

  check_first_step();

  const std::vector<CheckResult> results{
    { "first check of a long name", "1" },
    { "second check of a long name", "2 m", "1 m", true, "use smaller cells", Finding::resolution },
    { "third check of a long name",
      "3",
      "2",
      true,
      "write \"auto\"",
      Finding::fault,
      "a point at (0, 0) m, t = 1 s: so it is" },
    { "fourth check of a long name", "4", "5" }
  };
  std::cout << "layout\n" << verdict(results) << '\n' << verdict_table(results);
});
} // namespace test_balance_checks


// clang-format off
// Output:
// nothing known: 0 results
// at rest
// Checks      within bounds: mass balance 0
// in motion: 20 J are missing
// Checks      within bounds: mass balance 0; momentum balance 0; largest energy gain 0 %; numerical
//             dissipation 20 % of the released energy
// stopped, with a gain of 2 J
// Checks      fault: largest energy gain 2 %, t = 0 s (bound 0.5 %); what to do: use the default
//             transfer and F-bar, and halve "Courant number"
//             within bounds: mass balance 0; momentum balance 0; numerical dissipation 18.5 % of the
//             released energy
// a bed that gives 3 J
// Checks      fault: largest energy gain 2 %, t = 0 s (bound 0.5 %); what to do: use the default
//             transfer and F-bar, and halve "Courant number"
//             fault: largest energy gain of the bed 3 %, t = 0 s (bound 0.5 %); what to do: use the
//             default transfer and F-bar, and halve "Courant number"
//             within bounds: mass balance 0; momentum balance 0; numerical dissipation 18.5 % of the
//             released energy
// 1.6 kg and 0.16 N s too much
// Checks      fault: mass balance 0.01, t = 0 s (bound 1e-06); what to do: report the case as a fault
//             of Scree: no entry should do this
//             fault: momentum balance 0.001, t = 0 s (bound 1e-06); what to do: report the case as a
//             fault of Scree: no entry should do this
//             fault: largest energy gain 2 %, t = 0 s (bound 0.5 %); what to do: use the default
//             transfer and F-bar, and halve "Courant number"
//             fault: largest energy gain of the bed 3 %, t = 0 s (bound 0.5 %); what to do: use the
//             default transfer and F-bar, and halve "Courant number"
//             within bounds: numerical dissipation 18.5 % of the released energy
// layout
// Checks      fault: third check of a long name 3 (bound 2); a point at (0, 0) m, t = 1 s: so it is;
//             what to do: write "auto"
//             resolution: second check of a long name 2 m (bound 1 m); what to do: use smaller cells
//             within bounds: first check of a long name 1; fourth check of a long name 4
// check,value,bound,class,is_exceeded,place,remedy
// "first check of a long name","1","","information",0,"",""
// "second check of a long name","2 m","1 m","resolution",1,"","use smaller cells"
// "third check of a long name","3","2","fault",1,"a point at (0, 0) m, t = 1 s: so it is","write ""auto"""
// "fourth check of a long name","4","5","fault",0,"",""
