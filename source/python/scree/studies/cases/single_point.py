# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/single_point.md."""

import math

import numpy as np

from scree.studies import StabilityMap, Study, Variant, axis, measures, product


def point_sets(name):
    def entries(speed):
        velocity = f"{speed}; 0"
        return {"Water/Point sets": name, "Soil/Initial velocity": velocity,
                **({"Water/Initial velocity": velocity} if name == "double" else {})}
    return [Variant({"points": name, "speed": speed}, entries(speed)) for speed in (0., 2., 4., 6., 8.)]


def measure(run):
    mass = run.statistics("Water mass (kg)") + run.statistics("Water lost (kg)")
    made = float(np.max(np.abs(mass / mass[0] - 1)))
    return measures.classify(run, {"oscillation of p": measures.pressure_scatter(run), "error": made})


def verdict(rows, claim):
    single, double = rows.where(points="single"), rows.where(points="double")
    spray = double.where(state="J out of bounds")
    worst = single.with_largest("error")
    gaining = single.where(lambda row: row["gain"] > 0.005)
    claim = claim.shared(single=single, double=double, spray=spray, rest=single.where(speed=0), worst=worst,
                         gaining=gaining)
    return [
        claim("double", all(row["ended"] and row["error"] < 1e-6 and row["gain"] < measures.BOUNDS["gain"]
                            and row["oscillation of p"] < 0.6
                            for row in double), slowest=min(spray.values["speed"], default=math.nan)),
        claim("mass", single.smallest["error"] > 0.01),
        claim("worst", worst["error"] > 0.5 and worst["speed"] > 0, quick=False),
        claim("energy", gaining.n > 0, quick=False)]


STUDY = Study(
    "prm/slopes/slope_saturated_mohr_coulomb.prm",
    entries={"Mesh/Cell size": 0.1, "Mesh/Upper corner": "3, 5", "Soil/Region": "x < 1 && y < 0.6", "End time": 2.,
             "Soil/Mohr-Coulomb/Young's modulus": 1e6, "Time step/Maximum time step": 0.01, "Output/Interval": 0.1,
             "Output/Graphics": "points"},
    variants=product(point_sets("double") + point_sets("single"),
                     axis("friction", "Soil/Mohr-Coulomb/Friction angle", [18.5, 30., 40.]),
                     axis("k", "Water/Hydraulic conductivity", [5e-3, 1e-1])),
    needs_end=False, default={"points": "double"},
    quick=lambda labels: labels["friction"] == 18.5 and labels["k"] == 0.1 and labels["speed"] in (0., 4.),
    chart=StabilityMap("speed", "friction", panels=["points", "k"], xlabel="speed (m/s); k in m/s",
                       ylabel="friction angle (degrees)"))
