# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/dam_break.md."""

import math

import numpy as np

from scree.studies import Study, WorkPrecision, lost_energy, precision
from scree.studies.cases import dry_slope
from scree.studies.precision import DEFAULTS, LimitFit, at_finest, beside_defaults, costs, curve, methods, ratios

STEP = 0.04  # s/m: longest step over cell size
REFERENCE = 1 / 60  # m, cells of the reference
STEPS = {"half the step": 0.5, "twice the step": 2.}
METHODS = methods("linear", "2 x 2 points", "3 x 3 points", "6 x 6 points", "FLIP",
                  {name: {"Time step/Advection number": 0.3 * factor} for name, factor in STEPS.items()},
                  "tolerance 1e-2", "tolerance 1e-6", "tolerance 1e-9",
                  {"no volume correction": {"Water/Volume correction rate": 0}}, without="Soil")


def mesh(h, method=DEFAULTS):
    return {"Mesh/Cell size": h, "Time step/Maximum time step": STEP * h * STEPS.get(method, 1.)}


def variants(methods, sizes):
    return [variant for method in methods
            for variant in precision.variants(METHODS, lambda h, method=method: mesh(h, method), sizes, [method])]


def lengths(run):
    """Fronts of 90 and 99 % of the water and the height of its centre of mass at the times of the rows, m."""
    return np.array([run.statistics("Water front 90 % (m)"), run.statistics("Water front 99 % (m)"),
                     run.statistics("Potential energy (J)") / (run.statistics("Water mass (kg)") * 9.81)])


def measure(run):
    return {**dry_slope.errors(run, lengths(run), lengths(run.reference), 0.19),
            "largest volume error": np.max(run.statistics("Volume error (-)")),
            "numerical dissipation": lost_energy(run),
            "CG iterations": np.mean(run.statistics("CG iterations per step")[1:])}


def verdict(rows, claim):
    fit, raw = LimitFit(rows, REFERENCE), rows
    rows = fit.against_limit(rows)
    error, iterations, found = ratios(rows), ratios(rows, "CG iterations"), costs(rows)
    coarse, fine = max(curve(rows), default=math.nan), min(curve(rows), default=math.nan)
    volumes = [at_finest(rows, method, "largest volume error") for method in ("3 x 3 points", DEFAULTS)]
    claim = claim.shared(**beside_defaults(rows))
    return [
        claim("order", fit.found and fit.order > 1 and fit.lack(fine) < 0.005 and error["half the step"] > 0.9
              and error["twice the step"] > 1.2, quick=False, fit=fit, coarse=coarse, fine=fine,
              lack_of_coarse=fit.lack(coarse), lack_of_fine=fit.lack(fine), distance=at_finest(raw, DEFAULTS)),
        claim("tolerance", abs(error["tolerance 1e-6"] - 1) < 0.005 and iterations["tolerance 1e-6"] > 1.15
              and abs(error["tolerance 1e-2"] - 1) < 0.02 and iterations["tolerance 1e-2"] < 0.75,
              iterations=iterations),
        claim("points", error["3 x 3 points"] < 1.1 and error["2 x 2 points"] > 1, volume=100 * volumes[0],
              volume_of_defaults=volumes[1]),
        claim("transfer", error["FLIP"] < 1.5 and error["linear"] < 1.1),
        claim("volume correction", 0.85 < error["no volume correction"] < 1.2),
        claim("cost", found["tolerance 1e-6"] > 0.9 and found["2 x 2 points"] > 1.5 and found["half the step"] > 1.5,
              quick=False)]


STUDY = Study(
    "prm/water/dam_break.prm",
    entries={"End time": 0.68, "Output/Interval": 0.68, "Output/Statistics interval": 0.04, "Output/Graphics": "none"},
    variants=variants(METHODS, [1 / 10, 1 / 20]) + variants((DEFAULTS, "2 x 2 points", "3 x 3 points"), [1 / 30]),
    reference=mesh(REFERENCE), quick_reference={**mesh(1 / 30), "Water/Points per cell": 3},
    default={"method": DEFAULTS}, quick=lambda labels: labels["h"] > 0.09,
    table=lambda rows: precision.table(LimitFit(rows, REFERENCE).against_limit(rows)),
    chart=WorkPrecision({DEFAULTS: "defaults", "3 x 3 points": "3 x 3 points\n(recommended)",
                         "linear": "linear (cheapest)",
                         "half the step": "half the time step", "2 x 2 points": "2 x 2 points (worst)"},
                        "difference from the run with h = 0.017 m (-)"))
