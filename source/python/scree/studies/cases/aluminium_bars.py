# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/aluminium_bars.md."""

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies import RunCurves, Study, axis, mean_depth, product, reference_rows, tabled

BAR = 1.5e-3  # m
WIDTH = 0.01  # m, over which the depth is taken
RECOMMENDED, FIXED, FRICTION = "fixed, mu(I)", "fixed", "friction"
# entry, grain diameter (m)
BASES = {RECOMMENDED: ("fixed", 1.25e-3), FIXED: ("fixed", 0), FRICTION: ("friction 19.8", 0)}
LAST = 0.4423  # m
OVER, FRONT, TIP = "front over measured", "front (m)", "front 99.5 % (m)"
SURFACE, LARGEST, FAILURE = "surface, rms (m)", "surface, largest (m)", "failure line, rms (m)"


def reference(line):
    """The digitised places of a line, (n, 2), m."""
    return np.array([[float(row["x"]), float(row["y"])] for row in reference_rows("bui_2008") if row["line"] == line])


def depth(points, x):
    """Of the deposit at some places, m."""
    return mean_depth(points.positions[:, 0], points.arrays["volume"], np.maximum(x - WIDTH / 2, 0.), x + WIDTH / 2)


def failure_height(points, x, h):
    """Height up to which the column under a place has moved by less than a bar, m."""
    moved = points.arrays["displacement"][:, :2]
    start = points.positions[:, :2] - moved
    here = np.abs(start[:, 0] - x) < h / 2
    order = np.argsort(start[here, 1])
    height, length = start[here, 1][order], np.linalg.norm(moved[here], axis=1)[order]
    still = np.flatnonzero(length > BAR)
    return height[still[0]] if still.size else height[-1]


def measure(run):
    points = run.points()
    surface, failure = reference("surface"), reference("failure")
    error = depth(points, surface[:, 0]) - surface[:, 1]
    places = np.arange(0.2, 0.6, 1e-4)
    x = np.sort(points.positions[:, 0])
    heights = np.array([failure_height(points, place, run.labels["h"]) for place in failure[:, 0]])
    front = places[np.flatnonzero(depth(points, places) > BAR)[-1]]
    return {SURFACE: np.sqrt(np.mean(error**2)), LARGEST: np.max(np.abs(error)), FRONT: front, OVER: front / LAST,
            TIP: x[int(0.995 * x.size)], FAILURE: np.sqrt(np.mean((heights - failure[:, 1])**2))}


def base_entries(base):
    kind, diameter = BASES[base]
    return {"Boundaries/Bottom": kind, "Soil/Mohr-Coulomb/Grain diameter": diameter}


def verdict(rows, claim):
    claims, claim = [], claim.shared(last=LAST)
    for base in BASES:
        group = rows.where(base=base)
        values = {"base": base, "group": group}
        claims += [
            claim("surface", group.largest[SURFACE] < 5e-3, tabled=True, **values),
            claim("front", max(abs(front / LAST - 1) for front in group.values[FRONT]) < 0.05, quick=False,
                  worst=base == RECOMMENDED, recommended=" (recommended)" if base == RECOMMENDED else "",
                  off=[over - 1 for over in group.values[OVER]], **values),
            claim("failure", group.largest[FAILURE] < 0.01, quick=False, tabled=True, **values)]
    advances = {base: np.ptp(rows.where(base=base).values[FRONT]) for base in BASES}
    return [*claims, claim("mesh", advances[RECOMMENDED] < 0.05 * LAST, quick=False, inertial=advances[RECOMMENDED],
                           fixed=advances[FIXED], friction=advances[FRICTION])]


table = tabled({"base": "{[base]}", "h (mm)": "{[h]:g mm}", "front (m)": "{[front (m)]:.3f}",
                "front, 99.5 % of the mass (m)": "{[front 99.5 % (m)]:.3f}",
                "surface, RMS (mm)": "{[surface, rms (m)]:.1f mm}",
                "failure line, RMS (mm)": "{[failure line, rms (m)]:.1f mm}"}, by="base")


def curves(run):
    """Surface and failure line of a run, mm."""
    x, places, points = np.arange(0.0025, 0.56, 0.0025), reference("failure")[:, 0], run.points()
    name = f"{run.labels['base']}, {1e3 * run.labels['h']:g} mm"
    return {f"surface: {name}": (x, 1e3 * depth(points, x)),
            f"failure: {name}": (places, [1e3 * failure_height(points, place, run.labels["h"]) for place in places])}


def draw(figure, found, _):
    axes = figure.subplots()
    for name, label, style in (("surface: fixed, mu(I)", "surface, mu(I)\n(recommended)", "C0-"),
                               ("surface: fixed", "surface, base fixed", "C1-"),
                               ("surface: friction", "surface, base friction", "C3-"),
                               ("failure: fixed, mu(I)", "failure line,\nmu(I)", "C2-")):
        name += ", 2.5 mm"
        if name in found:
            axes.plot(*found[name], style, linewidth=1.5, label=label)
    for line, marker in (("surface", "o"), ("failure", "s")):
        places = reference(line)
        axes.plot(places[:, 0], 1e3 * places[:, 1], "k" + marker, markersize=4)
    for label, place, of_text in (("measured surface (dots)", (0.12, 70), (0.2, 92)),
                                  ("measured\nfailure line\n(squares)", (0.12, 37), (0.01, 10))):
        axes.annotate(label, place, xytext=of_text, fontsize=9, arrowprops={"arrowstyle": "-", "linewidth": 0.5})
    axes.set(xlabel="x (m); cells of 2.5 mm", ylabel="height (mm)", xlim=(0, 0.56), ylim=(0, 110))
    name_lines(axes)


STUDY = Study(
    "prm/columns/aluminium_bars.prm", chart=RunCurves(curves, draw, 3.6),
    entries={"Output/Graphics": "points", "Output/Interval": "1"},
    variants=product(axis("h", "Mesh/Cell size", [0.01, 0.005, 0.0025]), axis("base", base_entries, list(BASES))),
    quick=lambda labels: labels["h"] == 0.01)
