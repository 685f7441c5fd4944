# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/bar.md."""

import math

import numpy as np

from scree.studies.charts import WorkPrecision
from scree.studies.precision import DEFAULTS, at_finest, costs, failed, methods, order, ratio, table
from scree.studies.study import Claim, Study, axis, product, transfer

SPEED, MODULUS, AMPLITUDE = math.sqrt(10.), 1e4, 1e-5  # of the wave, m/s; Pa; m/s
TIME = 4.25 / SPEED  # s

METHODS = methods("linear", "PIC rate 5", {"TPIC": transfer("TPIC")}, "2 x 2 points", "3 x 3 points", "Courant number 0.15", "Courant number 0.9",
                  "modified F-bar", without="Water")


def mesh(h):
    return {"Mesh/Cell size": h, "Mesh/Upper corner": f"1, {h:.12g}"}


def relative(computed, exact):
    return math.sqrt(np.mean((computed - exact)**2) / np.mean(exact**2))


def errors(run, velocity, stress, velocity_on_time):
    """The columns of relative errors; runs with an error above 1 have diverged."""
    error = math.sqrt((velocity**2 + stress**2) / 2)
    return {"cells": round(1 / run.labels["h"]), "error": error if error < 1 else math.nan, "error of velocity": velocity,
            "error of stress": stress, "error of velocity, taken as on time": velocity_on_time}


def measure(run):
    points = run.points()
    x, omega, step = points.positions[:, 0], math.pi * SPEED, run.statistics("Time step (s)")[-1]
    computed, shape = points.arrays["velocity"][:, 0], AMPLITUDE * np.sin(math.pi * x)
    velocity = relative(computed, shape * math.cos(omega * (TIME - step / 2)))
    stress = relative(points.arrays["stress"][:, 0], MODULUS * AMPLITUDE / SPEED * np.cos(math.pi * x) * math.sin(omega * TIME))
    return errors(run, velocity, stress, relative(computed, shape * math.cos(omega * TIME)))


def verdict(rows):
    few, small, rejected = ratio(rows, "2 x 2 points"), ratio(rows, "Courant number 0.15"), failed(rows, "Courant number 0.9")
    linear, splines = at_finest(rows, "linear", "error of stress"), at_finest(rows, DEFAULTS, "error of stress")
    return [
        Claim(f"TPIC is the better choice for waves: {ratio(rows, 'TPIC'):.2g} times the error of FLIP without PIC rate on the same mesh, for "
              f"{ratio(rows, 'TPIC', 'core-seconds'):.2g} times the time. A PIC rate of 5 1/s does not change the error here "
              f"({ratio(rows, 'PIC rate 5'):.2g} times).",
              ratio(rows, "TPIC") < 0.5 and 0.9 < ratio(rows, "PIC rate 5") < 1.1),
        Claim(f"The error follows the cell size, order {order(rows):.2g}: Courant number 0.15 instead of 0.6 changes it by {100 * (small - 1):.0f} %, for "
              f"{ratio(rows, 'Courant number 0.15', 'core-seconds'):.2g} times the time.",
              order(rows) > 1.7 and 0.9 < small < 1.2),
        Claim(f"Courant number 0.9 diverges at h = {', '.join(f'{h:.2g}' for h in rejected)} m; use the default 0.6.", len(rejected) == 3, quick=False, worst=True),
        Claim(f"As long as points stay in their cells, 2 x 2 are sufficient: {few:.3g} times the error, "
              f"{ratio(rows, '2 x 2 points', 'core-seconds'):.2g} times the time.", few < 1.05),
        Claim(f"Linear functions give a stress of first order only: {linear:.2g} on the finest mesh, against {splines:.2g} with splines.", linear > 3 * splines,
              quick=False),
        Claim("Core-seconds for the same error: FLIP without PIC rate, that of the case, is not Pareto-optimal, TPIC is. The case has more points than necessary.",
              costs(rows)["TPIC"] < 0.9, quick=False),
    ]


STUDY = Study(
    title="Vibrating bar: error over cost",
    question="Which transfer and basis are best for elastic waves?",
    advice="Use TPIC and Courant number 0.6; no F-bar.",
    base="prm/dynamics/vibrating_bar.prm",
    entries={"Soil/Initial velocity": f"{AMPLITUDE:g}*sin(pi*x); 0", "Time step/Maximum time step": 1, "End time": TIME,
             "Output/Interval": TIME, "Output/Statistics interval": 0, "Output/Graphics": "points"},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", mesh, [1 / 16, 1 / 32, 1 / 64, 1 / 128, 1 / 256])),
    default={"method": DEFAULTS}, quick=lambda labels: labels["h"] > 0.03,
    measure=measure, verdict=verdict,
    table=table, chart=WorkPrecision({DEFAULTS: "defaults (FLIP)", "TPIC": "TPIC\n(recommended)", "linear": "linear"}, "error of velocity and stress against\nthe exact solution (-)", "cells", ""))
