# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/saturated_slope.md."""

import math

import numpy as np

from scree.studies import Lookup, Study, WorkPrecision
from scree.studies.cases import dry_slope
from scree.studies.precision import (DEFAULTS, LimitFit, at_finest, beside_defaults, curve, methods, order, ratios,
                                     table, variants)

FLIP = {"Transfer/Method": "FLIP", "Transfer/PIC rate": 5}
CANDIDATE = "FLIP, 3 x 3 points"
METHODS = methods("single-point", "no F-bar", "2 x 2 points", "3 x 3 points",
                  {"FLIP": FLIP, "FLIP, PIC rate 20": {**FLIP, "Transfer/PIC rate": 20},
                   CANDIDATE: {**FLIP, **methods("3 x 3 points")["3 x 3 points"]}},
                  "tolerance 1e-3", "Courant number 0.3", "Courant number 0.9")
TIP = "front 99 % at the end, m"
REFERENCE = 0.05  # m, cells of the reference
HYDROSTATIC = 1000 * 9.81 * 2  # p under the crest, 2 m high, at the start, Pa
FINEST = (DEFAULTS, "3 x 3 points", "FLIP", CANDIDATE, "FLIP, PIC rate 20")  # run on a fourth mesh


def measure(run):
    return {**dry_slope.measure(run), "median p oscillation": np.median(run.statistics("p oscillation (-)")[1:]),
            "largest effective stress, kPa": np.max(run.statistics("Largest effective stress (Pa)")) / 1e3,
            "largest p, kPa": np.max(run.statistics("Largest p (Pa)")) / 1e3,
            "CG iterations": np.mean(run.statistics("CG iterations per step")[1:])}


def verdict(rows, claim):
    error, oscillation, p_oscillation = (ratios(rows, name)
                                         for name in ("error", "mean oscillation", "median p oscillation"))
    coarse = next(iter(curve(rows, CANDIDATE).values()), dict.fromkeys(rows[0], math.nan))
    fine, finest = list(curve(rows).values())[-1], min(curve(rows))
    flip, own = curve(rows, "FLIP", TIP), curve(rows, column=TIP)
    is_farther = any(flip[h][TIP] > own[h][TIP] for h in flip.keys() & own.keys())
    gained = Lookup(lambda method: rows.where(method=method).largest["energy gained"])
    peak = Lookup(lambda method: _largest(rows, method))
    claim = claim.shared(**beside_defaults(rows), h=finest, peak=peak, oscillation=oscillation,
                         p_oscillation=p_oscillation)
    return [
        claim("convergence", at_finest(rows, CANDIDATE) < 0.15
              and not any(LimitFit(rows, REFERENCE, method).found for method in (CANDIDATE, DEFAULTS)), quick=False,
              worst=True,
              candidate=at_finest(rows, CANDIDATE), defaults=at_finest(rows, DEFAULTS), reference=REFERENCE),
        claim("FLIP", error["FLIP"] < 1.5 and not is_farther and gained["FLIP"] < 0.005,
              front=Lookup(lambda method: at_finest(rows, method, TIP))),
        claim("peaks", abs(peak["FLIP"] / peak[DEFAULTS] - 1) < 0.2, quick=False),
        claim("pore pressure", rows.largest["largest p, kPa"] < 1.05e-3 * HYDROSTATIC and p_oscillation["FLIP"] < 1.5,
              quick=False, rows=rows, hydrostatic=HYDROSTATIC / 1e3),
        claim("step", abs(error["Courant number 0.3"] - 1) < 0.05, quick=False),
        claim("points", error["3 x 3 points"] < 1.1 and p_oscillation["3 x 3 points"] < 1.2),
        claim("single-point", 0.8 < error["single-point"] < 1.55 and gained["single-point"] > 0.02,
              single=gained["single-point"], double=gained[DEFAULTS]),
        claim("F-bar", oscillation["no F-bar"] > 1.3, quick=False),
        claim("tolerance", abs(error["tolerance 1e-3"] - 1) < 0.01, quick=False),
        claim("cost", coarse["error"] < 1.1 * fine["error"] and coarse["core-seconds"] < 0.3 * fine["core-seconds"],
              quick=False, order=order(rows), distance=coarse["error"] / fine["error"], coarse=coarse, fine=fine)]


def _largest(rows, method):
    """Largest mean effective stress of all runs of a method, kPa."""
    stresses = rows.where(method=method).values["largest effective stress, kPa"]
    return max(filter(math.isfinite, stresses), default=math.nan)


STUDY = Study(
    "prm/slopes/slope_saturated_loose.prm", entries=dry_slope.STUDY.entries,
    variants=variants(METHODS, "Mesh/Cell size", [1 / 5, 2 / 15])
    + variants(METHODS, "Mesh/Cell size", [1 / 10], FINEST),
    reference={"Mesh/Cell size": REFERENCE, **METHODS[CANDIDATE]},
    quick_reference={"Mesh/Cell size": 2 / 15, **METHODS["3 x 3 points"]}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "single-point", "3 x 3 points", "FLIP"),
    table=lambda rows: table(rows,
                             [method for method in METHODS
                              if method.startswith("FLIP")]),
    chart=WorkPrecision({DEFAULTS: "AFLIP (the case)", "3 x 3 points": "3 x 3 points\n(recommended)",
                         "2 x 2 points": "2 x 2 points\n(cheapest)",
                         CANDIDATE: "FLIP, 3 x 3 points\n(method of reference)", "no F-bar": "no F-bar (worst)"},
                        "difference from the FLIP run with h = 0.05 m (-)"))
