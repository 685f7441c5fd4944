# SPDX-License-Identifier: LGPL-2.1-or-later
"""law_scenes.py SCREE SCENE: laws of the soil in motion, as scenes.py: dry grains that flow down planes, against closed forms (gravity is
inclined, so that the plane is a wall of the box), clay with and without a strength that falls with strain, clay with an undrained
strength, and mud."""

import math

import numpy as np

from scree.results import read_points, read_table

from scene_tools import GRAVITY, NO_STRESS, check, check_balances, largest_fall, main, mean_load, run


def gravity_down(degrees):
    """Entries of gravity down a plane: its part normal to the plane is "Gravity", which a start with K0 knows."""
    return {"Gravity": "0, %.9g" % (-GRAVITY * math.cos(math.radians(degrees))), "Body force": "%.9g; 0" % (GRAVITY * math.sin(math.radians(degrees)))}


def bagnold_flow(scree):
    """A layer with mu(I) flows down a plane steadily: u(y) = 2/3 I/d sqrt(phi g cos(theta)) (H^1.5 - (H - y)^1.5), with mu(I) = tan(theta) (Jop et al.
    2006). The part of a long layer that waves from its ends do not reach keeps that profile; without mu(I) its speed would grow by two fifths."""
    height, diameter, porosity, slow, increase, reference, slope, time, cell = 0.1, 0.0125, 0.4, math.sin(math.radians(30)), 0.26, 0.3, 32., 0.5, 0.1 / 16
    number = reference / (increase / (math.tan(math.radians(slope)) - slow) - 1)
    factor = 2 / 3 * number / diameter * math.sqrt((1 - porosity) * GRAVITY * math.cos(math.radians(slope)))

    def exact(y):
        return factor * (height ** 1.5 - np.maximum(height - y, 0.) ** 1.5)

    way = exact(height) * time
    run(scree, "columns/mohr_coulomb_collapse", "bagnold", {
        "Mesh/Upper corner": "%.9g, 0.125" % (math.ceil((1.5 + 2 * way) / cell) * cell), "Mesh/Cell size": cell, **gravity_down(slope),
        "End time": time, "Output/Graphics": "points", "Output/Interval": time, "Soil/Region": "x < %g && y < %g" % (1.2 + way, height),
        "Soil/Points per cell": "3", "Soil/Mohr-Coulomb/Grain diameter": diameter, "Soil/Initial state/K0": "1",
        "Soil/Initial velocity": "%.9g*(%.9g - (%g - y)^1.5); 0" % (factor, height ** 1.5, height), "Transfer/PIC rate": "0"})
    points = read_points("bagnold")
    middle = np.abs(points.positions[:, 0] - 1.05) < 0.1
    profile = exact(points.positions[middle, 1])
    error = points.arrays["velocity"][middle, 0] - profile
    check("flow down a plane: mean velocity over the exact one", 1 + np.mean(error) / np.mean(profile), 0.99, 1.01)
    check("flow down a plane: RMS deviation over the mean", np.sqrt(np.mean(error ** 2)) / np.mean(profile), 0, 0.02)


def savage_hutter_cap(scree):
    """A parabolic cap slides down a plane and spreads (Savage & Hutter 1989): centre by gravity less friction, half-length by L'' = 2 k g cos(zeta) H0 L0/L^2
    in the active state. Their k lacks a term of the order of H/L, which k - tan(delta)^2 has."""
    slope, friction, internal, height, time = 32., 22., 30., 0.075, 1.
    tangent, cosine = math.tan(math.radians(friction)), math.cos(math.radians(internal))
    active = 2 / cosine ** 2 * (1 - math.sqrt(1 - cosine ** 2 * (1 + tangent ** 2))) - 1
    half, rate, steps = 1., 0., 100000
    for _ in range(steps):
        rate += time / steps * 2 * (active - tangent ** 2) * GRAVITY * math.cos(math.radians(slope)) * height / half ** 2
        half += time / steps * rate
    way = 0.5 * GRAVITY * (math.sin(math.radians(slope)) - tangent * math.cos(math.radians(slope))) * time ** 2
    table = run(scree, "columns/mohr_coulomb_collapse", "cap", {
        "Mesh/Upper corner": "4.5, 0.1", "Mesh/Cell size": "0.0125", "Gravity": "%.9g, %.9g" % (
            GRAVITY * math.sin(math.radians(slope)), -GRAVITY * math.cos(math.radians(slope))), "End time": time, "Output/Graphics": "points",
        "Output/Interval": time, **NO_STRESS, "Soil/Region": "y < %g*(1 - (x - 1.25)^2)" % height, "Soil/Points per cell": "3",
        "Soil/Mohr-Coulomb/Friction angle": internal, "Boundaries/Bottom": "friction %g" % friction, "Transfer/PIC rate": "0"})
    points = read_points("cap")
    mass, x = points.arrays["mass"], points.positions[:, 0]
    centre = np.average(x, weights=mass)
    check("cap: way of the centre over that of a rigid block", (centre - 1.25) / way, 0.99, 1.01)
    check("cap: half-length over the closed form", math.sqrt(5 * np.average((x - centre) ** 2, weights=mass)) / half, 0.985, 1.015)
    check_balances("cap", table)


def biaxial(scree):
    """With a length of at least two cells, the load at 1 % does not depend on the cells; without one it falls with them (study shear_bands)."""
    loads = {}
    for cell in (0.1, 0.05):
        name = "cells of %g m" % cell
        table = run(scree, "softening/biaxial", "biaxial", {"Mesh/Cell size": cell, "Soil/Mohr-Coulomb/Nonlocal length": 0.2,
                                                             "Output/Statistics interval": "0.005", "End time": "0.57"})
        loads[cell] = mean_load(table)
        check(name + ": largest load over 2 c, kPa", np.max(table["Obstacle Platen force y (N)"]) / 4e4, 0.97, 1.02)
        check(name + ": energy made over work of the platen",
              largest_fall(table["Numerical dissipation (J)"]) / table["Obstacle Platen work (J)"][-1], 0, 5e-3)
    check("load at 1 %, small over large cells", loads[0.05] / loads[0.1], 0.98, 1.02)


def vertical_cut(scree):
    """A vertical cut in clay of strength s_u whose weight grows slowly falls at gamma H = 3.776 s_u, where the bounds of limit analysis meet."""
    table = run(scree, "slopes/vertical_cut", "cut", {})
    time = table["Time (s)"]
    falls = np.min(time[(time > 2.3) & (table["Kinetic energy (J)"] > 2)], initial=np.inf)
    check("gamma H/s_u as it falls, over 3.776", 2000 * (8 + 0.5 * (falls - 2)) * 2 / 1e4 / 3.776, 0.96, 1.04)


TRESCA = {"Soil/Material": "Tresca", "Soil/Tresca/Young's modulus": "1e7", "Soil/Tresca/Poisson's ratio": "0.3", "Soil/Tresca/Undrained strength": "20e3",
          "Soil/Tresca/Tension cut-off": "20e3", "Soil/Tresca/Sensitivity": "4", "Soil/Tresca/Remoulding strain": "0.15", "Output/Statistics interval": "0.005", "End time": "0.57",
          "Weak/Material": "Tresca", "Weak/Tresca/Young's modulus": "1e7", "Weak/Tresca/Poisson's ratio": "0.3", "Weak/Tresca/Undrained strength": "5e3",
          "Weak/Tresca/Tension cut-off": "5e3"}


def clay_biaxial(scree):
    """The load at 1 % is that of Mohr-Coulomb with the same fall and length, which does not depend on the cells (biaxial)."""
    table = run(scree, "softening/biaxial", "biaxial", {"Mesh/Cell size": 0.1, "Soil/Tresca/Nonlocal length": 0.2, **TRESCA})
    check("energy made over work of the platen", largest_fall(table["Numerical dissipation (J)"]) / table["Obstacle Platen work (J)"][-1], 0, 5e-3)
    other = run(scree, "softening/biaxial", "mohr_coulomb", {"Mesh/Cell size": 0.1, "Soil/Mohr-Coulomb/Nonlocal length": 0.2, "Output/Statistics interval": "0.005", "End time": "0.57"})
    check("load at 1 % over that of Mohr-Coulomb", mean_load(table) / mean_load(other), 0.999, 1.001)


def submerged_columns(scree):
    """Columns of beads in a viscous liquid (Rondon et al. 2011): the liquid takes over the weight of loose grains, and suction holds dense ones
    (measured: +133 and -126 Pa at 1.1 s). Bounds on the front frame the value found, 14.6 cm (measured: 16.3 cm)."""
    hydrostatic = 1010 * GRAVITY * (0.07 - 0.002)
    for kind, time, least, most in (("loose", 0.64, 100, 250), ("dense", 0.4, -140, -50)):
        name = "submerged_" + kind
        run(scree, "columns/" + name, name, {"End time": time})
        base = read_table(name + "/probe_base.csv")
        late = base["Time (s)"] > 0.8 * time
        check("%s column: excess pressure at the base, Pa" % kind, np.mean(base["Pore pressure (Pa)"][late]) - hydrostatic, least, most)
        front = read_table(name + "/probe_front.csv")["Front (m)"][-1]
        check("%s column: front (ours), m" % kind, front, *((0.141, 0.151) if kind == "loose" else (0.059, 0.066)))


def mud_layer(scree):
    """Mud on a plane, far from its ends: velocity and thickness of the plug, and the profile below it."""
    run(scree, "clay/mud", "mud", {"Output/Graphics": "points", "Output/Interval": 3})
    points = read_points("mud")
    height, pull, plug = 2., 1500 * 9.81 * math.sin(math.radians(15)), 6e3 / (1500 * 9.81 * math.sin(math.radians(15)))
    middle = np.abs(points.positions[:, 0] - 100) < 20
    y, u = points.positions[middle, 1], points.arrays["velocity"][middle, 0]
    exact = pull / 2e3 / 2 * ((height - plug) ** 2 - np.maximum(height - plug - y, 0.) ** 2)
    check("velocity of the plug over the exact one", np.mean(u[y > 1]) / np.max(exact), 0.97, 1.03)
    check("profile: RMS deviation over the RMS", np.sqrt(np.mean((u - exact) ** 2) / np.mean(exact ** 2)), 0, 0.04)


if __name__ == "__main__":
    main(globals())
