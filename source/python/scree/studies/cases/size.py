# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/size.md."""

import re

from scree.pictures.tables import name_lines
from scree.studies.charts import Curves, tick_axis
from scree.studies.study import Study, Variant
from scree.studies.words import filled

NS = "ns per point and step"
# Of the cases of prm/benchmarks: corner of the box (m), cell size (m) and end (s), and the cell sizes here.
SCENES = {"elastic 2D": ("elastic_2d", (1.28, 1.28), 0.01, 0.4, (0.0285, 0.01, 0.00285, 0.00143)),
          "elastic 3D": ("elastic_3d", (1.28, 1.28, 0.96), 0.02, 0.2, (0.0475, 0.02, 0.01, 0.0064)),
          "Nor-Sand 3D": ("nor_sand_column_3d", (1, 1, 0.6), 0.025, 0.1, (0.05, 0.02, 0.01, 0.0065)),
          "soil and water 2D": ("nor_sand_saturated_slope_2d", (9.6, 2.4), 0.03, 0.1, (0.12, 0.03, 0.0125, 0.007))}


def variants():
    found = []
    for scene, (name, corner, reference, end, sizes) in SCENES.items():
        for size in sizes:
            box = ", ".join(f"{-(-length // size) * size:.9g}" for length in corner)
            part = min(1.5, max(0.1, (size / reference) ** len(corner)))  # about as many updates
            entries = {"Mesh/Cell size": size, "Mesh/Upper corner": box, "End time": end * part * size / reference}
            found.append(Variant({"scene": scene, "h": size}, entries, f"prm/benchmarks/{name}.prm"))
    return found


def measure(run):
    points = float(re.search(r"/ ([\d.e+-]+) point updates", run.log).group(1)) / run.statistics("Step")[-1]
    memory = float(re.search(r"^Largest memory: ([\d.]+) MB", run.log, re.MULTILINE).group(1))
    return {"points": points, "MB": memory}


def bytes_per_point(rows, scene):
    """Of the points that the largest run has more than the smallest."""
    found = rows.where(scene=scene)
    small, large = found.with_smallest("points"), found.with_largest("points")
    return 1e6 * (large["MB"] - small["MB"]) / (large["points"] - small["points"])


def verdict(rows, claim):
    times = {scene: rows.where(scene=scene).values[NS] for scene in SCENES}
    spreads = {scene: max(found) / min(found) for scene, found in times.items() if found}
    return [claim("time", max(spreads.values()) <= 1.3, quick=False, spreads=spreads)]


def table(rows):
    return [("scene", "points", "ns per point and time step", "bytes per further point"),
            *((scene, filled("{:.1e}", found.values["points"]), filled("{:.0f}", found.values[NS]),
               f"{bytes_per_point(rows, scene):.0f}")
              for scene in SCENES for found in [rows.where(scene=scene)])]


def draw(figure, rows):
    axes = figure.subplots()
    for scene in SCENES:
        own = rows.where(scene=scene)
        axes.plot(own.values["points"], own.values[NS], marker="o", markersize=4, label=scene)
    axes.set(xscale="log", yscale="log", xlabel="points", ylabel="ns per point and time step, one core")
    tick_axis(axes.yaxis)
    name_lines(axes)


STUDY = Study(
    "prm/benchmarks/elastic_2d.prm", variants=variants(),
    quick=lambda labels: labels["scene"] == "elastic 2D" and labels["h"] > 0.009, chart=Curves(draw, 3.4, timed=True))
