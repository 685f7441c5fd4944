# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/submerged_slope.md."""
import math

import numpy as np

from scree.studies.charts import StabilityMap
from scree.studies.measures import classify
from scree.studies.study import Claim, Study, axis, product

CREST, FRICTION = 0.6, 30  # m, degrees


def slope(angle):
    return {"Soil/Region": f"if(x < 0.6, y < {CREST}, y < {CREST} - (x - 0.6)*{math.tan(math.radians(angle)):.6f})"}


def measure(run):
    water, soil, start = run.points(None, "water"), run.points(), run.points(0.)
    mass = start.arrays["mass"].sum()
    speeds = np.linalg.norm(water.arrays["velocity"][water.arrays["inside_soil"] < 0.5], axis=1)
    front = run.statistics("Front 99 % (m)")
    moved, fastest = 1e3 * (front[-1] - front[0]), 1e3 * np.max(np.linalg.norm(soil.arrays["velocity"], axis=1))
    angle = run.labels["angle"]
    wrong = moved > 1 if angle < FRICTION else moved < 10 if angle > FRICTION else False
    return {**classify(run, {"oscillation of p": np.mean(run.statistics("p oscillation (-)")), "error": int(wrong)}, mass * 9.81 * 0.01), "water, mm/s": 1e3 * math.sqrt(np.mean(speeds ** 2)),
            "soil, mm/s": fastest, "front moved, mm": moved,
            "volume error": max(run.statistics("Volume error (-)"))}


def verdict(rows):
    stable = [row for row in rows if row["state"] == "stable"]
    flat, steep = ([row for row in rows if row["angle"] < FRICTION], [row for row in rows if row["angle"] > FRICTION])
    drained = [row for row in flat if row["k"] == max(row["k"] for row in rows)]
    under = [row for row in flat if row["surface"] > CREST]

    def largest(chosen, column):
        return max(row[column] for row in chosen)
    return [
        Claim(f"{len(stable)} of {len(rows)} are stable for k from {largest(rows, 'k'):g} to {min(row['k'] for row in rows):g} m/s and any water level, on one mesh (h = 0.1 m).",
              len(stable) == len(rows)),
        Claim(f"Below the friction angle the front moves by at most {largest(flat, 'front moved, mm'):.2g} mm in 4 s (bound 1), soil by at most "
              f"{largest(flat, 'soil, mm/s'):.2g} mm/s. Spurious currents are at most {largest(under, 'water, mm/s'):.2g} mm/s under water (0.5 was asked and is missed), and "
              f"{largest(flat, 'water, mm/s'):.2g} mm/s where the water surface cuts a slope (5 was asked and is missed; sqrt(g 0.6 m) is 2.4 m/s). In gravel, k = {largest(rows, 'k'):g} m/s, the slope stays: at most "
              f"{largest(drained, 'front moved, mm'):.2g} mm, {largest(drained, 'water, mm/s'):.2g} mm/s.",
              largest(flat, "front moved, mm") < 1 and largest(flat, "soil, mm/s") < 60 and largest(under, "water, mm/s") < 29 and largest(flat, "water, mm/s") < 29
              and largest(drained, "front moved, mm") < 0.45 and largest(drained, "water, mm/s") < 10),
        Claim(f"Above it the slope slides: the front moves by at least {min(row['front moved, mm'] for row in steep):.2g} mm in 4 s (bound 10).",
              min(row["front moved, mm"] for row in steep) > 10),
    ]


STUDY = Study(title="Slope under still water",
              question="Do slopes under water stand below the friction angle and slide above it?",
              advice="Trust the angle at which slopes slide, drained and undrained.",
              base="prm/columns/column_saturated.prm", needs_end=False,
              entries={"Mesh/Upper corner": "3.2, 1.2", "Mesh/Cell size": 0.1, "Soil/Points per cell": 3, "Water/Points per cell": 3, "End time": 4.,
                       "Settling/Maximum time": 1., "Time step/Maximum time step": 2e-3, "Output/Interval": 0.5, "Output/Statistics interval": 0.05},
              variants=product(axis("surface", lambda y: {"Water/Region": f"y < {y:g}"}, [0.45, 0.65, 1.]),
                               axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-4, 1e-8]), axis("angle", slope, [15, 25, 30, 35, 45])),
              quick=lambda labels: labels["surface"] == 1. and labels["k"] in (1e-1, 1e-4) and labels["angle"] in (25, 45),
              measure=measure, verdict=verdict, default={},
              chart=StabilityMap("angle", "k", panels=["surface"], xlabel="angle of the slope (degrees); level of the water surface in m", ylabel="k (m/s)"))
