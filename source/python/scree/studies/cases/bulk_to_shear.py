# SPDX-License-Identifier: LGPL-2.1-or-later
"""An elastic block, 0.5 m x 0.5 m in 8 x 8 cells, sags and vibrates under its weight for 0.5 s; K/G varies from 1 to 10^4 at the same G.
It bulges sideways into cells that were empty, or stands between smooth walls that touch it (vertical strain only).
The oscillation of p' is the stress oscillation times the mean p', over rho g H/2, mean over time.
The energy of an elastic block in explicit time steps oscillates by about 0.02, which counts as a gain.
"""

import numpy as np

from scree import closed_forms
from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.study import Claim, Study, axis, product

SHEAR_MODULUS, SIDE, DENSITY = 5e4, 0.5, 2000.
SCATTER = "oscillation of p'"


def elastic(ratio):
    poisson = (3 * ratio - 2) / (6 * ratio + 2)
    return {"Soil/Linear elastic/Poisson's ratio": poisson, "Soil/Linear elastic/Young's modulus": 2 * SHEAR_MODULUS * (1 + poisson)}


def measure(run):
    # The block swings, and its mean p' may vanish: the unit is that of the weight.
    scatter = run.statistics("Stress oscillation (-)") * run.statistics("Mean effective stress (Pa)") / (DENSITY * closed_forms.GRAVITY * SIDE / 2)
    top = run.statistics("Height (m)")
    scatter = float(np.mean(scatter[1:])) if len(scatter) > 1 else float("nan")
    return {**measures.classify(run, {SCATTER: scatter}), "largest settlement": float(top[0] - np.min(top)), "cause": measures.cause(run)}


def verdict(rows):
    def select(sides, basis, kind):
        return {row["K/G"]: row for row in rows if (row["sides"], row["basis"], row["F-bar"]) == (sides, basis, kind)}

    ours, none, standard = (select("free", "spline", kind) for kind in ("modified", "none", "standard"))
    stiffest = max(ours)
    smooth = max(ratio for ratio, row in ours.items() if row[SCATTER] <= measures.BOUNDS[SCATTER])
    ours, none, standard = (rows_of[stiffest] for rows_of in (ours, none, standard))
    swing = max(row["gain"] for row in rows if row["default"])
    stiffness = 1 - none["largest settlement"] / ours["largest settlement"]
    def broken(sides):
        chosen = [row for row in rows if row["basis"] == "linear" and row["sides"] == sides]
        return sum(not row["ended"] for row in chosen), len(chosen)

    linear, linear_between = broken("free"), broken("walls")
    return [
        Claim(f"The defaults (splines, modified F-bar) are smooth with free sides up to K/G = {smooth:g}; at {stiffest:g} p' oscillates by {ours[SCATTER]:.2g}, "
              f"without F-bar by {none[SCATTER]:.2g}.", smooth >= 1000 and ours[SCATTER] < 0.3 and none[SCATTER] > 1),
        Claim(f"Standard F-bar gains {standard['gain']:.2g} of the released energy at K/G = {stiffest:g}, modified {ours['gain']:.1g}, and in no cell more than {swing:.2g}.",
              standard["gain"] > 0.1 > ours["gain"] and swing < 0.05),
        Claim(f"Without F-bar the block locks: at K/G = {stiffest:g} it sags {100 * stiffness:.0f} % less than with the modified one.",
              stiffness > 0.05),
        Claim(f"With linear functions the run stops when an edge of the block enters a new cell, whatever the F-bar: {linear[0]} of {linear[1]} runs with free sides, "
              f"{linear_between[0]} of {linear_between[1]} between walls. The node beyond the edge has little mass, and the gradient of its "
              "function acts on a point in the new cell in full. The gradient of a spline vanishes there, as its value does.",
              linear[0] > linear[1] / 2 and linear_between[0] == 0, quick=False),
    ]


STUDY = Study(
    title="Bulk over shear modulus",
    question="How nearly incompressible may soil be?",
    advice="Use splines with modified F-bar, up to K/G = 1000.",
    base="prm/benchmarks/elastic_2d.prm",
    entries={"Mesh/Cell size": 0.0625, "Soil/Region": f"x < {SIDE} && y < {SIDE}", "Soil/Grain density": DENSITY,
             "End time": 0.5,
             "Output/Interval": 0.1, "Output/Statistics interval": 0.02, "Output/Graphics": "points"},
    variants=product(axis("sides", lambda sides: {"Mesh/Upper corner": f"{1. if sides == 'free' else SIDE}, 0.625"}, ["free", "walls"]),
                     axis("basis", "Mesh/Basis", ["spline", "linear"]),
                     axis("K/G", elastic, [1., 10., 100., 1000., 10000.]), axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified"])),
    measure=measure, verdict=verdict, needs_end=False, default={"basis": "spline", "F-bar": "modified"},
    quick=lambda labels: labels["sides"] == "free" and labels["basis"] == "spline" and labels["K/G"] in (1000., 10000.),
    chart=StabilityMap("K/G", "F-bar", panels=["sides", "basis"], xlabel="bulk over shear modulus", ylabel="F-bar"))
