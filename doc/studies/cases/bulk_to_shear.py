# SPDX-License-Identifier: LGPL-2.1-or-later
"""How nearly incompressible may soil be before stress oscillates or the mesh locks?"""

import numpy as np

import closed_forms
import measures
from charts import StabilityMap
from study import Claim, Study, Variant, axis, product

SHEAR_MODULUS, SIDE, DENSITY = 5e4, 0.5, 2000.


def elastic(ratio):
    poisson = (3 * ratio - 2) / (6 * ratio + 2)
    return {"Soil/Linear elastic/Poisson's ratio": poisson, "Soil/Linear elastic/Young's modulus": 2 * SHEAR_MODULUS * (1 + poisson)}


def measure(run):
    # The block swings, and its mean P may vanish: the unit is that of the weight.
    scatter = run.statistics("^stress oscillation") * run.statistics("^mean P") / (DENSITY * closed_forms.GRAVITY * SIDE / 2)
    top = run.statistics("^height")
    scatter = float(np.mean(scatter[1:]))
    return {"state": measures.classify(run, scatter=scatter, oscillation=0.2, gain=0.05), "scatter": scatter, "gain": measures.energy_gain(run),
            "largest settlement": float(top[0] - np.min(top)), "smallest J": measures.volume_ratios(run)[0],
            "largest J": measures.volume_ratios(run)[1], "cause": measures.cause(run)}


def verdict(rows):
    return []


STUDY = Study(
    title="Elastic block under its weight: bulk over shear modulus", base="prm/benchmarks/elastic_2d.prm",
    entries={"Mesh/Upper corner": "1, 0.625", "Mesh/Cell size": 0.0625, "Soil/Region": f"x < {SIDE} && y < {SIDE}", "Soil/Grain density": DENSITY,
             "End time": 0.5,
             "Output/Interval": 0.1, "Output/Statistics interval": 0.02, "Output/Graphics": "points"},
    variants=product(axis("basis", "Mesh/Basis", ["spline", "quadratic", "linear"]), axis("points", "Soil/Points per cell", [2, 4]),
                     axis("K/G", elastic, [1., 10., 100., 1000., 10000.]), axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified"])),
    measure=measure, verdict=verdict, needs_end=False,
    chart=StabilityMap("K/G", "F-bar", panels=["points", "basis"], number="scatter", xlabel="bulk over shear modulus", ylabel=""))
