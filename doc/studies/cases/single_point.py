# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where is it enough that water rides on the soil's points?"""

import numpy as np

import measures
from charts import StabilityMap
from study import Claim, Study, axis, product


def measure(run):
    mass = run.statistics("^water mass") + run.statistics("^water lost")
    return {"state": measures.classify(run), "water made": float(np.max(np.abs(mass / mass[0] - 1))),
            "front": float(run.statistics("^front 99.5")[-1]), "largest porosity": float(np.max(run.statistics("^largest porosity"))),
            "p oscillation": measures.mean_oscillation(run), "gain": measures.energy_gain(run), "cause": measures.cause(run)}


def verdict(rows):
    return []


STUDY = Study(
    title="Saturated slide: water on its own points, and on the soil's", base="prm/slope_saturated_mohr_coulomb.prm",
    entries={"Mesh/Cell size": 0.1, "Mesh/Upper corner": "6, 1.5", "Soil/Region": "if(x < 1, y < 1, y < 2 - x)", "End time": 1.5,
             "Output/Interval": 0.25, "Output/Statistics interval": 0.05, "Output/Graphics": "points"},
    variants=product(axis("points", "Water/Point sets", ["double", "single"]),
                     axis("friction", "Soil/Mohr-Coulomb/Friction angle", [10., 18.5, 25., 30., 35., 40.]),
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 5e-3, 1e-4])),
    measure=measure, verdict=verdict, needs_end=False,
    chart=StabilityMap("friction", "k", panels=["points"], number="water made", xlabel="friction angle (degrees)", ylabel="k (m/s)"))
