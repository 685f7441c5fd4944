# SPDX-License-Identifier: LGPL-2.1-or-later
"""flow_scenes.py SCREE SCENE: dry grains that flow down planes, against closed forms. Gravity is inclined, so that the plane is a wall of the box."""

import math

import numpy as np

from scree.results import read_points

from scene_tools import NO_STRESS, check, check_balances, main, run

GRAVITY = 9.81


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


main(globals())
