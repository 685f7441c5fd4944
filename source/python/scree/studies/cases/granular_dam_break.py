# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/granular_dam_break.md."""

import math

import numpy as np

from scree import closed_forms
from scree.studies.charts import RunCurves
from scree.studies.measures import mean_depth
from scree.studies.study import Claim, Study, axis, product

LAYER, SLOPE, ORIGIN = 0.2, math.radians(20), np.array([5, 3.35])  # m, -, m
TIMES = (0.4, 0.8, 1.2)  # s
FRICTION, SMOOTH = "friction", "smooth"
BEDS = {FRICTION: {}, SMOOTH: {"Bed/Type": "free slip", "Bed/Friction angle": 0, "Soil/Mohr-Coulomb/Friction angle": 1, "Soil/Initial state/K0": 0.98}}
BOUND = {FRICTION: 0.04, SMOOTH: 0.03}


def exact(bed):
    return closed_forms.GrainDamBreak(LAYER, SLOPE, math.radians(10) if bed == FRICTION else 0.)


def depth(run, time, x):
    """Over the layer's, at places along the plane, m."""
    points = run.points(time)
    along = (points.positions[:, :2] - ORIGIN) @ (math.cos(SLOPE), -math.sin(SLOPE))
    return mean_depth(along, points.arrays["volume"], x - LAYER / 4, x + LAYER / 4) / LAYER


def measure(run):
    flow, part, columns = exact(run.labels["bed"]), np.linspace(-1, 2, 31), {}
    for time in TIMES:
        columns[f"error at {time:g} s"] = np.sqrt(np.mean((depth(run, time, flow.place(part, time)) - flow.depth(part))**2))
    parts = np.linspace(-1, 2, 3001)
    tenth = parts[np.flatnonzero(depth(run, TIMES[-1], flow.place(parts, TIMES[-1])) >= 0.1)[-1]]
    return {**columns, "behind at a tenth": 2 - 3 * math.sqrt(0.1) - tenth, "lost": run.statistics("Points lost")[-1]}


def verdict(rows):
    claims = []
    for bed in BEDS:
        group = [row for row in rows if row["bed"] == bed]
        errors = np.array([[row[f"error at {time:g} s"] for time in TIMES] for row in group])
        sizes = "; ".join(f"cells of {row['h']:g} m: " + ", ".join(f"{error:.3f}" for error in of) for row, of in zip(group, errors))
        claims += [Claim(f"Bed with {bed}: error of the depth at {', '.join(f'{time:g}' for time in TIMES)} s, {sizes}." if bed == FRICTION else
                         f"Smooth bed: error of the depth at {', '.join(f'{time:g}' for time in TIMES)} s, {sizes}.",
                         errors[:, -1].max() < BOUND[bed] and np.all(np.diff(errors) < 0), tabled=True),
                   Claim(f"{'With friction' if bed == FRICTION else 'Smooth'}: where a tenth of the layer's depth is left, the soil is " + ", ".join(f"{row['behind at a tenth']:+.3f} (h = {row['h']:g} m)" for row in group)
                         + " c t behind the closed form at 1.2 s.", max(abs(row["behind at a tenth"]) for row in group) < 0.1, worst=bed == FRICTION, tabled=True)]
    return claims


def table(rows):
    return [("bed", "h (m)", *(f"error of the depth at {time:g} s" for time in TIMES), "behind at 1.2 s, depth 0.1, over c t"),
            *((row["bed"], f"{row['h']:g}", *(f"{row[f'error at {time:g} s']:.3f}" for time in TIMES), f"{row['behind at a tenth']:+.3f}")
              for row in sorted(rows, key=lambda row: row["bed"]))]


def curves(run):
    """Depths of the finest runs, {"bed, time": (place, depth)}."""
    flow, part = exact(run.labels["bed"]), np.linspace(-1, 2, 301)
    return {f"{run.labels['bed']}, {time:g}": (flow.place(part, time), depth(run, time, flow.place(part, time))) for time in TIMES if run.labels["h"] < 0.03}


def draw(figure, found, _):
    plots = dict(zip(BEDS, figure.subplots(2, 1, sharex=True)))
    for bed, plot in plots.items():
        flow, part = exact(bed), np.linspace(-1, 2, 301)
        for time, colour in zip(TIMES, ("C0", "C1", "C2")):
            if f"{bed}, {time:g}" in found:
                plot.plot(*found[f"{bed}, {time:g}"], color=colour, linewidth=1.5)
            x = flow.place(part, time)
            plot.plot(x, flow.depth(part), "k--", linewidth=0.9)
            plot.annotate(f"{time:g} s", (np.interp(0.3, flow.depth(part)[::-1], x[::-1]), 0.3), xytext=(6, 2), textcoords="offset points", color=colour)
        plot.set(ylabel="depth over the layer's", title="bed with friction" if bed == FRICTION else "smooth bed")
    plots[SMOOTH].set_xlabel("place down the plane (m); cells of 0.02 m, dashed: shallow flow in closed form")


CHART = RunCurves(curves, draw, 5.)
STUDY = Study(title="Granular layer on an inclined plane",
              question="Does a layer on a bed follow shallow flow in closed form?",
              advice="Trust the depth of long waves on beds that cut the cells; the tip with friction is late.",
              base="prm/bed/granular_dam_break.prm", measure=measure, verdict=verdict, chart=CHART,
              entries={"Output/Graphics": "points", "Output/Interval": 0.4},
              variants=product(axis("h", "Mesh/Cell size", [0.04, 0.02]), axis("bed", lambda bed: BEDS[bed], list(BEDS))), quick=lambda labels: labels["h"] == 0.04, table=table)
