# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/resolution.md."""

import numpy as np

from scree import results
from scree.pictures.tables import name_lines
from scree.studies import Curves, Study, Variant, lost_energy, tick_axis

BANK, INCLINE, MOUNTAIN = "bank", "column on an incline", "mountain side"
# Case, sizes of cells (m), upper corner of the box (m), time (s), squares of the deposit (m).
SLIDES = {BANK: ("slopes/first_slope", (2, 1, 1 / 2, 1 / 4, 1 / 8), "20, 8", 5, 1.),
          INCLINE: ("bed/column_on_incline", (1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32), "6, 2", 4, 0.25),
          MOUNTAIN: ("terrain/mountain_dry", (20, 10, 20 / 3, 5, 2.5), "590, 890, 840", 40, 20.)}
CELLS, LENGTH, TOE, AREA, THICKNESS, STRESS = "cells over the thickness", "L", "toe", "area", "thickness", "p'"
BOUNDS = {LENGTH: (1, 0.05), TOE: (1, 0.1), AREA: (1, 0.1), THICKNESS: (3, 0.1), STRESS: (3, 0.1)}  # from cells on, deviation
REACH = 5.5  # cells by which the toe deviates at most


def variant(slide, h):
    case, _, corner, time, _ = SLIDES[slide]
    entries = {"Mesh/Cell size": f"{h:.12g}", "Mesh/Upper corner": corner, "Output/Interval": time, "Output/Graphics": "points"}
    return Variant({"slide": slide, "h": h}, {**entries, **({"End time": time} if slide == INCLINE else {})}, f"prm/{case}.prm")


def measure(run):
    slide, start, end = run.labels["slide"], run.points(0.), run.points()
    n, side = 2 if slide == MOUNTAIN else 1, SLIDES[slide][-1]
    squares, covered = (np.floor(points.positions[:, :n] / side) for points in (end, start))
    is_deposit, volume = ~np.isin([str(x) for x in squares], [str(x) for x in covered]), end.arrays["volume"]
    depths = np.bincount(np.unique(squares[is_deposit], axis=0, return_inverse=True)[1].ravel(), volume[is_deposit]) / side**n
    front = run.statistics("Front 90 % (m)")
    checks = {row["check"]: row["value"] for row in results.read_rows(run.folder / "checks.csv")}
    return {CELLS: float(checks["thickness of the moving soil"].removesuffix(" cells")),
            LENGTH: run.statistics("Run-out length (m)")[-1], TOE: run.statistics("Toe displacement (m)")[-1],
            AREA: front[-1] - front[0] if n == 1 else side**2 * np.sum(depths >= 1.), THICKNESS: depths.max(),
            STRESS: np.average(end.arrays["mean_effective_stress"][is_deposit], weights=volume[is_deposit]),
            "energy lost numerically": lost_energy(run)}


def deviations(rows):
    """{slide: [(row, {quantity: deviation from the finest run}, deviation of the toe in cells)]}, without the finest runs."""
    return {slide: [(row, {name: row[name] / group[-1][name] - 1 for name in BOUNDS}, (row[TOE] - group[-1][TOE]) / row["h"])
                    for row in group[:-1]] for (slide,), group in rows.grouped("slide").items()}


def verdict(rows, claim):
    found = [one for group in deviations(rows).values() for one in group]
    largest = {name: max((abs(error[name]) for row, error, _ in found if row[CELLS] >= least), default=np.nan)
               for name, (least, _) in BOUNDS.items()}
    reach = max(abs(cells) for *_, cells in found)
    return [claim("toe", reach <= REACH, reach=reach, bound=REACH),
            *(claim("bound", largest[name] < bound, quick=False, quantity=name, least=least, bound=bound, largest=largest[name])
              for name, (least, bound) in BOUNDS.items())]


def table(rows):
    return [("slide", "h (m)", CELLS, *BOUNDS, "toe, cells"),
            *((slide, f"{row['h']:.3g}", f"{row[CELLS]:.2g}", *(f"{100 * error[name]:+.1f} %" for name in BOUNDS), f"{cells:+.1f}")
              for slide, group in deviations(rows).items() for row, error, cells in group)]


def draw(figure, rows):
    for axes, (slide, group) in zip(figure.subplots(1, len(SLIDES), sharey=True), deviations(rows).items()):
        for name in BOUNDS:
            axes.plot([row[CELLS] for row, *_ in group], [100 * error[name] for _, error, _ in group], marker="o", markersize=4, label=name)
        axes.set(title=slide, xscale="log", xlabel=CELLS, ylabel="deviation from the finest run (%)")
        tick_axis(axes.xaxis)
        name_lines(axes)


STUDY = Study("prm/slopes/first_slope.prm", variants=[variant(slide, h) for slide in SLIDES for h in SLIDES[slide][1]],
              quick=lambda labels: labels["slide"] == INCLINE and labels["h"] > 0.1, chart=Curves(draw))
