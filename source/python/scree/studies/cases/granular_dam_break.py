# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/granular_dam_break.md."""

import math

import numpy as np

from scree import closed_forms
from scree.studies import RunCurves, Study, axis, mean_depth, product, tabled

LAYER, SLOPE, ORIGIN = 0.2, math.radians(20), np.array([5, 3.35])  # m, -, m
TIMES = (0.4, 0.8, 1.2)  # s
ERRORS, BEHIND = [f"error at {time:g} s" for time in TIMES], "behind at a tenth"
FRICTION, SMOOTH = "friction", "smooth"
BEDS = {FRICTION: {}, SMOOTH: {"Bed/Type": "free slip", "Bed/Friction angle": 0, "Soil/Mohr-Coulomb/Friction angle": 1,
                               "Soil/Initial state/K0": 0.98}}
WORDS = {FRICTION: ("Bed with friction", "With friction"), SMOOTH: ("Smooth bed", "Smooth")}
BOUND = {FRICTION: 0.04, SMOOTH: 0.03}


def exact(bed):
    return closed_forms.GrainDamBreak(LAYER, SLOPE, math.radians(10) if bed == FRICTION else 0.)


def depth(run, time, x):
    """Over the layer's, at places along the plane, m."""
    points = run.points(time)
    along = (points.positions[:, :2] - ORIGIN) @ (math.cos(SLOPE), -math.sin(SLOPE))
    return mean_depth(along, points.arrays["volume"], x - LAYER / 4, x + LAYER / 4) / LAYER


def measure(run):
    flow, part = exact(run.labels["bed"]), np.linspace(-1, 2, 31)
    errors = [np.sqrt(np.mean((depth(run, time, flow.place(part, time)) - flow.depth(part))**2)) for time in TIMES]
    parts = np.linspace(-1, 2, 3001)
    tenth = parts[np.flatnonzero(depth(run, TIMES[-1], flow.place(parts, TIMES[-1])) >= 0.1)[-1]]
    return {**dict(zip(ERRORS, errors)), BEHIND: 2 - 3 * math.sqrt(0.1) - tenth,
            "lost": run.statistics("Points lost")[-1]}


def verdict(rows, claim):
    claims, claim = [], claim.shared(times=list(TIMES))
    for bed, (name, start) in WORDS.items():
        group = rows.where(bed=bed)
        errors = np.array([[row[error] for error in ERRORS] for row in group])
        claims += [claim("depth", errors[:, -1].max() < BOUND[bed] and np.all(np.diff(errors) < 0), tabled=True,
                         bed=name),
                   claim("tip", max(map(abs, group.values[BEHIND])) < 0.1, worst=bed == FRICTION, tabled=True,
                         bed=start, behind={f"h = {row['h']:g} m": row[BEHIND] for row in group})]
    return claims


table = tabled({"bed": "{[bed]}", "h (m)": "{[h]:g}",
                **{f"error of the depth at {time:g} s": f"{{[error at {time:g} s]:.3f}}" for time in TIMES},
                "behind at 1.2 s, depth 0.1, over c t": "{[behind at a tenth]:+.3f}"}, by="bed")


def curves(run):
    """Depths of the finest runs, {"bed, time": (place, depth)}."""
    flow, part, bed = exact(run.labels["bed"]), np.linspace(-1, 2, 301), run.labels["bed"]
    return {f"{bed}, {time:g}": (flow.place(part, time), depth(run, time, flow.place(part, time)))
            for time in TIMES if run.labels["h"] < 0.03}


def draw(figure, found, _):
    plots = dict(zip(BEDS, figure.subplots(2, 1, sharex=True)))
    for bed, plot in plots.items():
        flow, part = exact(bed), np.linspace(-1, 2, 301)
        for time, colour in zip(TIMES, ("C0", "C1", "C2")):
            if f"{bed}, {time:g}" in found:
                plot.plot(*found[f"{bed}, {time:g}"], color=colour, linewidth=1.5)
            x = flow.place(part, time)
            plot.plot(x, flow.depth(part), "k--", linewidth=0.9)
            place = np.interp(0.3, flow.depth(part)[::-1], x[::-1]), 0.3
            plot.annotate(f"{time:g} s", place, xytext=(6, 2), textcoords="offset points", color=colour)
        plot.set(ylabel="depth over the layer's", title="bed with friction" if bed == FRICTION else "smooth bed")
    plots[SMOOTH].set_xlabel("place down the plane (m); cells of 0.02 m, dashed: shallow flow in closed form")


STUDY = Study(
    "prm/bed/granular_dam_break.prm", chart=RunCurves(curves, draw, 5.),
    entries={"Output/Graphics": "points", "Output/Interval": 0.4},
    variants=product(axis("h", "Mesh/Cell size", [0.04, 0.02]), axis("bed", BEDS.get, list(BEDS))),
    quick=lambda labels: labels["h"] == 0.04)
