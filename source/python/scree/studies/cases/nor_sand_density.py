# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/nor_sand_density.md."""
from scree.studies.charts import StabilityMap
from scree.studies.measures import classify, mean_oscillation
from scree.studies.study import Study, axis, product, transfer
from scree.studies.words import filled

SCATTER = "oscillation of p'"


def water(kind):
    if kind == "dry":
        return {}
    return {"Soil/Initial porosity": 0.4, "Water/Region": "same", "Water/Points per cell": 3,
            "Water/Hydraulic conductivity": 5e-3,
            **transfer("TPIC"), "Time step/Maximum time step": 1e-3}


def measure(run):
    return {**classify(run, {SCATTER: mean_oscillation(run, "Stress oscillation (-)")}),
            "largest effective stress, kPa": 1e-3 * max(run.statistics("Largest effective stress (Pa)")),
            "front, m": run.statistics("Front 99 % (m)")[-1], "unresolved": run.statistics("Unresolved")[-1]}


LIQUEFIES = (". It is {:.2g} saturated with v_0 = {:g}, where the sand is looser than critical and liquefies: "
             "the mean of p' falls towards 0")


def verdict(rows, claim):
    of = {name: rows.where({"F-bar": name}) for name in ("projected", "modified", "none", "standard")}
    projected, modified, none, standard = of.values()
    calm = {name: found.where(lambda row: row["state"] in ("stable", "oscillating")) for name, found in of.items()}
    # looser than critical, and wet
    loose = projected.where(lambda row: row["pores"] == "saturated" and row["v_0"] > 1.8)
    others = projected.where(lambda row: row not in loose)
    liquefied = filled(LIQUEFIES, loose.largest[SCATTER], loose[0]["v_0"]) if loose else ""
    n_more = sum(own > other for own, other in zip(modified.values[SCATTER], projected.values[SCATTER], strict=True))
    n_bad = standard.n - calm["standard"].n
    claim = claim.shared(rows=rows, others=others, **of)
    return [
        claim("projected", calm["projected"].n >= projected.n - 1 and others.largest[SCATTER] < 0.5
              and projected.smallest["smallest J"] > 0.5 and projected.largest["largest J"] < 2, quick=False,
              liquefied=liquefied),
        claim("modified", n_more >= 10, quick=False, n_more=n_more),
        claim("none", calm["none"].n == none.n and bool(none.where(state="oscillating")),
              oscillating=none.where(state="oscillating")),
        claim("standard", n_bad > 0.5 * standard.n, n_bad=n_bad),
        claim("unresolved", sum(rows.values["unresolved"]) == 0, n=sum(rows.values["unresolved"]))]


STUDY = Study(
    "prm/columns/column_loose.prm", needs_end=False,
    entries={"Mesh/Upper corner": "2.5, 1.2", "Mesh/Cell size": 0.1, "Soil/Points per cell": 3, "End time": 1.,
             "Output/Interval": 0.25, "Output/Statistics interval": 0.02},
    variants=product(axis("pores", water, ["dry", "saturated"]),
                     axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified", "projected"]),
                     axis("v_0", "Soil/Nor-Sand/Initial specific volume", [1.5, 1.55, 1.63, 1.7, 1.78, 1.85])),
    quick=lambda labels: labels["pores"] == "dry" and labels["v_0"] in (1.55, 1.85), default={"F-bar": "projected"},
    chart=StabilityMap("v_0", "F-bar", panels=["pores"], xlabel="initial specific volume v_0 (-)", ylabel="F-bar"))
