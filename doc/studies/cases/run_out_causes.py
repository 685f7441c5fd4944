# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which part of the method makes the front of a collapse depend on the size of the cells. The dense dry column of
[run_out](run_out.md), 1 m x 1 m, after 1.5 s, is run with cells of 0.1 m and of 0.05 m, 3 x 3 points in a cell, on a base that is fixed and on one with
friction of the soil's own angle, 22.3 degrees. One thing at a time is changed: damping (FLIP's PIC rate, TPIC), F-bar, points per cell. Bars: by how
much the smaller cells bring the front forward, measured at 90 % and at 99 % of the mass. For the surface rule of water the loose saturated slope serves in
the same way, with cells of 1/7 m and 1/10 m. "Depth 0.05 m" in the table: the largest x at which the soil, averaged over 0.1 m, is that deep.
"""

import run_out
from charts import Curves
from study import Claim, Study

COLUMN_CAUSES = {
    "as it is": {},
    "PIC rate 0": {"Transfer/PIC rate": 0},
    "PIC rate 20 1/s": {"Transfer/PIC rate": 20},
    "TPIC": {"Transfer/Method": "TPIC"},
    "no F-bar": {"Stabilisation/F-bar": "none"},
    "2 x 2 points": {"Soil/Points per cell": 2},
    "4 x 4 points": {"Soil/Points per cell": 4},
    "base of 35 degrees": {"Boundaries/Bottom": "friction 35"},
}
SURFACES = {"surface by distance (default)": {},
            "surface at half full cells": {"Water/Pressure/Free surface": "half full"}}
SIZES = {run_out.COLUMN: (10, 20), run_out.SATURATED: (7, 10)}


def changed(scene, soil, base, name, entries):
    """The sizes of a scene with one thing changed; that between them is for the short version."""
    found = []
    for n in (10, 14, 20) if name == "as it is" else SIZES[scene]:
        plain = run_out.variant(scene, soil, base, n)
        found.append(plain._replace(labels={**plain.labels, "changed": name}, entries={**plain.entries, **entries}))
    return found


VARIANTS = [variant for base in run_out.BASES for name, entries in COLUMN_CAUSES.items()
            if base == "fixed" or name in ("as it is", "PIC rate 0", "no F-bar", "4 x 4 points")
            for variant in changed(run_out.COLUMN, "dense", base, name, entries)]
VARIANTS += [variant for name, entries in SURFACES.items()
             for variant in changed(run_out.SATURATED, "loose", "friction", name, entries)]


def pairs(rows):
    """{(scene, base, what is changed): (row of the largest cells, row of the smallest)}."""
    found = {}
    for row in sorted(rows, key=lambda row: -row["h"]):
        found.setdefault((row["scene"], row["base"], row["changed"]), []).append(row)
    return {key: (group[0], group[-1]) for key, group in found.items() if len(group) > 1}


def advance(pair, percent):
    """By what part the smaller cells bring the front forward."""
    large, small = (row[f"front {percent} % (m)"] for row in pair)
    return small / large - 1


def verdict(rows):
    both = pairs(rows)
    column = {key[1:]: pair for key, pair in both.items() if key[0] == run_out.COLUMN}
    fixed, friction = column["fixed", "as it is"], column["friction", "as it is"]
    percent = {name: 100 * advance(pair, 99) for name, pair in {"fixed": fixed, "friction": friction}.items()}
    claims = [Claim(f"The base: cells of {fixed[1]['h']:.3g} m instead of {fixed[0]['h']:.3g} m bring the front at 99 % forward by {percent['fixed']:.1f} % on the fixed base, by {percent['friction']:.1f} % "
                    f"on the one with friction; at 90 %, where the deposit is several cells deep, by {100 * advance(fixed, 90):.1f} % and "
                    f"{100 * advance(friction, 90):.1f} %.", percent["fixed"] > 1.5 * percent["friction"])]
    if ("fixed", "PIC rate 0") in column:
        free, strong = (100 * advance(column["fixed", name], 99) for name in ("PIC rate 0", "PIC rate 20 1/s"))
        smooth = 100 * advance(column["fixed", "no F-bar"], 99)
        few, many = (100 * advance(column["fixed", name], 99) for name in ("2 x 2 points", "4 x 4 points"))
        others = [free, smooth, few, many]
        claims.append(Claim(f"Nothing else does that on the fixed base: without PIC the front still moves by {free:.1f} % (with 20 1/s: {strong:.1f} %), "
                            f"without F-bar by {smooth:.1f} %, with 2 x 2 or 4 x 4 points by {few:.1f} or {many:.1f} %.",
                            min(others) > percent["friction"], quick=False))
    return claims


def draw(figure, rows):
    both = pairs(rows)
    groups = {f"dense column, {run_out.BASES[base]}": {key[2]: pair for key, pair in both.items() if key[:2] == (run_out.COLUMN, base)}
              for base in run_out.BASES}
    groups["loose saturated slope, friction 22.3"] = {key[2]: pair for key, pair in both.items() if key[0] == run_out.SATURATED}
    groups = {title: group for title, group in groups.items() if group}
    for axes, (title, group) in zip(figure.subplots(1, len(groups), squeeze=False)[0], groups.items()):
        for offset, quantile in ((-0.2, 90), (0.2, 99)):
            axes.barh([line + offset for line in range(len(group))], [100 * advance(pair, quantile) for pair in group.values()], 0.38,
                      label=f"front at {quantile} % of the mass")
        axes.set_yticks(range(len(group)), list(group))
        axes.invert_yaxis()
        axes.axvline(0, color="0.5", linewidth=0.8)
        axes.set(title=title, xlabel="smaller cells bring it forward by (%)")
        axes.grid(alpha=0.3, axis="x")
    axes.legend(fontsize="x-small")


STUDY = Study(
    title="What makes the run-out depend on the mesh", base="prm/column_dense.prm", variants=VARIANTS,
    quick=lambda labels: labels["scene"] == run_out.COLUMN and labels["changed"] == "as it is" and labels["h"] > 0.06,
    measure=run_out.measure, verdict=verdict, chart=Curves(draw, size=(13, 4.2)))
