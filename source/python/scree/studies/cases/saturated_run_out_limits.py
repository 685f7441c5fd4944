# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/saturated_run_out_limits.md."""

import numpy as np

from scree.studies.cases.run_out import Limit
from scree.studies.cases.run_out_limits import HEIGHT, MASS, TIP, TRANSFERS, depth, front_of_depth, halving_of
from scree.pictures.tables import name_lines
from scree.studies.charts import Curves
from scree.studies.measures import grouped, lost_energy
from scree.studies.study import Claim, Study, Variant

COLUMN, SLOPE = "column", "slope"
FIXED, FRICTION = "fixed", "friction"
FILES = {COLUMN: "prm/columns/column_saturated.prm", SLOPE: "prm/slopes/slope_saturated_loose_friction.prm"}
BOXES = {COLUMN: (12, 1.5), SLOPE: (14, 2.5)}  # m
HEIGHTS = {COLUMN: 1., SLOPE: 2.}  # m
SIZES = {COLUMN: (10, 14, 20, 28, 40), SLOPE: (14, 20, 28, 40)}  # cells over the height
BASES = {(COLUMN, FIXED): "fixed", (COLUMN, FRICTION): "friction 26.6", (SLOPE, FRICTION): "friction 22.3"}
FRONT = "front 0.02 H"


def variant(scene, base, transfer, cells):
    size = HEIGHTS[scene] / cells
    corner = ", ".join(f"{np.ceil(round(length / size, 6)) * size:.12g}" for length in BOXES[scene])
    return Variant({"scene": scene, "base": base, "transfer": transfer, "cells": cells},
                   {**TRANSFERS[transfer], "Mesh/Cell size": f"{size:.12g}", "Mesh/Upper corner": corner, "Boundaries/Bottom": BASES[scene, base],
                    "Soil/Points per cell": 3, "Water/Points per cell": 3, "Output/Graphics": "points", "Output/Interval": 0.5,
                    "End time": 4 if scene == COLUMN else 5}, FILES[scene])


def variants():
    return [variant(scene, base, transfer, cells) for scene, base in BASES for transfer in TRANSFERS for cells in SIZES[scene]]


def measure(run):
    points, height = run.points(), HEIGHTS[run.labels["scene"]]
    return {FRONT: front_of_depth(points, 0.02 * height, 0.5 * height, 0.05 * height, 0.0025 * height), MASS: run.statistics("Front 90 % (m)")[-1],
            TIP: run.statistics("Front 99 % (m)")[-1], HEIGHT: depth(points, 0., 0.1 * height)[0],
            "last point (m)": points.positions[:, 0].max(), "p oscillation": np.median(run.statistics("p oscillation (-)")[1:]),
            "energy lost numerically": lost_energy(run)}


def curves(rows):
    return grouped(rows, "scene", "base", "transfer")


def number(limit):
    return f"{limit.value:.2f} +- {limit.uncertainty:.2f}"


def table(rows):
    found = [["scene", "base", "transfer", "99 %, 20 to 40 cells", "99 %, h = 0 (m)", "90 %, h = 0 (m)", "depth 0.02 H, h = 0 (m)", "height, h = 0 (m)"]]
    for (scene, base, transfer), group in curves(rows).items():
        if len(group) == len(SIZES[scene]):
            found.append([scene, base, transfer, f"{100 * halving_of(group, TIP, 20):+.1f} %", *(number(Limit(group, name)) for name in (TIP, MASS, FRONT, HEIGHT))])
    return found


def apart(limits):
    """Relative difference of the limits of the transfers."""
    values = [limit.value for limit in limits.values()]
    return (max(values) - min(values)) / np.mean(values)


def verdict(rows):
    groups, claims = curves(rows), []
    for scene, base in BASES:
        of = {transfer: groups.get((scene, base, transfer), []) for transfer in TRANSFERS}
        if any(len(group) < len(SIZES[scene]) for group in of.values()):
            continue
        changes = {transfer: halving_of(group, TIP, 20) for transfer, group in of.items()}
        told = ", ".join(f"{transfer} {100 * change:+.1f} %" for transfer, change in changes.items())
        claims.append(Claim(f"{scene.capitalize()}, base {base}: from 20 to 40 cells the front of 99 % changes by {told}. Bound: 3 % with TPIC.",
                            abs(changes["TPIC"]) < 0.03, quick=False))
        for name, percent in ((TIP, 99), (MASS, 90)):
            limits = {transfer: Limit(group, name) for transfer, group in of.items()}
            claims.append(Claim(f"{scene.capitalize()}, base {base}: at h = 0 the front of {percent} % is at {', '.join(f'{number(limit)} m ({name})' for name, limit in limits.items())}. "
                                f"The transfers differ by {100 * apart(limits):.1f} %. Bound: 3 %.", apart(limits) < 0.03, quick=False))
    last = max(rows, key=lambda row: row["last point (m)"] / BOXES[row["scene"]][0])
    farthest = last["last point (m)"] / BOXES[last["scene"]][0]
    claims.append(Claim(f"The farthest point is at {farthest:.2f} of the length of the box ({last['scene']}, base {last['base']}, {last['transfer']}, {last['cells']:.0f} cells). "
                        "Bound: 0.95.", farthest < 0.95))
    return claims


def draw(figure, rows):
    groups = curves(rows)
    for axes, (scene, base) in zip(figure.subplots(1, len(BASES)), BASES):
        for transfer, style in zip(TRANSFERS, ("C0-", "C1-", "C2-")):
            group = groups.get((scene, base, transfer), [])
            axes.plot([row["cells"] for row in group], [row[TIP] for row in group], style, marker="o", markersize=4, label=transfer)
            axes.plot([row["cells"] for row in group], [row[MASS] for row in group], style.replace("-", "--"))
        axes.set(title=f"{scene}, base {base}", xlabel="cells over the height", ylabel="front of 99 % and (dashed) 90 % (m)")
        name_lines(axes)


STUDY = Study(title="Limits of the saturated run-out", question="Does the run-out of saturated soil have a limit, the same for all transfers?",
              advice="Use a base with friction, and report the front of 90 % of the mass with the range of the transfers.",
              base=FILES[COLUMN], variants=variants(), table=table, measure=measure, verdict=verdict,
              quick=lambda labels: labels["scene"] == COLUMN and labels["cells"] == 10, chart=Curves(draw))
