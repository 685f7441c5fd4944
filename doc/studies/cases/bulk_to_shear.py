# SPDX-License-Identifier: LGPL-2.1-or-later
"""How nearly incompressible may soil be before stress oscillates or the mesh locks?"""

import numpy as np

import measures
from charts import StabilityMap
from study import Claim, Study, Variant, axis, product

SHEAR_MODULUS, SIDE = 2e5, 0.5


def elastic(ratio):
    poisson = (3 * ratio - 2) / (6 * ratio + 2)
    return {"Soil/Linear elastic/Poisson's ratio": poisson, "Soil/Linear elastic/Young's modulus": 2 * SHEAR_MODULUS * (1 + poisson)}


def measure(run):
    state = measures.classify(run, column="^stress oscillation", oscillation=0.1)
    top = run.statistics("^height")
    return {"state": state, "P oscillation": measures.mean_oscillation(run, "^stress oscillation"), "gain": measures.energy_gain(run),
            "largest settlement": float(top[0] - np.min(top)), "front": float(np.max(run.statistics("^front 90"))),
            "J": measures.volume_ratios(run)[0], "cause": measures.cause(run)}


def verdict(rows):
    return []


STUDY = Study(
    title="Elastic block under its weight: bulk over shear modulus", base="prm/benchmarks/elastic_2d.prm",
    entries={"Mesh/Upper corner": "1, 0.625", "Mesh/Cell size": 0.0625, "Soil/Region": f"x < {SIDE} && y < {SIDE}", "Soil/Grain density": 2000,
             "End time": 0.5,
             "Output/Interval": 0.1, "Output/Statistics interval": 0.02, "Output/Graphics": "points"},
    variants=product(axis("basis", "Mesh/Basis", ["spline", "quadratic", "linear"]), axis("points", "Soil/Points per cell", [2, 4]),
                     axis("K/G", elastic, [1., 10., 100., 1000., 10000.]), axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified"])),
    measure=measure, verdict=verdict, needs_end=False,
    chart=StabilityMap("K/G", "F-bar", panels=["points", "basis"], number="P oscillation", xlabel="bulk over shear modulus", ylabel=""))
