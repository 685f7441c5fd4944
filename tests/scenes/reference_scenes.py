# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program against the Python references of its time steps in doc/theory."""

import os
import sys

import numpy as np

from scree.results import read_points
from scene_tools import NO_STRESS, ROOT, check, main, run

sys.path.insert(0, os.path.join(ROOT, "doc", "theory"))
sys.dont_write_bytecode = True

import dry_step as dry_reference  # pylint: disable=wrong-import-position
import wet_step as reference  # pylint: disable=wrong-import-position

STEPS, STEPS_PER_ROW = 70, 10  # light nodes occur from step 57 on
DRY_STEPS = 50


def nearest(points, places):
    """The number of the point of a picture next to each place."""
    return np.linalg.norm(points.positions[None, :, :2] - places[:, None], axis=2).argmin(1)


def wet_step(scree):
    """The step of soil and water, with a tight pressure solve: kinetic energy to 1e-9, points and pressure to the single precision of pictures."""
    table = run(scree, "seepage/saturated_rest", "wet_step", {
        "End time": STEPS*reference.TIME_STEP, "Gravity": f"0, {-reference.GRAVITY}",
        "Mesh/Upper corner": "{}, {}".format(*reference.H*reference.CELLS), "Mesh/Cell size": reference.H,
        "Time step/Maximum time step": reference.TIME_STEP, "Stabilisation/F-bar": "none",
        "Soil/Region": f"y < {reference.SOIL_HEIGHT}", "Soil/Points per cell": reference.PER_CELL,
        "Soil/Grain density": reference.GRAIN_DENSITY, "Soil/Initial porosity": reference.POROSITY,
        "Soil/Linear elastic/Young's modulus": reference.YOUNG, "Soil/Linear elastic/Poisson's ratio": reference.POISSON, **NO_STRESS,
        "Water/Region": f"y < {reference.WATER_TABLE} || (x < {reference.COLUMN_WIDTH} && y < {reference.COLUMN_HEIGHT})",
        "Water/Points per cell": reference.PER_CELL, "Water/Density": reference.WATER_DENSITY,
        "Water/Hydraulic conductivity": reference.CONDUCTIVITY, "Water/Initial pressure": "none", "Water/Pressure/Relative tolerance": "1e-12",
        "Output/Graphics": "points", "Output/Interval": STEPS*reference.TIME_STEP, "Output/Statistics interval": STEPS_PER_ROW*reference.TIME_STEP})
    phases = reference.start()
    for row in range(1, STEPS//STEPS_PER_ROW + 1):
        for _ in range(STEPS_PER_ROW):
            reference.step(*phases)
        check(f"kinetic energy after {row*STEPS_PER_ROW} steps: relative difference",
              abs(table["Kinetic energy (J)"][row]/reference.kinetic_energy(*phases) - 1), 0, 1e-9)
    check("steps of the program: difference", abs(table["Step"][-1] - STEPS), 0, 0)
    for name, collection, points in zip(("soil", "water"), ("points", "water"), phases):
        picture = read_points("wet_step", collection=collection)
        match = nearest(picture, points.x)
        check(f"points of {name}: number of those without one of the program", len(points.x) - len(np.unique(match)), 0, 0)
        check(f"positions of {name}: largest difference over the cell size",
              np.abs(picture.positions[match, :2] - points.x).max()/reference.H, 0, 1e-6)
        check(f"velocities of {name}: largest difference over the largest one",
              np.abs(picture.arrays["velocity"][match, :2] - points.v).max()/np.abs(points.v).max(), 0, 1e-6)
    check("pressure of the water points: largest difference over the largest one",
          np.abs(picture.arrays["pressure"][match] - phases[1].p).max()/phases[1].p.max(), 0, 1e-6)


def dry_step(scree):
    """The step of dry soil: kinetic energy to 1e-9, points, stress and strain to the single precision of pictures."""
    table = run(scree, "columns/mohr_coulomb_collapse", "dry_step", {
        "End time": DRY_STEPS*dry_reference.TIME_STEP, "Gravity": f"0, {-dry_reference.GRAVITY}",
        "Time step/Courant number": 2, "Time step/Advection number": 1, "Time step/Maximum time step": dry_reference.TIME_STEP,
        "Output/Graphics": "points", "Output/Interval": DRY_STEPS*dry_reference.TIME_STEP, "Output/Statistics interval": STEPS_PER_ROW*dry_reference.TIME_STEP})
    soil = dry_reference.start()
    for row in range(1, DRY_STEPS//STEPS_PER_ROW + 1):
        for _ in range(STEPS_PER_ROW):
            dry_reference.step(soil)
        check(f"kinetic energy after {row*STEPS_PER_ROW} steps: relative difference",
              abs(table["Kinetic energy (J)"][row]/dry_reference.kinetic_energy(soil) - 1), 0, 1e-9)
    check("steps of the program: difference", abs(table["Step"][-1] - DRY_STEPS), 0, 0)
    picture = read_points("dry_step")
    match = nearest(picture, soil.x)
    check("points of soil: number of those without one of the program", len(soil.x) - len(np.unique(match)), 0, 0)
    for name, values, of_program, scale in (
            ("positions", soil.x, picture.positions[match, :2], soil.x.max()),
            ("velocities", soil.v, picture.arrays["velocity"][match, :2], np.abs(soil.v).max()),
            ("mean effective stress", -soil.stress.mean(1), picture.arrays["mean_effective_stress"][match], np.abs(soil.stress).max()),
            ("plastic shear strain", soil.shear, picture.arrays["plastic_shear_strain"][match], soil.shear.max())):
        check(f"{name}: largest difference over their scale", np.abs(of_program - values).max()/scale, 0, 1e-6)


if __name__ == "__main__":
    main(globals())
