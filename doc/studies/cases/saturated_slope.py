"""A saturated slope of loose sand slides (`prm/slope_saturated_loose.prm`, its first 1.5 s). The reference is the case's own method on a finer mesh,
h = 0.05 m with 3 x 3 points a cell. Error: as in the study of the dry slope, of the fronts that hold 90 and 99 % of the soil and of the height of the centre of mass of
soil and water. Methods differ from the case (double-point, TPIC, splines, 4 x 4 points a cell and phase, Courant number 0.6 and steps of
at most 1e-3 s, modified F-bar, relative tolerance of the pressure 1e-6) in one thing."""

import numpy as np

import dry_slope
from charts import WorkPrecision
from precision import DEFAULTS, cost_at_equal_error, costs, listed, order, ratio
from study import Claim, Study, axis, product


def points(number):
    return {"Soil/Points per cell": number, "Water/Points per cell": number}


METHODS = {
    DEFAULTS: {},
    "single-point": {"Water/Point sets": "single"},
    "no F-bar": {"Stabilisation/F-bar": "none"},
    "2 x 2 points": points(2),
    "3 x 3 points": points(3),
    "FLIP": {"Transfer/Method": "FLIP"},
    "APIC": {"Transfer/Method": "APIC"},
    "tolerance 1e-3": {"Water/Pressure/Relative tolerance": 1e-3},
    "Courant number 0.3": {"Time step/Courant number": 0.3},
    "Courant number 0.9": {"Time step/Courant number": 0.9},
}
FINEST = (DEFAULTS, "3 x 3 points")  # run on a fourth mesh


def measure(run):
    return {**dry_slope.measure(run), "mean p oscillation": np.mean(run.statistics("^p oscillation")[1:]),
            "CG iterations": np.mean(run.statistics("^CG iterations")[1:])}


def verdict(rows):
    return [Claim(listed(costs(rows)), True), Claim(f"{order(rows)}", True)]


STUDY = Study(
    title="Saturated slope of loose sand: error over cost", base="prm/slope_saturated_loose.prm", entries=dry_slope.STUDY.entries,
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 5, 2 / 15]))
    + product(axis("method", METHODS.__getitem__, FINEST), axis("h", "Mesh/Cell size", [1 / 10])),
    reference={"Mesh/Cell size": 0.05, **points(3)}, quick_reference={"Mesh/Cell size": 2 / 15, **points(3)}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "single-point", "3 x 3 points", "FLIP"),
    measure=measure, verdict=verdict,
    chart=WorkPrecision(error="error", curves=["method"], annotate="h", ylabel="error of fronts and centre of mass (-)"))
