# SPDX-License-Identifier: LGPL-2.1-or-later
"""layers.py SCREE LAUNCHER TEST: layers that a slide takes along: the balance of their volume, and the load that sets them in motion.

Each test is a function below (case_tools.py).
"""

import sys

import numpy as np

from scree.results import read_points, read_raster
from scree.scour import scour, write
from scree.variants import set_entry

from case_tools import HERE, check, run

CASE = (HERE.parent.parent / "prm" / "slopes" / "entrainment.prm").read_text(encoding="utf-8")
DENSITY, STRENGTH, DOWNHILL = 1590., 6e3, 4.1459  # kg/m^3, Pa, m/s^2 along the slope


def changed(**entries):
    text = set_entry(CASE, "Output directory", "results")
    for name, value in entries.items():
        text = set_entry(text, name.replace("__", "/").replace("_", " "), value)
    return text


def balance():
    """What a slide takes from a layer is what is laid down elsewhere, on one rank and two; nothing leaves the box."""
    text = changed(Mesh__Cell_size="0.5", End_time="3", Output__Interval="3", Layer__Points_per_cell="2", Slide__Points_per_cell="2")
    found = []
    for ranks in (1, 2):
        results = run(f"balance_{ranks}", text, ranks=ranks)
        path, one = write(results, "Layer")
        print(f"{ranks} ranks: {one.start} m^3/m, taken {one.taken}, laid down {one.laid_down}, left {one.left}")
        check(abs(one.start / 20 - 1) <= 1e-6, f"volume at the start: {one.start}")
        check(one.taken > 1. and path.exists(), f"the slide takes {one.taken} m^3/m of 20")
        check(abs(one.left) <= 1e-6 * one.start and abs(one.taken - one.laid_down - one.left) <= 1e-6 * one.start, "balance")
        found.append(np.nan_to_num(one.raster.values))
    check(np.max(np.abs(found[1] - found[0])) <= 1e-4, f"two ranks: {np.max(np.abs(found[1] - found[0]))}")


def space():
    """In 3D: half of a layer leaves the box; the raster has the scour at its place, and none of the body at rest."""
    block = """
set Dimension = 3
set Bodies = Slide, Layer
set Gravity = 0, 0, 0
set End time = 0.1
set Output directory = results
subsection Mesh
  set Lower corner = 0, 0, 0
  set Upper corner = 1.2, 0.8, 0.8
  set Cell size    = 0.1
end
subsection Boundaries
  set Right = open
end
subsection Slide
  set Region = x < 0.2 && z > 0.4 && z < 0.6
  set Points per cell = 2
end
subsection Layer
  set Region = x > 0.6 && x < 1.2 && z > 0.2 && z < 0.4
  set Points per cell = 2
  set Initial velocity = 3; 0; 0
end
subsection Output
  subsection Maps
    set Write = true
  end
end
"""
    results = run("space", block)
    path, one = write(results, "Layer")
    print(f"{one.start} m^3, taken {one.taken}, laid down {one.laid_down}, left {one.left}")
    check(abs(one.start - 0.096) <= 1e-6 and abs(one.left - 0.048) <= 1e-6 and abs(one.taken - 0.048) <= 1e-5, "volumes")
    values = read_raster(path).values
    check(values.shape == (8, 12) and np.nanmax(np.abs(values[:, 6:8] - 0.2)) <= 0.1 and np.nanmax(np.abs(values[:, 10])) <= 1e-4, "raster of the scour")
    check(write(results, "Slide")[1].taken <= 1e-9, "scour of a body at rest")


def threshold():
    """A slab on a layer of clay s_u: it rests below s_u/(rho g sin) and moves with g sin - s_u/(rho H) above, here 0.91 m and 1.63 m/s^2."""
    slab = {"End_time": "1", "Output__Interval": "1"}
    for height, cell in ((0.87, "0.25"), (1.5, "0.125")):
        results = run(f"slab_{height}", changed(Slide__Region=f"x < 40 && y > 0.5 && y < {height}", Mesh__Cell_size=cell, **slab))
        points = read_points(results)
        velocity = next(values for name, values in points.arrays.items() if name.startswith("velocity"))[:, 0]
        x, y = points.positions[:, 0], points.positions[:, 1]
        speed = np.mean(velocity[(x > 15) & (x < 25) & (y > 0.5)])
        exact = max(0., DOWNHILL - STRENGTH / (DENSITY * height))
        print(f"H = {height} m: {speed:.4f} m/s after 1 s, exact {exact:.4f}")
        check(abs(speed) <= 0.01 if exact == 0 else abs(speed / exact - 1) <= 0.1, f"H = {height} m: {speed} m/s, exact {exact}")
        change = np.nanmax(np.abs(scour(results, "Layer").raster.values[0, round(15 / float(cell)):round(25 / float(cell))]))  # far from the free ends
        check(exact > 0 or change <= 0.01, f"a layer at rest has scour: {change} m")


{"balance": balance, "space": space, "threshold": threshold}[sys.argv[3]]()
