# SPDX-License-Identifier: LGPL-2.1-or-later
"""clay_scenes.py SCREE SCENE: clay with an undrained strength, and mud, as scenes.py."""

import math

import numpy as np

from scree.results import read_points

from scene_tools import check, largest_fall, main, mean_load, run

TRESCA = {"Soil/Material": "Tresca", "Soil/Tresca/Young's modulus": "1e7", "Soil/Tresca/Poisson's ratio": "0.3", "Soil/Tresca/Undrained strength": "20e3",
          "Soil/Tresca/Tension cut-off": "20e3", "Soil/Tresca/Sensitivity": "4", "Soil/Tresca/Remoulding strain": "0.15", "Output/Statistics interval": "0.005", "End time": "0.57",
          "Weak/Material": "Tresca", "Weak/Tresca/Young's modulus": "1e7", "Weak/Tresca/Poisson's ratio": "0.3", "Weak/Tresca/Undrained strength": "5e3",
          "Weak/Tresca/Tension cut-off": "5e3"}


def clay_biaxial(scree):
    """The load at 1 % is that of Mohr-Coulomb with the same fall and length, which does not depend on the cells (softening_scenes.py)."""
    table = run(scree, "softening/biaxial", "biaxial", {"Mesh/Cell size": 0.1, "Soil/Tresca/Nonlocal length": 0.2, **TRESCA})
    check("energy made over work of the platen", largest_fall(table["Numerical dissipation (J)"]) / table["Obstacle Platen work (J)"][-1], 0, 5e-3)
    check("unresolved returns", table["Unresolved"][-1], 0, 0)
    other = run(scree, "softening/biaxial", "mohr_coulomb", {"Mesh/Cell size": 0.1, "Soil/Mohr-Coulomb/Nonlocal length": 0.2, "Output/Statistics interval": "0.005", "End time": "0.57"})
    check("load at 1 % over that of Mohr-Coulomb", mean_load(table) / mean_load(other), 0.999, 1.001)


def mud_layer(scree):
    """Mud on a plane, far from its ends: velocity and thickness of the plug, and the profile below it."""
    table = run(scree, "clay/mud", "mud", {"Output/Graphics": "points", "Output/Interval": 3})
    points = read_points("mud")
    height, pull, plug = 2., 1500 * 9.81 * math.sin(math.radians(15)), 6e3 / (1500 * 9.81 * math.sin(math.radians(15)))
    middle = np.abs(points.positions[:, 0] - 100) < 20
    y, u = points.positions[middle, 1], points.arrays["velocity"][middle, 0]
    exact = pull / 2e3 / 2 * ((height - plug) ** 2 - np.maximum(height - plug - y, 0.) ** 2)
    check("velocity of the plug over the exact one", np.mean(u[y > 1]) / np.max(exact), 0.97, 1.03)
    check("profile: RMS deviation over the RMS", np.sqrt(np.mean((u - exact) ** 2) / np.mean(exact ** 2)), 0, 0.04)
    check("unresolved returns", table["Unresolved"][-1], 0, 0)


main(globals())
