# SPDX-License-Identifier: LGPL-2.1-or-later
"""1. Bodies in a box that is 1, 4 and 16 times as large: a stiff elastic block, whose points stay in their cells; a soft one, whose points change cells; a
   column of Nor-Sand; a dam break.
2. A column of Nor-Sand dry, with single-point water, with double-point water, and water alone.
3. The dry column with pictures every 0.02 s: none, of the points, of points and grid.

The measure is processor time per time step; the shares of the parts of a time step are those of the log.
"""

import math
import re

from scree.studies.charts import Curves
from scree.studies.study import Claim, Study, Variant, transfer

COLUMN = {"End time": 0.5, "Mesh/Upper corner": "3, 1.5", "Output/Interval": 1.}
BLOCK = {"Mesh/Cell size": 0.02, "End time": 1.}
STIFF = {**BLOCK, "End time": 0.1, "Soil/Linear elastic/Young's modulus": 5e6}  # ten times the wave speed
BOXES = {"stiff block": ("prm/benchmarks/elastic_2d.prm", 1.28, 1.28, STIFF),
         "soft block": ("prm/benchmarks/elastic_2d.prm", 1.28, 1.28, BLOCK),
         "dry column": ("prm/columns/column_dense.prm", 3., 1.5, COLUMN),
         "dam break": ("prm/water/dam_break.prm", 9., 3., {"Mesh/Cell size": 0.1, "End time": 1.2, "Output/Interval": 2.})}
PHASES = {**COLUMN, **transfer("TPIC"), "Time step/Maximum time step": 5e-4, "End time": 0.2}
SOIL = {**PHASES, "Soil/Initial porosity": 0.4}
WATER = {"dry": ("prm/columns/column_dense.prm", SOIL),
         "single": ("prm/columns/column_dense.prm", {**SOIL, "Water/Region": "same", "Water/Point sets": "single"}),
         "double": ("prm/columns/column_dense.prm", {**SOIL, "Water/Region": "same"}),
         "water alone": ("prm/water/dam_break.prm", {**PHASES, "Water/Region": "x < 1 && y < 1", "Water/Volume correction rate": 0})}
PICTURES = ["none", "points", "points and grid"]
OF_WATER, OF_SOIL = "pressure: [a-z]+|grid to water points", "grid to points, stress"  # parts of a step, as the log names them


def variants():
    found = []
    for name, (base, width, height, entries) in BOXES.items():
        for times in (1, 4, 16):
            side = math.isqrt(times)
            box = {"Mesh/Upper corner": f"{side * width:g}, {side * height:g}", "Output/Graphics": "none"}
            found.append(Variant({"question": "empty cells", "scene": name, "choice": times}, {**entries, **box}, base))
    for name, (base, entries) in WATER.items():
        found.append(Variant({"question": "phases", "scene": "column", "choice": name}, {**entries, "Output/Graphics": "none"}, base))
    for name in PICTURES:
        found.append(Variant({"question": "pictures", "scene": "dry column", "choice": name},
                             {**COLUMN, "Output/Interval": 0.02, "Output/Graphics": name}, "prm/columns/column_dense.prm"))
    return found


def measure(run):
    cost = run.cost

    def share(parts):
        return sum(float(percent) for percent in re.findall(rf"^(?:{parts}) +[\d.]+ +([\d.]+) %", run.log, re.MULTILINE))

    front = "Front 99 % (m)" if "Front 99 % (m)" in run.columns else "Water front 99 % (m)"
    return {"ms per step": 1e3 * cost["core-seconds"] / cost["steps"], "front": run.statistics(front)[-1],
            "share of water (%)": share(OF_WATER), "share of soil (%)": share(OF_SOIL)}


def verdict(rows):
    def pick(question, scene=None):
        return {row["choice"]: row for row in rows if row["question"] == question and scene in (None, row["scene"])}

    claims = []
    boxes = {name: pick("empty cells", name) for name in BOXES if len(pick("empty cells", name)) > 1}
    largest = {name: max(box) for name, box in boxes.items()}
    rise = {name: box[largest[name]]["ms per step"] / box[1]["ms per step"] for name, box in boxes.items()}
    times = max(largest.values())
    claims.append(Claim(f"While points stay in their cells, a box {times:g} times as large takes {rise['stiff block']:.2f} times the time per time step.",
                        holds=rise["stiff block"] < 1.25))
    if len(rise) == len(BOXES):
        stiff, soft = (boxes[f"{name} block"][1]["ns per point and step"] for name in ("stiff", "soft"))
        claims.append(Claim(f"The stiff block takes {stiff:.0f} ns per point and step and the soft one {soft:.0f}. The difference is the sort "
                            "of the points, which is omitted where none changes its cell.", holds=stiff < soft < 1.6 * stiff))
        moving = [name for name in BOXES if name != "stiff block"]
        claims.append(Claim("Where points change cells the larger box takes " + ", ".join(f"{rise[name]:.2f} ({name})" for name in moving) + " times as long: "
                            "only the sort of deal.II visits cells without points, occasionally.", holds=all(rise[name] < 1.25 for name in moving)))
    same = max(abs(box[largest[name]]["front"] / box[1]["front"] - 1) for name, box in boxes.items())
    claims.append(Claim(f"The larger box changes the front by {same:.0e} of its distance.", holds=same < 1e-6))
    phases = pick("phases")
    if len(phases) == len(WATER):
        dry, single, double, water = (phases[name] for name in WATER)
        claims.append(Claim(f"A dry column spends {dry['share of water (%)']:.1f} % of its time on water, and water alone {water['share of soil (%)']:.1f} % on soil. Bound: less than 0.1 %.",
                            holds=dry["share of water (%)"] < 0.1 and water["share of soil (%)"] < 0.1))
        claims.append(Claim(f"A time step takes {single['ms per step'] / dry['ms per step']:.1f} times as long with water on the soil's points, "
                            f"{double['ms per step'] / dry['ms per step']:.1f} times with water on its own, and {water['ms per step'] / dry['ms per step']:.2f} times "
                            "with water alone.", holds=dry["ms per step"] < single["ms per step"] < double["ms per step"]))
    pictures = pick("pictures")
    if len(pictures) == len(PICTURES):
        none, points, grid = (pictures[name]["core-seconds"] for name in PICTURES)
        claims.append(Claim(f"Pictures every {pictures['none']['steps'] * 0.02 / COLUMN['End time']:.0f} time steps cost {points / none - 1:.0%} (points) and "
                            f"{grid / none - 1:.0%} (points and grid) of the run. Bound: 25 %.", holds=grid / none < 1.25))
    return claims


def table(rows):
    return [("question", "scene", "choice", "ms per time step", "time on water (%)", "time on soil (%)"),
            *((row["question"], row["scene"], f"{row['choice']:g} times" if row["question"] == "empty cells" else row["choice"], f"{row['ms per step']:.3g}",
               f"{row['share of water (%)']:.1f}", f"{row['share of soil (%)']:.1f}") for row in rows if row["question"] != "empty cells" or row["choice"] in (1, 16))]


def draw(figure, rows):
    axes = figure.subplots(1, 3, width_ratios=[9, 4, 3])
    for plot, question in zip(axes, ("empty cells", "phases", "pictures")):
        chosen = [row for row in rows if row["question"] == question]
        scenes = list(dict.fromkeys(row["scene"] for row in chosen))
        bars = plot.bar(range(len(chosen)), [row["ms per step"] for row in chosen], color=[f"C{scenes.index(row['scene'])}" for row in chosen])
        plot.bar_label(bars, fmt="%.2g", fontsize=8)
        plot.margins(y=0.12)
        plot.grid(False, axis="x")
        names = [f"{row['scene']}, {row['choice']:g} x" if question == "empty cells" else row["choice"] for row in chosen]
        plot.set_xticks(range(len(chosen)), names, rotation=60, ha="right", rotation_mode="anchor", fontsize=9)
        plot.set_title(question)
    axes[0].set_ylabel("processor time per time step (ms)")


STUDY = Study(title="Overhead of unused features",
              question="What do empty cells, absent phases and pictures cost?",
              advice="Make the box as large as needed; write few pictures.",
              base="prm/columns/column_dense.prm", variants=variants(), measure=measure, verdict=verdict,
              quick=lambda labels: labels["scene"] == "stiff block", table=table, chart=Curves(draw, 4., timed=True))
