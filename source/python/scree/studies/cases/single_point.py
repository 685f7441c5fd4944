# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/single_point.md."""

import math

import numpy as np

from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.study import Claim, Study, Variant, axis, product


def point_sets(name):
    return [Variant({"points": name, "speed": speed}, {"Water/Point sets": name, "Soil/Initial velocity": f"{speed}; 0",
                                                       **({"Water/Initial velocity": f"{speed}; 0"} if name == "double" else {})})
            for speed in (0., 2., 4., 6., 8.)]


def measure(run):
    mass = run.statistics("Water mass (kg)") + run.statistics("Water lost (kg)")
    made = float(np.max(np.abs(mass / mass[0] - 1)))
    return {**measures.classify(run, {"oscillation of p": measures.pressure_scatter(run), "error": made}),
            "largest porosity": float(np.max(run.statistics("Largest porosity (-)"))), "front 90": float(run.statistics("Front 90 % (m)")[-1]),
            "water lost": float(run.statistics("Water lost (kg)")[-1] / mass[0]), "cause": measures.cause(run)}


def verdict(rows):
    single, double = ([row for row in rows if row["points"] == name] for name in ("single", "double"))
    open_ = [row for row in double if row["state"] == "J out of bounds"]
    made = [row["error"] for row in single]
    rest = [row["error"] for row in single if row["speed"] == 0]
    worst = max(single, key=lambda row: row["error"])
    gains = sum(row["gain"] > 0.005 for row in single)
    return [
        Claim(f"Double-point water conserves its mass in all {len(double)} runs, which come to their end, and gains no energy (at most {max(row['gain'] for row in double):.1g} of the "
              f"released energy). The spray is not stable: J of single soil points is up to {max(row['largest J'] for row in double):.0f}, beyond the bound in "
              f"{len(open_)} runs, from {min((row['speed'] for row in open_), default=math.nan):g} m/s on. p oscillates by up to {max(row['oscillation of p'] for row in double):.2g} (0.3 was asked and is missed).",
              all(row["ended"] and row["error"] < 1e-6 and row["gain"] < measures.BOUNDS["gain"] and row["oscillation of p"] < 0.6 for row in double)),
        Claim(f"Single-point water gains {100 * min(made):.0f} % of mass and more in each of {len(made)} runs; in a column that only collapses "
              f"{100 * min(rest):.0f} to {100 * max(rest):.0f} %.", min(made) > 0.01),
        Claim(f"Where soil is thrown about, the gain reaches {worst['error']:.3g} times its mass at {worst['speed']:g} m/s, friction "
              f"{worst['friction']:g} degrees and k = {worst['k']:g} m/s.", worst["error"] > 0.5 and worst["speed"] > 0, quick=False),
        Claim(f"That water adds energy: {gains} of {len(single)} single-point runs gain more than 0.005 of the released energy, up to "
              f"{max(row['gain'] for row in single):.2g}.", gains > 0, quick=False),
    ]


STUDY = Study(
    title="Saturated soil thrown at a wall",
    question="Does water keep its mass and pressure in an impact?",
    advice="Use double-point water for soil that is thrown about; do not trust p and J of single points in the spray.",
    base="prm/slopes/slope_saturated_mohr_coulomb.prm",
    entries={"Mesh/Cell size": 0.1, "Mesh/Upper corner": "3, 5", "Soil/Region": "x < 1 && y < 0.6", "End time": 2.,
             "Soil/Mohr-Coulomb/Young's modulus": 1e6, "Time step/Maximum time step": 0.01, "Output/Interval": 0.1,
             "Output/Graphics": "points"},
    variants=product(point_sets("double") + point_sets("single"),
                     axis("friction", "Soil/Mohr-Coulomb/Friction angle", [18.5, 30., 40.]),
                     axis("k", "Water/Hydraulic conductivity", [5e-3, 1e-1])),
    measure=measure, verdict=verdict, needs_end=False, default={"points": "double"},
    quick=lambda labels: labels["friction"] == 18.5 and labels["k"] == 0.1 and labels["speed"] in (0., 4.),
    chart=StabilityMap("speed", "friction", panels=["points", "k"], xlabel="speed (m/s); k in m/s", ylabel="friction angle (degrees)"))
