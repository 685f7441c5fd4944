# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where in its cell may the water's surface lie? Three rules for where p = 0: ours finds the surface's distance from the corners; the other two,
usual in published methods, put p = 0 at corners next to an empty cell, or at those that are less than half full. Water alone, and saturated
soil, at rest for 0.2 s, ten cells deep, on regular points and on points moved by up to a quarter of their spacing. State: `measures.BOUNDS`. The number
is the error, the rms of that of p at the water's points over rho g h, h the cell, against rho g depth.
"""

from scree.studies import measures
from scree.studies.charts import StabilityMap
from scree.studies.study import Claim, Study, Variant, axis, product

CELL = 0.1
SCENES = {"water": ("prm/water/hydrostatic.prm", "Water/Region", {"Mesh/Upper corner": "0.4, 1.5"}),
          "saturated soil": ("prm/seepage/saturated_rest.prm", "Soil/Region", {"Mesh/Upper corner": "0.4, 1.5", "Time step/Maximum time step": 2e-3})}



def scene(name):
    base, region, entries = SCENES[name]
    return [Variant({"scene": name, "points": points, "surface": part},
                    {**entries, region: f"y < {1 + part * CELL:.6g}", "Water/Jitter": jitter,
                     **({"Soil/Jitter": jitter} if name != "water" else {})}, base)
            for points, jitter in (("regular", 0.), ("jittered", 0.25)) for part in (0., 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875)]


def measure(run):
    surface = 1 + run.labels["surface"] * CELL
    error = measures.hydrostatic_error(run, surface) if run.ended else float("nan")
    # Next to nothing is released: the weight of a layer of one cell, lifted by it, is the measure of energy.
    mass = run.statistics("Water mass (kg)")[0] / surface * CELL
    return {**measures.classify(run, {"oscillation of p": measures.mean_oscillation(run), "error": error}, mass * 9.81 * CELL), "cause": measures.cause(run)}


def verdict(rows):
    regular, jittered = (max(row["error"] for row in rows if row["rule"] == "distance" and row["points"] == points)
                         for points in ("regular", "jittered"))
    others = [row for row in rows if row["rule"] != "distance" and row["ended"]]
    inside = [row for row in others if row["surface"] > 0]
    on_face = [row for row in rows if row["rule"] == "half full" and row["surface"] == 0 and row["points"] == "regular"]
    return [
        Claim(f"With our rule p is right wherever the surface lies: error at most {regular:.1g} rho g h on regular points, {jittered:.2g} on "
              "jittered ones.", regular < 2e-3 and jittered < 0.02),
        Claim("Both other rules put the surface at the top of the last cell that holds water: a surface at a part s of a cell makes an error of "
              f"(1 - s) rho g h (within {max(abs(row['error'] - 1 + row['surface']) for row in inside):.1g}), without oscillation that would tell.",
              all(abs(row["error"] - 1 + row["surface"]) < 0.01 and row["state"] == "wrong" for row in inside)),
        Claim("A surface on a cell's face leaves corners that are exactly half full: the rule 'half full' then finds no surface, and p has no level.",
              bool(on_face) and all(row["cause"] == "no level of p" for row in on_face)),
    ]


STUDY = Study(
    title="Water at rest: place of the surface in its cell", base="prm/water/hydrostatic.prm",
    entries={"Mesh/Cell size": CELL, "End time": 0.2, "Output/Interval": 0.1, "Output/Statistics interval": 0.02, "Output/Graphics": "points"},
    variants=product([variant for name in SCENES for variant in scene(name)],
                     axis("rule", "Water/Pressure/Free surface", ["half full", "empty cell", "distance"])),
    measure=measure, verdict=verdict, needs_end=False, default={"rule": "distance"},
    quick=lambda labels: labels["surface"] in (0., 0.375) and labels["scene"] == "water",
    chart=StabilityMap("surface", "rule", panels=["scene", "points"], number="error", xlabel="surface above a cell's face (cells)", ylabel=""))
