# SPDX-License-Identifier: LGPL-2.1-or-later
"""obstacle_scenes.py SCREE SCENE: scenes with obstacles, at rest and moving, as scenes.py.

Bounds are from closed forms and from the same physics without the obstacle: they stood before the runs did.
"""

import math
import os

import numpy as np

from scene_tools import GRAVITY, NO_STRESS, ROOT, at, check, check_gain, check_momentum, largest_fall, main, run


def check_energy(name, table, gain=1e-3):
    """Momentum to rounding, no energy from nothing; released is what gravity and the obstacles' motion give, and what was in motion."""
    check_momentum(name, table)
    work = sum(np.ptp(values) for column, values in table.items() if column.startswith("Obstacle") and column.endswith("work (J)"))
    check_gain(name, table, gain, np.ptp(table["Potential energy (J)"]) + work + table["Kinetic energy (J)"][0])


def obstacle_impact(scree):
    """A block flies against a smooth wall, oblique to the cells or not: what it loses of its momentum the wall gets, and nothing along it."""
    for angle in (0, 27):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        table = run(scree, "bed/piston", "impact",
                    {"End time": "0.15", "Gravity": "0, 0", "Mesh/Upper corner": "2, 1.5", "Transfer/PIC rate": "0",
                     "Obstacle Piston/Level set expression": "(1.113 - x)*%.15g + (0.7 - y)*%.15g" % (c, s),
                     "Obstacle Piston/Velocity": "", "Boundaries/Bottom": "free slip",
                     "Soil/Region": "x > 0.3 && x < 0.7 && y > 0.5 && y < 0.9", "Soil/Initial velocity": "5; 0",
                     **NO_STRESS, "Output/Statistics interval": "0.002"})
        momentum = np.array([table["Momentum %s (N s)" % a] for a in "xy"])
        impulse = np.array([table["Obstacle Piston impulse %s (N s)" % a] for a in "xy"])
        name = "impact, %d degrees" % angle
        loss = np.max(np.abs(momentum - momentum[:, :1] + impulse)) / momentum[0, 0]
        check(name + ": momentum lost less impulse on the wall", loss, 0, 1e-9)
        check(name + ": impulse on the wall over momentum before", impulse[:, -1] @ (c, s) / (momentum[0, 0] * c), 1, 2)
        check(name + ": impulse along the smooth wall", abs(impulse[:, -1] @ (-s, c)) / momentum[0, 0], 0, 1e-12)
        sum_of_forces = np.sum(table["Obstacle Piston force x (N)"][1:] * np.diff(table["Time (s)"]))
        check(name + ": sum of force times time over the impulse", sum_of_forces / impulse[0, -1], 1 - 1e-9, 1 + 1e-9)
        energy = table["Kinetic energy (J)"] + table["Elastic energy (J)"]
        check(name + ": energy made over that of the start", max(energy) / energy[0] - 1, -1, 1e-3)
        check(name + ": energy that the wall gives back over it", largest_fall(table["Obstacle Piston dissipation (J)"]) / energy[0], 0, 1e-3)


def obstacle_pressure(scree):
    """An elastic layer at rest beside a smooth wall presses on it with K0 g rho y, so that force and moment are known."""
    height, ratio = 0.4, 0.3
    coefficient = ratio / (1 - ratio)
    for offset in (0, 0.37):
        wall = 1 + offset * 0.05
        table = run(scree, "bed/piston", "pressure",
                    {"End time": "0.5", "Obstacle Piston/Level set expression": "%.15g - x" % wall, "Obstacle Piston/Velocity": "",
                     "Obstacle Piston/Moment about": "%.15g, 0" % wall, "Boundaries/Bottom": "free slip",
                     "Soil/Region": "x < %.15g && y < %g" % (wall, height), "Soil/Initial state/K0": "%.15g" % coefficient})
        force = np.mean(table["Obstacle Piston force x (N)"][1:])
        moment = np.mean(table["Obstacle Piston moment z (N m)"][1:])
        exact = coefficient * 1500 * GRAVITY * height**2 / 2
        name = "pressure of a layer at rest, offset %g" % offset
        check(name + ": force over the exact one", force / exact, 0.98, 1.02)
        check(name + ": height of the force over a third", -moment / force / (height / 3), 0.95, 1.05)


def obstacle_piston(scree):
    """A block that a piston pushes at a constant speed moves with it; the piston's work is what friction takes."""
    table = run(scree, "bed/piston", "piston", {"Output/Statistics interval": "0.005"})
    time, mass = table["Time (s)"], table["Mass (kg)"][0]
    late = time >= 0.5 - 1e-9
    speed = table["Momentum x (N s)"] / mass
    check("piston: mean speed of the block over the piston's", np.trapz(speed[late], time[late]) / 0.5 / 0.5, 0.999, 1.001)
    check("piston: its way, m", table["Obstacle Piston displacement x (m)"][-1], 0.475 - 1e-9, 0.475 + 1e-9)
    force = -np.mean(table["Obstacle Piston force x (N)"][late])
    check("piston: mean force over friction", force / (math.tan(math.radians(20)) * mass * GRAVITY), 0.999, 1.001)
    work = table["Obstacle Piston work (J)"]
    check("piston: mean power over force times speed", (work[-1] - work[late][0]) / 0.5 / (force * 0.5), 0.99, 1.01)
    check_energy("piston", table)


def obstacle_gate(scree):
    """A column behind a gate that is gone at once comes to rest as one without; behind one that lifts slowly it stays behind at first."""
    entries = {"Bed/Profile": os.path.join(ROOT, "prm", "bed", "incline.csv"), "End time": "2.5", "Mesh/Upper corner": "6, 2.5",
               "Soil/Region": "x < 1 && y < 1.5"}
    gate = {"Obstacle Gate/Type": "free slip", "Obstacle Gate/Level set expression": "max(abs(x - 1.15) - 0.15, 0.35 - y)"}
    without = run(scree, "bed/column_on_incline", "without", entries)
    gates = {}  # tables by the gate's speed
    for speed in (10, 1):
        gates[speed] = run(scree, "bed/column_on_incline", "gate", {**entries, **gate, "Obstacle Gate/Velocity": "0; %g" % speed})
        check_energy("gate at %g m/s" % speed, gates[speed])
    for column in ("Front 90 % (m)", "Front 99 % (m)"):
        check("fast gate: %s at rest over that without a gate" % column, gates[10][column][-1] / without[column][-1], 0.99, 1.01)
        check("slow gate: %s at 1 s over that without a gate" % column, at(gates[1], column, 1) / at(without, column, 1), 0.5, 0.99)


def obstacle_wall(scree):
    """A slide hits a wall: impulses on all that holds it are the loss of momentum; at the end it rests and presses on."""
    table = run(scree, "bed/flow_against_wall", "wall", {})
    check_energy("wall", table)
    force = table["Obstacle Wall force x (N)"]
    weight = table["Mass (kg)"][0] * GRAVITY
    check("wall: largest force over the weight", max(force) / weight, 0.1, 3)
    check("wall: force at the end over the weight", force[-5:].mean() / weight, 0.01, 0.3)
    check("wall: smallest force", min(force), 0, max(force))
    # Those of doc/tutorials/barrier.md, N and m, within a tenth.
    time = table["Time (s)"]
    rest = time > time[-1] - 0.305
    lever = -table["Obstacle Wall moment z (N m)"][rest].sum() / force[rest].sum()
    check("wall: largest force after 1.45 s, N", max(force[time > 1.45]), 0.9 * 1920, 1.1 * 1920)
    check("wall: force of the deposit, N", force[rest].mean(), 0.9 * 1610, 1.1 * 1610)
    check("wall: its height, m", lever, 0.9 * 0.126, 1.1 * 0.126)
    # Nothing pulls the wall back.
    check("wall: vertical force on the smooth wall", max(map(abs, table["Obstacle Wall force y (N)"])), 0, 1e-9 * weight)


def obstacle_slit(scree):
    """A slide through a slit in 3D: both piers bear the same, and no more passes than without them."""
    table = run(scree, "bed/slit_dam", "slit", {})
    check_energy("slit dam", table)
    front, back = (table["Obstacle %s pier impulse x (N s)" % side][-1] for side in ("Front", "Back"))
    # Clipped seeds are no mirror images: 1e-4 of the momentum goes across the channel after .1 s, and grains make more of it.
    check("slit dam: impulses of the piers, one over the other", front / back, 0.99, 1.01)
    across = [table["Obstacle %s pier impulse y (N s)" % side][-1] for side in ("Front", "Back")]
    check("slit dam: impulses across the channel cancel, over those along it", abs(sum(across)) / front, 0, 1e-2)


if __name__ == "__main__":
    main(globals())
