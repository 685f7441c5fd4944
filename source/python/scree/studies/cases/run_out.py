# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out.md."""

import math

from scree.pictures.tables import name_lines
from scree.studies import Curves, Limit, Study, Variant, filled, lost_energy, whole_cells

FIXED, FRICTION, LOW_PIC = "fixed", "friction", "friction, PIC rate 1/s"
TREATMENTS = {FIXED: {"Boundaries/Bottom": "fixed"}, FRICTION: {"Boundaries/Bottom": "friction 22.3"},
              LOW_PIC: {"Boundaries/Bottom": "friction 22.3", "Transfer/PIC rate": 1}}
COLUMN, SLOPE, SATURATED, PERMEABLE = "column", "slope", "saturated slope", "permeable saturated slope"
FILES = {COLUMN: "columns/column", SLOPE: "slopes/slope", SATURATED: "slopes/slope_saturated",
         PERMEABLE: "slopes/slope_saturated"}
BOXES = {COLUMN: (4.5, 1.5), SLOPE: (10., 2.5), SATURATED: (12., 2.5), PERMEABLE: (12., 2.5)}  # m
TIMES = {COLUMN: {"dense": 1.5, "loose": 1.5}, SLOPE: {"dense": 3., "loose": 3.}, SATURATED: {"dense": 9., "loose": 5.},
         PERMEABLE: {"dense": 6.}}  # s
FOUR, WET = (10, 14, 20, 28), (7, 10, 14, 20)
CELLS_PER_METRE = {**{(COLUMN, soil, treatment): FOUR for treatment in (FIXED, LOW_PIC) for soil in ("dense", "loose")},
                   (SLOPE, "dense", LOW_PIC): FOUR, (SLOPE, "loose", LOW_PIC): FOUR, (SATURATED, "loose", FRICTION): WET,
                   (SATURATED, "dense", FRICTION): WET, (PERMEABLE, "dense", FRICTION): WET}
RECOMMENDED = {COLUMN: LOW_PIC, SLOPE: LOW_PIC, SATURATED: FRICTION, PERMEABLE: FRICTION}
FRONT, TIP = "front 90 % (m)", "front 99 % (m)"


def measure(run):
    return {**{name: run.statistics(name.replace("front", "Front"))[-1] for name in (FRONT, TIP)},
            "energy lost numerically (-)": lost_energy(run)}


def variant(scene, soil, treatment, cells_per_metre):
    points = 3 if scene == COLUMN or (scene, soil, treatment) == (SLOPE, "dense", LOW_PIC) else 2
    end = TIMES[scene][soil]
    entries = {**whole_cells(1 / cells_per_metre, BOXES[scene]), **TREATMENTS[treatment],
               "End time": end, "Output/Interval": end if scene in (COLUMN, SLOPE) else 1., "Output/Graphics": "points",
               "Soil/Points per cell": points}
    if scene in (SATURATED, PERMEABLE):
        entries["Water/Points per cell"] = points
    if scene == PERMEABLE:
        entries["Water/Hydraulic conductivity"] = 5e-2
    labels = {"scene": scene, "soil": soil, "treatment": treatment, "h": 1 / cells_per_metre}
    return Variant(labels, entries, f"prm/{FILES[scene]}_{soil}.prm")


def curves(rows):
    return rows.grouped("scene", "soil", "treatment")


def verdict(rows, claim):
    groups = curves(rows)
    limits = {key: Limit(group, FRONT) for key, group in groups.items()}
    best = {key: limit for key, limit in limits.items() if key[2] == RECOMMENDED[key[0]]}
    tips = {key: Limit(groups[key], TIP) for key in best}
    worst, worst_tip = (max(abs(limit.last_change) for limit in of.values()) for of in (best, tips))
    spread, spread_tip = (max(limit.spread for limit in of.values()) for of in (best, tips))

    claim = claim.shared(worst_front=worst, worst_tip=worst_tip, spread=spread, spread_tip=spread_tip)
    claims = [claim("front", worst < 0.02, quick=False)]
    claims += [claim("recommended", abs(limit.last_change) < 0.02, quick=False, tabled=True, limit=limit,
                     scene=", ".join(key)) for key, limit in best.items()]
    for (scene, soil, treatment), limit in limits.items():
        if treatment == FIXED:
            other = limits[scene, soil, RECOMMENDED[scene]]
            claims.append(claim("fixed", limit.missing > 1.5 * other.missing, tabled=True, limit=limit, other=other,
                                scene=f"{scene}, {soil}"))
    dry, wet = (max((abs(tip.last_change)
                     for (scene, _, _), tip in tips.items() if (scene in (COLUMN, SLOPE)) == is_dry), default=math.nan)
                for is_dry in (True, False))
    return [*claims, claim("tip", dry < 0.03 < wet, quick=False, dry=dry, wet=wet)]


def table(rows):
    lines = [("scene", "base", "smallest h (m)", "fronts of 90 % (m)", "last change", "at h = 0 (m)",
              "99 %, last change")]
    for (scene, soil, treatment), group in sorted(curves(rows).items(), key=lambda item: item[0][2] == FIXED):
        limit, tip = Limit(group, FRONT), Limit(group, TIP)
        lines.append((f"{scene}, {soil}", "fixed" if treatment == FIXED else "friction", f"{limit.h[-1]:.3g}",
                      filled("{:.2f}", list(limit.values)), f"{100 * limit.last_change:+.1f} %", f"{limit:.2f}",
                      f"{100 * tip.last_change:+.1f} %"))
    return lines


def draw(figure, rows):
    plots = figure.subplots(2, 2)
    for axes, scene in zip(plots.flat, (COLUMN, SLOPE, SATURATED, PERMEABLE)):
        for (_, soil, treatment), group in ((key, group) for key, group in curves(rows).items() if key[0] == scene):
            color, linestyle = {"dense": "C0", "loose": "C1"}[soil], "--" if treatment == FIXED else "-"
            limit = Limit(group, FRONT)
            axes.plot(limit.h[::-1], limit.values[::-1], color=color, linestyle=linestyle, marker="o", markersize=4,
                      label=f"{soil},\n{'fixed base' if treatment == FIXED else 'friction'}")
            axes.errorbar(0., limit.value, limit.uncertainty, color=color, marker="s", markersize=4, capsize=3)
        axes.set(title=scene, xlabel="cell size h (m); squares: fit at h = 0", ylabel="front of 90 % (m)",
                 xlim=(-0.005, None))
        axes.margins(y=0.2)
        name_lines(axes, 8)


STUDY = Study(
    "prm/slopes/slope_dense.prm",
    variants=[variant(*curve, n) for curve, sizes in CELLS_PER_METRE.items() for n in sizes],
    quick=lambda labels: labels["scene"] == COLUMN and labels["soil"] == "dense" and labels["h"] > 0.06,
    chart=Curves(draw, 5.4))
