# SPDX-License-Identifier: LGPL-2.1-or-later
"""bank_scenes.py SCREE SCENE [FIRST LAST [METHOD]]: random scenes by seeds, with water and of slides on mountains of scree-mountain.

Nothing is tuned to them. The tests run a few; more by hand, as in bank_scenes.py build/scree water_bank 100 140 FLIP, and by scree-terrain-bank.
"""

import math
import random
import sys

from scree import terrain_bank

from scene_tools import NO_STRESS, check, largest_gain, main, mean_oscillation, run

METHODS = ("TPIC", "AFLIP")


def scene_of(seed):
    """A random scene: its words, case, entries and whether its soil is elastic."""
    rng = random.Random(seed)
    kind = rng.choice(("water falls on a floor", "dam break", "block falls on a floor", "block falls on an oblique bed", "column on a floor",
                       "column on an oblique bed", "water falls on a block", "infiltration", "block falls into water"))
    cell, points = rng.choice((0.05, 0.1)), rng.choice((2, 3, 4))
    gap, speed = rng.uniform(0., 0.4), rng.uniform(0., 2.)
    is_elastic = rng.random() < 0.4
    has_soil = kind not in ("water falls on a floor", "dam break")
    lower, upper = "y < 0.4", "y > %.4f && y < %.4f" % (0.4 + gap, 0.8 + gap)
    falling = "0; if(y > %.4f, %.4f, 0)" % (0.4 + gap / 2, -speed)
    regions = {"water falls on a floor": ("", "y > %.4f && y < %.4f" % (gap, 0.4 + gap)), "dam break": ("", "x < 0.5 && y < 0.8"),
               "block falls on a floor": ("x > 0.3 && x < 0.8 && y > %.4f && y < %.4f" % (gap, 0.4 + gap), "same"),
               "column on a floor": ("x < 0.5 && y < 0.7", "same"), "water falls on a block": (lower, lower + " || (" + upper + ")"),
               "infiltration": (lower, "y > 0.4 && y < 0.8"), "block falls into water": (upper, lower + " || (" + upper + ")")}
    tilt = rng.uniform(0.1, 0.6)
    level = "y - 0.13 - %.4f*x" % tilt
    regions["block falls on an oblique bed"] = ("x > 0.5 && x < 1 && %s > %.4f && %s < %.4f" % (level, gap, level, gap + 0.4), "same")
    regions["column on an oblique bed"] = ("x > 0.7 && x < 1.2 && %s > 0 && %s < 0.5" % (level, level), "same")
    soil, water = regions[kind]
    falls = kind.startswith("block falls on") or kind == "water falls on a floor"
    velocity = "0; %.4f" % -speed if falls else falling if kind in ("water falls on a block", "block falls into water") else ""
    young = 10 ** rng.uniform(5, 7.5)
    entries = {
        "Mesh/Upper corner": "1.5, 1.6", "Mesh/Cell size": "%g" % cell, "End time": "0.5", "Output/Statistics interval": "0.005",
        "Time step/Maximum time step": "auto", "Time step/Courant number": "%.2f" % rng.uniform(0.2, 0.7),
        "Water/Region": water, "Water/Points per cell": "%d" % points,
        "Water/Initial pressure": "none", "Water/Initial velocity": velocity}
    if has_soil:
        conductivity = 10 ** rng.uniform(-5, -1)
        entries.update({"Soil/Region": soil, "Soil/Points per cell": "%d" % points,
                        **NO_STRESS, "Soil/Initial velocity": velocity, "Water/Hydraulic conductivity": "%.3g" % conductivity})
        if is_elastic:
            entries.update({"Soil/Material": "linear elastic", "Soil/Linear elastic/Young's modulus": "%.3g" % young,
                            "Soil/Linear elastic/Poisson's ratio": "0.3"})
        else:
            entries.update({"Soil/Mohr-Coulomb/Young's modulus": "%.3g" % young,
                            "Soil/Mohr-Coulomb/Friction angle": "%.1f" % rng.uniform(25, 42)})
    if kind == "infiltration":
        entries.update({"Boundaries/Water/Bottom": "impermeable"})
    if kind.endswith("bed"):
        entries.update({"Boundaries/Bottom": "open", "Bed/Level set expression": level, "Bed/Type": rng.choice(("free slip", "friction"))})
        if entries["Bed/Type"] == "friction":
            entries["Bed/Friction angle"] = "25"
    return kind, "columns/column_saturated" if has_soil else "water/dam_break", entries, has_soil and is_elastic


def water_bank(scree):
    """Without elastic soil no scene gains .05 % of what it releases in any time step, with elastic soil .5 % (explicit stress)."""
    first, last = (int(number) for number in (sys.argv[3:5] or ("0", "5")))
    for seed in range(first, last):
        kind, case, entries, is_elastic = scene_of(seed)
        for method in sys.argv[5:6] or METHODS:
            run(scree, case, "bank", {**entries, "Transfer/Method": method})
            check("%d, %s, %s%s: largest energy gain" % (seed, method, kind, ", elastic" if is_elastic else ""), largest_gain("bank"), 0,
                  0.005 if is_elastic else 5e-4)


def layered_slope(seed):
    """The entries of a slope 6 m high of two to four layers, that may slide when its strength is divided."""
    rng = random.Random(seed)
    run_of_slope = 1 / math.tan(math.radians(rng.uniform(25, 45)))
    n_layers = rng.randint(2, 4)
    heights = sorted(rng.uniform(1, 8) for _ in range(n_layers - 1))
    faces = [f"{height:.3f} + {math.tan(math.radians(rng.uniform(-8, 8))):.4f}*x" for height in heights]
    bodies, is_wet = ["Soil", "Second", "Third", "Fourth"][:n_layers], rng.random() < 0.6
    entries = {"Bodies": ", ".join(bodies), "End time": "0.02", "Mesh/Upper corner": f"{round(2 * (22 + 6 * run_of_slope)) / 2}, 10",
               "Mesh/Cell size": "0.5", "Boundaries/Bottom": "fixed", "Settling/Maximum time": "10", "Stage Weak/Duration": "2.5",
               "Stage Weak/Settling/Maximum time": "0"}
    for i, body in enumerate(bodies):
        region = [f"y < if(x < 10, 9, max(3, 9 - (x - 10)/{run_of_slope:.3f}))", *(f"y >= {face}" for face in faces[max(i - 1, 0):i]),
                  *(f"y < {face}" for face in faces[i:])]
        modulus, friction, cohesion = 10 ** rng.uniform(6.7, 8.3), rng.uniform(18, 40), 10 ** rng.uniform(3.3, 4.6)
        law = {"Young's modulus": f"{modulus:.3e}", "Poisson's ratio": "0.3", "Friction angle": f"{friction:.1f}", "Cohesion": f"{cohesion:.0f}",
               "Tension cut-off": f"{min(cohesion, 0.9 * cohesion / math.tan(math.radians(friction))):.0f}", "Dilation angle": rng.choice(("0", "0", "5"))}
        entries |= {f"{body}/Region": " && ".join(region), f"{body}/Points per cell": "3", f"{body}/Material": "Mohr-Coulomb",
                    f"{body}/Initial porosity": "0.4", f"{body}/Initial state/Type": "K0", f"{body}/Initial state/K0": "auto"}
        entries |= {f"{body}/Mohr-Coulomb/{entry}": value for entry, value in law.items()}
    if is_wet:
        entries |= {"Water/Phreatic surface": f"{rng.uniform(3.5, 6):.2f}", "Water/Points per cell": "3",
                    "Water/Hydraulic conductivity": f"{10 ** rng.uniform(-5, -2):.1e}"}
    return entries | {"Stage Weak/Safety/Strength factor": rng.choice(("1", "1.5", "2", "2.5"))}


def layer_bank(scree):
    """The stress of slopes of several layers does not oscillate, also where strong soil slides over weak soil; .1 % is asked of the energy."""
    first, last = (int(number) for number in (sys.argv[3:5] or ("10", "12")))
    for seed in range(first, last):
        table = run(scree, "slopes/first_slope", "slope", layered_slope(seed))
        check("%d: oscillation of p'" % seed, mean_oscillation(table), 0, 0.12)
        check("%d: largest energy gain" % seed, largest_gain("slope"), 0, 5e-3, asked=1e-3)


def terrain_bank_short(scree):
    """No point is thrown, lost or pressed into the ground; the soil weighs what its map says; no energy from nothing. These three mountains
    meet the bound of depth at 15 s; others do not (doc/verification/bed_and_contact.md, "Terrain")."""
    for seed, options, methods in ((1, {}, ("FLIP", "AFLIP", "TPIC")), (2, {}, ("AFLIP",)), (3, {"rim": "cut"}, ("AFLIP",))):
        for method in methods:
            numbers = terrain_bank.run_case(scree, "%d_%s" % (seed, method), seed, options, 20., {"End time": "15", "Transfer/Method": method})
            for key, bound in terrain_bank.BOUNDS.items():
                missed = {"asked": bound} if key == "energy" and method != "FLIP" else {}  # each time step: up to 8.6e-4
                check("mountain %d, %s: %s" % (seed, method, key), numbers[key], 0, 1e-3 if missed else bound, **missed)


if __name__ == "__main__":
    main(globals())
