# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/low_stress.md."""
import math

import numpy as np

from scree.studies import StabilityMap, Study, Variant, classify, mean_oscillation

CASES = {("Nor-Sand", "dry"): "columns/column_loose", ("Mohr-Coulomb", "dry"): "columns/mohr_coulomb_collapse",
         ("Nor-Sand", "saturated"): "slopes/slope_saturated_loose",
         ("Mohr-Coulomb", "saturated"): "columns/column_saturated"}


def variant(law, pores, part, height):
    """The case of a soil, with lengths and times of its scale; `part`: of the gravity of the Earth."""
    gravity = 9.81 * part
    end = 2 * math.sqrt(height / gravity)
    entries = {"Mesh/Upper corner": f"{2.5 * height:.10g}, {1.25 * height:.10g}", "Mesh/Cell size": height / 8,
               "Soil/Region": f"x < {height:g} && y < {height:g}", "Gravity": f"0, {-gravity:.10g}", "End time": end,
               "Output/Interval": end / 2, "Output/Statistics interval": end / 50}
    if pores == "saturated":
        entries.update({"Water/Points per cell": 2, "Time step/Maximum time step": end / 400})
    return Variant({"soil": f"{law}, {pores}", "gravity": part, "height": height}, entries,
                   f"prm/{CASES[law, pores]}.prm")


def measure(run):
    return {**classify(run, {"oscillation of p'": mean_oscillation(run, "Stress oscillation (-)")}),
            "unresolved": run.statistics("Unresolved")[-1]}


def verdict(rows, claim):
    ended = rows.where(ended=True)
    calm = rows.where(lambda row: row["state"] in ("stable", "oscillating"))
    failed = rows.where(lambda row: row not in calm)
    scales = [row["height"] * row["gravity"] for row in rows]
    smallest, largest = (np.mean([row["oscillation of p'"] for row, scale in zip(rows, scales) if scale == chosen])
                         for chosen in (min(scales), max(scales)))
    wet = failed.where(soil="Mohr-Coulomb, saturated", state="energy gain")
    claim = claim.shared(rows=rows, ended=ended, calm=calm, failed=failed, smallest=smallest, largest=largest)
    return [
        *([claim("gain", wet.n == failed.n, quick=False)] if failed else []),
        claim("oscillation", smallest > largest),
        claim("end", ended.n == rows.n),
        claim("unresolved", sum(rows.values["unresolved"]) == 0, n=sum(rows.values["unresolved"]))]


STUDY = Study(
    "prm/columns/column_loose.prm", needs_end=False, entries={"Soil/Points per cell": 2},
    variants=[variant(*case, part, height) for case in CASES for part in (0.01, 1.) for height in (0.02, 0.1, 0.5, 2.)],
    quick=lambda labels: labels["gravity"] == 1. and labels["height"] in (0.1, 2.), default={},
    chart=StabilityMap("height", "gravity", panels=["soil"], xlabel="height (m)", ylabel="gravity over 9.81 m/s²"))
