# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/nor_sand_density.md."""
import numpy as np

from scree.studies.charts import StabilityMap
from scree.studies.measures import classify, mean_oscillation
from scree.studies.study import Claim, Study, axis, product, transfer


def water(kind):
    if kind == "dry":
        return {}
    return {"Soil/Initial porosity": 0.4, "Water/Region": "same", "Water/Points per cell": 3, "Water/Hydraulic conductivity": 5e-3,
            **transfer("TPIC"), "Time step/Maximum time step": 1e-3}


def measure(run):
    return {**classify(run, {"oscillation of p'": mean_oscillation(run, "Stress oscillation (-)")}),
            "largest effective stress, kPa": 1e-3 * max(run.statistics("Largest effective stress (Pa)")), "front, m": run.statistics("Front 99 % (m)")[-1],
            "unresolved": run.statistics("Unresolved")[-1]}


def verdict(rows):
    def of(stabilisation):
        return [row for row in rows if row["F-bar"] == stabilisation]

    def count(stabilisation, state):
        return sum(row["state"] == state for row in of(stabilisation))
    def scatter(chosen):
        return [row["oscillation of p'"] for row in chosen]
    projected, modified, none, standard = map(of, ("projected", "modified", "none", "standard"))
    loose = [row for row in projected if row["pores"] == "saturated" and row["v_0"] > 1.8]  # looser than critical, and wet
    others = [row for row in projected if row not in loose]
    bad = len(standard) - count("standard", "stable") - count("standard", "oscillating")
    return [
        Claim(f"With the projected F-bar (the default) p' oscillates by {min(scatter(others)):.2g} to {max(scatter(others)):.2g} of its mean, v_0 from {min(row['v_0'] for row in rows):g} to "
              f"{max(row['v_0'] for row in rows):g}, dry and saturated" + (
                  f". It is {max(scatter(loose)):.2g} saturated with v_0 = {loose[0]['v_0']:g}, where the sand is looser than critical and liquefies: the mean of p' falls "
                  "towards 0" if loose else "")
              + f". None gains more than {100 * max(row['gain'] for row in projected):.2g} % of the energy released; V/V_0 of a point stays between "
              f"{min(row['smallest J'] for row in projected):.2g} and {max(row['largest J'] for row in projected):.2g}.",
              count("projected", "stable") + count("projected", "oscillating") >= len(projected) - 1 and max(scatter(others)) < 0.5
              and all(0.5 < row["smallest J"] and row["largest J"] < 2 for row in projected), quick=False),
        Claim(f"With the cell means of the modified F-bar it oscillates by {min(scatter(modified)):.2g} to {max(scatter(modified)):.2g}, more in "
              f"{np.sum(np.array(scatter(modified)) > np.array(scatter(projected)))} of {len(modified)} columns.",
              np.sum(np.array(scatter(modified)) > np.array(scatter(projected))) >= 10, quick=False),
        Claim(f"Without stabilisation no run stops, but p' oscillates beyond the bound in {count('none', 'oscillating')} of {len(none)} (by {min(scatter(none)):.2g} to "
              f"{max(scatter(none)):.2g}).", count("none", "oscillating") + count("none", "stable") == len(none) and count("none", "oscillating") > 0),
        Claim(f"With the standard F-bar {bad} of {len(standard)} runs gain energy, leave the bounds of V/V_0 or stop: up to {100 * max(row['gain'] for row in standard):.2g} % of the energy "
              f"released, V/V_0 up to {max(row['largest J'] for row in standard):.2g}.", bad > 0.5 * len(standard)),
        Claim(f"The return map leaves {sum(row['unresolved'] for row in rows):g} updates unresolved.", sum(row["unresolved"] for row in rows) == 0),
    ]


STUDY = Study(title="Density of Nor-Sand",
              question="How smooth is the stress of Nor-Sand for any density?",
              advice="Use projected F-bar; judge loose saturated Nor-Sand by its front, not by p' of points.",
              base="prm/columns/column_loose.prm", needs_end=False,
              entries={"Mesh/Upper corner": "2.5, 1.2", "Mesh/Cell size": 0.1, "Soil/Points per cell": 3, "End time": 1., "Output/Interval": 0.25,
                       "Output/Statistics interval": 0.02},
              variants=product(axis("pores", water, ["dry", "saturated"]), axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified", "projected"]),
                               axis("v_0", "Soil/Nor-Sand/Initial specific volume", [1.5, 1.55, 1.63, 1.7, 1.78, 1.85])),
              quick=lambda labels: labels["pores"] == "dry" and labels["v_0"] in (1.55, 1.85),
              measure=measure, verdict=verdict, default={"F-bar": "projected"},
              chart=StabilityMap("v_0", "F-bar", panels=["pores"], xlabel="initial specific volume v_0 (-)", ylabel="F-bar"))
