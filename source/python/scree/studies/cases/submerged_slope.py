# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/submerged_slope.md."""
import math

import numpy as np

from scree.studies import StabilityMap, Study, axis, classify, product

CREST, FRICTION = 0.6, 30  # m, degrees
MOVED, SOIL, WATER = "front moved, mm", "soil, mm/s", "water, mm/s"


def slope(angle):
    face = f"{CREST} - (x - 0.6)*{math.tan(math.radians(angle)):.6f}"
    return {"Soil/Region": f"if(x < 0.6, y < {CREST}, y < {face})"}


def measure(run):
    water, soil, start = run.points(None, "water"), run.points(), run.points(0.)
    mass = start.arrays["mass"].sum()
    speeds = np.linalg.norm(water.arrays["velocity"][water.arrays["inside_soil"] < 0.5], axis=1)
    front = run.statistics("Front 99 % (m)")
    moved = 1e3 * (front[-1] - front[0])
    angle = run.labels["angle"]
    wrong = moved > 1 if angle < FRICTION else moved < 10 if angle > FRICTION else False
    measured = {"oscillation of p": np.mean(run.statistics("p oscillation (-)")), "error": int(wrong)}
    return {**classify(run, measured, mass * 9.81 * 0.01), WATER: 1e3 * math.sqrt(np.mean(speeds ** 2)),
            SOIL: 1e3 * np.max(np.linalg.norm(soil.arrays["velocity"], axis=1)), MOVED: moved}


def verdict(rows, claim):
    stable = rows.where(state="stable")
    flat, steep = rows.where(lambda row: row["angle"] < FRICTION), rows.where(lambda row: row["angle"] > FRICTION)
    drained, under = flat.where(k=rows.largest["k"]), flat.where(lambda row: row["surface"] > CREST)
    claim = claim.shared(rows=rows, stable=stable, flat=flat, steep=steep, drained=drained, under=under)
    return [
        claim("stable", stable.n == rows.n),
        claim("stands", flat.largest[MOVED] < 1 and flat.largest[SOIL] < 60 and under.largest[WATER] < 29
              and flat.largest[WATER] < 29
              and drained.largest[MOVED] < 0.45 and drained.largest[WATER] < 10),
        claim("slides", steep.smallest[MOVED] > 10)]


STUDY = Study(
    "prm/columns/column_saturated.prm", needs_end=False,
    entries={"Mesh/Upper corner": "3.2, 1.2", "Mesh/Cell size": 0.1, "Soil/Points per cell": 3,
             "Water/Points per cell": 3,
             "End time": 4., "Settling/Maximum time": 1., "Time step/Maximum time step": 2e-3, "Output/Interval": 0.5,
             "Output/Statistics interval": 0.05},
    variants=product(axis("surface", lambda y: {"Water/Region": f"y < {y:g}"}, [0.45, 0.65, 1.]),
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-4, 1e-8]),
                     axis("angle", slope, [15, 25, 30, 35, 45])),
    quick=lambda labels: labels["surface"] == 1. and labels["k"] in (1e-1, 1e-4) and labels["angle"] in (25, 45),
    default={}, chart=StabilityMap("angle", "k", panels=["surface"],
                                   xlabel="angle of the slope (degrees); level of the water surface in m",
                                   ylabel="k (m/s)"))
