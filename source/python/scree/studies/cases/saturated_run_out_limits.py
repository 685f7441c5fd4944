# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/saturated_run_out_limits.md."""

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies import (HEIGHT, MASS, TIP, TRANSFERS, Curves, Limit, Rows, Study, Variant, apart, depth,
                           front_of_depth, halving_of, lost_energy, whole_cells)

COLUMN, SLOPE = "column", "slope"
FIXED, FRICTION = "fixed", "friction"
FILES = {COLUMN: "prm/columns/column_saturated.prm", SLOPE: "prm/slopes/slope_saturated_loose_friction.prm"}
BOXES = {COLUMN: (12, 1.5), SLOPE: (14, 2.5)}  # m
HEIGHTS = {COLUMN: 1., SLOPE: 2.}  # m
SIZES = {COLUMN: (10, 14, 20, 28, 40), SLOPE: (14, 20, 28, 40)}  # cells over the height
BASES = {(COLUMN, FIXED): "fixed", (COLUMN, FRICTION): "friction 26.6", (SLOPE, FRICTION): "friction 22.3"}
FRONT, LAST = "front 0.02 H", "last point (m)"


def variant(scene, base, transfer, cells):
    return Variant({"scene": scene, "base": base, "transfer": transfer, "cells": cells},
                   {**TRANSFERS[transfer], **whole_cells(HEIGHTS[scene] / cells, BOXES[scene]),
                    "Boundaries/Bottom": BASES[scene, base],
                    "Soil/Points per cell": 3, "Water/Points per cell": 3, "Output/Graphics": "points",
                    "Output/Interval": 0.5, "End time": 4 if scene == COLUMN else 5}, FILES[scene])


def variants():
    return [variant(scene, base, transfer, cells)
            for scene, base in BASES for transfer in TRANSFERS for cells in SIZES[scene]]


def measure(run):
    points, height = run.points(), HEIGHTS[run.labels["scene"]]
    return {FRONT: front_of_depth(points, 0.02 * height, 0.5 * height, 0.05 * height, 0.0025 * height),
            MASS: run.statistics("Front 90 % (m)")[-1], TIP: run.statistics("Front 99 % (m)")[-1],
            HEIGHT: depth(points, 0., 0.1 * height)[0], LAST: points.positions[:, 0].max(),
            "p oscillation": np.median(run.statistics("p oscillation (-)")[1:]),
            "energy lost numerically": lost_energy(run)}


def curves(rows):
    return rows.grouped("scene", "base", "transfer")


def table(rows):
    found = [["scene", "base", "transfer", "99 %, 20 to 40 cells", "99 %, h = 0 (m)", "90 %, h = 0 (m)",
              "depth 0.02 H, h = 0 (m)", "height, h = 0 (m)"]]
    for (scene, base, transfer), group in curves(rows).items():
        if len(group) == len(SIZES[scene]):
            limits = [f"{Limit(group, name):.2f}" for name in (TIP, MASS, FRONT, HEIGHT)]
            found.append([scene, base, transfer, f"{100 * halving_of(group, TIP, 20):+.1f} %", *limits])
    return found


def verdict(rows, claim):
    groups, claims = curves(rows), []
    for scene, base in BASES:
        of = {transfer: groups.get((scene, base, transfer), []) for transfer in TRANSFERS}
        if any(len(group) < len(SIZES[scene]) for group in of.values()):
            continue
        name = {"scene": scene.capitalize(), "base": base}
        changes = {transfer: halving_of(group, TIP, 20) for transfer, group in of.items()}
        claims.append(claim("halving", abs(changes["TPIC"]) < 0.03, quick=False, changes=changes, **name))
        for quantity, percent in ((TIP, 99), (MASS, 90)):
            limits = {transfer: Limit(group, quantity) for transfer, group in of.items()}
            claims.append(claim("transfers", apart(limits) < 0.03, quick=False, percent=percent, limits=limits,
                                apart=apart(limits), **name))
    last = max(rows, key=lambda row: row[LAST] / BOXES[row["scene"]][0])
    farthest = last[LAST] / BOXES[last["scene"]][0]
    return [*claims, claim("box", farthest < 0.95, farthest=farthest, row=last)]


def draw(figure, rows):
    groups = curves(rows)
    for axes, (scene, base) in zip(figure.subplots(1, len(BASES)), BASES):
        for transfer, style in zip(TRANSFERS, ("C0-", "C1-", "C2-")):
            group = groups.get((scene, base, transfer), Rows())
            axes.plot(group.values["cells"], group.values[TIP], style, marker="o", markersize=4, label=transfer)
            axes.plot(group.values["cells"], group.values[MASS], style.replace("-", "--"))
        axes.set(title=f"{scene}, base {base}", xlabel="cells over the height",
                 ylabel="front of 99 % and (dashed) 90 % (m)")
        name_lines(axes)


STUDY = Study(
    FILES[COLUMN], variants=variants(),
    quick=lambda labels: labels["scene"] == COLUMN and labels["cells"] == 10, chart=Curves(draw))
