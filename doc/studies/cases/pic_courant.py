# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which transfer stays quiet and gains no energy, at which step?"""

import measures
from charts import StabilityMap
from study import Claim, Study, Variant, axis, product

TRANSFERS = {"FLIP, 0/s": ("FLIP", 0), "FLIP, 1/s": ("FLIP", 1), "FLIP, 5/s": ("FLIP", 5), "FLIP, 20/s": ("FLIP", 20), "FLIP, 100/s": ("FLIP", 100),
             "PIC": ("PIC", 5), "APIC": ("APIC", 5), "TPIC": ("TPIC", 5)}


def transfer(name):
    method, rate = TRANSFERS[name]
    return {"Transfer/Method": method, **({"Transfer/PIC rate": rate} if method == "FLIP" else {})}


SCENES = [Variant({"scene": "vibrating bar"}, {"Mesh/Cell size": 0.0625, "Mesh/Upper corner": "1, 0.0625", "End time": 1.265, "Output/Interval": 0.31625,
                                               "Output/Statistics interval": 0.0632}, "prm/vibrating_bar.prm"),
          Variant({"scene": "Mohr-Coulomb column"}, {"Mesh/Cell size": 0.1, "Soil/Region": "x < 1 && y < 1", "End time": 1., "Output/Interval": 0.25,
                                                     "Output/Statistics interval": 0.05}, "prm/mohr_coulomb_collapse.prm"),
          Variant({"scene": "Nor-Sand column"}, {"Mesh/Cell size": 0.1, "End time": 1., "Output/Interval": 0.25,
                                                 "Output/Statistics interval": 0.05}, "prm/column_dense.prm")]


def measure(run):
    bar = run.labels["scene"] == "vibrating bar"
    front = run.statistics("^front 99.5")
    lost = run.statistics("^numerical")[-1] / measures.released_energy(run)
    return {"state": measures.classify(run, column="^stress oscillation", oscillation=1e9 if bar else 0.25),
            "energy lost": float(lost), "gain": measures.energy_gain(run), "P oscillation": measures.mean_oscillation(run, "^stress oscillation"),
            "front": float(front[-1]), "cause": measures.cause(run)}


def verdict(rows):
    return []


STUDY = Study(
    title="Transfer and step", base="prm/column_dense.prm", entries={"Output/Graphics": "points"},
    variants=product(SCENES, [Variant({"transfer": name}, transfer(name)) for name in TRANSFERS],
                     axis("step/limit", "Time step/Courant number", [0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5])),
    measure=measure, verdict=verdict, needs_end=False,
    chart=StabilityMap("step/limit", "transfer", panels=["scene"], number="energy lost", xlabel="step over limit", ylabel=""))
