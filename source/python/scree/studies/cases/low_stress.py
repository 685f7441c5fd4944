# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/low_stress.md."""
import math

from scree.studies.charts import StabilityMap
from scree.studies.measures import classify, mean_oscillation
from scree.studies.study import Claim, Study, Variant

CASES = {("Nor-Sand", "dry"): "columns/column_loose", ("Mohr-Coulomb", "dry"): "columns/mohr_coulomb_collapse", ("Nor-Sand", "saturated"): "slopes/slope_saturated_loose",
         ("Mohr-Coulomb", "saturated"): "columns/column_saturated"}


def variant(law, pores, part, height):
    """The case of a soil, with lengths and times of its scale; `part`: of the gravity of the Earth."""
    gravity = 9.81 * part
    end = 2 * math.sqrt(height / gravity)
    entries = {"Mesh/Upper corner": f"{2.5 * height:.10g}, {1.25 * height:.10g}", "Mesh/Cell size": height / 8, "Soil/Region": f"x < {height:g} && y < {height:g}",
               "Gravity": f"0, {-gravity:.10g}", "End time": end, "Output/Interval": end / 2, "Output/Statistics interval": end / 50}
    if pores == "saturated":
        entries.update({"Water/Points per cell": 2, "Time step/Maximum time step": end / 400})
    return Variant({"soil": f"{law}, {pores}", "gravity": part, "height": height}, entries, f"prm/{CASES[law, pores]}.prm")


def measure(run):
    height = run.labels["height"]
    suction = -min(run.columns.get("Smallest p (Pa)", [0.]))  # dry soil has none
    return {**classify(run, {"oscillation of p'": mean_oscillation(run, "Stress oscillation (-)")}),
            "front/height": run.statistics("Front 99 % (m)")[-1] / height, "suction/weight": suction / (1000 * 9.81 * run.labels["gravity"] * height),
            "unresolved": run.statistics("Unresolved")[-1]}


def verdict(rows):
    ended = [row for row in rows if row["ended"]]
    calm = [row for row in rows if row["state"] in ("stable", "oscillating")]
    failed = [row for row in rows if row not in calm]
    smallest, largest = (pick(row["height"] * row["gravity"] for row in rows) for pick in (min, max))

    def mean(scale):
        chosen = [row["oscillation of p'"] for row in rows if row["height"] * row["gravity"] == scale]
        return sum(chosen) / len(chosen)
    return [
        *([Claim(f"{len(failed)} of {len(rows)} columns, of saturated Mohr-Coulomb sand, gain energy: up to {100 * max(row['gain'] for row in failed):.1f} % of the released energy, within "
                 "a few time steps.", quick=False, holds=all(row["soil"] == "Mohr-Coulomb, saturated" and row["state"] == "energy gain" for row in failed))] if failed else []),
        Claim(f"p' oscillates by {mean(largest):.2g} of its mean at the largest stress and {mean(smallest):.2g} at the smallest (means over soils), as the stiffness is the same and "
              "the weight smaller.", mean(smallest) > mean(largest)),
        Claim(f"{len(ended)} of {len(rows)} columns collapse to their end, {len(calm)} without gain of energy or volumes out of bounds.", len(ended) == len(rows)),
        Claim(f"The return map leaves {sum(row['unresolved'] for row in rows):g} updates unresolved.", sum(row["unresolved"] for row in rows) == 0),
    ]


STUDY = Study(title="Low stress",
              question="Do the laws work at the stress of small columns and low gravity?",
              advice="Scale the stiffness with the weight in small models; use fronts, not p' of points.",
              base="prm/columns/column_loose.prm", needs_end=False, entries={"Soil/Points per cell": 2},
              variants=[variant(*case, part, height) for case in CASES for part in (0.01, 1.) for height in (0.02, 0.1, 0.5, 2.)],
              quick=lambda labels: labels["gravity"] == 1. and labels["height"] in (0.1, 2.),
              measure=measure, verdict=verdict, default={},
              chart=StabilityMap("height", "gravity", panels=["soil"], xlabel="height (m)", ylabel="gravity over 9.81 m/s²"))
