# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/dry_slope.md."""

import math

import numpy as np

from scree.studies.charts import WorkPrecision
from scree.studies.measures import energy_gain, lost_energy
from scree.studies.precision import DEFAULTS, LimitFit, at_finest, costs, curve, methods, ratio, table
from scree.studies.study import Claim, Study, axis, product, transfer

METHODS = methods("linear", "no F-bar", "standard F-bar", "2 x 2 points", "3 x 3 points", "PIC rate 0", "PIC rate 5", "PIC rate 20", {"TPIC": transfer("TPIC")},
                  "Courant number 0.3", "Courant number 0.9", without="Water")
REFERENCE = 0.04  # m, cells of the reference
FINEST = (DEFAULTS, "3 x 3 points", "TPIC", "PIC rate 5")  # run on a fourth mesh


def lengths(run):
    """Fronts of 90 and 99 % of the soil and the height of the centre of mass at the times of the rows, m."""
    mass = run.statistics("Mass (kg)") + run.columns.get("Water mass (kg)", 0.)  # the study of the saturated slope measures so, too
    return np.array([run.statistics("Front 90 % (m)"), run.statistics("Front 99 % (m)"), run.statistics("Potential energy (J)") / (mass * 9.81)])


def errors(run, own, exact, since):
    """Columns of the errors of three lengths, over the displacement of each in the reference, from a time on."""
    scale = np.abs(exact[:, -1] - exact[:, 0])
    found = np.sqrt(np.mean(((own - exact)[:, run.time > since] / scale[:, None])**2, axis=1))
    return {"error": math.sqrt(np.mean(found**2)), "error of front 90 %": found[0], "error of front 99 %": found[1], "error of centre of mass": found[2]}


def measure(run):
    own = lengths(run)
    released = run.statistics("Potential energy (J)")[0] - run.statistics("Potential energy (J)")[-1]
    return {**errors(run, own, lengths(run.reference), 0.45), "front 99 % at the end, m": own[1, -1],
            "mean oscillation": np.mean(run.statistics("Stress oscillation (-)")[1:]),
            "numerical dissipation": lost_energy(run), "energy gained": energy_gain(run, released)}


def verdict(rows):
    fit, tip, raw = LimitFit(rows, REFERENCE), LimitFit(rows, REFERENCE, column="error of front 99 %"), rows
    rows = fit.against_limit(rows)
    found = costs(rows)
    others = {method: cost for method, cost in found.items() if "points" not in method}
    finest = min(curve(rows), default=math.nan)
    return [
        Claim(f"With the smallest cells, h = {finest:.3g} m, the defaults differ by about {100 * fit.lack(finest):.0f} % from their extrapolated limit ({100 * fit.lack(0.1):.0f} % at 0.1 m), by a fit of order "
              f"{fit.order:.2f}. The front of 99 % of the mass alone differs by {100 * tip.lack(finest):.0f} % (order {tip.order:.1f}). The {100 * at_finest(raw, DEFAULTS):.0f} % of the chart are "
              f"the difference from the run with h = {REFERENCE:g} m.",
              fit.found and fit.lack(finest) < 0.15, quick=False),
        Claim(f"FLIP with a low PIC rate has the smallest error: 5 1/s has {ratio(rows, 'PIC rate 5'):.2g} times the error of 1 1/s, TPIC "
              f"{ratio(rows, 'TPIC'):.2g} times, at the same cost per time step. Against the reference alone the ratios are {ratio(raw, 'PIC rate 5'):.2g} and {ratio(raw, 'TPIC'):.2g}. "
              f"Velocity filters retard the slope; without PIC the error is {ratio(rows, 'PIC rate 0'):.2g} times that of 1 1/s.",
              ratio(rows, "PIC rate 5") > 1.1 and ratio(rows, "TPIC") > 1.5),
        Claim(f"On h = 0.1 m the transfer takes {100 * _at(rows, DEFAULTS, 0.1)['numerical dissipation']:.0f} % of the released energy instead of "
              f"{100 * _at(rows, 'PIC rate 5', 0.1)['numerical dissipation']:.0f} % (rate 0: {100 * _at(rows, 'PIC rate 0', 0.1)['numerical dissipation']:.0f} %); the stress "
              f"oscillates {1 / ratio(rows, 'PIC rate 5', 'mean oscillation'):.2f} times as much as with 5 1/s.",
              ratio(rows, "PIC rate 5", "mean oscillation") > 0.85, quick=False),
        Claim(f"3 x 3 points are sufficient: {ratio(rows, '3 x 3 points'):.3g} times the error for {ratio(rows, '3 x 3 points', 'core-seconds'):.2g} times the time.",
              ratio(rows, "3 x 3 points") < 1.1),
        Claim(f"2 x 2 points: {ratio(rows, '2 x 2 points'):.2g} times the error for {ratio(rows, '2 x 2 points', 'core-seconds'):.2g} times the time, but "
              f"{ratio(rows, '2 x 2 points', 'mean oscillation'):.2g} times the stress oscillation, growing with refinement.",
              ratio(rows, "2 x 2 points") < 1.2 and ratio(rows, "2 x 2 points", "mean oscillation") > 1.2, quick=False),
        Claim(f"Modified F-bar is best: without F-bar the stress oscillates {ratio(rows, 'no F-bar', 'mean oscillation'):.2g} times as much, with the standard one "
              f"{ratio(rows, 'standard F-bar', 'mean oscillation'):.2g} times, and the run takes more time steps.",
              ratio(rows, "no F-bar", "mean oscillation") > 2 and ratio(rows, "standard F-bar", "mean oscillation") > 2
              and costs(rows)["no F-bar"] > 1, quick=False),
        Claim(f"The time step has no influence up to Courant number 0.9: {ratio(rows, 'Courant number 0.9'):.3g} times the error, 0.3 "
              f"{ratio(rows, 'Courant number 0.3'):.3g} times.",
              abs(ratio(rows, "Courant number 0.9") - 1) < 0.05 and abs(ratio(rows, "Courant number 0.3") - 1) < 0.05, quick=False),
        Claim("Core-seconds for the same error: but for the number of points the defaults are Pareto-optimal within the timing noise. No other change takes less than "
              f"{min(others.values()):.2g} of their time.", min(others.values()) > 0.7, quick=False),
    ]


def _at(rows, method, h):
    """The row of a method on a mesh; a row of nan without one."""
    nothing = dict.fromkeys(rows[0], math.nan)
    return next((row for row in rows if row["method"] == method and abs(row["h"] - h) < 1e-3), nothing)


STUDY = Study(
    title="Dry slope: error over cost",
    question="Which method gives the front of a dry slope at the least cost?",
    advice="Use FLIP with a PIC rate of 1 1/s. The default F-bar since these runs is the projected one.",
    base="prm/slopes/slope_dense.prm",
    entries={"Transfer/PIC rate": "auto", "End time": 1.5, "Mesh/Upper corner": "8, 2.4", "Output/Interval": 1.5, "Output/Statistics interval": 0.1, "Output/Graphics": "none"},
    variants=product(axis("method", METHODS.__getitem__, METHODS), axis("h", "Mesh/Cell size", [1 / 5, 2 / 15, 1 / 10]))
    + product(axis("method", METHODS.__getitem__, FINEST), axis("h", "Mesh/Cell size", [1 / 15])),
    reference={"Mesh/Cell size": REFERENCE}, quick_reference={"Mesh/Cell size": 0.1, "Soil/Points per cell": 3}, default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.19 and labels["method"] in (DEFAULTS, "3 x 3 points", "PIC rate 5", "TPIC"),
    measure=measure, verdict=verdict,
    table=lambda rows: table(LimitFit(rows, REFERENCE).against_limit(rows)),
    chart=WorkPrecision({DEFAULTS: "defaults", "3 x 3 points": "3 x 3 points\n(recommended)", "2 x 2 points": "2 x 2 points\n(cheapest)", "PIC rate 5": "PIC rate 5 1/s", "TPIC": "TPIC (worst)"}, "difference from the run with h = 0.04 m (-)"))
