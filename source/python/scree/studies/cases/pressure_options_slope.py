# SPDX-License-Identifier: LGPL-2.1-or-later
"""A saturated slope of Mohr-Coulomb soil, 0.8 m high, in the first second of its slide: a free surface moves through the cells, cells empty, and points cross.
The oscillation of p is the RMS about linear fits over 3 x 3 cells, over the mean p at the start, mean over time.
The options are those of [the column](consolidation.md#options-of-the-pressure-over-conductivity-and-time-step).
"""

import math

from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.cases.pressure_options import OPTIONS, SCATTER
from scree.studies.study import Claim, Study, Variant, axis, product


def measure(run):
    front = run.statistics("Front 99.5 % (m)")
    return {**measures.classify(run, {SCATTER: measures.pressure_scatter(run)}), "front": float(front[-1]),
            "time reached": float(run.time[-1]), "largest p": float(max(run.statistics("Largest p (Pa)"))),
            "cause": measures.cause(run)}


def verdict(rows):
    def select(pressure):
        return [row for row in rows if row["pressure"] == pressure]

    def scatter(pressure):
        return max((row[SCATTER] for row in select(pressure)), default=math.nan)

    ours = select("ours")
    return [
        Claim(f"Ours, from k = {max(row['k'] for row in ours):g} to {min(row['k'] for row in ours):g} m/s, gains {max(row['gain'] for row in ours):.1g} of the released energy. Its oscillation of p is just "
              f"within the bound of {measures.BOUNDS[SCATTER]:g}: up to {scatter('ours'):.2g} of the mean p at the start, highest where nothing drains.",
              all(row["state"] == "stable" for row in ours), quick=False),
        Claim(f"The plain average of the points oscillates less ({scatter('p^n average'):.2g}), but damps the hydrostatic pressure, too "
              "(study of the column).", scatter("p^n average") < scatter("ours"), quick=False),
    ]


STUDY = Study(
    title="Options of the pressure in a saturated slide",
    question="Is the pressure of a slide smooth for any conductivity and time step?",
    advice="Keep the default of `Previous pressure`; keep the Courant number at 0.9 or below.",
    base="prm/slopes/slope_saturated_mohr_coulomb.prm",
    entries={"Mesh/Cell size": 0.1, "Mesh/Upper corner": "4, 1.2", "Soil/Region": "if(x < 0.6, y < 0.8, y < 1.4 - x)", "End time": 1.,
             "Soil/Mohr-Coulomb/Young's modulus": 1e6, "Time step/Maximum time step": 0.01, "Output/Interval": 0.1,
             "Output/Graphics": "points"},
    variants=product([Variant({"pressure": name}, {f"Water/Pressure/{entry}": value for entry, value in entries.items()})
                      for name, entries in OPTIONS.items()],
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12]),
                     axis("step/limit", "Time step/Courant number", [0.3, 0.6, 1.2])),
    measure=measure, verdict=verdict, needs_end=False, default={"pressure": "ours"},
    quick=lambda labels: labels["pressure"] == "ours" and labels["k"] in (1e-1, 1e-3, 1e-12) and labels["step/limit"] == 0.6,
    chart=StabilityMap("k", "step/limit", panels=["pressure"], xlabel="k (m/s)", ylabel="time step over limit"))
