# SPDX-License-Identifier: LGPL-2.1-or-later
"""layers.py SCREE LAUNCHER TEST: layers of several soils: the load that sets them in motion, the stress at their interfaces.

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


def column(name, bodies):
    """Height (m) and fields of points that settle from no stress, of bodies {name: (region, Young's modulus)}."""
    soil = {"Points per cell": 3, "Material": "Mohr-Coulomb", "Initial porosity": 0.4, "Mohr-Coulomb/Poisson's ratio": 0.3,
            "Mohr-Coulomb/Friction angle": 30, "Mohr-Coulomb/Cohesion": 1e6, "Mohr-Coulomb/Dilation angle": 0}
    case = {"Bodies": ", ".join(bodies), "End time": 0.02, "Mesh/Upper corner": "0.5, 2.5", "Mesh/Cell size": 0.25,
            "Settling/Maximum time": 10, "Output/Interval": 0.02}
    for body, (region, modulus) in bodies.items():
        case |= {f"{body}/Region": region, f"{body}/Mohr-Coulomb/Young's modulus": modulus}
        case |= {f"{body}/{entry}": value for entry, value in soil.items()}
    points = read_points(run(name, case))
    return points.positions[:, 1], points.arrays


def interface():
    """p' within a cell of an interface that lies on a face or in the middle of a cell, K0 times the weight above, is met within 20 %."""
    for height in (1., 1.125):
        for moduli in ((6e6, 2e6), (2e7, 2e6), (2e6, 2e7)):
            layers = {"Low": (f"y < {height}", moduli[0]), "Up": (f"y > {height} && y < 2", moduli[1])}
            y, arrays = column(f"column_{height}_{moduli[0]:g}_{moduli[1]:g}", layers)
            above = np.array([arrays["mass"][y > level].sum() for level in y]) * 9.81 / 0.5
            exact = above * (1 + 2 * 0.3 / 0.7) / 3
            near = abs(y - height) < 0.25
            error = np.sqrt(np.mean((arrays["mean_effective_stress"] - exact)[near] ** 2)) / np.mean(exact[near])
            print(f"interface at {height} m, moduli {moduli}: {error:.3f}")
            check(error <= 0.2, f"interface at {height} m, moduli {moduli}: p' differs by {error}")


{"interface": interface, "threshold": threshold}[sys.argv[3]]()
