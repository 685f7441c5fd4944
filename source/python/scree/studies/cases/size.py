# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/size.md."""

import re

from scree.pictures.tables import name_lines
from scree.studies.charts import Curves, tick_axis
from scree.studies.study import Claim, Study, Variant

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
            found.append(Variant({"scene": scene, "h": size}, {"Mesh/Cell size": size, "Mesh/Upper corner": box, "End time": end * part * size / reference},
                                 f"prm/benchmarks/{name}.prm"))
    return found


def measure(run):
    points = float(re.search(r"/ ([\d.e+-]+) point updates", run.log).group(1)) / run.statistics("Step")[-1]
    memory = float(re.search(r"^Largest memory: ([\d.]+) MB", run.log, re.MULTILINE).group(1))
    return {"points": points, "MB": memory}


def bytes_per_point(rows):
    """{scene: of the points that the largest run has more than the smallest}."""
    ends = {scene: [pick((row for row in rows if row["scene"] == scene), key=lambda row: row["points"]) for pick in (min, max)] for scene in SCENES}
    return {scene: 1e6 * (large["MB"] - small["MB"]) / (large["points"] - small["points"]) for scene, (small, large) in ends.items()}


def verdict(rows):
    times = {scene: [row["ns per point and step"] for row in rows if row["scene"] == scene] for scene in SCENES}
    spreads = {scene: max(found) / min(found) for scene, found in times.items() if found}
    return [Claim("The time per point varies with the number of points by a factor " + ", ".join(f"{value:.2f} ({scene})" for scene, value in spreads.items())
                  + ". Bound: 1.3.", max(spreads.values()) <= 1.3, quick=False)]


def table(rows):
    memory = bytes_per_point(rows)
    return [("scene", "points", "ns per point and time step", "bytes per further point"),
            *((scene, *(", ".join(f"{row[column]:{form}}" for row in rows if row["scene"] == scene) for column, form in (("points", ".1e"), ("ns per point and step", ".0f"))),
               f"{memory[scene]:.0f}") for scene in SCENES)]


def draw(figure, rows):
    axes = figure.subplots()
    for scene in SCENES:
        own = [row for row in rows if row["scene"] == scene]
        axes.plot([row["points"] for row in own], [row["ns per point and step"] for row in own], marker="o", markersize=4, label=scene)
    axes.set(xscale="log", yscale="log", xlabel="points", ylabel="ns per point and time step, one core")
    tick_axis(axes.yaxis)
    name_lines(axes)


STUDY = Study(title="Speed and memory over the number of points",
              question="What do larger scenes cost?",
              advice="Expect the time per point to change by less than 1.5 and the memory of the table.",
              base="prm/benchmarks/elastic_2d.prm", variants=variants(), measure=measure, verdict=verdict,
              quick=lambda labels: labels["scene"] == "elastic 2D" and labels["h"] > 0.009, table=table, chart=Curves(draw, 3.4, timed=True))
