# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/aluminium_bars.md."""

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies.charts import RunCurves
from scree.studies.measures import mean_depth
from scree.studies.study import Claim, Study, axis, product, reference_rows

BAR = 1.5e-3  # m
WIDTH = 0.01  # m, over which the depth is taken
RECOMMENDED, FIXED, FRICTION = "fixed, mu(I)", "fixed", "friction"
BASES = {RECOMMENDED: ("fixed", 1.25e-3), FIXED: ("fixed", 0), FRICTION: ("friction 19.8", 0)}  # entry, grain diameter (m)
LAST = 0.4423  # m
OVER = "front over measured"


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
    return {"surface, rms (m)": np.sqrt(np.mean(error**2)), "surface, largest (m)": np.max(np.abs(error)),
            "front (m)": (front := places[np.flatnonzero(depth(points, places) > BAR)[-1]]), OVER: front / LAST, "front 99.5 % (m)": x[int(0.995 * x.size)],
            "failure line, rms (m)": np.sqrt(np.mean((heights - failure[:, 1])**2)),
            "kinetic over released energy": run.statistics("Kinetic energy (J)")[-1] / np.ptp(run.statistics("Potential energy (J)"))}


def verdict(rows):
    claims = []
    for base in BASES:
        group = [row for row in rows if row["base"] == base]

        def text(name, factor, digits, group=group):
            return ", ".join(f"{factor * row[name]:.{digits}f}" for row in group)

        sizes = ", ".join(f"{1e3 * row['h']:g}" for row in group)
        worst = max(row["surface, rms (m)"] for row in group)
        front = max(abs(row["front (m)"] / LAST - 1) for row in group)
        failure = max(row["failure line, rms (m)"] for row in group)
        claims += [Claim(f"Base {base}, cells of {sizes} mm: the surface deviates by {text('surface, rms (m)', 1e3, 1)} mm RMS, {text('surface, largest (m)', 1e3, 1)} mm at most.", worst < 5e-3, tabled=True),
                   Claim(f"Base {base}{' (recommended)' if base == RECOMMENDED else ''}: the front comes to {text('front (m)', 1, 3)} m with cells of {sizes} mm, measured {LAST:.3f} m. "
                         f"The deviation is {', '.join(f'{100 * (row[OVER] - 1):+.1f} %' for row in group)}, bound 5 %. 99.5 % of the mass: "
                         f"{text('front 99.5 % (m)', 1, 3)} m.", front < 0.05, quick=False, worst=base == RECOMMENDED),
                   Claim(f"Base {base}: the failure line deviates by {text('failure line, rms (m)', 1e3, 1)} mm RMS.", failure < 0.01, quick=False, tabled=True)]
    advances = {base: np.ptp([row["front (m)"] for row in rows if row["base"] == base]) for base in BASES}
    claims.append(Claim(f"From the largest to the smallest cells the front advances by {1e3 * advances[RECOMMENDED]:.0f} mm with mu(I), by {1e3 * advances[FIXED]:.0f} mm on the fixed base "
                        f"without it, and by {1e3 * advances[FRICTION]:.0f} mm on the base with friction.", advances[RECOMMENDED] < 0.05 * LAST, quick=False))
    return claims


def table(rows):
    return [("base", "h (mm)", "front (m)", "front, 99.5 % of the mass (m)", "surface, RMS (mm)", "failure line, RMS (mm)"),
            *((row["base"], f"{1e3 * row['h']:g}", f"{row['front (m)']:.3f}", f"{row['front 99.5 % (m)']:.3f}", f"{1e3 * row['surface, rms (m)']:.1f}",
               f"{1e3 * row['failure line, rms (m)']:.1f}") for row in sorted(rows, key=lambda row: row["base"]))]


def compared(rows):
    finest = min(row["h"] for row in rows)
    return [(f"aluminium bars, front, base {row['base']}, h = {1e3 * row['h']:g} mm", "m", LAST, row["front (m)"]) for row in rows if row["h"] == finest]


def curves(run):
    """Surface and failure line of a run, mm."""
    x, places, points = np.arange(0.0025, 0.56, 0.0025), reference("failure")[:, 0], run.points()
    name = f"{run.labels['base']}, {1e3 * run.labels['h']:g} mm"
    return {f"surface: {name}": (x, 1e3 * depth(points, x)),
            f"failure: {name}": (places, [1e3 * failure_height(points, place, run.labels["h"]) for place in places])}


def draw(figure, found, _):
    axes = figure.subplots()
    for name, label, style in (("surface: fixed, mu(I), 2.5 mm", "surface, mu(I)\n(recommended)", "C0-"), ("surface: fixed, 2.5 mm", "surface, base fixed", "C1-"),
                               ("surface: friction, 2.5 mm", "surface, base friction", "C3-"), ("failure: fixed, mu(I), 2.5 mm", "failure line,\nmu(I)", "C2-")):
        if name in found:
            axes.plot(*found[name], style, linewidth=1.5, label=label)
    for line, marker in (("surface", "o"), ("failure", "s")):
        places = reference(line)
        axes.plot(places[:, 0], 1e3 * places[:, 1], "k" + marker, markersize=4)
    axes.annotate("measured surface (dots)", (0.12, 70), xytext=(0.2, 92), fontsize=9, arrowprops={"arrowstyle": "-", "linewidth": 0.5})
    axes.annotate("measured\nfailure line\n(squares)", (0.12, 37), xytext=(0.01, 10), fontsize=9, arrowprops={"arrowstyle": "-", "linewidth": 0.5})
    axes.set(xlabel="x (m); cells of 2.5 mm", ylabel="height (mm)", xlim=(0, 0.56), ylim=(0, 110))
    name_lines(axes)


CHART = RunCurves(curves, draw, 3.6)
STUDY = Study(title="Aluminium bars",
              question="Does a dry collapse stop where the measured one stops?",
              advice="Give the angle its kind, and the grains a diameter, on a fixed base. Expect a front 7 to 10 % short.",
              base="prm/columns/aluminium_bars.prm", measure=measure, verdict=verdict, chart=CHART, table=table, compared=compared,
              entries={"Output/Graphics": "points", "Output/Interval": "1"},
              variants=product(axis("h", "Mesh/Cell size", [0.01, 0.005, 0.0025]),
                               axis("base", lambda base: {"Boundaries/Bottom": BASES[base][0], "Soil/Mohr-Coulomb/Grain diameter": BASES[base][1]}, list(BASES))),
              quick=lambda labels: labels["h"] == 0.01)
