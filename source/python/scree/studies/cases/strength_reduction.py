# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/strength_reduction.md."""

import math

import numpy as np

from scree.closed_forms import slip_circle_factor
from scree.pictures.tables import name_lines
from scree.results import read_table
from scree.studies import Curves, Study, Variant

HEIGHT, WEIGHT = 10., 2000 * 9.81 * 10  # m, and gamma H in Pa
BANK = "example 1, other entries"
LAYERS = {"c_u2/c_u1 = 0.6": 0.6, "c_u2/c_u1 = 1": 1., "c_u2/c_u1 = 1.5": 1.5}
NUMBERS = {"60 degrees": (1 / math.tan(math.radians(60)), 0.191), "vertical": (0., 1 / 3.83)}
ELEMENTS, CIRCLES, CHART = "finite elements", "slip circles", "Taylor's chart"
# The factors and where they are from.
REFERENCES = {"example 1": (1.4, ELEMENTS), "example 2, D = 1.5": (1.4, ELEMENTS),
              "c_u2/c_u1 = 0.6": (slip_circle_factor(2, 2, 0.25, 0.15), CIRCLES), "c_u2/c_u1 = 1": (1.47, CHART),
              "c_u2/c_u1 = 1.5": (slip_circle_factor(2, 2, 0.25, 0.375), CIRCLES), "60 degrees": (1.3, CHART),
              "vertical": (1.3, CHART)}
SCENES = {scene: factor for scene, (factor, _) in REFERENCES.items()}
DEFAULT = "default"
OTHERS = {"E = 1e6 Pa": {"Soil/Mohr-Coulomb/Young's modulus": 1e6},
          "E = 1e8 Pa": {"Soil/Mohr-Coulomb/Young's modulus": 1e8},
          "2 x 2 points": {"Soil/Points per cell": 2}, "4 x 4 points": {"Soil/Points per cell": 4},
          "Courant number 0.3": {"Time step/Courant number": 0.3},
          "TPIC": {"Transfer/Method": "TPIC"}, "FLIP": {"Transfer/Method": "FLIP"},
          "displacement 0.01 H": {"Safety/Displacement": 0.01}, "displacement 0.05 H": {"Safety/Displacement": 0.05}}


def clay(body, strength):
    """Entries of undrained clay, c_u over gamma H."""
    entries = {"Young's modulus": 1e7, "Poisson's ratio": 0.3, "Friction angle": 0, "Dilation angle": 0,
               "Cohesion": round(strength * WEIGHT, 3), "Tension cut-off": 1e9}
    return {f"{body}/Mohr-Coulomb/{name}": value for name, value in entries.items()}


def section(crest, run, depth, toe, cell):
    """Entries of box and slope, lengths in m: the crest, the slope, the depth below the toe, the ground in front of
    it."""
    face = f"y < {depth:g} + ({crest + run:g} - x)*{HEIGHT / run:.12g}" if run else f"x < {crest:g}"
    region = f"y < {HEIGHT + depth:g} && (y < {depth:g} || {face})"
    width = math.ceil((crest + run + toe) / cell) * cell
    return {"Mesh/Upper corner": f"{width:g}, {HEIGHT + depth + 2:g}", "Mesh/Cell size": cell, "Soil/Region": region}


def layers(scene, cell):
    """A bank and the ground below it, of other strength."""
    foundation = {"Material": "Mohr-Coulomb", "Points per cell": 3, "Grain density": 2000, "Initial porosity": 0,
                  "Initial state/Type": "K0", "Initial state/K0": 0.9}
    return {**section(20., 20., 10., 20., cell), **clay("Soil", 0.25), **clay("Foundation", 0.25 * LAYERS[scene]),
            "Bodies": "Soil, Foundation", **{f"Foundation/{name}": value for name, value in foundation.items()},
            "Soil/Region": "y >= 10 && y < 20 && y < 10 + (40 - x)/2", "Foundation/Region": "y < 10",
            "Soil/Initial state/K0": 0.9}


def entries_of(scene, cell):
    if scene == "example 1":
        return {"Mesh/Cell size": cell}
    if scene == "example 2, D = 1.5":
        return section(14., 20., 5., 14., cell)
    if scene in LAYERS:
        return layers(scene, cell)
    run, number = NUMBERS[scene]
    return {**section(15., run * HEIGHT, 0., 4., cell), **clay("Soil", 1.3 * number), "Soil/Initial state/K0": 0.9}


def variants():
    found = [Variant({"scene": scene, "H/h": round(HEIGHT / cell), "entries": DEFAULT}, entries_of(scene, cell))
             for cell in (1., 0.5) for scene in SCENES]
    bank = [Variant({"scene": BANK, "H/h": 10, "entries": name},
                    {"Mesh/Cell size": 1., "Safety/Tolerance": 0.005, **entries})
            for name, entries in {DEFAULT: {}, **OTHERS}.items()]
    return found + bank


def measure(run):
    trials = read_table(run.folder / "safety" / "safety.csv")
    factors, is_at_rest = trials["Factor (-)"], trials["Rests (-)"] == 1
    rests, fails = np.max(factors[is_at_rest]), np.min(factors[~is_at_rest])
    return {"factor": 0.5 * (rests + fails), "rests": rests, "fails": fails, "trials": len(factors), "steps": np.sum(trials["Steps (-)"])}


def deviation(row):
    return row["factor"] / SCENES[row["scene"]] - 1


def scenes_of(rows):
    return rows.where(lambda row: row["scene"] in SCENES)


def bank_of(rows):
    """(the default, the others) of example 1 with other entries."""
    bank = rows.where(scene=BANK)
    return bank.first(entries=DEFAULT), bank.where(lambda row: row["entries"] != DEFAULT)


def verdict(rows, claim):
    found = []
    for cells in sorted(set(scenes_of(rows).values["H/h"])):
        group = scenes_of(rows).where({"H/h": cells})
        worst = max(group, key=lambda row: abs(deviation(row)))
        found.append(claim("factor", abs(deviation(worst)) < 0.03, worst=True, cells=cells, group=group, row=worst,
                           off=deviation(worst)))
    default, others = bank_of(rows)
    if others:
        worst = max(others, key=lambda row: abs(row["factor"] / default["factor"] - 1))
        change = worst["factor"] / default["factor"] - 1
        found.append(claim("entries", abs(change) < 0.01, quick=False, change=change, row=worst))
    return found


def table(rows):
    default, others = bank_of(rows)
    lines = [(row, row["scene"], "computed" if REFERENCES[row["scene"]][1] == CIRCLES else "published", 3,
              *REFERENCES[row["scene"]]) for row in scenes_of(rows)]
    lines += [(row, f"example 1, {row['entries']}", "default", 4, default["factor"], "this study") for row in others]
    return [("slope", "H/h", "reference", "factor", "source", "computed", "deviation"),
            *((slope, f"{row['H/h']:.0f}", kind, f"{exact:.{digits}g}", source, f"{row['factor']:.3f}",
               f"{100 * (row['factor'] / exact - 1):+.1f} %") for row, slope, kind, digits, exact, source in lines)]


def draw(figure, rows):
    axes, points = figure.subplots(), []
    for cells, color in ((10, "C0"), (20, "C1")):
        group = scenes_of(rows).where({"H/h": cells})
        points.append(axes.errorbar([SCENES[row["scene"]] for row in group], group.values["factor"],
                                    [0.5 * (row["fails"] - row["rests"]) for row in group], color=color, marker="o",
                                    markersize=5, linestyle="", label=f"h = H/{cells}"))
    ends = [0.9, 2.1]
    for part, style, label in ((1., "-", "equal"), (0.97, "--", "-3 %"), (1.03, "--", "+3 %")):
        axes.plot(ends, [part * end for end in ends], style, color="0.5", linewidth=1, label=label)
    axes.set(xlabel="reference factor of safety", ylabel="factor of scree --safety")
    name_lines(axes)
    axes.legend(handles=points, loc="upper left")


STUDY = Study(
    "prm/slopes/griffiths_lane.prm", variants=variants(), options=("--safety",), entries={"Output/Graphics": "points"},
    quick=lambda labels: labels["scene"] == "example 1" and labels["H/h"] == 10, chart=Curves(draw))
