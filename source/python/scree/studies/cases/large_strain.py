# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/large_strain.md."""

import functools
import math

import numpy as np

from scree import closed_forms
from scree.studies import Study, WorkPrecision
from scree.studies.precision import (DEFAULTS, at_finest, beside_defaults, costs, failed, methods, order, ratios, table,
                                     variants)

MUD = closed_forms.Mud(1., closed_forms.oedometric_modulus(2e4, 0.2), 0.5, 1e-2)
TIMES = [MUD.time(factor) for factor in (0.25, 0.5, 1.)]
METHODS = methods("linear", "standard F-bar", "modified F-bar", "2 x 2 points", "3 x 3 points", "6 x 6 points", "FLIP",
                  "Courant number 0.2", "Courant number 0.9")


def mesh(h):
    return {"Mesh/Cell size": h, "Mesh/Upper corner": f"{2 * h:.12g}, 1.2"}


@functools.cache
def reference():
    return closed_forms.consolidate(MUD, TIMES, 100)


def measure(run):
    n_rows = round(float(run.entries["Soil/Points per cell"]) / float(run.entries["Mesh/Cell size"]))
    pressures, heights = [], []
    for state in reference():
        soil, water = run.points(state.time), run.points(state.time, "water")
        if soil.positions.shape[0] % n_rows:  # the run has lost soil
            return {"ended": False, "error": math.nan, "error of p": math.nan, "error of heights": math.nan}
        rows = np.sort(soil.positions[:, 1]).reshape(n_rows, -1).mean(axis=1)  # points of a row stay side by side
        material_height = (np.arange(n_rows) + 0.5) / n_rows
        exact = np.interp(material_height, [0, *state.material_height, 1], [0, *state.height, 1 - state.settlement])
        heights.append((rows - exact) / closed_forms.final_settlement(MUD))

        y = water.positions[:, 1]
        inside = y < 1 - state.settlement
        excess = water.arrays["pressure"][inside] - closed_forms.hydrostatic_pressure(y[inside], 1.)
        exact = np.interp(y[inside], [*state.height, 1 - state.settlement], [*state.excess_pressure, 0])
        pressures.append((excess - exact) / (MUD.buoyant_weight * MUD.height))
    errors = [math.sqrt(np.mean([np.mean(error**2) for error in kind])) for kind in (pressures, heights)]
    return {"error": math.sqrt(np.mean(np.square(errors))), "error of p": errors[0], "error of heights": errors[1]}


def verdict(rows, claim):
    error, best, six = ratios(rows), at_finest(rows, DEFAULTS), "6 x 6 points"
    stops = ", ".join(f"{h:.2g}" for h in failed(rows, "linear"))
    stops = f", and the run stops or loses soil at h = {stops} m" if stops else ""
    claim = claim.shared(**beside_defaults(rows))
    return [
        claim("basis", not error["linear"] < 5 and not failed(rows, DEFAULTS), stops=stops),
        claim("points", error["3 x 3 points"] > 1.2 and error["2 x 2 points"] > 2, worst=True),
        claim("more points", at_finest(rows, six) > best, quick=False, six=at_finest(rows, six) / best,
              time_of_six=at_finest(rows, six, "core-seconds") / at_finest(rows, DEFAULTS, "core-seconds")),
        claim("F-bar", 0.8 < error["modified F-bar"] < 1.4, quick=False),
        claim("transfer", 0.8 < error["FLIP"] < 1.4 and error["Courant number 0.9"] < 1.1, quick=False),
        claim("cost", costs(rows)["3 x 3 points"] > 1.1, quick=False, order=order(rows))]


STUDY = Study(
    "prm/consolidation/large_strain_consolidation.prm",
    entries={"End time": TIMES[-1], "Output/Interval": TIMES[0], "Output/Graphics": "points"},
    variants=variants(METHODS, mesh, [1 / 10, 1 / 20, 1 / 40]), default={"method": DEFAULTS}, table=table,
    quick=lambda labels: labels["h"] > 0.03
    and labels["method"] in (DEFAULTS, "linear", "modified F-bar", "2 x 2 points", "3 x 3 points"),
    chart=WorkPrecision({DEFAULTS: "defaults\n(recommended)", "6 x 6 points": "6 x 6 points",
                         "3 x 3 points": "3 x 3 points", "2 x 2 points": "2 x 2 points", "linear": "linear (worst)"},
                        "RMS error of p and heights against\nfinite differences (-)"))
