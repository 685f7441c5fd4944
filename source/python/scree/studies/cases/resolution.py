# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/resolution.md."""

import numpy as np

from scree import results
from scree.pictures.tables import name_lines
from scree.studies import Curves, Study, Variant, tick_axis

# Case, sizes of cells (m), changed entries, squares of the deposit (m) and axes of the map.
SLIDES = {"bank": ("slopes/first_slope", (2, 1, 1 / 2, 1 / 4, 1 / 8), {"Mesh/Upper corner": "20, 8", "Output/Interval": 5}, 1., 1),
          "column on an incline": ("bed/column_on_incline", (1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32), {"End time": 4, "Output/Interval": 4}, 0.25, 1),
          "mountain side": ("terrain/mountain_dry", (20, 10, 20 / 3, 5, 2.5), {"Mesh/Upper corner": "590, 890, 840", "Output/Interval": 40}, 20., 2)}
CELLS, TOE, REACH = "cells over the thickness", "toe", 5.5  # cells by which the toe deviates at most
BOUNDS = {"L": (1, 0.05), TOE: (1, 0.1), "area": (1, 0.1), "thickness": (3, 0.1), "p'": (3, 0.1)}  # from cells on, deviation


def measure(run):
    start, end, (*_, side, n) = run.points(0.), run.points(), SLIDES[run.labels["slide"]]
    squares, covered = (np.floor(points.positions[:, :n] / side) for points in (end, start))
    is_deposit, volume = ~np.isin([str(x) for x in squares], [str(x) for x in covered]), end.arrays["volume"]
    depths = np.bincount(np.unique(squares[is_deposit], axis=0, return_inverse=True)[1].ravel(), volume[is_deposit]) / side**n
    checks = {row["check"]: row["value"] for row in results.read_rows(run.folder / "checks.csv")}
    front = run.statistics("Front 90 % (m)")
    return {CELLS: float(checks["thickness of the moving soil"].removesuffix(" cells")),
            "L": run.statistics("Run-out length (m)")[-1], TOE: run.statistics("Toe displacement (m)")[-1],
            "area": front[-1] - front[0] if n == 1 else side**2 * np.sum(depths >= 1.), "thickness": depths.max(),
            "p'": np.average(end.arrays["mean_effective_stress"][is_deposit], weights=volume[is_deposit])}


def deviations(rows):
    """{slide: [(cells, {quantity: deviation from the finest run}, that of the toe in cells, row)]}, without the finest runs."""
    return {slide: [(row[CELLS], {name: row[name] / group[-1][name] - 1 for name in BOUNDS}, (row[TOE] - group[-1][TOE]) / row["h"], row)
                    for row in group[:-1]] for (slide,), group in rows.grouped("slide").items()}


def verdict(rows, claim):
    found = [one for group in deviations(rows).values() for one in group]
    claims = [claim("toe", (reach := max(abs(toe) for _, _, toe, _ in found)) <= REACH, reach=reach, bound=REACH)]
    for name, (least, bound) in BOUNDS.items():
        largest = max((abs(error[name]) for cells, error, *_ in found if cells >= least), default=np.nan)
        claims.append(claim("bound", largest < bound, quick=False, quantity=name, least=least, bound=bound, largest=largest))
    return claims


def table(rows):
    return [("slide", "h (m)", CELLS, *BOUNDS, "toe, cells"),
            *((slide, f"{row['h']:.3g}", f"{cells:.2g}", *(f"{100 * error[name]:+.1f} %" for name in BOUNDS), f"{toe:+.1f}")
              for slide, group in deviations(rows).items() for cells, error, toe, row in group)]


def draw(figure, rows):
    plots = figure.subplots(2, 2).ravel()
    for axes, (slide, group), line in zip(plots, deviations(rows).items(), (":", "-", "--")):
        cells, errors, toes, _ = zip(*group)
        for name in BOUNDS:
            axes.plot(cells, [100 * error[name] for error in errors], marker="o", markersize=4, label=name)
        axes.set(title=slide, ylabel="deviation from the finest run (%)", ylim=(-90, 60))
        plots[-1].plot(cells, toes, "k", linestyle=line, marker="o", markersize=4, label=slide)
    plots[-1].set(title="toe", ylabel="deviation of the toe (cells)", ylim=(-REACH, REACH))
    for axes in plots:
        axes.set(xscale="log", xlabel=CELLS, xlim=(0.15, 10))
        tick_axis(axes.xaxis)
        name_lines(axes)


STUDY = Study("prm/slopes/first_slope.prm", quick=lambda labels: labels["slide"] != "mountain side" and labels["h"] > 0.24,
              variants=[Variant({"slide": slide, "h": h}, {"Mesh/Cell size": f"{h:.12g}", **entries, "Output/Graphics": "points"}, f"prm/{case}.prm")
                        for slide, (case, sizes, entries, *_) in SLIDES.items() for h in sizes], chart=Curves(draw, 5.4))
