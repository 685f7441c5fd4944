# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/manufactured.md."""

import math

import numpy as np

from scree.studies.cases.bar import errors, relative
from scree.studies.charts import WorkPrecision
from scree.studies.precision import DEFAULTS, at_finest, curve, methods, order, ratio, table
from scree.studies.study import Claim, Study, axis, product, transfer

AMPLITUDE, MODULUS, TIME = 0.1, 1e4, 0.6  # m, Pa, s

METHODS = methods("linear", "PIC rate 0", "PIC rate 5", {"TPIC": transfer("TPIC")}, "2 x 2 points", "3 x 3 points", "6 x 6 points", "Courant number 0.3",
                  "Courant number 0.9", "modified F-bar", without="Water")
DENSER = {"points as fine as cells^2": {}, "TPIC, points as fine as cells^2": METHODS["TPIC"]}


def denser_points(h):
    """As many points along a cell as keep their spacing in proportion to h^2."""
    return {"Mesh/Cell size": h, "Soil/Points per cell": round(0.5 / h)}


def body_force(x):
    """Dv/Dt + E/(rho_0 g) g' (1 + ln g) along the axis `x` ("x" or "y"), of X = x - A sin(pi x) sin(pi t) and g = dX/dx."""
    sine, cosine = f"(0.1*sin(pi*{x}))", f"(0.1*pi*cos(pi*{x}))"
    g, g_x, g_t = f"(1-{cosine}*sin(pi*t))", f"(pi*pi*{sine}*sin(pi*t))", f"(-pi*{cosine}*cos(pi*t))"
    n, n_x, n_t = f"(pi*{sine}*cos(pi*t))", f"(pi*{cosine}*cos(pi*t))", f"(-pi*pi*{sine}*sin(pi*t))"
    return f"{n_t}/{g}-{n}*{g_t}/{g}^2+{n}/{g}*({n_x}/{g}-{n}*{g_x}/{g}^2)+10/{g}*{g_x}*(1+ln({g}))"


def measure(run):
    points, step = run.points(), run.statistics("Time step (s)")[-1]
    x, y = points.positions[:, 0], points.positions[:, 1]
    computed = points.arrays["velocity"][:, 0]

    def stretch(z, time):
        return 1 / (1 - AMPLITUDE * math.pi * np.cos(math.pi * z) * math.sin(math.pi * time))

    def exact(z, time):
        return AMPLITUDE * math.pi * np.sin(math.pi * z) * math.cos(math.pi * time) * stretch(z, time)

    velocity = relative(computed, exact(x - computed * step / 2, TIME - step / 2))
    stress = relative(points.arrays["stress"][:, 0], MODULUS * np.log(stretch(x, TIME)) / (stretch(x, TIME) * stretch(y, TIME)))
    return errors(run, velocity, stress, relative(computed, exact(x, TIME)))


def verdict(rows):
    *_, middle, fine = (row["error"] for row in curve(rows).values())
    few = [row["error"] for row in curve(rows, "2 x 2 points").values()]
    denser, linear = order(rows, "points as fine as cells^2"), ratio(rows, "linear")
    large = ratio(rows, "Courant number 0.9")
    return [
        Claim(f"With 4 x 4 points per cell the error does not converge: it is {fine:.2g} on the finest mesh and {middle:.2g} with cells twice as large. The points are the "
              f"quadrature points. Finer cells need denser points: with a spacing in proportion to h^2 the order is {denser:.2g}.", fine > 0.7 * middle and denser > 1,
              quick=False),
        Claim(f"Where points cross cells, only splines are suitable: linear functions make {linear:.2g} times the error.", linear > 5),
        Claim(f"3 x 3 points: {ratio(rows, '3 x 3 points'):.2g} times the error; 2 x 2: it grows with refinement, from {few[0]:.2g} to {few[-1]:.2g}; 6 x 6: "
              f"{ratio(rows, '6 x 6 points'):.2g} times, for {ratio(rows, '6 x 6 points', 'core-seconds'):.2g} times the time.",
              ratio(rows, "3 x 3 points") > 1.2 and few[-1] > few[0] and ratio(rows, "6 x 6 points") > 0.7, quick=False),
        Claim(f"Of the transfers TPIC is best on fine meshes, {at_finest(rows, 'TPIC') / fine:.2g} times the defaults' error at h = 1/64 m "
              f"(FLIP with a PIC rate of 0 and 5 1/s {at_finest(rows, 'PIC rate 0') / fine:.2g} and {at_finest(rows, 'PIC rate 5') / fine:.2g}).",
              at_finest(rows, "TPIC") < 0.9 * fine, quick=False),
        Claim(f"Courant number 0.9 is as good as 0.6 down to h = 1/32 m and diverges on the finest mesh (error there {at_finest(rows, 'Courant number 0.9'):.2g}; "
              f"mean over the meshes {large:.2g} times the error).", at_finest(rows, "Courant number 0.9") > 3 * fine, quick=False),
        Claim(f"The averages of the modified F-bar, which this compressible case does not need, cost accuracy: {ratio(rows, 'modified F-bar'):.2g} times the error.",
              1.1 < ratio(rows, "modified F-bar") < 2),
    ]


STUDY = Study(
    title="Manufactured solution: error over cost",
    question="Does the error converge where points cross cells?",
    advice="Use splines. For a smaller error refine points faster than cells: spacing in proportion to h^2.",
    base="prm/dynamics/vibrating_bar.prm",
    entries={"End time": TIME, "Output/Interval": TIME, "Output/Statistics interval": 0, "Output/Graphics": "points",
             "Mesh/Upper corner": "1, 1", "Body force": f"{body_force('x')}; {body_force('y')}",
             "Soil/Initial velocity": "0.1*pi*sin(pi*x); 0.1*pi*sin(pi*y)",
             "Boundaries/Left": "free slip", "Boundaries/Right": "free slip", "Transfer/PIC rate": "auto", "Time step/Maximum time step": 1},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 8, 1 / 16, 1 / 32, 1 / 64]))
    + product(axis("method", DENSER.__getitem__, DENSER), axis("h", denser_points, [1 / 8, 1 / 16, 1 / 32])),
    default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.05 and labels["method"] in (DEFAULTS, "linear", "2 x 2 points", "modified F-bar"),
    measure=measure, verdict=verdict,
    table=lambda rows: [line[:3] for line in table(rows)], chart=WorkPrecision({DEFAULTS: "defaults", "TPIC, points as fine as cells^2": "TPIC, spacing h²\n(best)", "TPIC": "TPIC", "2 x 2 points": "2 x 2 points", "linear": "linear (worst)"}, "error of velocity and stress against\nthe exact solution (-)", "cells", ""))
