"""A saturated slope of loose sand slides (`prm/slope_saturated_loose.prm`, its first 1.5 s). The reference is the case's own method on a finer mesh,
h = 0.05 m with 3 x 3 points a cell. Error: as in the study of the dry slope, of the fronts that hold 90 and 99 % of the soil and of the height of the centre of mass of
soil and water. Methods differ from the case (double-point, TPIC, splines, 4 x 4 points a cell and phase, Courant number 0.6 and steps of
at most 1e-3 s, modified F-bar, relative tolerance of the pressure 1e-6) in one thing."""

import numpy as np

import dry_slope
from charts import WorkPrecision
from precision import DEFAULTS, costs, listed, order, ratio
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
    "FLIP, 3 x 3 points": {"Transfer/Method": "FLIP", **points(3)},
    "APIC": {"Transfer/Method": "APIC"},
    "tolerance 1e-3": {"Water/Pressure/Relative tolerance": 1e-3},
    "Courant number 0.3": {"Time step/Courant number": 0.3},
    "Courant number 0.9": {"Time step/Courant number": 0.9},
}
FINEST = (DEFAULTS, "3 x 3 points", "FLIP", "FLIP, 3 x 3 points")  # run on a fourth mesh


def measure(run):
    return {**dry_slope.measure(run), "mean p oscillation": np.mean(run.statistics("^p oscillation")[1:]),
            "CG iterations": np.mean(run.statistics("^CG iterations")[1:])}


def verdict(rows):
    found, candidate = costs(rows), "FLIP, 3 x 3 points"
    return [
        Claim(f"FLIP (PIC rate 5 1/s) is better than the TPIC of the case: {ratio(rows, 'FLIP'):.2g} times the error on the same mesh, even against a reference that "
              f"is TPIC's, for {ratio(rows, 'FLIP', 'core-seconds'):.2g} times the time; p oscillates {ratio(rows, 'FLIP', 'mean p oscillation'):.2g} times and the "
              f"stress {ratio(rows, 'FLIP', 'mean oscillation'):.2g} times as much, and no more energy is gained.",
              ratio(rows, "FLIP") < 0.75 and ratio(rows, "FLIP", "mean p oscillation") < 1.5),
        Claim(f"TPIC filters once a step: Courant number 0.3 instead of 0.6 makes {ratio(rows, 'Courant number 0.3'):.2g} times the error, for "
              f"{ratio(rows, 'Courant number 0.3', 'core-seconds'):.2g} times the time; 0.9 {ratio(rows, 'Courant number 0.9'):.2g} times.",
              ratio(rows, "Courant number 0.3") > 1.05, quick=False),
        Claim(f"3 x 3 points suffice: {ratio(rows, '3 x 3 points'):.2g} times the error for {ratio(rows, '3 x 3 points', 'core-seconds'):.2g} times the time, p "
              f"oscillation {ratio(rows, '3 x 3 points', 'mean p oscillation'):.3g} times.",
              ratio(rows, "3 x 3 points") < 1.1 and ratio(rows, "3 x 3 points", "mean p oscillation") < 1.2),
        Claim(f"Single-point water has the same fronts ({ratio(rows, 'single-point'):.2g} times the error) for {ratio(rows, 'single-point', 'core-seconds'):.2g} times the "
              f"time, but gains energy: {100 * max(row['energy gained'] for row in rows if row['method'] == 'single-point'):.0f} % of what is released, double-point "
              f"{100 * max(row['energy gained'] for row in rows if row['method'] == DEFAULTS):.1g} %.",
              0.8 < ratio(rows, "single-point") < 1.25 and max(row["energy gained"] for row in rows if row["method"] == "single-point") > 0.02),
        Claim(f"Without F-bar the stress oscillates {ratio(rows, 'no F-bar', 'mean oscillation'):.2g} times as much, and the error is {ratio(rows, 'no F-bar'):.2g} times "
              "as large.", ratio(rows, "no F-bar", "mean oscillation") > 1.3, quick=False),
        Claim(f"A relative tolerance of the pressure of 1e-3 instead of 1e-6 does not show ({ratio(rows, 'tolerance 1e-3'):.4g} times the error), but hardly pays: "
              f"{ratio(rows, 'tolerance 1e-3', 'core-seconds'):.2g} times the time.", abs(ratio(rows, "tolerance 1e-3") - 1) < 0.01, quick=False),
        Claim(f"Core-seconds for the same error (order {order(rows):.2g} only), over those of the defaults: " + listed(found)
              + f". The case is not on the front; {candidate} is.", found.get(candidate, 1) < 0.5, quick=False),
    ]


STUDY = Study(
    title="Saturated slope of loose sand: error over cost", base="prm/slope_saturated_loose.prm", entries=dry_slope.STUDY.entries,
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 5, 2 / 15]))
    + product(axis("method", METHODS.__getitem__, FINEST), axis("h", "Mesh/Cell size", [1 / 10])),
    reference={"Mesh/Cell size": 0.05, **points(3)}, quick_reference={"Mesh/Cell size": 2 / 15, **points(3)}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "single-point", "3 x 3 points", "FLIP"),
    measure=measure, verdict=verdict,
    chart=WorkPrecision(error="error", curves=["method"], annotate="h", ylabel="error of fronts and centre of mass (-)"))
