// SPDX-License-Identifier: LGPL-2.1-or-later

// The numbers of an advice that follow from those of a scene: groups against hand calculation, regimes over the
// conductivity, cell sizes that divide the box, steps as the clock takes them, cost in proportion.
#include "../test.h"

#include <scree/advice/advise.h>
#include <scree/advice/scene_numbers.h>

namespace test_advice_groups
{
/// prm/consolidation/terzaghi.prm: c_v = 0.11326 m^2/s, drainage time 8.829 s, T_v = 1 at the end.
SceneNumbers terzaghi()
{
  SceneNumbers scene;
  scene.gravity             = 0;
  scene.end_time            = 8.829;
  scene.height              = 1;
  scene.has_soil            = true;
  scene.courant_of_transfer = 0.6;
  scene.is_elastic          = true;
  scene.mean                = { 1e6 / (3 * (1 - 2 * 0.2)), 1e6 / (2 * 1.2), 1590 };
  scene.fastest             = scene.mean;
  scene.grain_density       = 2650;
  scene.porosity            = 0.4;
  scene.has_water           = true;
  scene.water_fills_soil    = true;
  scene.conductivity        = 1e-3;
  scene.cell_size           = 0.05;
  scene.n_cells             = 48;
  scene.n_occupied          = 40;
  scene.n_soil_points       = 640;
  scene.n_water_points      = 640;
  return scene;
}

/// A saturated slope, 2 m high, of soil that flows and stiffens with its pressure.
SceneNumbers slope()
{
  SceneNumbers scene = terzaghi();
  scene.gravity      = 9.81;
  scene.end_time     = 12;
  scene.height       = 2;
  scene.fall         = 0.3;
  scene.is_elastic   = false;
  scene.mean         = { 4e6, 4e6, 1500 };
  scene.fastest      = { 7e6, 4e6, 1500, 14e3 };
  scene.conductivity = 5e-3;
  return scene;
}

void test_groups()
{
  const Groups column = groups_of(terzaghi());
  std::cout << "Terzaghi: c_v " << column.consolidation_coefficient << " m^2/s, drainage time " << column.drainage_time
            << " s, T_v " << column.time_factor << ", cells " << column.cells_over_height << '\n';
  // Q = n^2 rho_w g/k = 1.5696e6 N s/m^4; soil 1590, water 400 kg/m^3
  std::cout << "  drag time over (1590 400/1990)/1.5696e6 s: " << column.drag_time / (1590. * 400. / 1990. / 1.5696e6)
            << "; wave H/c over 1/sqrt(1.1111e6/1590): " << column.motion_time * std::sqrt(1e6 / 0.9 / 1590) << '\n';

  const SceneNumbers scene = slope();
  const Groups groups      = groups_of(scene);
  // M = 9.3333e6 Pa, rho = 1500 + 400 kg/m^3
  std::cout << "Slope: sqrt(H/g) " << groups.motion_time << " s, rho g H/M in per mille " << 1e3 * groups.own_strain
            << ", rho g H/G " << 1e3 * groups.shear_stress_ratio << ", Mach number in per cent "
            << 100 * groups.mach_number << ", drainage over motion " << groups.drainage << '\n';

  SceneNumbers dry = scene;
  dry.has_water    = false;
  std::cout << "Dry: density " << dry.density() << ", drainage " << groups_of(dry).drainage << '\n';
}

void test_regimes()
{
  std::cout << "Regimes of the slope over k:";
  SceneNumbers scene = slope();
  for (int exponent = 1; exponent >= -9; exponent -= 2)
    {
      scene.conductivity = std::pow(10., exponent);
      std::cout << " 1e" << exponent << ' ' << name_of(regime_of(scene));
    }
  std::cout << '\n';

  // At the thresholds' own conductivities the regime of elastic soil changes.
  scene.end_time   = 0.01;
  scene.is_elastic = true;
  for (const double threshold : { thresholds::drained_below, thresholds::undrained_above })
    {
      scene.conductivity = conductivity_for(slope(), threshold);
      std::cout << "At the threshold: drainage over threshold " << groups_of(scene).drainage / threshold << ',';
      for (const double factor : { 1.01, 0.99 })
        {
          SceneNumbers beside = scene;
          beside.conductivity = factor * scene.conductivity;
          std::cout << ' ' << name_of(regime_of(beside));
        }
      std::cout << '\n';
    }
  // Undrained in its motion, but the run lasts until the pressure leaves.
  scene.conductivity /= 2;
  scene.end_time = 100;
  std::cout << "The same for 100 s: " << name_of(regime_of(scene)) << '\n';

  SceneNumbers dry   = slope();
  dry.has_water      = false;
  SceneNumbers water = slope();
  water.has_soil     = false;
  std::cout << "Without water: " << name_of(regime_of(dry)) << "; without soil: " << name_of(regime_of(water)) << '\n';

  const auto points = [](const SceneNumbers &scene) {
    return point_sets_for(regime_of(scene), scene).sets == PointSets::double_point ? "double" : "single";
  };
  SceneNumbers reservoir     = terzaghi();
  reservoir.water_fills_soil = false;
  SceneNumbers tight         = slope();
  tight.conductivity         = 1e-9;
  std::cout << "Points of water: slope " << points(slope()) << ", tight slope " << points(tight) << ", Terzaghi "
            << points(terzaghi()) << ", with a reservoir " << points(reservoir) << '\n';
}

void test_resolution()
{
  for (const SceneNumbers &scene : { slope(), terzaghi() })
    {
      const ErrorLaw law = error_law_of(scene);
      std::cout << "Error " << law.measure << ": law and its inverse " << law.error(law.cells_over_height(0.02)) / 0.02
                << ", halved cells " << law.error(20) / law.error(40) << '\n';
    }
  SceneNumbers cyclic = terzaghi(), reservoir = terzaghi(), early = terzaghi(), dam = slope(), still = slope(),
               level = slope(), dry = slope(), tight = slope();
  dry.has_water              = false;
  SceneNumbers held          = dry;
  held.sticks                = true;
  SceneNumbers held_slope    = slope();
  held_slope.sticks          = true;
  tight.conductivity         = 1e-9;
  cyclic.has_changing_forces = true;
  reservoir.water_fills_soil = false;
  early.end_time             = 0.5;
  dam.has_soil = still.has_soil = false;
  still.fall = level.fall = 0;
  std::cout
      << "Error of a dry slope with 20 and 30 cells over its height, in per cent; on a fixed base 19 and 12 measured: "
      << 100 * error_law_of(held).error(20) << ", " << 100 * error_law_of(held).error(30)
      << "; with friction 7.7 at 20: " << 100 * error_law_of(dry).error(20) << '\n';
  std::cout << "Whether finer cells help: slope " << error_law_of(slope()).remedy.empty() << ", on a fixed base, dry, "
            << error_law_of(held).remedy.empty() << ", tight slope " << error_law_of(tight).remedy.empty() << '\n';
  std::cout << "Whether the error is known: dry slope " << error_law_of(dry).gap.empty() << ", slope "
            << error_law_of(slope()).gap.empty() << ", on a fixed base " << error_law_of(held_slope).gap.empty()
            << ", tight slope " << error_law_of(tight).gap.empty() << ", dam " << error_law_of(dam).gap.empty()
            << ", Terzaghi " << error_law_of(terzaghi()).gap.empty() << "; cyclic load "
            << error_law_of(cyclic).gap.empty() << ", reservoir " << error_law_of(reservoir).gap.empty()
            << ", before T_v = 0.1 " << error_law_of(early).gap.empty() << ", still water "
            << error_law_of(still).gap.empty() << ", level soil " << error_law_of(level).gap.empty() << '\n';
  std::cout << "Promised for Terzaghi in 200 cells over the least that was measured: "
            << error_law_of(terzaghi()).error(200) / ErrorLaw::smallest << "; Courant number beside a reservoir "
            << time_step_for(reservoir, TimeStepParameters()).courant_number << '\n';
  GridParameters grid;
  grid.lower_corner = { 0, 0 };
  grid.upper_corner = { 10, 2.5 };
  grid.cell_size    = 0.05;
  for (const double cells : { 1., 20., 46., 115. })
    {
      const double size = cell_size_for(grid, 2, cells);
      std::cout << "At least " << cells << " cells over 2 m: " << 2 / size << "; over the box " << 10 / size << " x "
                << 2.5 / size << '\n';
    }
  grid.upper_corner = { 0.7, 1.3 };
  grid.cell_size    = 0.1;
  std::cout << "A box of 7 x 13 cells, at least 25 over 1 m: " << 1 / cell_size_for(grid, 1, 25) << '\n';
  TimeStepParameters step;
  SceneNumbers water = slope();
  water.has_soil     = false;
  std::cout << "Courant number: slope " << time_step_for(slope(), step).courant_number << ", Terzaghi "
            << time_step_for(terzaghi(), step).courant_number << "; step of free water over cell "
            << time_step_for(water, step).maximum_time_step / water.cell_size << '\n';
}

/// Steps of a clock that always may take `step`.
double clock_steps(const Schedule &schedule, const double end, const double step)
{
  TimeStepper clock(schedule.time_step);
  double next = schedule.output.interval;
  while (clock.time() < end * (1 - 1e-12))
    {
      const double due = std::min(end, next);
      clock.advance(clock.next_step(step, due), due);
      if (clock.time() >= next * (1 - 1e-12))
        next += schedule.output.interval;
    }
  return clock.step();
}

/// Steps of 1e-3 s, half of it the law.
Observation seen(const SceneNumbers &scene)
{
  Observation seen;
  seen.n_first       = 10;
  seen.n_points      = scene.n_points();
  seen.first.parts   = { { TimerSection::stress, 5e-4 },
                         { TimerSection::points_to_grid, 2e-4 },
                         { TimerSection::pressure_solve, 2e-4 },
                         { TimerSection::sort, 1e-4 } };
  seen.first.seconds = 1e-3;
  seen.later         = seen.first;
  seen.memory        = 2e8;
  seen.intervals     = { { 1e-3, scene.fastest.speed(), 0. } };
  return seen;
}

void test_cost()
{
  Schedule schedule;
  schedule.output.interval  = 0.7;
  const SceneNumbers column = terzaghi();
  const Observation start   = seen(column);
  const RunCost cost        = cost_of_run(column, start, schedule);
  std::cout << "Terzaghi: step over 0.6 h/c " << cost.first_step / (0.6 * 0.05 / column.fastest.speed())
            << ", steps over the clock's " << cost.n_steps / clock_steps(schedule, column.end_time, cost.first_step)
            << ", seconds of steps over steps times step " << cost.step_seconds / cost.n_steps / start.first.seconds
            << '\n';

  // A pilot with a quarter of the points: its solve takes three times as long later, its sort, of which it saw nothing
  // at first, 2e-5 s; waves are twice as fast in the second half.
  Observation pilot       = start;
  pilot.n_points          = start.n_points / 4;
  pilot.first.seconds     = 2.5e-4;
  pilot.first.parts       = { { TimerSection::stress, 2e-4 }, { TimerSection::pressure_solve, 5e-5 } };
  pilot.later.parts       = { { TimerSection::stress, 2e-4 },
                              { TimerSection::pressure_solve, 1.5e-4 },
                              { TimerSection::sort, 2e-5 } };
  const double wave       = column.fastest.speed();
  pilot.intervals         = { { column.end_time / 2, wave, 0. }, { column.end_time / 2, 2 * wave, 0. } };
  const Observation whole = with_pilot(start, pilot);
  const RunCost of_whole  = cost_of_run(column, whole, schedule);
  std::cout << "With a pilot: law " << whole.later.seconds_of(TimerSection::stress) / 5e-4 << ", solve "
            << whole.later.seconds_of(TimerSection::pressure_solve) / 2e-4 << ", sort "
            << whole.later.seconds_of(TimerSection::sort) / 2e-5 << " times; steps over the first guess "
            << std::round(100 * of_whole.n_steps / cost.n_steps) / 100 << ", seconds of later steps "
            << (of_whole.step_seconds - 10 * whole.first.seconds) / (of_whole.n_steps - 10) / whole.later.seconds
            << '\n';

  SceneNumbers block         = slope();
  block.dim                  = 3;
  const SceneNumbers finer   = with_cell_size(block, 0.025);
  const Observation of_block = seen(block), of_finer = with_cell_size(of_block, block, 0.025);
  std::cout << "Halved cells in 3D: points " << finer.n_points() / block.n_points() << ", time of a step "
            << of_finer.later.seconds / of_block.later.seconds << ", steps "
            << std::round(cost_of_run(finer, of_finer, schedule).n_steps /
                          cost_of_run(block, of_block, schedule).n_steps)
            << '\n';
  // All of the law, half of the transfer and the sort, nothing of the pressure.
  std::cout << "Soil without its water: " << without_water(start, column).later.seconds / start.later.seconds
            << " of the cost of a step\n";
}

void run()
{
  test_groups();
  test_regimes();
  test_resolution();
  test_cost();
}

const UnitTest registered("advice_groups", run);
} // namespace test_advice_groups


// clang-format off
// Output:
// Terzaghi: c_v 0.113263 m^2/s, drainage time 8.829 s, T_v 1, cells 20
//   drag time over (1590 400/1990)/1.5696e6 s: 1; wave H/c over 1/sqrt(1.1111e6/1590): 1
// Slope: sqrt(H/g) 0.451524 s, rho g H/M in per mille 3.99407, rho g H/G 9.3195, Mach number in per cent 5.61535, drainage over motion 1.86227
// Dry: density 1500, drainage 0
// Regimes of the slope over k: 1e1 coupled 1e-1 coupled 1e-3 coupled 1e-5 coupled 1e-7 undrained 1e-9 undrained
// At the threshold: drainage over threshold 1, drained coupled
// At the threshold: drainage over threshold 1, coupled undrained
// The same for 100 s: coupled
// Without water: dry; without soil: water alone
// Points of water: slope double, tight slope single, Terzaghi single, with a reservoir double
// Error of the run-out: law and its inverse 1, halved cells 2
// Error of stress and pressure: law and its inverse 1, halved cells 4
// Error of a dry slope with 20 and 30 cells over its height, in per cent; on a fixed base 19 and 12 measured: 19, 12.6667; with friction 7.7 at 20: 8
// Whether finer cells help: slope 1, on a fixed base, dry, 0, tight slope 0
// Whether the error is known: dry slope 1, slope 1, on a fixed base 0, tight slope 0, dam 1, Terzaghi 1; cyclic load 0, reservoir 0, before T_v = 0.1 0, still water 0, level soil 0
// Promised for Terzaghi in 200 cells over the least that was measured: 1; Courant number beside a reservoir 0.6
// At least 1 cells over 2 m: 10.4; over the box 52 x 13
// At least 20 cells over 2 m: 20; over the box 100 x 25
// At least 46 cells over 2 m: 46.4; over the box 232 x 58
// At least 115 cells over 2 m: 115.2; over the box 576 x 144
// A box of 7 x 13 cells, at least 25 over 1 m: 30
// Courant number: slope 0.6, Terzaghi 0.9; step of free water over cell 0.04
// Terzaghi: step over 0.6 h/c 1, steps over the clock's 1, seconds of steps over steps times step 1
// With a pilot: law 1, solve 3, sort 4 times; steps over the first guess 1.5, seconds of later steps 1
// Halved cells in 3D: points 8, time of a step 8, steps 2
// Soil without its water: 0.65 of the cost of a step
