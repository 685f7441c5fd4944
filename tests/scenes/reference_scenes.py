# SPDX-License-Identifier: LGPL-2.1-or-later
"""reference_scenes.py SCREE SCENE: the program against the Python references of its time steps in doc/theory; orders of convergence and errors
of velocity and stress, as scenes.py."""

import math
import os
import sys

import numpy as np

from scree.results import read_points
from scree.studies.cases.manufactured import body_force

from scene_tools import NO_STRESS, ROOT, check, main, run

sys.path.insert(0, os.path.join(ROOT, "doc", "theory"))
sys.dont_write_bytecode = True

import dry_step as dry_reference  # pylint: disable=wrong-import-position
import wet_step as reference  # pylint: disable=wrong-import-position

STEPS, STEPS_PER_ROW = 70, 10  # light nodes occur from step 57 on
DRY_STEPS = 50
MODULUS = 1e4  # Young's, Pa


def walk(of, phases, table, n_steps):
    """Steps of a reference, whose kinetic energy is that of the program."""
    for row in range(1, n_steps//STEPS_PER_ROW + 1):
        for _ in range(STEPS_PER_ROW):
            of.step(*phases)
        check(f"kinetic energy after {row*STEPS_PER_ROW} steps: relative difference", abs(table["Kinetic energy (J)"][row]/of.kinetic_energy(*phases) - 1), 0, 1e-9)
    check("steps of the program: difference", abs(table["Step"][-1] - n_steps), 0, 0)


def compare_points(name, picture, points, scale, **fields):
    """Places, over a scale, m, velocities and further fields, {name: (values, scale)}, of a reference's points are those of the nearest ones of the program."""
    match = np.linalg.norm(picture.positions[None, :, :2] - points.x[:, None], axis=2).argmin(1)
    check(f"points of {name}: number of those without one of the program", len(points.x) - len(np.unique(match)), 0, 0)
    check(f"positions of {name}: largest difference over {scale:g} m", np.abs(picture.positions[match, :2] - points.x).max()/scale, 0, 1e-6)
    for field, (values, largest) in {"velocity": (points.v, np.abs(points.v).max()), **fields}.items():
        found = picture.arrays[field][match]
        check(f"{field} of {name}: largest difference over its scale", np.abs((found[:, :2] if values.ndim == 2 else found) - values).max()/largest, 0, 1e-6)


def wet_step(scree):
    """The step of soil and water, with a tight pressure solve: kinetic energy to 1e-9, points and pressure to the single precision of pictures."""
    table = run(scree, "seepage/saturated_rest", "wet_step", {
        "End time": STEPS*reference.TIME_STEP, "Gravity": f"0, {-reference.GRAVITY}",
        "Mesh/Upper corner": "{}, {}".format(*reference.H*reference.CELLS), "Mesh/Cell size": reference.H,
        "Time step/Maximum time step": reference.TIME_STEP, "Stabilisation/F-bar": "projected",
        "Soil/Region": f"y < {reference.SOIL_HEIGHT}", "Soil/Points per cell": reference.PER_CELL,
        "Soil/Grain density": reference.GRAIN_DENSITY, "Soil/Initial porosity": reference.POROSITY,
        "Soil/Linear elastic/Young's modulus": reference.YOUNG, "Soil/Linear elastic/Poisson's ratio": reference.POISSON, **NO_STRESS,
        "Water/Region": f"y < {reference.WATER_TABLE} || (x < {reference.COLUMN_WIDTH} && y < {reference.COLUMN_HEIGHT})",
        "Water/Points per cell": reference.PER_CELL, "Water/Density": reference.WATER_DENSITY,
        "Water/Hydraulic conductivity": reference.CONDUCTIVITY, "Water/Initial pressure": "none", "Water/Pressure/Relative tolerance": "1e-12",
        "Output/Graphics": "points", "Output/Interval": STEPS*reference.TIME_STEP, "Output/Statistics interval": STEPS_PER_ROW*reference.TIME_STEP})
    soil, water = phases = reference.start()
    walk(reference, phases, table, STEPS)
    compare_points("soil", read_points("wet_step"), soil, reference.H)
    compare_points("water", read_points("wet_step", collection="water"), water, reference.H, pressure=(water.p, water.p.max()))


def dry_step(scree):
    """The step of dry soil: kinetic energy to 1e-9, points, stress and strain to the single precision of pictures."""
    table = run(scree, "columns/mohr_coulomb_collapse", "dry_step", {
        "End time": DRY_STEPS*dry_reference.TIME_STEP, "Gravity": f"0, {-dry_reference.GRAVITY}",
        "Time step/Courant number": 2, "Time step/Advection number": 1, "Time step/Maximum time step": dry_reference.TIME_STEP,
        "Output/Graphics": "points", "Output/Interval": DRY_STEPS*dry_reference.TIME_STEP, "Output/Statistics interval": STEPS_PER_ROW*dry_reference.TIME_STEP})
    soil = dry_reference.start()
    walk(dry_reference, [soil], table, DRY_STEPS)
    compare_points("soil", read_points("dry_step"), soil, soil.x.max(), mean_effective_stress=(-soil.stress.mean(1), np.abs(soil.stress).max()),
                   plastic_shear_strain=(soil.shear, soil.shear.max()))


def errors_of(scree, method, end, entries, exact):
    """Relative errors of velocity and stress along x at the end, s, of the elastic soil of prm/dynamics/vibrating_bar.prm with other entries.

    The step shrinks with the square of the cell, because symplectic Euler holds velocities half a step late: the order seen is that of space."""
    run(scree, "dynamics/vibrating_bar", "order", {
        "Transfer/Method": method, "Transfer/PIC rate": "0" if method == "FLIP" else "auto", "End time": "%.12g" % end, "Output/Interval": "%.12g" % end,
        "Output/Statistics interval": "0", "Output/Graphics": "points", **entries})
    points = read_points("order")
    found = points.arrays["velocity"][:, 0], points.arrays["stress"][:, 0]
    return [np.linalg.norm(values - wanted) / np.linalg.norm(wanted) for values, wanted in zip(found, exact(*points.positions[:, :2].T))]


def check_errors(name, coarse, fine, before):
    """The errors of the finer cells are those of before, to 1e-3; returns the orders of both."""
    for what, error, known in zip(("velocity", "stress"), fine, before):
        check(f"{name}: error of {what} over that before", error / known, 0.999, 1.001)
    return np.log2(np.divide(coarse, fine))


def order_bar(scree):
    """A bar between two fixed walls swings in its first mode; small strain, so that v = V sin(pi x) cos(pi c t),
    sigma = E V/c cos(pi x) sin(pi c t), c = sqrt(E/rho). At an eighth of the second period velocity and stress are both far from 0."""
    amplitude, speed = 1e-3, math.sqrt(MODULUS / 1e3)
    time = 2.25 / speed

    def exact(x, _):
        phase = math.pi * speed * time
        return amplitude * np.sin(math.pi * x) * math.cos(phase), MODULUS * amplitude / speed * np.cos(math.pi * x) * math.sin(phase)

    for method, before in (("FLIP", (6.654e-3, 4.533e-3)), ("TPIC", (1.846e-3, 3.102e-3)), ("AFLIP", (2.877e-3, 2.264e-3))):
        coarse, fine = (errors_of(scree, method, time, {"Mesh/Cell size": f"{1 / n:.12g}", "Mesh/Upper corner": f"1, {1 / n:.12g}",
                                                        "Time step/Courant number": f"{2 / n:.12g}"}, exact) for n in (32, 64))
        check(f"bar, {method}: smaller order", min(check_errors("bar, " + method, coarse, fine, before)), 1.7, 3)


def order_manufactured(scree):
    """A manufactured solution at large strain whose points cross cells: a closed box in which, along each axis, with A = 0.1 and omega = pi,
      X = x - A sin(pi x) sin(omega t)          (where a point at x came from)
      g = dX/dx = 1/F,   v = -X_t/g,   sigma_xx = E ln(F_x)/(F_x F_y)      (Hencky, Poisson's ratio 0)
    solves the equation of motion with the acceleration b = Dv/Dt + E/(rho_0 g) g' (1 + ln g). Displacements are 1.6 and 3.2 cells. With a fixed
    number of points in a cell the sum over points stops to resolve the integrals (Steffen, Kirby & Berzins 2008): the error levels out. With points
    that grow denser than the cells, 8 and 16 along an axis, it falls on."""
    amplitude, time = 0.1, 0.6

    def exact(x, y):
        stretch_x, stretch_y = (1 / (1 - amplitude * math.pi * np.cos(math.pi * z) * math.sin(math.pi * time)) for z in (x, y))
        return (amplitude * math.pi * np.sin(math.pi * x) * math.cos(math.pi * time) * stretch_x,
                MODULUS * np.log(stretch_x) / (stretch_x * stretch_y))

    def errors(method, n, points):
        return errors_of(scree, method, time, {
            "Body force": f"{body_force('x')}; {body_force('y')}", "Mesh/Cell size": f"{1 / n:.12g}", "Mesh/Upper corner": "1, 1",
            "Time step/Courant number": f"{6.4 / n:.12g}", "Boundaries/Left": "free slip", "Boundaries/Right": "free slip",
            "Soil/Initial velocity": "0.1*pi*sin(pi*x); 0.1*pi*sin(pi*y)", "Soil/Points per cell": str(points)}, exact)

    orders = []
    for method, same, denser in (("FLIP", (1.069e-1, 1.334e-2), (2.344e-2, 3.120e-3)), ("TPIC", (2.975e-2, 6.937e-3), (4.057e-3, 2.531e-3))):
        check_errors(method + ", 4 points", *(errors(method, n, 4) for n in (16, 32)), same)
        orders += [*check_errors(method + ", more points", *(errors(method, n, n // 2) for n in (16, 32)), denser)]
    check("mean order with points that grow denser", np.mean(orders), 1.5, 3)


if __name__ == "__main__":
    main(globals())
