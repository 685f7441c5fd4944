# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/terzaghi.md."""

import math

import numpy as np

from scree import closed_forms
from scree.studies import ROOT, Study, WorkPrecision, prm_files
from scree.studies.precision import DEFAULTS, beside_defaults, costs, methods, order, ratios, table, variants

FACTORS = (0.1, 0.5, 1.)
BASE = "prm/consolidation/terzaghi.prm"
ENTRIES = prm_files.read_entries(ROOT / BASE)
ELASTIC = [float(ENTRIES[f"Soil/Linear elastic/{name}"]) for name in ("Young's modulus", "Poisson's ratio")]
COLUMN = closed_forms.Terzaghi(1., 100., closed_forms.oedometric_modulus(*ELASTIC),
                               float(ENTRIES["Water/Hydraulic conductivity"]))
METHODS = methods("single-point", "linear",
                  {"linear, single-point": {"Mesh/Basis": "linear", "Water/Point sets": "single"}},
                  "Courant number 0.2", "Courant number 0.9", "2 x 2 points", "3 x 3 points", "tolerance 1e-3",
                  "tolerance 1e-9")


def mesh(h):
    return {"Mesh/Cell size": h, "Mesh/Upper corner": f"{2 * h:.12g}, 1.2",
            "Surface load/Upper corner": f"{2 * h:.12g}, 1"}


def rms(values):
    return math.sqrt(np.mean(np.square(values)))


def measure(run):
    errors = []
    for factor in FACTORS:
        water = run.points(COLUMN.time(factor), "water")
        depth, pressure = 1 - water.positions[:, 1], water.arrays["pressure"] / COLUMN.load
        errors.append(rms(pressure - closed_forms.terzaghi_pressure(depth, factor)))
    return {"error": rms(errors)}


def verdict(rows, claim):
    error, found = ratios(rows), costs(rows)
    orders = [order(rows), order(rows, "linear")]
    change = abs(error["tolerance 1e-3"] - 1)
    claim = claim.shared(**beside_defaults(rows))
    return [
        claim("order", orders[0] > 1.8 and orders[1] > 1.7 and error["Courant number 0.2"] > 0.85
              and error["Courant number 0.9"] < 1.15, order=orders[0], order_of_linear=orders[1]),
        claim("single-point", 0.98 < error["single-point"] < 1.02),
        claim("basis", error["linear"] < 1.1),
        claim("tolerance", change < 0.06, change=change),
        claim("points", error["2 x 2 points"] < 1.05 and error["3 x 3 points"] < 1.05),
        claim("cost", found["2 x 2 points"] < 0.8 and found["Courant number 0.2"] > 1.5, quick=False)]


STUDY = Study(
    BASE, entries={"Surface load/Traction": f"0; {-COLUMN.load:g}", "End time": COLUMN.time(1),
                   "Output/Interval": COLUMN.time(0.1), "Output/Graphics": "points"},
    variants=variants(METHODS, mesh, [1 / 10, 1 / 20, 1 / 40]), default={"method": DEFAULTS}, table=table,
    quick=lambda labels: labels["h"] > (0.03 if labels["method"] in (DEFAULTS, "linear") else 0.09),
    chart=WorkPrecision({DEFAULTS: "defaults", "2 x 2 points": "2 x 2 points\n(recommended)",
                         "Courant number 0.9": "Courant number 0.9",
                         "Courant number 0.2": "Courant number 0.2\n(worst)"},
                        "RMS error of p/q against the series (-)"))
