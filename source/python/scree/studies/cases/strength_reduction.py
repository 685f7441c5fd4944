# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/strength_reduction.md."""

import math

import numpy as np

from scree.closed_forms import slip_circle_factor
from scree.pictures.tables import name_lines
from scree.studies.charts import Curves
from scree.studies.study import Claim, Study, Variant

HEIGHT, WEIGHT = 10., 2000 * 9.81 * 10  # m, and gamma H in Pa
BANK = "example 1, other entries"
SCENES = {"example 1": 1.4, "example 2, D = 1.5": 1.4, "c_u2/c_u1 = 0.6": slip_circle_factor(2, 2, 0.25, 0.15), "c_u2/c_u1 = 1": 1.47,
          "c_u2/c_u1 = 1.5": slip_circle_factor(2, 2, 0.25, 0.375), "60 degrees": 1.3, "vertical": 1.3}
SOURCES = {"example 1": "finite elements", "example 2, D = 1.5": "finite elements", "c_u2/c_u1 = 0.6": "slip circles", "c_u2/c_u1 = 1": "Taylor's chart",
           "c_u2/c_u1 = 1.5": "slip circles", "60 degrees": "Taylor's chart", "vertical": "Taylor's chart"}
LAYERS = {"c_u2/c_u1 = 0.6": 0.6, "c_u2/c_u1 = 1": 1., "c_u2/c_u1 = 1.5": 1.5}
NUMBERS = {"60 degrees": (1 / math.tan(math.radians(60)), 0.191), "vertical": (0., 1 / 3.83)}
DEFAULT = "default"
OTHERS = {"E = 1e6 Pa": {"Soil/Mohr-Coulomb/Young's modulus": 1e6}, "E = 1e8 Pa": {"Soil/Mohr-Coulomb/Young's modulus": 1e8},
          "2 x 2 points": {"Soil/Points per cell": 2}, "4 x 4 points": {"Soil/Points per cell": 4}, "Courant number 0.3": {"Time step/Courant number": 0.3},
          "TPIC": {"Transfer/Method": "TPIC"}, "FLIP": {"Transfer/Method": "FLIP"}, "displacement 0.01 H": {"Safety/Displacement": 0.01},
          "displacement 0.05 H": {"Safety/Displacement": 0.05}}


def clay(body, strength):
    """Entries of undrained clay, c_u over gamma H."""
    entries = {"Young's modulus": 1e7, "Poisson's ratio": 0.3, "Friction angle": 0, "Dilation angle": 0, "Cohesion": round(strength * WEIGHT, 3), "Tension cut-off": 1e9}
    return {f"{body}/Mohr-Coulomb/{name}": value for name, value in entries.items()}


def section(crest, run, depth, toe, cell):
    """Entries of box and slope, lengths in m: the crest, the slope, the depth below the toe, the ground in front of it."""
    face = f"({crest + run:g} - x)*{HEIGHT / run:.12g}" if run else None
    region = f"y < {HEIGHT + depth:g} && (y < {depth:g} || " + (f"y < {depth:g} + {face})" if face else f"x < {crest:g})")
    width = math.ceil((crest + run + toe) / cell) * cell
    return {"Mesh/Upper corner": f"{width:g}, {HEIGHT + depth + 2:g}", "Mesh/Cell size": cell, "Soil/Region": region}


def entries_of(scene, cell):
    if scene == "example 1":
        return {"Mesh/Cell size": cell}
    if scene == "example 2, D = 1.5":
        return section(14., 20., 5., 14., cell)
    if scene in LAYERS:
        found = {**section(20., 20., 10., 20., cell), **clay("Soil", 0.25), **clay("Foundation", 0.25 * LAYERS[scene]), "Bodies": "Soil, Foundation"}
        for name in ("Material", "Points per cell", "Grain density", "Initial porosity", "Initial state/Type", "Initial state/K0"):
            found[f"Foundation/{name}"] = {"Material": "Mohr-Coulomb", "Points per cell": 3, "Grain density": 2000, "Initial porosity": 0,
                                           "Initial state/Type": "K0", "Initial state/K0": 0.9}[name]
        found.update({"Soil/Region": "y >= 10 && y < 20 && y < 10 + (40 - x)/2", "Foundation/Region": "y < 10", "Soil/Initial state/K0": 0.9})
        return found
    run, number = NUMBERS[scene]
    return {**section(15., run * HEIGHT, 0., 4., cell), **clay("Soil", 1.3 * number), "Soil/Initial state/K0": 0.9}


def variants():
    found = [Variant({"scene": scene, "H/h": round(HEIGHT / cell), "entries": DEFAULT}, entries_of(scene, cell))
             for cell in (1., 0.5) for scene in SCENES]
    bank = [Variant({"scene": BANK, "H/h": 10, "entries": name}, {"Mesh/Cell size": 1., "Safety/Tolerance": 0.005, **entries})
            for name, entries in {DEFAULT: {}, **OTHERS}.items()]
    return found + bank


def measure(run):
    trials = np.atleast_1d(np.genfromtxt(run.folder / "safety" / "safety.csv", delimiter=",", names=True))
    rests, fails = np.max(trials["factor"][trials["rests"] == 1]), np.min(trials["factor"][trials["rests"] == 0])
    return {"factor": 0.5 * (rests + fails), "rests": rests, "fails": fails, "trials": len(trials), "steps": np.sum(trials["steps"])}


def deviation(row):
    return row["factor"] / SCENES[row["scene"]] - 1


def scenes_of(rows):
    return [row for row in rows if row["scene"] in SCENES]


def bank_of(rows):
    """(the default, the others) of example 1 with other entries."""
    bank = [row for row in rows if row["scene"] == BANK]
    return next((row for row in bank if row["entries"] == DEFAULT), None), [row for row in bank if row["entries"] != DEFAULT]


def verdict(rows):
    found = []
    for cells in sorted({row["H/h"] for row in scenes_of(rows)}):
        group = [row for row in scenes_of(rows) if row["H/h"] == cells]
        worst = max(group, key=lambda row: abs(deviation(row)))
        found.append(Claim(f"h = H/{cells:.0f}: the factor of {len(group)} slopes deviates by {100 * deviation(worst):+.1f} % at most ({worst['scene']}). Bound: 3 %.",
                           abs(deviation(worst)) < 0.03, worst=True))
    default, others = bank_of(rows)
    if others:
        worst = max(others, key=lambda row: abs(row["factor"] / default["factor"] - 1))
        found.append(Claim(f"Example 1, h = H/10: other entries change the factor by {100 * (worst['factor'] / default['factor'] - 1):+.1f} % at most ({worst['entries']}). Bound: 1 %.",
                           abs(worst["factor"] / default["factor"] - 1) < 0.01, quick=False))
    return found


def table(rows):
    default, others = bank_of(rows)
    head = [("slope", "H/h", "reference", "factor", "source", "computed", "deviation")]
    return head + [(row["scene"], f"{row['H/h']:.0f}", "published" if SOURCES[row["scene"]] != "slip circles" else "computed", f"{SCENES[row['scene']]:.3g}", SOURCES[row["scene"]],
                    f"{row['factor']:.3f}", f"{100 * deviation(row):+.1f} %") for row in scenes_of(rows)] + [
                        (f"example 1, {row['entries']}", "10", "default", f"{default['factor']:.3f}", "this study", f"{row['factor']:.3f}",
                         f"{100 * (row['factor'] / default['factor'] - 1):+.1f} %") for row in others]


def draw(figure, rows):
    axes, points = figure.subplots(), []
    for cells, color in ((10, "C0"), (20, "C1")):
        group = [row for row in scenes_of(rows) if row["H/h"] == cells]
        points.append(axes.errorbar([SCENES[row["scene"]] for row in group], [row["factor"] for row in group], [0.5 * (row["fails"] - row["rests"]) for row in group],
                      color=color, marker="o", markersize=5, linestyle="", label=f"h = H/{cells}"))
    ends = [0.9, 2.1]
    for part, style, label in ((1., "-", "equal"), (0.97, "--", "-3 %"), (1.03, "--", "+3 %")):
        axes.plot(ends, [part * end for end in ends], style, color="0.5", linewidth=1, label=label)
    axes.set(xlabel="reference factor of safety", ylabel="factor of scree --safety")
    name_lines(axes)
    axes.legend(handles=points, loc="upper left")


STUDY = Study(title="Strength reduction", question="Is the factor of safety by strength reduction that of finite elements and of charts?",
              advice="Use 10 cells over the height or more.",
              base="prm/slopes/griffiths_lane.prm", variants=variants(), table=table, options=("--safety",),
              entries={"Output/Graphics": "points"}, quick=lambda labels: labels["scene"] == "example 1" and labels["H/h"] == 10,
              measure=measure, verdict=verdict, chart=Curves(draw))
