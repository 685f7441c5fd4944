"""Terzaghi's consolidation (`prm/terzaghi.prm`) with a tenth of the case's load: strain is small, and a settlement of 9e-4 of the height alone would
change p/q by 5e-4. Error: rms of the L2 errors of p/q over the water's points at T_v = 0.1, 0.5 and 1, against the series; the table also has
that against the solution with inertia (`doc/closed_forms.py`), which Terzaghi's leaves out, so that orders of convergence are not hidden by it,
and the largest error of the degree of consolidation U. Methods differ from the case (double-point, splines, TPIC, 4 x 4 points a cell and phase,
Courant number 0.6, relative tolerance of the pressure 1e-6) in one thing or two."""

import math

import numpy as np

import closed_forms
from charts import WorkPrecision
from precision import DEFAULTS, cost_at_equal_error, costs, listed, order, ratio
from study import ROOT, Claim, Study, axis, prm_files, product

FACTORS = (0.1, 0.5, 1.)
BASE = "prm/terzaghi.prm"
ENTRIES = prm_files.read_entries(ROOT / BASE)
COLUMN = closed_forms.Terzaghi(1., 100., closed_forms.oedometric_modulus(float(ENTRIES["Soil/Linear elastic/Young's modulus"]),
                                                                        float(ENTRIES["Soil/Linear elastic/Poisson's ratio"])),
                               float(ENTRIES["Water/Hydraulic conductivity"]))
GRAIN_DENSITY, POROSITY = float(ENTRIES["Soil/Grain density"]), float(ENTRIES["Soil/Initial porosity"])

LINEAR, SINGLE = {"Mesh/Basis": "linear"}, {"Water/Point sets": "single"}
METHODS = {
    DEFAULTS: {},
    "single-point": SINGLE,
    "linear": LINEAR,
    "linear, single-point": {**LINEAR, **SINGLE},
    "quadratic": {"Mesh/Basis": "quadratic"},
    "Courant number 0.2": {"Time step/Courant number": 0.2},
    "Courant number 0.9": {"Time step/Courant number": 0.9},
    "2 x 2 points": {"Soil/Points per cell": 2, "Water/Points per cell": 2},
    "3 x 3 points": {"Soil/Points per cell": 3, "Water/Points per cell": 3},
    "tolerance 1e-3": {"Water/Pressure/Relative tolerance": 1e-3},
    "tolerance 1e-9": {"Water/Pressure/Relative tolerance": 1e-9},
}


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
    return [Claim(listed(costs(rows)), True), Claim(f"{order(rows)}", True)]


STUDY = Study(
    title="Terzaghi's consolidation: error over cost", base=BASE,
    entries={"Surface load/Traction": f"0; {-COLUMN.load:g}", "End time": COLUMN.time(1), "Output/Interval": COLUMN.time(0.1),
             "Output/Graphics": "points"},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", mesh, [1 / 10, 1 / 20, 1 / 40])),
    default={"method": DEFAULTS}, quick=lambda labels: labels["h"] > 0.03,
    measure=measure, verdict=verdict,
    chart=WorkPrecision(error="error", curves=["method"], annotate="h", ylabel="error of p/q, rms of T_v = 0.1, 0.5, 1 (-)"))
