# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/air_gap.md."""
import numpy as np

from scree.studies import StabilityMap, Study, Variant, classify, filled, roughness

CELL, HEIGHT = 0.05, 0.4  # m
PAIRS = ["water on water", "soil on water", "water on soil", "soil on soil"]


def variant(pair, gap, speed):
    """A pair of bodies with its gap (cells) and speed; water alone has a case without soil for its base."""
    upper, _, lower = pair.split()
    bottom = HEIGHT + gap * CELL
    above, below = f"(y > {bottom:g} && y < {bottom + HEIGHT:g})", f"y < {HEIGHT:g}"
    soil = [region for region, what in ((above, upper), (below, lower)) if what == "soil"]
    velocity = f"0; if(y > {HEIGHT + gap * CELL / 2:g}, {-speed:g}, 0)"
    entries = {"Water/Region": f"{below} || {above}", "Water/Initial velocity": velocity}
    if soil:
        entries.update({"Soil/Initial state/Type": "none", "Soil/Initial state/K0": "auto", "Soil/Points per cell": 3,
                        "Soil/Region": " || ".join(soil), "Soil/Initial velocity": velocity,
                        "Water/Hydraulic conductivity": 1e-3})
    else:
        entries.update({"Water/Volume correction rate": 0, "Time step/Maximum time step": 1e-3})
    return Variant({"pair": pair, "gap": gap, "v": speed}, entries, None if soil else "prm/water/dam_break.prm")


def measure(run):
    water = run.points(None, "water")
    rough = roughness(water, CELL, "pressure") / (1000 * 9.81 * 2 * HEIGHT)
    # The body's top from its centre of volume: two full layers without a gap have theirs at their height.
    volumes = water.arrays["volume"]
    upper = np.argsort(water.positions[:, 1])[len(volumes) // 2:]
    left = (np.average(water.positions[upper, 1], weights=volumes[upper]) - 1.5 * HEIGHT) / CELL
    return {**classify(run, {"oscillation of p": rough}), "air left, cells": left}


def verdict(rows, claim):
    of = {pair: rows.where(pair=pair) for pair in PAIRS}
    gaining = {pair: found.where(state="energy gain") for pair, found in of.items()}
    gains = [filled("{} in {} of {} (up to {:.2g %} of what is released)", pair, found.n, of[pair].n,
                    of[pair].largest["gain"])
             for pair, found in gaining.items() if found]
    water, ended = of[PAIRS[0]], rows.where(ended=True)
    claim = claim.shared(rows=rows, water=water, ended=ended)
    return [
        claim("gain", rows.largest["gain"] <= 0.005, quick=False, gains=gains or "none"),
        claim("air", rows.largest["air left, cells"] <= 0.5, quick=False,
              air=[f"{pair.split()[0]} on soil {of[pair].span['air left, cells']:.2g}" for pair in PAIRS[2:]
                   if of[pair]]),
        claim("water", water.largest["gain"] < 0.005 and water.largest["air left, cells"] < 0.6),
        claim("end", ended.n == rows.n)]


STUDY = Study(
    "prm/columns/column_saturated.prm", needs_end=False,
    entries={"Mesh/Upper corner": "0.3, 1.2", "Mesh/Cell size": CELL, "Water/Initial pressure": "none",
             "Water/Points per cell": 3, "End time": 0.5, "Output/Interval": 0.25, "Output/Statistics interval": 0.005},
    variants=[variant(pair, gap, speed) for pair in PAIRS for gap in (0.5, 1., 2., 4.) for speed in (0., 1., 5.)],
    quick=lambda labels: labels["pair"] != PAIRS[1] and labels["gap"] in (1., 4.) and labels["v"] in (0., 5.),
    default={}, chart=StabilityMap("v", "gap", panels=["pair"], xlabel="speed (m/s)", ylabel="gap (cells)"))
