# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/dry_slope.md."""

import math

import numpy as np

from scree.studies import Lookup, Study, WorkPrecision, energy_gain, lost_energy, transfer
from scree.studies.precision import (DEFAULTS, LimitFit, at_finest, beside_defaults, costs, curve, methods, ratios,
                                     table, variants)

METHODS = methods("linear", "no F-bar", "standard F-bar", "2 x 2 points", "3 x 3 points", "PIC rate 0", "PIC rate 5",
                  "PIC rate 20",
                  {"TPIC": transfer("TPIC")}, "Courant number 0.3", "Courant number 0.9", without="Water")
REFERENCE = 0.04  # m, cells of the reference
FINEST = (DEFAULTS, "3 x 3 points", "TPIC", "PIC rate 5")  # run on a fourth mesh


def lengths(run):
    """Fronts of 90 and 99 % of the soil and the height of the centre of mass at the times of the rows, m."""
    # the study of the saturated slope measures so, too
    mass = run.statistics("Mass (kg)") + run.columns.get("Water mass (kg)", 0.)
    return np.array([run.statistics("Front 90 % (m)"), run.statistics("Front 99 % (m)"),
                     run.statistics("Potential energy (J)") / (mass * 9.81)])


def errors(run, own, exact, since):
    """Columns of the errors of three lengths, over the displacement of each in the reference, from a time on."""
    scale = np.abs(exact[:, -1] - exact[:, 0])
    found = np.sqrt(np.mean(((own - exact)[:, run.time > since] / scale[:, None])**2, axis=1))
    return {"error": math.sqrt(np.mean(found**2)), "error of front 90 %": found[0], "error of front 99 %": found[1],
            "error of centre of mass": found[2]}


def measure(run):
    own = lengths(run)
    released = run.statistics("Potential energy (J)")[0] - run.statistics("Potential energy (J)")[-1]
    return {**errors(run, own, lengths(run.reference), 0.45), "front 99 % at the end, m": own[1, -1],
            "mean oscillation": np.mean(run.statistics("Stress oscillation (-)")[1:]),
            "numerical dissipation": lost_energy(run), "energy gained": energy_gain(run, released)}


def verdict(rows, claim):
    fit, tip, raw = LimitFit(rows, REFERENCE), LimitFit(rows, REFERENCE, column="error of front 99 %"), rows
    rows = fit.against_limit(rows)
    error, oscillation, found = ratios(rows), ratios(rows, "mean oscillation"), costs(rows)
    least = min(cost for method, cost in found.items() if "points" not in method)
    finest = min(curve(rows), default=math.nan)

    def dissipation(method):
        """On h = 0.1 m, %; nan without such a run."""
        row = rows.first(lambda row: row["method"] == method and abs(row["h"] - 0.1) < 1e-3)
        return 100 * row["numerical dissipation"] if row else math.nan

    claim = claim.shared(**beside_defaults(rows), oscillation=oscillation)
    return [
        claim("limit", fit.found and fit.lack(finest) < 0.15, quick=False, h=finest, fit=fit, lack=fit.lack(finest),
              lack_of_tenth=fit.lack(0.1),
              tip=tip, lack_of_tip=tip.lack(finest), distance=at_finest(raw, DEFAULTS), reference=REFERENCE),
        claim("rate", error["PIC rate 5"] > 1.1 and error["TPIC"] > 1.5, raw=ratios(raw)),
        claim("dissipation", oscillation["PIC rate 5"] > 0.85, quick=False, dissipation=Lookup(dissipation),
              factor=1 / oscillation["PIC rate 5"]),
        claim("3 points", error["3 x 3 points"] < 1.1),
        claim("2 points", error["2 x 2 points"] < 1.2 and oscillation["2 x 2 points"] < 1.2, quick=False),
        claim("F-bar", oscillation["no F-bar"] > 2 and oscillation["standard F-bar"] > 2 and found["no F-bar"] > 1,
              quick=False),
        claim("step", abs(error["Courant number 0.9"] - 1) < 0.05 and abs(error["Courant number 0.3"] - 1) < 0.05,
              quick=False),
        claim("cost", least > 0.7, quick=False, least=least)]


STUDY = Study(
    "prm/slopes/slope_dense.prm",
    entries={"Transfer/PIC rate": "auto", "End time": 1.5, "Mesh/Upper corner": "8, 2.4", "Output/Interval": 1.5,
             "Output/Statistics interval": 0.1, "Output/Graphics": "none"},
    variants=variants(METHODS, "Mesh/Cell size", [1 / 5, 2 / 15, 1 / 10])
    + variants(METHODS, "Mesh/Cell size", [1 / 15], FINEST),
    reference={"Mesh/Cell size": REFERENCE}, quick_reference={"Mesh/Cell size": 0.1, "Soil/Points per cell": 3},
    default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "3 x 3 points", "PIC rate 5", "TPIC"),
    table=lambda rows: table(LimitFit(rows, REFERENCE).against_limit(rows)),
    chart=WorkPrecision({DEFAULTS: "defaults", "3 x 3 points": "3 x 3 points\n(recommended)",
                         "2 x 2 points": "2 x 2 points\n(cheapest)",
                         "PIC rate 5": "PIC rate 5 1/s", "TPIC": "TPIC (worst)"},
                        "difference from the run with h = 0.04 m (-)"))
