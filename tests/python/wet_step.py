# SPDX-License-Identifier: LGPL-2.1-or-later
"""wet_step.py SCREE: the program SCREE against the reference of its wet time step in doc/theory/wet_step.py, with a tight pressure solve."""

import os
import pathlib
import subprocess
import sys

import numpy as np

from scree.results import read_points, read_statistics
from scree.variants import write_variant

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "doc" / "theory"))
sys.dont_write_bytecode = True

import wet_step as reference  # pylint: disable=wrong-import-position

STEPS, STEPS_PER_ROW = 70, 10  # light nodes occur from step 57 on


def run(scree):
    """Statistics of the case of the reference; the points are in folder run."""
    entries = {
        "Output directory": "run", "End time": STEPS*reference.TIME_STEP, "Gravity": f"0, {-reference.GRAVITY}",
        "Mesh/Upper corner": "{}, {}".format(*reference.H*reference.CELLS), "Mesh/Cell size": reference.H,
        "Time step/Maximum time step": reference.TIME_STEP, "Transfer/Method": "AFLIP", "Stabilisation/F-bar": "none",
        "Soil/Region": f"y < {reference.SOIL_HEIGHT}", "Soil/Points per cell": reference.PER_CELL,
        "Soil/Grain density": reference.GRAIN_DENSITY, "Soil/Initial porosity": reference.POROSITY,
        "Soil/Linear elastic/Young's modulus": reference.YOUNG, "Soil/Linear elastic/Poisson's ratio": reference.POISSON,
        "Soil/Initial state/Type": "none", "Soil/Initial state/K0": "auto",
        "Water/Region": f"y < {reference.WATER_TABLE} || (x < {reference.COLUMN_WIDTH} && y < {reference.COLUMN_HEIGHT})",
        "Water/Points per cell": reference.PER_CELL, "Water/Density": reference.WATER_DENSITY,
        "Water/Hydraulic conductivity": reference.CONDUCTIVITY, "Water/Initial pressure": "none",
        "Water/Pressure/Step": "variational", "Water/Pressure/Fading": "0", "Water/Pressure/Projection": "0",
        "Water/Pressure/Relative tolerance": "1e-12", "Output/Interval": STEPS*reference.TIME_STEP,
        "Output/Statistics interval": STEPS_PER_ROW*reference.TIME_STEP, "Output/Screen": "nothing"}
    write_variant(ROOT / "prm" / "seepage" / "saturated_rest.prm", "case.prm", entries)
    result = subprocess.run([os.path.abspath(scree), "case.prm"], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit("The program stopped: " + result.stderr)
    return read_statistics("run")


def nearest(points, places):
    """The number of the point of a picture next to each place."""
    return np.linalg.norm(points.positions[None, :, :2] - places[:, None], axis=2).argmin(1)


def main():
    failures = []

    def check(what, value, bound):
        is_good = value <= bound
        print(f"{what:<66} {value:9.2e}  bound {bound:g}{'' if is_good else '  <-- FAILED'}")
        if not is_good:
            failures.append(what)

    table = run(sys.argv[1])
    phases = reference.start()
    for row in range(1, STEPS//STEPS_PER_ROW + 1):
        for _ in range(STEPS_PER_ROW):
            reference.step(*phases)
        check(f"kinetic energy after {row*STEPS_PER_ROW} steps: relative difference",
              abs(table["Kinetic energy (J)"][row]/reference.kinetic_energy(*phases) - 1), 1e-9)
    check("steps of the program: difference", abs(table["Step"][-1] - STEPS), 0)
    # Pictures have single precision.
    for name, collection, points in zip(("soil", "water"), ("points", "water"), phases):
        picture = read_points("run", collection=collection)
        match = nearest(picture, points.x)
        check(f"points of {name}: number of those without one of the program", len(points.x) - len(np.unique(match)), 0)
        check(f"positions of {name}: largest difference over the cell size",
              np.abs(picture.positions[match, :2] - points.x).max()/reference.H, 1e-6)
        check(f"velocities of {name}: largest difference over the largest one",
              np.abs(picture.arrays["velocity"][match, :2] - points.v).max()/np.abs(points.v).max(), 1e-6)
    check("pressure of the water points: largest difference over the largest one",
          np.abs(picture.arrays["pressure"][match] - phases[1].p).max()/phases[1].p.max(), 1e-6)
    sys.exit("failed: " + ", ".join(failures) if failures else 0)


if __name__ == "__main__":
    main()
