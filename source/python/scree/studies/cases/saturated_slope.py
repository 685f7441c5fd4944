# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/saturated_slope.md."""

import math

import numpy as np

from scree.studies.cases import dry_slope
from scree.studies.charts import WorkPrecision
from scree.studies.precision import DEFAULTS, LimitFit, at_finest, curve, methods, order, ratio, table
from scree.studies.study import Claim, Study, axis, product


FLIP = {"Transfer/Method": "FLIP", "Transfer/PIC rate": 5}
METHODS = methods("single-point", "no F-bar", "2 x 2 points", "3 x 3 points",
                  {"FLIP": FLIP, "FLIP, PIC rate 20": {**FLIP, "Transfer/PIC rate": 20}, "FLIP, 3 x 3 points": {**FLIP, **methods("3 x 3 points")["3 x 3 points"]}},
                  "tolerance 1e-3", "Courant number 0.3", "Courant number 0.9")
TIP = "front 99 % at the end, m"
REFERENCE = 0.05  # m, cells of the reference
HYDROSTATIC = 1000 * 9.81 * 2  # p under the crest, 2 m high, at the start, Pa
FINEST = (DEFAULTS, "3 x 3 points", "FLIP", "FLIP, 3 x 3 points", "FLIP, PIC rate 20")  # run on a fourth mesh


def measure(run):
    return {**dry_slope.measure(run), "median p oscillation": np.median(run.statistics("p oscillation (-)")[1:]),
            "largest effective stress, kPa": np.max(run.statistics("Largest effective stress (Pa)")) / 1e3,
            "largest p, kPa": np.max(run.statistics("Largest p (Pa)")) / 1e3, "CG iterations": np.mean(run.statistics("CG iterations per step")[1:])}


def verdict(rows):
    candidate = "FLIP, 3 x 3 points"
    coarse = next(iter(curve(rows, candidate).values()), dict.fromkeys(rows[0], math.nan))
    fine = list(curve(rows).values())[-1]
    finest = min(curve(rows))

    def front(method):
        return at_finest(rows, method, TIP)
    flip, own = curve(rows, "FLIP", TIP), curve(rows, column=TIP)
    farther = [flip[h][TIP] > own[h][TIP] for h in flip.keys() & own.keys()]
    return [
        Claim(f"No mesh has converged: with h = {finest:.2g} m FLIP with 3 x 3 points differs by {100 * at_finest(rows, candidate):.0f} % from its own run with "
              f"h = {REFERENCE:g} m, the AFLIP of the case by {100 * at_finest(rows, DEFAULTS):.0f} %. The fits of an order and a limit (study of the dry slope) find none for either.",
              at_finest(rows, candidate) < 0.15 and not any(LimitFit(rows, REFERENCE, method).found for method in (candidate, DEFAULTS)), quick=False, worst=True),
        Claim(f"FLIP (PIC rate 5 1/s) runs out less far than the AFLIP of the case and has {ratio(rows, 'FLIP'):.2g} times its distance to the reference on the "
              f"same mesh (0.75 was asked and is missed). It takes {ratio(rows, 'FLIP', 'core-seconds'):.2g} times the time. It gains no energy. Independent of the reference, "
              f"the fronts of AFLIP are the farther on each mesh (at 99 % of the soil {front('FLIP'):.2f} against {front(DEFAULTS):.2f} m with h = {finest:.2g} m).",
              ratio(rows, "FLIP") < 1.5 and not any(farther) and max(row["energy gained"] for row in rows if row["method"] == "FLIP") < 0.005),
        Claim(f"Single peaks of p' are more than 1.2 times as high with FLIP: {_largest(rows, 'FLIP'):.0f} kPa ({_largest(rows, 'FLIP, 3 x 3 points'):.0f} kPa with 3 x 3 points), against "
              f"{_largest(rows, DEFAULTS):.0f} kPa with AFLIP. A PIC rate of 20 1/s has {ratio(rows, 'FLIP, PIC rate 20'):.2g} times the error of AFLIP and peaks of "
              f"{_largest(rows, 'FLIP, PIC rate 20'):.0f} kPa.",
              _largest(rows, "FLIP") > 1.2 * _largest(rows, DEFAULTS), quick=False),
        Claim(f"The pore pressure has no such peaks: p does not exceed {max(row['largest p, kPa'] for row in rows):.1f} kPa with any method; that of water at rest under "
              f"the crest is {HYDROSTATIC / 1e3:.1f} kPa. With FLIP it oscillates {ratio(rows, 'FLIP', 'median p oscillation'):.2g} times as much as with AFLIP.",
              max(row["largest p, kPa"] for row in rows) < 1.05e-3 * HYDROSTATIC and ratio(rows, "FLIP", "median p oscillation") < 1.5, quick=False),
        Claim(f"Courant number 0.3 instead of 0.6 makes {ratio(rows, 'Courant number 0.3'):.2g} times the error, for "
              f"{ratio(rows, 'Courant number 0.3', 'core-seconds'):.2g} times the time; 0.9 {ratio(rows, 'Courant number 0.9'):.2g} times.",
              ratio(rows, "Courant number 0.3") > 1.05, quick=False),
        Claim(f"3 x 3 points are sufficient: {ratio(rows, '3 x 3 points'):.2g} times the error for {ratio(rows, '3 x 3 points', 'core-seconds'):.2g} times the time, p "
              f"oscillation {ratio(rows, '3 x 3 points', 'median p oscillation'):.3g} times.",
              ratio(rows, "3 x 3 points") < 1.1 and ratio(rows, "3 x 3 points", "median p oscillation") < 1.2),
        Claim(f"Single-point water has nearly the same fronts ({ratio(rows, 'single-point'):.2g} times the error; 1.25 was asked and is missed) for {ratio(rows, 'single-point', 'core-seconds'):.2g} times the "
              f"time, but gains energy: {100 * max(row['energy gained'] for row in rows if row['method'] == 'single-point'):.0f} % of the released energy, double-point "
              f"{100 * max(row['energy gained'] for row in rows if row['method'] == DEFAULTS):.1g} %.",
              0.8 < ratio(rows, "single-point") < 1.55 and max(row["energy gained"] for row in rows if row["method"] == "single-point") > 0.02),
        Claim(f"Without F-bar the stress oscillates {ratio(rows, 'no F-bar', 'mean oscillation'):.2g} times as much, and the error is {ratio(rows, 'no F-bar'):.2g} times "
              "as large.", ratio(rows, "no F-bar", "mean oscillation") > 1.3, quick=False),
        Claim(f"A relative tolerance of the pressure of 1e-3 instead of 1e-4 does not show ({ratio(rows, 'tolerance 1e-3'):.4g} times the error) and saves little: "
              f"{ratio(rows, 'tolerance 1e-3', 'core-seconds'):.2g} times the time.", abs(ratio(rows, "tolerance 1e-3") - 1) < 0.01, quick=False),
        Claim(f"Core-seconds for the same distance to the reference, among methods of the same order ({order(rows):.2g} against this reference). The case is not Pareto-optimal: "
              f"{candidate} has {coarse['error'] / fine['error']:.2g} times its distance with h = {coarse['h']:.2g} instead of {fine['h']:.2g} m, for {coarse['core-seconds']:.2g} instead of "
              f"{fine['core-seconds']:.2g} core-seconds.", coarse["error"] < 1.1 * fine["error"] and coarse["core-seconds"] < 0.3 * fine["core-seconds"], quick=False),
    ]


def _largest(rows, method):
    """Largest mean effective stress of all runs of a method, kPa."""
    stresses = [row["largest effective stress, kPa"] for row in rows if row["method"] == method]
    return max(filter(math.isfinite, stresses), default=math.nan)


STUDY = Study(
    title="Saturated slope: error over cost",
    question="Which method gives the front of a saturated slope at the least cost?",
    advice="Run at least two cell sizes with AFLIP.",
    base="prm/slopes/slope_saturated_loose.prm", entries=dry_slope.STUDY.entries,
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 5, 2 / 15]))
    + product(axis("method", METHODS.__getitem__, FINEST), axis("h", "Mesh/Cell size", [1 / 10])),
    reference={"Mesh/Cell size": REFERENCE, **METHODS["FLIP, 3 x 3 points"]}, quick_reference={"Mesh/Cell size": 2 / 15, **METHODS["3 x 3 points"]}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "single-point", "3 x 3 points", "FLIP"),
    measure=measure, verdict=verdict,
    table=lambda rows: table(rows, [method for method in METHODS if method.startswith("FLIP")]),
    chart=WorkPrecision({DEFAULTS: "AFLIP (the case)", "3 x 3 points": "3 x 3 points\n(recommended)", "2 x 2 points": "2 x 2 points\n(cheapest)", "FLIP, 3 x 3 points": "FLIP, 3 x 3 points\n(method of reference)", "no F-bar": "no F-bar (worst)"}, "difference from the FLIP run with h = 0.05 m (-)"))
