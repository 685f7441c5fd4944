# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plane collapse of a column of aluminium bars (Bui, Fukagawa, Sako & Ohno 2008), 0.2 m x 0.1 m; case `prm/columns/aluminium_bars.prm`.
Measured data: friction angle 19.8 degrees, bulk modulus 0.7 MPa, Poisson's ratio 0.3, no cohesion, no dilation. Nothing is fitted.
Two bases: one on which the bars do not slip, and one with the friction of the bars among themselves, which is the recommended one.

- Surface: depth of the deposit (volume over a width of 0.01 m) against the digitised line, RMS and largest difference at its 23 places.
- Front: where the deposit is 1.5 mm deep, the diameter of the thicker bars and the depth at the last digitised place, 0.442 m.
- Failure line: at each of its 9 places the height below which points have moved by less than 1.5 mm; RMS difference.

Bounds: surface 5 mm RMS, a twentieth of the height of the column; front 5 %; failure line 10 mm RMS.
"""


import numpy as np

from scree.studies.charts import RunCurves
from scree.studies.study import Claim, Study, axis, product, reference_rows

BAR = 1.5e-3  # m
WIDTH = 0.01  # m, over which the depth is taken
FIXED, FRICTION = "fixed", "friction"
LAST = 0.4423  # m
OVER = "front over measured"


def reference(line):
    """The digitised places of a line, (n, 2), m."""
    return np.array([[float(row["x"]), float(row["y"])] for row in reference_rows("bui_2008") if row["line"] == line])


def depth(points, x):
    """Of the deposit at some places, m."""
    order = np.argsort(points.positions[:, 0])
    places, volume = points.positions[order, 0], np.cumsum(points.arrays["volume"].ravel()[order])
    low, high = np.maximum(x - WIDTH / 2, 0.), x + WIDTH / 2
    return (np.interp(high, places, volume) - np.interp(low, places, volume, left=0.)) / (high - low)


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
    CHART.keep(run)
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
    for base in (FIXED, FRICTION):
        group = [row for row in rows if row["base"] == base]

        def text(name, factor, digits, group=group):
            return ", ".join(f"{factor * row[name]:.{digits}f}" for row in group)

        sizes = ", ".join(f"{1e3 * row['h']:g}" for row in group)
        worst = max(row["surface, rms (m)"] for row in group)
        front = max(abs(row["front (m)"] / LAST - 1) for row in group)
        failure = max(row["failure line, rms (m)"] for row in group)
        claims += [Claim(f"Base {base}, cells of {sizes} mm: the surface deviates by {text('surface, rms (m)', 1e3, 1)} mm RMS, {text('surface, largest (m)', 1e3, 1)} mm at most.", worst < 5e-3),
                   Claim(f"Base {base}{' (recommended)' if base == FRICTION else ''}: the front comes to {text('front (m)', 1, 3)} m with cells of {sizes} mm, measured {LAST:.3f} m. "
                         f"The deviation is {', '.join(f'{100 * (row[OVER] - 1):+.1f} %' for row in group)}, bound 5 %. 99.5 % of the mass: "
                         f"{text('front 99.5 % (m)', 1, 3)} m.", front < 0.05, quick=False, worst=base == FRICTION),
                   Claim(f"Base {base}: the failure line deviates by {text('failure line, rms (m)', 1e3, 1)} mm RMS.", failure < 0.01, quick=False)]
    fixed, friction = ([row["front (m)"] for row in rows if row["base"] == base] for base in (FIXED, FRICTION))
    claims.append(Claim(f"From the largest to the smallest cells the front on the fixed base advances by {1e3 * np.ptp(fixed):.0f} mm, on the base with friction by {1e3 * np.ptp(friction):.0f} mm. "
                        "On a fixed base the soil shears within the lowest cells, which become thinner. A fixed base therefore agrees with the experiment at one cell size only; the base with "
                        "friction is the one to compare with.", np.ptp(fixed) > 3 * np.ptp(friction), quick=False))
    return claims


def draw(figure, runs):
    axes = figure.subplots()
    x = np.arange(0.0025, 0.56, 0.0025)
    for run in runs:
        axes.plot(x, 1e3 * depth(run.points(), x), "--" if run.labels["base"] == FIXED else "-", linewidth=1,
                  label=f"base {run.labels['base']}, cells of {1e3 * run.labels['h']:g} mm")
    for line, marker in (("surface", "o"), ("failure", "s")):
        places = reference(line)
        axes.plot(places[:, 0], 1e3 * places[:, 1], "k" + marker, markersize=3, label=f"measured: {'surface' if line == 'surface' else 'failure line'}")
    finest = min(runs, key=lambda run: (run.labels["h"], run.labels["base"] == FIXED))
    places = reference("failure")[:, 0]
    axes.plot(places, [1e3 * failure_height(finest.points(), place, finest.labels["h"]) for place in places], "C7:", label="failure line, finest cells, with friction")
    axes.set(xlabel="x, m", ylabel="height, mm", xlim=(0, 0.56), ylim=(0, 110))
    axes.grid(alpha=0.3)
    axes.legend(fontsize="x-small")


CHART = RunCurves(draw, size=(9, 4))
STUDY = Study(title="Collapse of a column of aluminium bars", base="prm/columns/aluminium_bars.prm", measure=measure, verdict=verdict, chart=CHART,
              entries={"Output/Graphics": "points", "Output/Interval": "1"},
              variants=product(axis("h", "Mesh/Cell size", [0.01, 0.005, 0.0025]),
                               axis("base", lambda base: {"Boundaries/Bottom": "friction 19.8" if base == FRICTION else "fixed"}, [FIXED, FRICTION])),
              quick=lambda labels: labels["h"] == 0.01)
