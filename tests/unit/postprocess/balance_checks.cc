// SPDX-License-Identifier: LGPL-2.1-or-later
// What the lines `Checks` of a run say of mass, momentum and energy, against hand calculation, and how they are laid
// out.
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

  explicit Watched(const double mass_scaling = 1.)
      : forces(scene.grid, { 0., -10. }, BodyForceParameters(), mass_scaling)
      , statistics(scene.grid, forces.gravity(), features(mass_scaling))
  {
    scene.add_soil("x < 0.4 && y < 0.4");
  }

  static SceneFeatures<2> features(const double mass_scaling)
  {
    SceneFeatures<2> result;
    result.mass_scaling = mass_scaling;
    return result;
  }

  void look(const RunBalance<2> &totals, const double time)
  {
    checks.look(statistics.collect(scene.bodies, scene.water, totals, time, 0, 0., UpdateReport()));
  }
};


template <int dim>
void set_velocity(SoilScene<dim> &scene, const double along_last_axis)
{
  for (auto &body : scene.bodies)
    for_each_point(body.points,
                   [&](const auto &point) { point.properties[body.layout.velocity + dim - 1] = along_last_axis; });
}


/// A block of 160 kg that resists as 640 kg: a load of 400 J gives it 1 m/s, 320 J, of which 80 J are of its true mass.
void check_scaled_masses()
{
  Watched watched(4.);
  auto &[scene, forces, checks, statistics] = watched;
  RunBalance<2> totals;
  watched.look(totals, 0.);
  set_velocity(scene, -1.);
  totals.balance.body_impulse = 4. * PointSums<2>(scene.bodies, scene.water, forces.gravity(), MPI_COMM_WORLD).momentum;
  totals.balance.load_work    = 400.;
  totals.balance.motion       = 320.; // J s, over 2 s in which the work grows evenly
  watched.look(totals, 2.);
  std::cout << "masses times 4, in motion: 80 J are missing\n" << verdict(checks.results()) << '\n';
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
  totals.balance.body_impulse = PointSums<2>(scene.bodies, scene.water, forces.gravity(), MPI_COMM_WORLD).momentum;
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
  watched.look(totals, 0.);
  std::cout << "a bed that gives 3 J\n" << verdict(checks.results()) << '\n';
  totals.balance.bed_dissipation = 0.;
  totals.material.plastic_dissipation -= 3.;

  totals.lost_mass = 1.6;
  totals.balance.wall_impulse[0] += 0.16;
  watched.look(totals, 0.);
  std::cout << "1.6 kg and 0.16 N s too much\n" << verdict(checks.results()) << '\n';

  check_scaled_masses();

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
// Checks      within bounds: mass balance 0; momentum balance 0; largest energy gain 0 %;
//             numerical dissipation 20 % of the released energy
// stopped, with a gain of 2 J
// Checks      out of bounds: largest energy gain 2 % (bound 0.5 %)
//             within bounds: mass balance 0; momentum balance 0;
//             numerical dissipation 18.5 % of the released energy
// a bed that gives 3 J
// Checks      out of bounds: largest energy gain 3 %, of the bed (bound 0.5 %)
//             within bounds: mass balance 0; momentum balance 0;
//             numerical dissipation 18.5 % of the released energy
// 1.6 kg and 0.16 N s too much
// Checks      out of bounds: mass balance 0.01 (bound 1e-06); momentum balance 0.001 (bound 1e-06);
//             largest energy gain 3 %, of the bed (bound 0.5 %)
//             within bounds: numerical dissipation 18.5 % of the released energy
// masses times 4, in motion: 80 J are missing
// Checks      out of bounds:
//             mean kinetic energy 80 % of the work, with masses times 4; 20 % with true ones (bound 0.1 %, else "Mass scaling" is too large)
//             within bounds: mass balance 0; momentum balance 0; largest energy gain 0 %;
//             numerical dissipation 20 % of the released energy
// layout
// Checks      out of bounds: second check of a long name 2 (bound 1)
//             worst: a point at (0, 0) m, t = 1 s: so it is
//             within bounds: first check of a long name 1; third check of a long name 3;
//             fourth check of a long name 4
