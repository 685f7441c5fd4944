# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/pic_courant.md."""

import math

from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.study import Claim, Study, Variant, axis, product, transfer

TRANSFERS = {**{f"FLIP, {rate}/s": {"Transfer/Method": "FLIP", "Transfer/PIC rate": rate} for rate in (0, 1, 5, 20, 100)},
             "TPIC": transfer("TPIC")}

DEFAULT = "FLIP, 1/s"  # of the program, not of the cases, which have 5/s
SCATTER = "oscillation of p'"

SCENES = [Variant({"scene": "vibrating bar"}, {"Mesh/Cell size": 0.0625, "Mesh/Upper corner": "1, 0.0625", "End time": 1.26491,
                                               "Output/Interval": 0.31623, "Output/Statistics interval": 0.31623,
                                               "Time step/Maximum time step": 1}, "prm/dynamics/vibrating_bar.prm"),
          Variant({"scene": "Mohr-Coulomb column"}, {"Mesh/Cell size": 0.1, "Soil/Region": "x < 1 && y < 1", "End time": 1., "Output/Interval": 0.25,
                                                     "Output/Statistics interval": 0.05}, "prm/columns/mohr_coulomb_collapse.prm"),
          Variant({"scene": "Nor-Sand column"}, {"Mesh/Cell size": 0.1, "End time": 1., "Output/Interval": 0.25,
                                                 "Output/Statistics interval": 0.05}, "prm/columns/column_dense.prm")]


def measure(run):
    oscillation = {} if run.labels["scene"] == "vibrating bar" else {SCATTER: measures.mean_oscillation(run, "Stress oscillation (-)")}
    front = run.statistics("Front 99.5 % (m)")
    lost = run.statistics("Numerical dissipation (J)")[-1] / measures.released_energy(run)
    return {**measures.classify(run, oscillation), "energy lost": float(lost), "front": float(front[-1]), "cause": measures.cause(run)}


def verdict(rows):
    def select(transfer, scene):
        return [row for row in rows if row["transfer"] == transfer and row["scene"] == scene and row["step/limit"] <= 1.2]

    def spread(transfer):
        """Of the front over the steps, of the column where it is larger."""
        fronts = [[row["front"] for row in select(transfer, scene)] for scene in dict.fromkeys(row["scene"] for row in columns)]
        return max(max(of_scene) / min(of_scene) - 1 for of_scene in fronts)

    def lost(transfer, scene):
        return next((row["energy lost"] for row in select(transfer, scene) if row["step/limit"] == 0.6), math.nan)

    column, default = "Mohr-Coulomb column", DEFAULT
    name = default.replace(",", " at")
    columns = [row for row in rows if row["scene"] != "vibrating bar" and row["step/limit"] <= 1.2]
    own = [row for row in columns if row["transfer"] == default]
    tpic, flip = ({row["step/limit"]: row[SCATTER] for row in select(transfer, "Nor-Sand column")} for transfer in ("TPIC", default))
    bar = [row for row in rows if row["scene"] == "vibrating bar"]
    limit, beyond = (max((row["step/limit"] for row in bar if row["state"] == "stable"), default=math.nan),
                     min((row["step/limit"] for row in bar if row["state"] != "stable"), default=math.nan))
    return [
        Claim(f"With the default, {name}, {sum(row['state'] == 'stable' for row in own)} of the {len(own)} columns with time steps up to 1.2 of the limit are stable. The oscillation of p' is "
              f"{min(row[SCATTER] for row in own):.2f} to {max(row[SCATTER] for row in own):.2f} of the mean p' in all of them, and none stops or gains energy.",
              all(row["state"] in ("stable", "oscillating") and row[SCATTER] < 0.3 for row in own)),
        Claim(f"The elastic bar (no F-bar) is stable to {limit:g} of the limit time step and diverges at {beyond:g} with every transfer: the "
              "limit does not depend on the transfer.", limit < beyond, quick=False),
        Claim(f"Up to 1.2 no transfer gains energy in a collapse (at most {max(row['gain'] for row in columns):.1g} of the released one).",
              all(row["gain"] < 0.005 for row in columns)),
        Claim(f"{name} depends little on the time step: up to 1.2 of the limit the front of a column changes by at most {100 * spread(default):.1f} %. With TPIC it changes by up to "
              f"{100 * spread('TPIC'):.0f} %, as it filters once per time step.",
              spread(default) < 0.03 < spread("TPIC")),
        Claim(f"At 0.6 of the limit FLIP loses {100 * lost('FLIP, 0/s', column):.0f}, {100 * lost(default, column):.0f}, {100 * lost('FLIP, 5/s', column):.0f} and "
              f"{100 * lost('FLIP, 100/s', column):.0f} % of the released energy at 0, 1, 5 and 100/s, TPIC {100 * lost('TPIC', column):.0f} %.",
              lost("FLIP, 0/s", column) < lost(default, column) < lost("FLIP, 100/s", column), quick=False),
        Claim(f"Small time steps do not improve TPIC: in Nor-Sand its stress oscillates at 0.2 of the limit ({tpic.get(0.2, math.nan):.2f}) more than at 1.2 "
              f"({tpic.get(1.2, math.nan):.2f}), that of {name} less so ({flip.get(0.2, math.nan):.2f}, {flip.get(1.2, math.nan):.2f}).",
              tpic.get(0.2, math.nan) > 1.2 * tpic.get(1.2, math.nan), quick=False),
    ]


STUDY = Study(
    title="Transfer and time step",
    question="Which transfers are stable up to which time step, and what do they dissipate?",
    advice="Keep the default Courant number, at most 0.9; use FLIP at 1 1/s in collapses.",
    base="prm/columns/column_dense.prm", entries={"Output/Graphics": "points"},
    variants=product(SCENES, [Variant({"transfer": name}, entries) for name, entries in TRANSFERS.items()],
                     axis("step/limit", "Time step/Courant number", [0.2, 0.4, 0.6, 0.8, 1., 1.2, 1.5, 2.])),
    measure=measure, verdict=verdict, needs_end=False,
    quick=lambda labels: labels["scene"] == "Mohr-Coulomb column" and labels["transfer"] in (DEFAULT, "TPIC")
    and labels["step/limit"] in (0.6, 1.2), default={"transfer": DEFAULT},
    chart=StabilityMap("step/limit", "transfer", panels=["scene"], xlabel="time step over limit", ylabel="transfer"))
