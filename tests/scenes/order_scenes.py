# SPDX-License-Identifier: LGPL-2.1-or-later
"""order_scenes.py SCREE SCENE: orders of convergence and errors of velocity and stress, as scenes.py.

The step shrinks with the square of the cell, because symplectic Euler holds velocities half a step late: the order seen is that of space.
"""

import math

import numpy as np

from scree.results import read_points
from scree.studies.cases.manufactured import body_force

from scene_tools import check, main, run

MODULUS = 1e4  # Young's, Pa


def errors_of(scree, method, end, entries, exact):
    """Relative errors of velocity and stress along x at the end, s, of the elastic soil of prm/dynamics/vibrating_bar.prm with other entries."""
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
