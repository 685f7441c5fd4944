#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""wet_slab_map.py SCREE: the saturated slab of scene wet_slab over cohesion, stiffness, conductivity, slope and Courant number.

Prints a row for each run and the worst of each bound; writes runs into the working folder. Speed is that after 0.3 s, over
g (sin s - tan 25 cos s) 0.3 s, which friction leaves with p = 0.
"""

import itertools
import math
import sys

import numpy as np

from scene_tools import largest_fall, run
from water_scenes import wet_slab_entries

GRAVITY = 9.81
COURANTS = (0.9, 0.3, 0.1)


def speed_and_gain(scree, cohesion, modulus, conductivity, slope, courant):
    angle = math.radians(slope)
    entries = wet_slab_entries(0.1, courant)
    entries["Soil/Region"] = entries["Soil/Region"].format("y", "0")
    entries.update({"Gravity": "%.12g, %.12g" % (GRAVITY * math.sin(angle), -GRAVITY * math.cos(angle)),
                    "Boundaries/Bottom": "friction 25", "Soil/Material": "Mohr-Coulomb",
                    "Soil/Mohr-Coulomb/Young's modulus": "%g" % modulus, "Soil/Mohr-Coulomb/Friction angle": "25",
                    "Soil/Mohr-Coulomb/Cohesion": "%g" % cohesion, "Water/Hydraulic conductivity": "%g" % conductivity})
    table = run(scree, "saturated_rest", "map", entries)
    mass = table["Mass (kg)"][-1] + table["Water mass (kg)"][-1]
    slowest = 0.3 * GRAVITY * (math.sin(angle) - math.tan(math.radians(25)) * math.cos(angle))
    gain = largest_fall(table["Numerical dissipation (J)"]) / np.ptp(table["Potential energy (J)"])
    return table["Momentum x (N s)"][-1] / mass / slowest, gain


def main(scree):
    slowest, spread, gain = math.inf, 0., 0.
    for case in itertools.product((5e3, 20e3), (1e6, 1e7), (1e-6, 1e-3), (30, 35, 45)):
        runs = [speed_and_gain(scree, *case, courant) for courant in COURANTS]
        speeds = [speed for speed, _ in runs]
        print("c %g Pa, E %g Pa, k %g m/s, %g degrees: speed " % case + ", ".join("%.3f" % speed for speed in speeds), flush=True)
        slowest, spread = min(slowest, *speeds), max(spread, max(speeds) / max(min(speeds), 1e-3) - 1)
        gain = max(gain, *(one for _, one in runs))
    print("worst: speed %.3f, difference between Courant numbers %.1f %%, gain of energy %.2g of that released" % (slowest, 100 * spread, gain))


if __name__ == "__main__":
    main(sys.argv[1])
