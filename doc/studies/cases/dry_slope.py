"""A slope of dense dry sand fails and runs out (`prm/slope_dense.prm`, its first 1.5 s). There is no exact solution: the reference is the
defaults' run on a finer mesh, h = 0.04 m, so that what all meshes have in common, the base above all, does not show. Error: rms over time (each
0.1 s from 0.5 s on) and over three lengths, the fronts that hold 90 and 99 % of the mass and the height of the centre of mass, of their distance to the
reference, over what each has moved in it by the end. Methods differ from the defaults (splines, FLIP with a PIC rate of 5 1/s, 4 x 4 points a cell,
Courant number 0.6, modified F-bar) in one thing."""

import math

import numpy as np

from charts import WorkPrecision
from precision import DEFAULTS, cost_at_equal_error, costs, listed, order, ratio
from study import Claim, Study, axis, product

METHODS = {
    DEFAULTS: {},
    "linear": {"Mesh/Basis": "linear"},
    "no F-bar": {"Stabilisation/F-bar": "none"},
    "standard F-bar": {"Stabilisation/F-bar": "standard"},
    "2 x 2 points": {"Soil/Points per cell": 2},
    "3 x 3 points": {"Soil/Points per cell": 3},
    "PIC rate 0": {"Transfer/PIC rate": 0},
    "PIC rate 1": {"Transfer/PIC rate": 1},
    "PIC rate 20": {"Transfer/PIC rate": 20},
    "APIC": {"Transfer/Method": "APIC"},
    "TPIC": {"Transfer/Method": "TPIC"},
    "Courant number 0.3": {"Time step/Courant number": 0.3},
    "Courant number 0.9": {"Time step/Courant number": 0.9},
    "3 x 3 points, PIC rate 1": {"Soil/Points per cell": 3, "Transfer/PIC rate": 1},
}
FINEST = (DEFAULTS, "3 x 3 points", "TPIC", "3 x 3 points, PIC rate 1")  # run on a fourth mesh


def lengths(run, gravity=9.81):
    """Fronts of 90 and 99 % of the soil and the height of the centre of mass at the times of the rows, m."""
    mass = run.statistics("^mass ") if run.statistics("^water mass") is None else run.statistics("^mass ") + run.statistics("^water mass")
    return np.array([run.statistics("^front 90"), run.statistics("^front 99 "), run.statistics("^potential") / (mass * gravity)])


def measure(run):
    own, exact = lengths(run), lengths(run.reference)
    scale = np.abs(exact[:, -1] - exact[:, 0])
    late = run.time > 0.45
    errors = np.sqrt(np.mean(((own - exact)[:, late] / scale[:, None])**2, axis=1))
    dissipation = run.statistics("^numerical")
    released = run.statistics("^potential")[0] - run.statistics("^potential")[-1]
    return {"error": math.sqrt(np.mean(errors**2)), "error of front 90 %": errors[0], "error of front 99 %": errors[1],
            "error of centre of mass": errors[2], "front 99 % at the end, m": own[1, -1],
            "mean oscillation": np.mean(run.statistics("^stress oscillation")[1:]),
            "numerical dissipation": dissipation[-1] / released,
            "energy gained": np.max(np.maximum.accumulate(dissipation) - dissipation) / released}


def verdict(rows):
    return [Claim(listed(costs(rows)), True), Claim(f"{order(rows)}", True)]


STUDY = Study(
    title="Dry slope of dense sand: error over cost", base="prm/slope_dense.prm",
    entries={"End time": 1.5, "Mesh/Upper corner": "8, 2.4", "Output/Interval": 1.5, "Output/Statistics interval": 0.1, "Output/Graphics": "none"},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 5, 2 / 15, 1 / 10]))
    + product(axis("method", METHODS.__getitem__, FINEST), axis("h", "Mesh/Cell size", [1 / 15])),
    reference={"Mesh/Cell size": 0.04}, quick_reference={"Mesh/Cell size": 0.1, "Soil/Points per cell": 3}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "3 x 3 points", "PIC rate 0", "TPIC"),
    measure=measure, verdict=verdict,
    chart=WorkPrecision(error="error", curves=["method"], annotate="h", ylabel="error of fronts and centre of mass (-)"))
