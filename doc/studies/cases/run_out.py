# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far columns (1 m x 1 m, after 1.5 s) and slopes (crest 2 m, height 2 m, 45 degrees; dry after 3 s, saturated when they have come to rest: loose
after 5 s, dense after 9 s) of Nor-Sand run out, over the size of the cells and on two bases: fixed, as in `prm/slope_*.prm` and `prm/column_*.prm`,
and with friction of the soil's own angle at critical state in simple shear, tan(22.3 degrees) = M/sqrt(3) = .41 (`prm/*_friction.prm`). The front is
the x below which 99 % of the mass lies. Columns have 3 x 3 points in a cell, slopes 2 x 2, for the time they take.

Value at h = 0: the middle between the least-squares fits with errors in proportion to h and to h^2; its uncertainty is half their distance and the
rms deviation of the worse one. Order: the exponent between 0.5 and 3 that fits best, with four sizes; where it is one of these two, the sizes do not tell.
"""

import math

import numpy as np

from charts import Curves
from study import Claim, Study, Variant

BASES = {"friction": "friction 22.3", "fixed": "fixed"}
COLUMN, SLOPE, SATURATED = "column", "slope", "saturated slope"
FILES = {COLUMN: "column", SLOPE: "slope", SATURATED: "slope_saturated"}
BOXES = {COLUMN: (4.5, 1.5), SLOPE: (10., 2.5), SATURATED: (12., 2.5)}  # m
TIMES = {COLUMN: {"dense": 1.5, "loose": 1.5}, SLOPE: {"dense": 3., "loose": 3.}, SATURATED: {"dense": 9., "loose": 5.}}  # s
POINTS = {COLUMN: 3, SLOPE: 2, SATURATED: 2}
CELLS_PER_METRE = {(COLUMN, "friction"): (10, 14, 20, 28, 40), (COLUMN, "fixed"): (10, 14, 20, 28),
                   (SLOPE, "friction"): (10, 14, 20, 28, 40), (SLOPE, "fixed"): (10, 14),
                   (SATURATED, "friction"): (7, 10, 14, 20), (SATURATED, "fixed"): (7, 10)}
QUANTILES = (80, 90, 95, 99, 99.5)
FRONT = "front 99 % (m)"


def front(points, percent):
    """x below which this part of the mass lies, m; between two points by the mass passed so far."""
    x = points.positions[:, 0]
    order = np.argsort(x)
    mass = np.cumsum(points.arrays["mass"][order])
    return np.interp(percent / 100 * mass[-1], mass, x[order])


def front_of_depth(points, depth, width=0.1):
    """Largest x around which the soil, averaged over `width`, is `depth` deep, m."""
    order = np.argsort(points.positions[:, 0])
    x, volume = points.positions[order, 0], np.cumsum(points.arrays["volume"][order])
    centres = np.arange(width / 2, x[-1] + width, width / 20)
    depths = (np.interp(centres + width / 2, x, volume) - np.interp(centres - width / 2, x, volume, left=0.)) / width
    return centres[np.flatnonzero(depths >= depth)[-1]]


def measure(run):
    points = run.points()
    potential = run.statistics("^potential energy")
    return {**{f"front {percent:g} % (m)": front(points, percent) for percent in QUANTILES},
            "front by depth 0.05 m (m)": front_of_depth(points, 0.05),
            "centre of mass (m)": np.average(points.positions[:, 0], weights=points.arrays["mass"]),
            "energy lost numerically (-)": run.statistics("^numerical dissipation")[-1] / (potential[0] - potential[-1])}


def variant(scene, soil, base, cells_per_metre):
    box = ", ".join(f"{math.ceil(round(length * cells_per_metre, 6)) / cells_per_metre:.12g}" for length in BOXES[scene])
    entries = {"Mesh/Cell size": 1 / cells_per_metre, "Mesh/Upper corner": box, "Boundaries/Bottom": BASES[base],
               "End time": TIMES[scene][soil], "Output/Interval": TIMES[scene][soil] if scene != SATURATED else 1., "Output/Graphics": "points",
               "Soil/Points per cell": POINTS[scene]}
    if scene == SATURATED:
        entries["Water/Points per cell"] = POINTS[scene]
    return Variant({"scene": scene, "soil": soil, "base": base, "h": 1 / cells_per_metre}, entries, f"prm/{FILES[scene]}_{soil}.prm")


def curves(rows):
    """{(scene, soil, base): rows from the largest cells to the smallest}."""
    found = {}
    for row in sorted(rows, key=lambda row: -row["h"]):
        found.setdefault((row["scene"], row["soil"], row["base"]), []).append(row)
    return found


def fit(h, values, order):
    """(value at h = 0, factor of h^order, rms deviation) by least squares."""
    matrix = np.column_stack([np.ones_like(h), h**order])
    solution = np.linalg.lstsq(matrix, values, rcond=None)[0]
    return *solution, np.sqrt(np.mean((matrix @ solution - values)**2))


class Limit:
    """What the sizes of one curve tell about h = 0, as the page's introduction defines it."""

    def __init__(self, group, name=FRONT):
        h, values = (np.array([row[key] for row in group]) for key in ("h", name))
        first, second = fit(h, values, 1.), fit(h, values, 2.)
        self.value = (first[0] + second[0]) / 2
        self.uncertainty = abs(first[0] - second[0]) / 2 + max(first[2], second[2])
        orders = np.arange(0.5, 3.01, 0.05)
        self.order = orders[np.argmin([fit(h, values, order)[2] for order in orders])]
        self.last_change = values[-1] / values[-2] - 1

    @property
    def order_text(self):
        return f"order {self.order:.1f}" if 0.51 < self.order < 2.99 else "no order to be told"


def verdict(rows):
    groups = curves(rows)
    claims = []
    sticking = {key: abs(Limit(group).last_change) for key, group in groups.items() if key[2] == "fixed"}
    sliding = {key: abs(Limit(group).last_change) for key, group in groups.items() if key[2] == "friction"}
    claims.append(Claim(f"On the base with friction the front at 99 % of the mass moves by at most {100 * max(sliding.values()):.1f} % from the "
                        f"second finest to the finest of four cells, dry and saturated, dense and loose.", max(sliding.values()) < 0.02, quick=False))
    for (scene, soil, base), group in groups.items():
        if base == "friction":
            limit = Limit(group)
            claims.append(Claim(f"{scene.capitalize()}, {soil}: " + ", ".join(f"{row[FRONT]:.2f}" for row in group) +
                                f" m with cells of " + ", ".join(f"{row['h']:.3g}" for row in group) +
                                f" m; last change {100 * limit.last_change:+.1f} %, {limit.order_text}; {limit.value:.2f} +- {limit.uncertainty:.2f} m at h = 0.",
                                abs(limit.last_change) < 0.02, quick=False))
    return claims


def draw(figure, rows):
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    for axes, scene in zip(figure.subplots(1, len(scenes), squeeze=False)[0], scenes):
        for (_, soil, base), group in ((key, group) for key, group in curves(rows).items() if key[0] == scene):
            style = {"color": {"dense": "C0", "loose": "C1"}[soil], "linestyle": {"friction": "-", "fixed": "--"}[base]}
            axes.plot([row["h"] for row in group], [row[FRONT] for row in group], marker="o", markersize=4, label=f"{soil}, {base}", **style)
            if base == "friction" and len(group) > 2:
                limit = Limit(group)
                axes.errorbar(0., limit.value, limit.uncertainty, color=style["color"], marker="s", markersize=4, capsize=3)
        axes.set(title=scene, xlabel="cell size h (m)", ylabel="front, 99 % of the mass (m)", xlim=(-0.005, None))
        axes.grid(alpha=0.3)
        axes.legend(fontsize="x-small")


STUDY = Study(
    title="Run-out and mesh", base="prm/slope_dense.prm",
    variants=[variant(scene, soil, base, n)
              for (scene, base), sizes in CELLS_PER_METRE.items() for soil in ("dense", "loose") for n in sizes],
    quick=lambda labels: labels["scene"] == COLUMN and labels["soil"] == "dense" and labels["h"] > 0.06,
    measure=measure, verdict=verdict, chart=Curves(draw, size=(11, 4.2)))
