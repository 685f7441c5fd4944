# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options of the pressure on soil that moves: a saturated slope of Mohr-Coulomb soil, 0.8 m high, in the first second of its slide.
States as in the study of the column at rest; here a free surface moves through the cells, cells empty, and points cross. The number is the
time mean of the p oscillation.
"""

import measures
from charts import StabilityMap
from pressure_options import OPTIONS
from study import Claim, Study, Variant, axis, product


def measure(run):
    front = run.statistics("^front 99.5")
    scatter = measures.pressure_scatter(run)
    return {"state": measures.classify(run, scatter=scatter, oscillation=0.1), "scatter": scatter, "gain": measures.energy_gain(run),
            "front": float(front[-1]), "time reached": float(run.time[-1]), "largest p": float(max(run.statistics("^largest p \\("))),
            "cause": measures.cause(run)}


def verdict(rows):
    return []


STUDY = Study(
    title="Options of the pressure in a saturated slide", base="prm/slope_saturated_mohr_coulomb.prm",
    entries={"Mesh/Cell size": 0.1, "Mesh/Upper corner": "4, 1.2", "Soil/Region": "if(x < 0.6, y < 0.8, y < 1.4 - x)", "End time": 1.,
             "Soil/Mohr-Coulomb/Young's modulus": 1e6, "Time step/Maximum time step": 0.01, "Output/Interval": 0.1,
             "Output/Graphics": "points"},
    variants=product([Variant({"pressure": name}, {f"Water/Pressure/{entry}": value for entry, value in entries.items()})
                      for name, entries in OPTIONS.items()],
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12]),
                     axis("step/limit", "Time step/Courant number", [0.3, 0.6, 1.2])),
    measure=measure, verdict=verdict, needs_end=False,
    chart=StabilityMap("k", "step/limit", panels=["pressure"], number="scatter", xlabel="k (m/s)", ylabel="step over limit"))
