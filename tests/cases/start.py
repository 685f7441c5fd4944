# SPDX-License-Identifier: LGPL-2.1-or-later
"""start.py SCREE LAUNCHER TEST: what a run begins with, against closed forms: points, stress and pressure, measures.

Each test is a function below (case_tools.py).
"""

import sys

import numpy as np

from scree.results import read_points, read_statistics

from case_tools import check, run

PLANE = {"End time": 1e-9, "Output/Graphics": "points", "Mesh/Cell size": 0.1, "Soil/Points per cell": 2, "Soil/Material": "linear elastic", "Soil/Initial porosity": 0.4,
         "Soil/Grain density": 2650, "Water/Points per cell": 2, "Water/Density": 1025, "Transfer/Method": "TPIC"}
SPACE = {"Dimension": 3, "Gravity": "0, 0, -9.81", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "1, 1, 1"}


def begun(name, entries, ranks=1):
    """The run folder of a case that ends at once, in the plane or in space; it has water if the water has a region."""
    case = {**PLANE, **(SPACE if "z" in "".join(str(value) for value in entries.values()) else {}), **entries}
    bodies = entries.get("Bodies", "Soil").split(", ")
    case = {entry: value for entry, value in case.items() if "Water/Region" in entries or not entry.startswith("Water/")}
    soil = {entry.removeprefix("Soil/"): case.pop(entry) for entry in list(case) if entry.startswith("Soil/")}
    return run(name.replace(" ", "_"), {**case, **{f"{body}/{entry}": value for body in bodies if body != "none" for entry, value in soil.items()
                                                   if f"{body}/{entry}" not in case}}, ranks=ranks)


def stress():
    """Pressure is the weight of the water above, in the soil and outside; vertical stress is the weight above less the pressure, horizontal ones are K0 times
    that, shear is none: below level and inclined surfaces, dry, with the water table above and inside the soil, in layers, with gravity along any axis."""
    weight, k0, n = 9.81, 0.683, 0.4
    water, dry, lift = 1025 * weight, (1 - n) * 2650 * weight, (1 - n) * 1025 * weight
    light, dense = 0.2 * 2650 * weight, 0.8 * (2650 - 1025) * weight  # dry soil of porosity 0.8, soil of porosity 0.2 under water
    for name, entries, pressure, vertical, up in (
            ("dry slope", {"Soil/Region": "if(x < 0.4, y < 0.8, y < 1 - 0.5*x)"}, None, lambda x, y, z: dry * (np.where(x < 0.4, 0.8, 1 - 0.5 * x) - y), 1),
            ("dry slope in space", {"Soil/Region": "z < 0.8 - 0.5*x"}, None, lambda x, y, z: dry * (0.8 - 0.5 * x - z), 2),
            # The lower layer rises by a fifth; a layer thinner than a quarter of a cell may be overlooked, so this one does not run out.
            ("dry layers", {"Bodies": "Lower, Upper", "Lower/Region": "y < 0.8 && y < 0.3 + 0.2*x", "Upper/Region": "y < 0.8 && y >= 0.3 + 0.2*x", "Upper/Initial porosity": 0.8}, None,
             lambda x, y, z: dry * np.maximum(0, 0.3 + 0.2 * x - y) + light * (0.8 - np.maximum(y, 0.3 + 0.2 * x)), 1),
            ("pool", {"Bodies": "none", "Water/Region": "y < 0.73"}, lambda x, y, z: water * (0.73 - y), None, 1),
            ("submerged incline", {"Soil/Region": "y < 0.3 + 0.4*x", "Water/Region": "y < 0.9"}, lambda x, y, z: water * (0.9 - y), lambda x, y, z: (dry - lift) * (0.3 + 0.4 * x - y), 1),
            ("water table inside", {"Soil/Region": "y < 0.8", "Water/Region": "y < 0.47"}, lambda x, y, z: water * (0.47 - y), lambda x, y, z: dry * (0.8 - y) - lift * np.maximum(0, 0.47 - y), 1),
            ("saturated layers", {"Bodies": "Lower, Upper", "Lower/Region": "y < 0.4", "Upper/Region": "y >= 0.4 && y < 0.8", "Upper/Initial porosity": 0.2, "Water/Region": "same"},
             lambda x, y, z: water * (0.8 - y), lambda x, y, z: (dry - lift) * np.maximum(0, 0.4 - y) + dense * (0.8 - np.maximum(0.4, y)), 1),
            ("gravity to the right", {"Gravity": "9.81, 0", "Soil/Region": "x > 0.5", "Water/Region": "x > 0.2"}, lambda x, y, z: water * (x - 0.2), lambda x, y, z: (dry - lift) * (x - 0.5), 0),
            ("submerged in space", {"Soil/Region": "z < 0.3 + 0.4*x", "Water/Region": "z < 0.9"}, lambda x, y, z: water * (0.9 - z), lambda x, y, z: (dry - lift) * (0.3 + 0.4 * x - z), 2)):
        start = {} if vertical is None else {"Soil/Initial state/Type": "K0", "Soil/Initial state/K0": k0}
        for ranks in (1, 2) if up == 2 else (1,):
            results = begun(name, {**start, **entries}, ranks)
            if pressure:
                points = read_points(results, 0., "water")
                exact = pressure(*points.positions.T)
                check(np.max(np.abs(points.arrays["pressure"].ravel() - exact)) < 1e-5 * np.max(exact), f"{name}: pressure")
            if vertical:
                points = read_points(results, 0.)
                exact = vertical(*points.positions.T)
                wanted = -exact[:, None] * np.diag([1 if axis == up else k0 for axis in range(3)]).ravel()
                check(np.max(np.abs(points.arrays["stress"].reshape(-1, 9) - wanted)) < 1e-5 * np.max(exact), f"{name}: stress")


def points():
    """A body has the mass of its region, within 0.1 % where its surface is oblique to the lattice or round and exactly where it is not; no point has less than a
    quarter of a cube's volume. Water has the volume of its region outside the soil and of the pores inside, also where the surfaces of both cut the lattice."""
    end = (0.83 - 0.3) / 0.37
    beach = 0.3 * end + 0.37 * end * end / 2 + 0.83 * (1.7 - end)
    half, ball = np.pi * 0.256 / 3, "(x - 0.51)^2 + (y - 0.49)^2 + (z - 0.5)^2 < 0.4^2"
    wide, dry = {"Mesh/Upper corner": "2, 1.5", "Soil/Points per cell": 4, "Water/Points per cell": 4}, {"Soil/Initial porosity": 0}
    for name, entries, soil, water, n_points, bound in (  # volumes, m^3, and numbers of points of both
            ("square", {**wide, **dry, "Soil/Region": "x < 1 && y < 1"}, 1, 0, 1600, 1e-12),
            ("cuboid", {**dry, "Soil/Region": "x < 0.5 && z < 0.5"}, 0.25, 0, 2000, 1e-12),
            ("slope", {**dry, "Mesh/Upper corner": "5, 2.5", "Soil/Points per cell": 4, "Soil/Region": "if(x < 2, y < 2, y < 4 - x)"}, 6, 0, 9640, 1e-3),
            ("disc", {**dry, "Mesh/Upper corner": "1.5, 1.5", "Soil/Points per cell": 4, "Soil/Region": "(x - 0.71)^2 + (y - 0.73)^2 < 0.5^2"}, np.pi / 4, 0, 1284, 1e-3),
            ("ball", {**dry, "Soil/Region": ball}, half, 0, 2340, 1e-3),
            # Two bodies share the cubes on their common face; what one leaves out the other must take.
            ("two bodies", {**wide, **dry, "Bodies": "A, B", "A/Region": "y < 1 && y < 0.3 + 0.37*x", "B/Region": "y < 1 && y >= 0.3 + 0.37*x"}, 2, 0, 3237, 1e-3),
            ("pond", {**wide, "Bodies": "none", "Water/Region": "y < 0.7"}, 0, 1.4, 2240, 1e-12),
            ("pond in soil", {**wide, "Soil/Region": "x < 1 && y < 1", "Water/Region": "y < 0.5"}, 1, 0.7, 3200, 1e-12),
            ("pores", {**wide, "Bodies": "A, B", "A/Region": "x < 1 && y < 1", "B/Region": "x > 1 && y < 0.5", "B/Initial porosity": 0.1, "Water/Region": "same"}, 1.5, 0.45, 4800, 1e-12),
            ("beach", {**wide, "Soil/Region": "y < 0.3 + 0.37*x && y < 1", "Water/Region": "y < 0.83 && x < 1.7"}, None, 0.83 * 1.7 - 0.6 * beach, None, 1e-3),
            ("tight pores", {"Soil/Region": "y < 0.5", "Soil/Initial porosity": 0.01, "Soil/Points per cell": 4, "Water/Points per cell": 4, "Water/Region": "same"}, 0.5, 0.005, 1600, 1e-12),
            ("sunken ball", {"Soil/Region": ball, "Soil/Initial porosity": 0.2, "Water/Region": "z < 2"}, half, 1 - 0.8 * half, 10340, 1e-3)):
        for ranks in (1, 2) if name in ("beach", "ball") else (1,):
            results = begun(name, entries, ranks)
            first = {column: values[0] for column, values in read_statistics(results).items()}
            found = first.get("Points", 0) + first.get("Water points", 0)
            check(n_points in (None, found), f"{name}, {ranks} ranks: {found} points")
            wet = first.get("Water mass (kg)", 0) / 1025
            check(abs(wet - water) <= bound * max(water, 1e-9), f"{name}: {wet} m^3 of water, not {water}")
            if soil:
                sets = read_points(results, 0.)
                volume = sets.arrays["volume"].ravel().astype(float)
                solid = np.unique(np.round(sets.arrays["mass"].ravel() / volume, 1))
                check(abs(np.sum(volume) / soil - 1) <= max(bound, 1e-6), f"{name}: {np.sum(volume)} m^3 of soil, not {soil}")  # pictures have single precision
                check(len(solid) > 1 or abs(first["Mass (kg)"] / (soil * solid[0]) - 1) < max(bound, 1e-6), f"{name}: {first['Mass (kg)']} kg")
                cube = (0.1 / entries.get("Soil/Points per cell", 2))**(3 if np.ptp(sets.positions[:, 2]) else 2)
                check(np.min(volume) > 0.2499 * cube, f"{name}: a sliver of {np.min(volume)} m^3 stands by itself")


def measures():
    """Fronts are the places of points below which so much of the mass lies; the stress oscillation of 0 and 2 Pa in turns of points, and of cells."""
    first = read_statistics(begun("fronts", {"Mesh/Upper corner": "1.2, 1.2", "Bodies": "A, B", "A/Region": "x > 0.1 && x < 0.5 && y < 0.3", "B/Region": "x > 0.5 && x < 0.8 && y < 0.3"}))
    for part in (90, 99, 99.5):
        check(abs(first[f"Front {part:g} % (m)"][0] - 0.1 - 0.7 * part / 100) <= 0.0251, f"front of {part} %: {first[f'Front {part:g} % (m)'][0]} m")
    first = read_statistics(begun("tie", {"Soil/Region": "x < 0.5 && y < 0.3"}))["Front 90 % (m)"][0]  # the ninth of ten columns has it exactly
    check(abs(first - 0.425) < 1e-9, f"front of 90 % of ten columns: {first} m")
    for axes, width, wanted in ((2, 0.05, 1), (2, 0.1, 1.04492), (3, 0.05, 1), (3, 0.1, 0.985881)):
        turns = "*".join(f"sin(pi*({axis})/{width})" for axis in "xyz"[:axes])
        found = read_statistics(begun(f"turns of {width} in {axes}", {
            "Mesh/Upper corner": ", ".join(axes * ["1.2"]), "Bodies": "A, B", "A/Region": f"x > 0.2 && y < 0.8 && {turns} > 0", "B/Region": f"x > 0.2 && y < 0.8 && {turns} < 0",
            "A/Initial state/Type": "isotropic", "A/Initial state/Pressure": 2, "A/Initial porosity": 0, "B/Initial porosity": 0}))["Stress oscillation (-)"][0]
        check(abs(found - wanted) < 1e-5, f"oscillation of turns of {width} m in {axes} dimensions: {found}, not {wanted}")


globals()[sys.argv[3]]()
