# SPDX-License-Identifier: LGPL-2.1-or-later
"""layers.py SCREE LAUNCHER TEST: layers that a slide takes along: the load that sets them in motion.

Each test is a function below (case_tools.py).
"""

import sys

import numpy as np

from scree.results import read_points
from scree.variants import set_entries

from case_tools import HERE, check, run

CASE = (HERE.parent.parent / "prm" / "slopes" / "entrainment.prm").read_text(encoding="utf-8")
DENSITY, STRENGTH, DOWNHILL = 1590., 6e3, 4.1459  # kg/m^3, Pa, m/s^2 along the slope


def threshold():
    """A slab on a layer of clay s_u: it rests below s_u/(rho g sin) and moves with g sin - s_u/(rho H) above, here 0.91 m and 1.63 m/s^2."""
    slab = {"Output directory": "results", "End time": 1, "Output/Interval": 1}
    for height, cell in ((0.87, "0.25"), (1.5, "0.125")):
        results = run(f"slab_{height}", set_entries(CASE, {**slab, "Slide/Region": f"x < 40 && y > 0.5 && y < {height}", "Mesh/Cell size": cell}))
        points = read_points(results)
        velocity = next(values for name, values in points.arrays.items() if name.startswith("velocity"))[:, 0]
        x, y = points.positions[:, 0], points.positions[:, 1]
        speed = np.mean(velocity[(x > 15) & (x < 25) & (y > 0.5)])
        exact = max(0., DOWNHILL - STRENGTH / (DENSITY * height))
        print(f"H = {height} m: {speed:.4f} m/s after 1 s, exact {exact:.4f}")
        check(abs(speed) <= 0.01 if exact == 0 else abs(speed / exact - 1) <= 0.1, f"H = {height} m: {speed} m/s, exact {exact}")


{"threshold": threshold}[sys.argv[3]]()
