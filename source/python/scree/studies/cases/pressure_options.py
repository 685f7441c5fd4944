# SPDX-License-Identifier: LGPL-2.1-or-later
"""Terzaghi's column, 1 m in ten cells, is under a sudden load q for 0.4 s, from T_v = 4.5 (k = 0.1 m/s) to 0.
The error is the RMS of p/q at four times, below three cells from the drained top, against the solution with inertia.
The oscillation of p is the RMS of that error about linear fits over three cells; energy is in parts of q^2 H/E_oed.
"Ours" has the defaults; the other option is `Previous pressure = average`.
The limit is that of the explicit time step of the soil.
Other variants, the plain fractional step among them, are in doc/developer/development_log.md, "Choices for the pressure that failed".
"""

import math

import numpy as np

from scree import closed_forms
from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.study import Claim, Study, Variant, axis, product

END, LOAD, CELL = 0.4, 1000., 0.1
SCATTER = "oscillation of p"
COLUMN = closed_forms.Terzaghi(1., LOAD, closed_forms.oedometric_modulus(1e6, 0.2), 1.)
OPTIONS = {
    "ours": {},
    "p^n average": {"Previous pressure": "average"},
}


def pressure_error(run):
    """(rms error of p/q, its scatter about linear fits over three cells), below three cells from the top, over all pictures."""
    column = COLUMN._replace(conductivity=float(run.entries["Water/Hydraulic conductivity"]))
    errors, scatter = [], []
    for time in np.arange(1, 5) * END / 4:
        water = run.points(time, "water")
        if abs(water.time - time) > 1e-6:
            return math.nan, math.nan
        y = water.positions[:, 1]
        exact, _ = closed_forms.consolidation_with_inertia(column, 2650., 0.4, 1 - y, time)
        error = water.arrays["pressure"] / LOAD - exact
        errors.extend(error[y < 0.7])
        for middle in np.arange(0.15, 0.6, CELL):
            near, inside = (np.abs(y - middle) < width for width in (1.5 * CELL, 0.5 * CELL))
            scatter.extend((error - np.polyval(np.polyfit(y[near], error[near], 1), y))[inside])
    return math.sqrt(np.mean(np.square(errors))), math.sqrt(np.mean(np.square(scatter)))


def measure(run):
    error, scatter = pressure_error(run)
    energy = LOAD**2 / COLUMN.modulus * CELL
    return {**measures.classify(run, {SCATTER: scatter, "error": error}, energy), "cause": measures.cause(run)}


def verdict(rows):
    def select(pressure, lowest=0., highest=0.9):
        return [row for row in rows if row["pressure"] == pressure and lowest <= row["step/limit"] <= highest]

    def largest(*arguments):
        return max((row["error"] for row in select(*arguments)), default=math.nan)

    ours = select("ours")
    average = largest("p^n average")
    failed = {step: sum(row["state"] != "stable" for row in select("ours", step, step)) for step in (1.2, 1.5)}
    return [
        Claim(f"Ours is stable for any conductivity from {max(row['k'] for row in ours):g} to {min(row['k'] for row in ours):g} m/s up to 0.9 of the "
              f"limit step, with an error of at most {largest('ours'):.1g} of the load and an oscillation of p of at most {max(row[SCATTER] for row in ours):.1g}.",
              all(row["state"] == "stable" for row in ours) and all(row[SCATTER] < 0.02 for row in ours)),
        Claim(f"At 1.2 of the limit time step {failed[1.2]} of {len(select('ours', 1.2, 1.2))} conductivities are no longer stable, at 1.5 {failed[1.5]} of "
              f"{len(select('ours', 1.5, 1.5))}, with either option. The limit is that of the soil; the pressure does not change it.",
              all(row["state"] != "stable" for row in rows if row["step/limit"] == 1.5)),
        Claim(f"p^n as a plain average of the points deviates by up to {average:.2g}, more at larger time steps and smaller k.", average > 0.05, quick=False),
    ]


STUDY = Study(
    title="Options of the pressure over conductivity and time step",
    question="For which conductivities and time steps is the pressure stable?",
    advice="Any conductivity; keep the Courant number at 0.9 or below.",
    base="prm/consolidation/terzaghi.prm",
    entries={"Mesh/Cell size": CELL, "Mesh/Upper corner": "0.1, 1.2", "End time": END, "Output/Interval": END / 4,
             "Output/Statistics interval": END / 4, "Output/Graphics": "points"},
    variants=product([Variant({"pressure": name}, {f"Water/Pressure/{entry}": value for entry, value in entries.items()})
                      for name, entries in OPTIONS.items()],
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-2, 1e-3, 1e-4, 1e-7, 1e-12]),
                     axis("step/limit", "Time step/Courant number", [0.1, 0.3, 0.6, 0.9, 1.2, 1.5])),
    measure=measure, verdict=verdict, needs_end=False, default={"pressure": "ours"},
    quick=lambda labels: labels["pressure"] == "ours" and labels["k"] in (1e-1, 1e-3, 1e-12) and labels["step/limit"] in (0.6, 0.9, 1.5),
    chart=StabilityMap("k", "step/limit", panels=["pressure"], xlabel="k (m/s)", ylabel="time step over limit"))
