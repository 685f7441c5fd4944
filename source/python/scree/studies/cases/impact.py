# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/impact.md."""
import numpy as np

from scree.studies import BOUNDS, Span, StabilityMap, Study, axis, classify, product, roughness

HEAD = 1000 * 9.81 * 0.5  # Pa


def speed(v):
    velocity = f"0; {-v}"
    return {"Soil/Initial velocity": velocity, "Water/Initial velocity": velocity, "End time": 0.1 / v + 0.3}


def measure(run):
    water = run.points(None, "water")
    rough = roughness(water, float(run.entries["Mesh/Cell size"]), "pressure") / HEAD
    # From 0.1 m above the floor, with the momentum of the start and of free fall.
    momentum, speed_at_start = np.asarray(run.statistics("Momentum y (N s)")), run.labels["v"]
    speed_at_touch = (speed_at_start**2 + 2 * 9.81 * 0.1)**0.5
    later = (speed_at_touch - speed_at_start) / 9.81 + 0.1
    mass = -momentum[0] / speed_at_start
    impulse = 1 + np.interp(later, run.statistics("Time (s)"), momentum) / (mass * speed_at_touch)
    return {**classify(run, {"oscillation of p": rough}), "impulse": impulse,
            "peak p, kPa": 1e-3 * max(run.statistics("Largest p (Pa)")),
            "volume error": max(run.statistics("Volume error (-)"))}


def pairs(rows, quantity):
    """A quantity of each impact on the coarse and on the fine mesh."""
    fine = {(row["k"], row["v"]): row[quantity] for row in rows.where(h=rows.smallest["h"])}
    return [(row[quantity], fine[row["k"], row["v"]]) for row in rows.where(h=0.1)]


def verdict(rows, claim):
    ended, spray = rows.where(ended=True), rows.where(state="J out of bounds")
    slower = rows.where(lambda row: row not in spray and row["v"] < rows.largest["v"])
    calm = slower.largest["v"] if slower else 0.
    changes = [abs(fine - coarse) for coarse, fine in pairs(rows, "impulse")]
    ratios = Span.of(fine / coarse for coarse, fine in pairs(rows, "peak p, kPa"))
    claim = claim.shared(rows=rows, ended=ended, spray=spray, bounds=BOUNDS)
    return [
        claim("oscillation", rows.largest["oscillation of p"] < 1.2,
              mean=sum(rows.values["oscillation of p"]) / rows.n),
        claim("impulse", max(changes) < 0.1 and ratios.high > 1.5, quick=False, largest=max(changes),
              mean=sum(changes) / len(changes), ratios=ratios),
        claim("spray", spray.smallest["v"] > calm, quick=False, calm=calm) if spray else claim("no spray", True),
        claim("end", ended.n == rows.n and rows.largest["gain"] < BOUNDS["gain"])]


STUDY = Study(
    "prm/columns/column_saturated.prm", needs_end=False,
    entries={"Soil/Region": "x > 0.5 && x < 1.5 && y > 0.1 && y < 0.6", "Soil/Initial state/Type": "none",
             "Soil/Initial state/K0": "auto", "Water/Initial pressure": "none", "Mesh/Upper corner": "2, 1.5",
             "Soil/Points per cell": 3, "Water/Points per cell": 3, "Output/Interval": 0.1,
             "Output/Statistics interval": 0.002},
    variants=product(axis("h", "Mesh/Cell size", [0.1, 0.05]),
                     axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-2, 1e-3, 1e-5]),
                     axis("v", speed, [0.5, 1., 2., 5., 10.])),
    quick=lambda labels: labels["h"] == 0.1 and labels["k"] in (1e-1, 1e-5) and labels["v"] in (1., 10.), default={},
    chart=StabilityMap("v", "k", panels=["h"], xlabel="speed (m/s); h in m", ylabel="k (m/s)"))
