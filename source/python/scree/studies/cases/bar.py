# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/bar.md."""

import math

import numpy as np

from scree.studies import Study, WorkPrecision, transfer
from scree.studies.precision import (DEFAULTS, at_finest, beside_defaults, costs, failed, methods, order, ratio, table,
                                     variants)

SPEED, MODULUS, AMPLITUDE = math.sqrt(10.), 1e4, 1e-5  # of the wave, m/s; Pa; m/s
TIME = 4.25 / SPEED  # s
METHODS = methods("linear", "PIC rate 5", {"TPIC": transfer("TPIC")}, "2 x 2 points", "3 x 3 points",
                  "Courant number 0.15", "Courant number 0.9", "modified F-bar", without="Water")


def mesh(h):
    return {"Mesh/Cell size": h, "Mesh/Upper corner": f"1, {h:.12g}"}


def relative(computed, exact):
    return math.sqrt(np.mean((computed - exact)**2) / np.mean(exact**2))


def errors(run, velocity, stress):
    """The columns of relative errors; runs with an error above 1 have diverged."""
    error = math.sqrt((velocity**2 + stress**2) / 2)
    return {"cells": round(1 / run.labels["h"]), "error": error if error < 1 else math.nan,
            "error of velocity": velocity, "error of stress": stress}


def measure(run):
    points = run.points()
    x, omega, step = points.positions[:, 0], math.pi * SPEED, run.statistics("Time step (s)")[-1]
    velocity = AMPLITUDE * np.sin(math.pi * x) * math.cos(omega * (TIME - step / 2))
    stress = MODULUS * AMPLITUDE / SPEED * np.cos(math.pi * x) * math.sin(omega * TIME)
    return errors(run, relative(points.arrays["velocity"][:, 0], velocity),
                  relative(points.arrays["stress"][:, 0], stress))


def verdict(rows, claim):
    few, small = ratio(rows, "2 x 2 points"), ratio(rows, "Courant number 0.15")
    diverged = failed(rows, "Courant number 0.9")
    linear, splines = (at_finest(rows, method, "error of stress") for method in ("linear", DEFAULTS))
    claim = claim.shared(**beside_defaults(rows))
    return [
        claim("transfer", ratio(rows, "TPIC") < 0.5 and 0.9 < ratio(rows, "PIC rate 5") < 1.1),
        claim("order", order(rows) > 1.7 and 0.9 < small < 1.2, order=order(rows), change=small - 1),
        claim("step", len(diverged) == 3, quick=False, worst=True, diverged=diverged),
        claim("points", few < 1.05),
        claim("basis", linear > 3 * splines, quick=False, linear=linear, splines=splines),
        claim("cost", costs(rows)["TPIC"] < 0.9, quick=False)]


STUDY = Study(
    "prm/dynamics/vibrating_bar.prm",
    entries={"Soil/Initial velocity": f"{AMPLITUDE:g}*sin(pi*x); 0", "Time step/Maximum time step": 1, "End time": TIME,
             "Output/Interval": TIME, "Output/Statistics interval": 0, "Output/Graphics": "points"},
    variants=variants(METHODS, mesh, [1 / 16, 1 / 32, 1 / 64, 1 / 128, 1 / 256]), default={"method": DEFAULTS},
    table=table, quick=lambda labels: labels["h"] > 0.03,
    chart=WorkPrecision({DEFAULTS: "defaults (FLIP)", "TPIC": "TPIC\n(recommended)", "linear": "linear"},
                        "error of velocity and stress against\nthe exact solution (-)", "cells", ""))
