# SPDX-License-Identifier: LGPL-2.1-or-later
"""obstacle_motion_scenes.py SCREE SCENE: obstacles that move in water and in saturated soil, as scenes.py.

Bounds stood before the runs, but where it says "ours": these are a frame around what was found.
"""

import math

import numpy as np

from scree.results import read_points, read_times

from bed_water_scenes import check_balance
from scene_tools import GRAVITY, WATER, at, check, check_gain, main, nudged_gravity, run


def obstacle_bore(scree, cell=0.1, most_speed=1.07, most_gain=2e-3):
    """A piston at constant speed into still water: the bore has the depth and the speed of the shock relations, and the piston's force is what
    the momentum grows by.

    The bore breaks, and each rounding lets it break in another way. So the momentum's bound is on the median of three runs with gravity changed
    by 1e-6. The bounds of the defaults are ours: four cells deep, and it breaks.
    """
    still, depth, piston = 0.4, 0.8, math.sqrt(0.75 * GRAVITY * 0.4)
    bore = 2 * piston  # speed, from the conservation of mass
    name = "bore, cells of %g m" % cell
    folder = "bore_%g" % cell
    entries = {"Mesh/Cell size": str(cell), "Time step/Maximum time step": "%g" % (0.04 * cell),
               "Water/Volume correction rate": "%g" % (0.5 * math.sqrt(GRAVITY / cell))}
    errors = []
    for nudge in reversed(range(3)):  # The others are looked at in the one with the gravity of the case.
        table = run(scree, "bed/bore", folder,
                    {**entries, "Gravity": nudged_gravity(nudge), "Output/Graphics": "none" if nudge else "points"})
        momentum = table["Momentum x (N s)"]
        given = -table["Obstacle Piston impulse x (N s)"] - WATER * still**2 / 2 * table["Time (s)"]
        errors.append(np.max(np.abs(momentum - given)) / momentum[-1])
    time, work = table["Time (s)"], table["Obstacle Piston work (J)"]
    check_balance(name, table)
    check(name + ": mean force on the piston over that of the depth behind", -np.mean(table["Obstacle Piston force x (N)"][time > 2]) /
          (WATER * depth**2 / 2), 0.97, 1.03)
    check(name + ": momentum less impulses of piston and far wall over momentum, median", np.median(errors), 0, 0.014, 0.01)
    energy = table["Kinetic energy (J)"] + table["Potential energy (J)"]
    check(name + ": energy gained over work of the piston", (energy[-1] - energy[0]) / work[-1], 0.5, 1)
    check_gain(name, table, most_gain, work[-1])
    times, fronts, depths = [], [], []
    for moment in read_times(folder, "water"):
        if moment < 1.99:
            continue
        water = read_points(folder, moment, "water")
        column, faces = np.histogram(water.positions[:, 0], 408, (0, 20.4), weights=water.arrays["volume"].ravel() / 0.05)
        column = np.convolve(column, np.full(20, 1 / 20), "valid")  # in a window of 1 m: the front breaks, and a depth at one place flickers
        middle = faces[10:-10]
        foot = np.nonzero(column > (still + depth) / 2)[0][-1]
        times.append(moment)
        fronts.append(np.interp((still + depth) / 2, column[[foot + 1, foot]], middle[[foot + 1, foot]]))
        behind = 0.4 + np.interp(moment, time, table["Obstacle Piston displacement x (m)"])
        depths.append(np.mean(column[(middle > behind + 0.7) & (middle < fronts[-1] - 1.2)]))
    check(name + ": mean depth behind over that of the shock", np.mean(depths) / depth, 0.97, 1.03)
    check(name + ": speed over that of the shock", np.polyfit(times, fronts, 1)[0] / bore, 0.97, most_speed)


def obstacle_bore_fine(scree):
    """The bore with cells of half the width."""
    obstacle_bore(scree, 0.05, 1.03, 1e-3)


def obstacle_lifted_gate(scree):
    """A gate that holds water, and lets go of it: nothing gets past it before, and the faster it is, the less it changes of the dam break."""
    moments = (0.3, 0.5, 0.8)
    reference = run(scree, "water/dam_break", "reference", {"Output/Statistics interval": "0.01"})
    errors = []
    for speed in (20, 40):
        name = "gate at %d m/s" % speed
        table = run(scree, "bed/gate", "gate", {"Obstacle Gate/Velocity": "0; if(t < 0.1, 0, %d)" % speed})
        closed = (table["Time (s)"] > 0) & (table["Time (s)"] < 0.0999)
        check(name + ": foremost point while it is closed, m", max(table["Water tip (m)"][closed]), 0.98, 1)
        check(name + ": force while it is closed over that of still water",
              np.mean(table["Obstacle Gate force x (N)"][closed]) / (WATER * 2), 0.99, 1.01)
        check_gain(name, table)
        check_balance(name, table)
        errors.append(max(abs(at(table, column, 0.1 + moment) / at(reference, column, moment) - 1) for moment in moments
                          for column in ("Water front 90 % (m)", "Water front 99 % (m)")))
    check("gate at 20 m/s: largest difference of a front from the dam break", errors[0], 0, 0.05)
    check("gate at 40 m/s: over that at 20 m/s", errors[1] / errors[0], 0, 0.7)
    check_gain("gate of the case", run(scree, "bed/gate", "slow", {}))


def obstacle_moving_tank(scree):
    """A tank of water with a cylinder in it, all of which move at the same speed, is a tank at rest. So is one of saturated soil."""
    volume = math.pi * 0.25**2
    for velocity, bound in (("0.5; 0", 0.01), ("0; 0.3", 0.01), ("0.4; 0.3", 0.015)):  # the last is ours
        name = "tank at %s m/s" % velocity
        table = run(scree, "water/hydrostatic", "tank",
                    {"End time": "0.6", "Mesh/Upper corner": "2, 1.6", "Mesh/Cell size": "0.05", "Water/Region": "x > 0.2 && x < 1.4 && y < 1.113",
                     "Water/Initial velocity": velocity,
                     "Obstacle Tank/Type": "free slip", "Obstacle Tank/Velocity": velocity,
                     "Obstacle Tank/Level set expression": "min(min(x - 0.313, 1.313 - x), y - 0.213)",
                     "Obstacle Body/Type": "free slip", "Obstacle Body/Velocity": velocity,
                     "Obstacle Body/Level set expression": "sqrt((x - 0.813)^2 + (y - 0.613)^2) - 0.25"})
        up, weight = table["Obstacle Body force y (N)"], GRAVITY * table["Water mass (kg)"][0]
        check(name + ": mean force upwards on the cylinder over the weight of its water", np.mean(up[1:]) / (WATER * volume), 1 - bound, 1 + bound)
        check(name + ": mean force to the side over it", abs(np.mean(table["Obstacle Body force x (N)"][1:])) / (WATER * volume), 0, bound)
        check(name + ": force of cylinder and tank downwards over the weight", -np.mean((up + table["Obstacle Tank force y (N)"])[1:]) / weight,
              0.99, 1.01)
        check_balance(name, table)
    table = run(scree, "seepage/saturated_rest", "wet_tank",
                {"End time": "0.3", "Mesh/Upper corner": "1.8, 1.2", "Mesh/Cell size": "0.05", "Soil/Region": "x > 0.213 && x < 1.213 && y < 0.83",
                 "Soil/Linear elastic/Young's modulus": "1e6", "Soil/Linear elastic/Poisson's ratio": "0.25",
                 "Soil/Initial velocity": "0.5; 0", "Water/Initial velocity": "0.5; 0", "Boundaries/Bottom": "free slip",
                 "Soil/Initial state/K0": "%.15g" % (1 / 3), "Obstacle Tank/Type": "free slip",
                 "Obstacle Tank/Level set expression": "x - 0.213", "Obstacle Tank/Velocity": "0.5; 0",
                 "Obstacle Wall/Type": "free slip", "Obstacle Wall/Level set expression": "1.213 - x", "Obstacle Wall/Velocity": "0.5; 0"})
    soil = table["Mass (kg)"][0] / 0.83 * GRAVITY
    pores = table["Water mass (kg)"][0] / (1000 * 0.83)
    exact = 0.5 * 0.83**2 * (WATER + (soil - (1 - pores) * WATER) / 3)
    for wall, sign in (("Wall", 1), ("Tank", -1)):
        check("saturated soil between walls that move, %s: force over water and earth pressure" % wall.lower(),
              sign * np.mean(table["Obstacle %s force x (N)" % wall][2:]) / exact, 0.98, 1.02)


def obstacle_suction(scree):
    """A piston that recedes faster than water follows: what p < 0 pulls is in the piston's force and work, so that no energy is made. Without it the
    piston's work lacks 242 of 456 J."""
    table = run(scree, "water/hydrostatic", "suction", {
        "End time": "0.6", "Mesh/Upper corner": "3, 1", "Mesh/Cell size": "0.05", "Water/Region": "y < 0.5 && x < 1.5", "Obstacle Piston/Type": "free slip",
        "Obstacle Piston/Level set expression": "1.5 - x", "Obstacle Piston/Velocity": "2*min(1, t/0.02); 0"})
    check("receding piston: largest suction, Pa", min(table["Smallest p (Pa)"]), -1e5, -5000)
    check_gain("receding piston", table, 0.005, table["Kinetic energy (J)"][-1])


def obstacle_at_wall(scree):
    """Pistons and gates that touch walls of the box: what happens to the water there is what happens far from the walls."""
    entries = {"End time": "0.4", "Mesh/Upper corner": "2, 1", "Mesh/Cell size": "0.05", "Water/Region": "y < 0.5", "Obstacle Piston/Type": "free slip",
               "Obstacle Piston/Velocity": "0.2; 0"}
    for name, at_wall, elsewhere in (("piston that leaves through a wall", "1.9 - x", "1.7 - x"), ("piston that starts at a wall", "x - 0.01", "x - 0.21")):
        table, reference = (run(scree, "water/hydrostatic", "piston", {**entries, "Obstacle Piston/Level set expression": place})
                            for place in (at_wall, elsewhere))
        for column in ("Obstacle Piston impulse x (N s)", "Kinetic energy (J)"):  # no wave comes back within this time
            check(name + ": " + column + " over that of a piston elsewhere", table[column][-1] / reference[column][-1], 0.95, 1.05)
        check_balance(name, table)
    table = run(scree, "water/hydrostatic", "outside", {**entries, "End time": "0.6", "Obstacle Piston/Level set expression": "x + 0.05"})
    check("piston that comes in: force before, N", table["Obstacle Piston force x (N)"][5], 0, 0)
    check("piston that comes in: force later over that of still water", -table["Obstacle Piston force x (N)"][-1] / (WATER * 0.5**2 / 2), 1, 1.3)
    table = run(scree, "water/hydrostatic", "gone", {**entries, "End time": "0.55", "Mesh/Cell size": "0.1", "Obstacle Piston/Level set expression": "1.9 - x"})
    force, dissipation = (np.abs(table["Obstacle Piston " + column]) for column in ("force x (N)", "dissipation (J)"))
    check("piston that has left: largest force over that of still water", force[table["Time (s)"] > 0.501].max() / (WATER * 0.5**2 / 2), 0, 1.3)
    check("piston that has left: dissipation over the work of still water", dissipation.max() / (WATER * 0.5**2 / 2 * 0.1), 0, 0.1)
    table = run(scree, "water/hydrostatic", "gate",
                {**entries, "End time": "0.8", "Water/Region": "x < 0.5 && y < 0.6 || y < 0.4", "Obstacle Piston/Velocity": "0; if(t < 0.5, -0.4, 0)",
                 "Obstacle Piston/Level set expression": "max(abs(x - 1) - 0.1, 0.2 - y)"})
    check("gate that closes: water that is left over that of the start", table["Water mass (kg)"][-1] / table["Water mass (kg)"][0], 1, 1)
    table = run(scree, "water/hydrostatic", "plate",
                {"End time": "0.6", "Mesh/Upper corner": "2, 1.5", "Mesh/Cell size": "0.05", "Water/Region": "x < 0.5 && y > 1.2 - x && y < 1.3",
                 "Obstacle Plate/Type": "free slip", "Obstacle Plate/Level set expression": "(y - 0.5 - x)/sqrt(2)"})
    check("oblique plate at a wall: water that is left over that of the start", table["Water mass (kg)"][-1] / table["Water mass (kg)"][0], 1, 1)


if __name__ == "__main__":
    main(globals())
