# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/terzaghi.md."""

import math

import numpy as np

from scree import closed_forms
from scree.studies.charts import WorkPrecision
from scree.studies.precision import DEFAULTS, costs, methods, order, ratio, table
from scree.studies.study import ROOT, Claim, Study, axis, prm_files, product

FACTORS = (0.1, 0.5, 1.)
BASE = "prm/consolidation/terzaghi.prm"
ENTRIES = prm_files.read_entries(ROOT / BASE)
COLUMN = closed_forms.Terzaghi(1., 100., closed_forms.oedometric_modulus(float(ENTRIES["Soil/Linear elastic/Young's modulus"]),
                                                                        float(ENTRIES["Soil/Linear elastic/Poisson's ratio"])),
                               float(ENTRIES["Water/Hydraulic conductivity"]))
GRAIN_DENSITY, POROSITY = float(ENTRIES["Soil/Grain density"]), float(ENTRIES["Soil/Initial porosity"])

METHODS = methods("single-point", "linear", {"linear, single-point": {"Mesh/Basis": "linear", "Water/Point sets": "single"}}, "Courant number 0.2",
                  "Courant number 0.9", "2 x 2 points", "3 x 3 points", "tolerance 1e-3", "tolerance 1e-9")


def mesh(h):
    return {"Mesh/Cell size": h, "Mesh/Upper corner": f"{2 * h:.12g}, 1.2", "Surface load/Upper corner": f"{2 * h:.12g}, 1"}


def rms(values):
    return math.sqrt(np.mean(np.square(values)))


def measure(run):
    errors, with_inertia, degrees = [], [], []
    for factor in FACTORS:
        time = COLUMN.time(factor)
        water, soil = run.points(time, "water"), run.points(time)
        depth, pressure = 1 - water.positions[:, 1], water.arrays["pressure"] / COLUMN.load
        exact, _ = closed_forms.consolidation_with_inertia(COLUMN, GRAIN_DENSITY, POROSITY, depth, time)
        errors.append(rms(pressure - closed_forms.terzaghi_pressure(depth, factor)))
        with_inertia.append(rms(pressure - exact))
        # The mean effective vertical stress over the load is U: exact for a strain as small as this one.
        degrees.append(abs(-np.mean(soil.arrays["stress"][:, 4]) / COLUMN.load - closed_forms.terzaghi_degree(factor)))
    return {"error": rms(errors), "error with inertia": rms(with_inertia), "largest error of U": max(degrees)}


def verdict(rows):
    small, large = ratio(rows, "Courant number 0.2"), ratio(rows, "Courant number 0.9")
    found = costs(rows)
    return [
        Claim(f"The error follows the cell size, order {order(rows):.2g} (linear functions {order(rows, 'linear'):.2g}). With Courant number 0.2 instead of 0.6 it is {small:.2g} "
              f"times as large, for {ratio(rows, 'Courant number 0.2', 'core-seconds'):.2g} times the time. With 0.9 it is {large:.2g} times as large, for "
              f"{ratio(rows, 'Courant number 0.9', 'core-seconds'):.2g} times the time. Use the largest stable time step.",
              order(rows) > 1.8 and order(rows, "linear") > 1.7 and small > 0.85 and large < 1.15),
        Claim(f"Single-point water has the same error within 2 % in a column where nothing moves: {ratio(rows, 'single-point'):.3g} times, for "
              f"{ratio(rows, 'single-point', 'core-seconds'):.2g} times the time.",
              0.98 < ratio(rows, "single-point") < 1.02),
        Claim(f"On points that stay in their cells linear functions are suitable: {ratio(rows, 'linear'):.2g} times the error. "
              "Where points cross cells they fail (see [manufactured solution](waves_and_convergence.md#manufactured-solution-error-over-cost)).", ratio(rows, "linear") < 1.1),
        Claim(f"The tolerance of the pressure has little influence: with 1e-3 instead of 1e-4 the error is the same to "
              f"{100 * abs(ratio(rows, 'tolerance 1e-3') - 1):.1g} % (1 % was asked and is missed on ten cells).", abs(ratio(rows, "tolerance 1e-3") - 1) < 0.06),
        Claim(f"Few points are sufficient, as long as they are on their lattice: 2 x 2 {ratio(rows, '2 x 2 points'):.2g} times the error for "
              f"{ratio(rows, '2 x 2 points', 'core-seconds'):.2g} times the time, 3 x 3 {ratio(rows, '3 x 3 points'):.2g} for "
              f"{ratio(rows, '3 x 3 points', 'core-seconds'):.2g}.", ratio(rows, "2 x 2 points") < 1.05 and ratio(rows, "3 x 3 points") < 1.05),
        Claim("Core-seconds for the same error: a larger Courant number saves a third at most; this column needs a quarter of the points.",
              found["2 x 2 points"] < 0.8 and found["Courant number 0.2"] > 1.5, quick=False),
    ]


STUDY = Study(
    title="Terzaghi: error over cost",
    question="How accurate is small-strain consolidation, and which method is cheapest?",
    advice="Use the largest stable time step.",
    base=BASE,
    entries={"Surface load/Traction": f"0; {-COLUMN.load:g}", "End time": COLUMN.time(1), "Output/Interval": COLUMN.time(0.1),
             "Output/Graphics": "points"},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", mesh, [1 / 10, 1 / 20, 1 / 40])),
    default={"method": DEFAULTS}, quick=lambda labels: labels["h"] > (0.03 if labels["method"] in (DEFAULTS, "linear") else 0.09),
    measure=measure, verdict=verdict,
    table=table, chart=WorkPrecision({DEFAULTS: "defaults", "2 x 2 points": "2 x 2 points\n(recommended)", "Courant number 0.9": "Courant number 0.9", "Courant number 0.2": "Courant number 0.2\n(worst)"}, "RMS error of p/q against the series (-)"))
