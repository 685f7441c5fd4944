# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out.md."""

import math

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies.charts import Curves
from scree.studies.measures import grouped, lost_energy, mean_depth
from scree.studies.study import Claim, Study, Variant

FIXED, FRICTION, LOW_PIC = "fixed", "friction", "friction, PIC rate 1/s"
TREATMENTS = {FIXED: {"Boundaries/Bottom": "fixed"}, FRICTION: {"Boundaries/Bottom": "friction 22.3"},
              LOW_PIC: {"Boundaries/Bottom": "friction 22.3", "Transfer/PIC rate": 1}}
COLUMN, SLOPE, SATURATED, PERMEABLE = "column", "slope", "saturated slope", "permeable saturated slope"
FILES = {COLUMN: "columns/column", SLOPE: "slopes/slope", SATURATED: "slopes/slope_saturated", PERMEABLE: "slopes/slope_saturated"}
BOXES = {COLUMN: (4.5, 1.5), SLOPE: (10., 2.5), SATURATED: (12., 2.5), PERMEABLE: (12., 2.5)}  # m
TIMES = {COLUMN: {"dense": 1.5, "loose": 1.5}, SLOPE: {"dense": 3., "loose": 3.}, SATURATED: {"dense": 9., "loose": 5.}, PERMEABLE: {"dense": 6.}}  # s
FOUR, WET = (10, 14, 20, 28), (7, 10, 14, 20)
CELLS_PER_METRE = {**{(COLUMN, soil, treatment): FOUR for treatment in TREATMENTS for soil in ("dense", "loose")},
                   (SLOPE, "dense", FRICTION): FOUR, (SLOPE, "loose", FRICTION): FOUR[:3], (SLOPE, "dense", LOW_PIC): FOUR, (SLOPE, "loose", LOW_PIC): FOUR,
                   (SATURATED, "loose", FRICTION): WET, (SATURATED, "dense", FRICTION): WET, (PERMEABLE, "dense", FRICTION): WET}
RECOMMENDED = {COLUMN: LOW_PIC, SLOPE: LOW_PIC, SATURATED: FRICTION, PERMEABLE: FRICTION}
QUANTILES = (80, 90, 95, 99, 99.5)
FRONT, TIP = "front 90 % (m)", "front 99 % (m)"


def front(points, percent):
    """x below which this part of the mass lies, m; between two points by the mass passed so far."""
    x = points.positions[:, 0]
    order = np.argsort(x)
    mass = np.cumsum(points.arrays["mass"][order])
    return np.interp(percent / 100 * mass[-1], mass, x[order])


def front_of_depth(points, depth, width=0.1):
    """Largest x around which the soil, averaged over `width`, is `depth` deep, m."""
    x = points.positions[:, 0]
    centres = np.arange(width / 2, x.max() + width, width / 20)
    depths = mean_depth(x, points.arrays["volume"], centres - width / 2, centres + width / 2)
    return centres[np.flatnonzero(depths >= depth)[-1]]


def measure(run):
    points = run.points()
    return {**{f"front {percent:g} % (m)": front(points, percent) for percent in QUANTILES},
            "front by depth 0.05 m (m)": front_of_depth(points, 0.05),
            "centre of mass (m)": np.average(points.positions[:, 0], weights=points.arrays["mass"]),
            "energy lost numerically (-)": lost_energy(run)}


def variant(scene, soil, treatment, cells_per_metre):
    points = 3 if scene == COLUMN or (scene, soil, treatment) == (SLOPE, "dense", LOW_PIC) else 2
    box = ", ".join(f"{math.ceil(round(length * cells_per_metre, 6)) / cells_per_metre:.12g}" for length in BOXES[scene])
    entries = {"Mesh/Cell size": 1 / cells_per_metre, "Mesh/Upper corner": box, **TREATMENTS[treatment],
               "End time": TIMES[scene][soil], "Output/Interval": TIMES[scene][soil] if scene in (COLUMN, SLOPE) else 1., "Output/Graphics": "points",
               "Soil/Points per cell": points}
    if scene in (SATURATED, PERMEABLE):
        entries["Water/Points per cell"] = points
    if scene == PERMEABLE:
        entries["Water/Hydraulic conductivity"] = 5e-2
    return Variant({"scene": scene, "soil": soil, "treatment": treatment, "h": 1 / cells_per_metre}, entries, f"prm/{FILES[scene]}_{soil}.prm")


def curves(rows):
    return grouped(rows, "scene", "soil", "treatment")


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
        self.h, self.values = h, values
        self.last_change = values[-1] / values[-2] - 1
        self.missing = 1 - values[0] / self.value
        self.spread = values.max() / values.min() - 1

    @property
    def fronts(self):
        return ", ".join(f"{value:.2f}" for value in self.values)

    @property
    def short_text(self):
        return f"{self.fronts} m, last change {100 * self.last_change:+.1f} %, within {100 * self.spread:.1f} %"

    @property
    def text(self):
        order = f"order {self.order:.1f}" if len(self.h) > 2 and 0.51 < self.order < 2.99 else "order not determined"
        return (self.fronts + " m with cells of " + ", ".join(f"{h:.3g}" for h in self.h) +
                f" m. Last change {100 * self.last_change:+.1f} %, {order}, {self.value:.2f} +- {self.uncertainty:.2f} m at h = 0")


def verdict(rows):
    groups = curves(rows)
    limits = {key: Limit(group) for key, group in groups.items()}
    best = {key: limit for key, limit in limits.items() if key[2] == RECOMMENDED[key[0]]}
    tips = {key: Limit(groups[key], TIP) for key in best}
    worst, worst_tip = (max(abs(limit.last_change) for limit in of.values()) for of in (best, tips))
    spread, spread_tip = (max(limit.spread for limit in of.values()) for of in (best, tips))
    claims = [Claim(f"With friction on the base and little damping the front of 99 % of the mass changes by up to {100 * worst_tip:.1f} % at the last of four mesh sizes. Over all four it "
                    f"changes by {100 * spread_tip:.0f} %. The front of 90 % changes by up to {100 * worst:.1f} %, and by {100 * spread:.0f} % over all four. 90 % was chosen "
                    "after the results at 99 %.", worst < 0.02, quick=False)]
    claims += [Claim(f"{scene.capitalize()}, {soil}, {treatment}: {limit.text}. All sizes are within {100 * limit.spread:.1f} %. At 99 %: {tips[scene, soil, treatment].short_text}.",
                     abs(limit.last_change) < 0.02, quick=False, tabled=True) for (scene, soil, treatment), limit in best.items()]
    for (scene, soil, treatment), limit in limits.items():
        if treatment == FIXED:
            other = limits[scene, soil, RECOMMENDED[scene]]
            claims.append(Claim(f"{scene.capitalize()}, {soil}, {treatment}: {limit.text}. With the largest cells the front is {100 * limit.missing:.0f} % short of the value at "
                                f"h = 0; with friction and a PIC rate of 1/s {100 * other.missing:.0f} %.", limit.missing > 1.5 * other.missing, tabled=True))
    dry, wet = (max((abs(tip.last_change) for (scene, _, _), tip in tips.items() if (scene in (COLUMN, SLOPE)) == is_dry), default=math.nan) for is_dry in (True, False))
    claims.append(Claim(f"Nearer to the tip, at 99 % of the mass, the last change is at most {100 * dry:.1f} % dry, and up to {100 * wet:.1f} % with water.",
                        dry < 0.03 < wet, quick=False))
    return claims


def table(rows):
    groups = {key: group for key, group in curves(rows).items() if key[2] in (RECOMMENDED[key[0]], FIXED)}
    lines = [("scene", "base", "smallest h (m)", "fronts of 90 % (m)", "last change", "at h = 0 (m)", "99 %, last change")]
    for (scene, soil, treatment), group in sorted(groups.items(), key=lambda item: item[0][2] == FIXED):
        limit, tip = Limit(group), Limit(group, TIP)
        lines.append((f"{scene}, {soil}", "fixed" if treatment == FIXED else "friction", f"{limit.h[-1]:.3g}", limit.fronts,
                      f"{100 * limit.last_change:+.1f} %", f"{limit.value:.2f} +- {limit.uncertainty:.2f}", f"{100 * tip.last_change:+.1f} %"))
    return lines


def draw(figure, rows):
    plots = figure.subplots(2, 2)
    for axes, scene in zip(plots.flat, (COLUMN, SLOPE, SATURATED, PERMEABLE)):
        for (_, soil, treatment), group in ((key, group) for key, group in curves(rows).items() if key[0] == scene):
            if treatment not in (FIXED, RECOMMENDED[scene]):
                continue
            style = {"color": {"dense": "C0", "loose": "C1"}[soil], "linestyle": "--" if treatment == FIXED else "-", "marker": "o", "markersize": 4}
            limit = Limit(group)
            axes.plot([*limit.h[::-1]], [*limit.values[::-1]], label=f"{soil},\n{'fixed base' if treatment == FIXED else 'friction'}", **style)
            axes.errorbar(0., limit.value, limit.uncertainty, color=style["color"], marker="s", markersize=4, capsize=3)
        axes.set(title=scene, xlabel="cell size h (m); squares: fit at h = 0", ylabel="front of 90 % (m)", xlim=(-0.005, None))
        axes.margins(y=0.2)
        name_lines(axes, 8)


STUDY = Study(
    title="Run-out and mesh",
    question="Does the run-out converge with the cell size?",
    advice="Without inertial friction, give the base friction; a PIC rate of 1 1/s; report the front of 90 % of the mass, for two cell sizes.",
    base="prm/slopes/slope_dense.prm",
    variants=[variant(scene, soil, treatment, n) for (scene, soil, treatment), sizes in CELLS_PER_METRE.items() for n in sizes],
    quick=lambda labels: labels["scene"] == COLUMN and labels["soil"] == "dense" and labels["treatment"] != FRICTION and labels["h"] > 0.06,
    measure=measure, verdict=verdict, table=table, chart=Curves(draw, 5.4))
