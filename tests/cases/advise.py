# SPDX-License-Identifier: LGPL-2.1-or-later
"""advise.py SCREE LAUNCHER TEST: what --advise says of cases.

Each test is a function below (case_tools.py).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from scree.variants import read_case, read_entries, set_entries

from case_tools import HERE, LAUNCHER, SCREE, check

# Whole runs with wider cells, of which later steps are told, for three cases; the others end in their first steps.
WHOLE = ("columns/column_saturated_3d", "bed/slit_dam", "benchmarks/elastic_2d")
FIRST_STEPS = ("bed/piston", "clay/quick_clay", "contact/slide_over_slab", "dynamics/shaken_block", "seepage/capillary_fringe",
               "slopes/slope_saturated_dense_single", "slopes/slope_jefferies_been", "slopes/rain", "terrain/mountain_dry", "water/hydrostatic", "quickstart")
# Numbers that are there and above 0.
NUMBERS = (r"^  steps to .* (\S+)$", r"^  run +(\S+)", r"^  memory +(\S+)", r"^  cell size +(\S+)")
# Of other cases: changed entries, options, what is said.
SAID = (("columns/column_saturated", {}, ("--accuracy", "0.1"), ("as now: the error is not known",)),  # fronts of saturated soil have not converged
        ("columns/column_saturated", {"Water/Hydraulic conductivity": 1e-9}, (), ("^  do not refine .*grows with finer cells",)),
        ("slopes/first_slope", {}, ("--accuracy", "0.1"), ("cell size .*H/h = 1[6-9]",)),  # ten per cent of the dry run-out: 1.6 (h/H) = 0.1
        ("columns/mohr_coulomb_collapse", {}, ("--accuracy", "0.1"),
         ("^  measured in such scenes .*10 to 19 % of the displacement of the front", "^  do not refine .*Set Grain diameter")),
        ("terrain/mountain_dry", {}, (), (r"cell size .* m, H/h = 3\.[0-9]* \(now 10 m: the error is not known\)",)),  # on a bed the thickness counts
        ("slopes/first_slope", {"Soil/Grain density": "2.0"}, ("--ranks", "64"),
         (r'^Unusual value: .*entry "Grain density" = 2.0: usual are 900 to 8000 kg/m\^3', "^  on 64 ranks, if shared out evenly ")))


def advice(text, *options, ranks=1, folder="prm"):
    """What is said of the text of a case in a folder."""
    case = pathlib.Path(folder, "case.prm")
    case.parent.mkdir(parents=True, exist_ok=True)
    case.write_text(text, encoding="utf-8")
    launcher = [*LAUNCHER, str(ranks)] if ranks > 1 else []
    return subprocess.run([*launcher, SCREE, "--advise", case, *options], capture_output=True, text=True, check=True).stdout


def kinds():
    """Cases of all kinds of prm/ get an advice with all its parts, and nothing is left behind; two ranks count the same points. The study "advice" asks
    for that of all other cases."""
    shutil.rmtree("prm", ignore_errors=True)
    shutil.copytree(HERE.parents[1] / "prm", "prm", ignore=shutil.ignore_patterns("element"))
    os.environ["TMPDIR"] = str(pathlib.Path("temporary").resolve())
    pathlib.Path("temporary").mkdir(exist_ok=True)
    for name in (*WHOLE, *FIRST_STEPS):
        case = pathlib.Path("prm", f"{name}.prm")
        text = advice(set_entries(read_case(case), {} if name in WHOLE else {"End time": 0.02}), folder=case.parent)
        for part in ("Scales", "Size", "Estimated cost of this case", "Recommendation for a relative error of 0.05"):
            check(re.search(f"^{part}", text, re.MULTILINE), f"{name}: no part {part}: {text}")
        for pattern in NUMBERS:
            check(float(re.search(pattern, text, re.MULTILINE)[1]) > 0, f"{name}: {pattern}: {text}")
        check(name not in WHOLE or re.search("^  later: the case was run with cells  *[2-9]", text, re.MULTILINE), f"{name}: later steps are not known: {text}")
        entries = read_entries(case)
        laws = {value for entry, value in entries.items() if entry.endswith("/Material")}
        # Rigid bodies only are no soil whose drainage could matter.
        wanted = any(entry.startswith("Water/") for entry in entries) and entries.get("Bodies") != "none" and laws != {"rigid"}
        check(("\nSoil and water" in text) == wanted, f"{name}: a part of soil and water: {text}")
    for name, entries, options, wanted in SAID:
        text = advice(set_entries(read_case(f"prm/{name}.prm"), entries), *options, folder=pathlib.Path("prm", name).parent)
        for pattern in wanted:
            check(re.search(pattern, text, re.MULTILINE), f"{name}: no {pattern} in {text}")
    texts = [advice(set_entries(read_case("prm/columns/column_saturated.prm"), {"End time": 0.02}), "--accuracy", "0.1", ranks=ranks) for ranks in (1, 2)]
    counts = [re.findall(r"^  (?:soil points|water points|cells of|cell size).*", text, re.MULTILINE) for text in texts]
    check(counts[0] == counts[1] and len(counts[0]) >= 4, f"one rank: {counts[0]}, two: {counts[1]}")
    steps = [float(re.search(NUMBERS[0], text, re.MULTILINE)[1]) for text in texts]
    check(abs(steps[0] / steps[1] - 1) < 0.02, f"steps: {steps}")
    check(not pathlib.Path("results").exists() and not list(pathlib.Path("temporary").iterdir()), "something is left behind")


def block():
    """What --advise counts and weighs of a block of 1 m, against hand calculation: c^2 = M/rho, M = E (1 - nu)/((1 + nu)(1 - 2 nu)) of elastic soil, K = P/kappa
    and G of Nor-Sand."""
    soil = {"Gravity": "0, -10", "Output directory": "results", "Mesh/Upper corner": "2, 2", "Soil/Region": "x < 1 && y < 1", "Soil/Points per cell": 2,
             "Soil/Grain density": 2500, "Soil/Initial porosity": 0.4, "Output/Graphics": "none"}
    space = {"Dimension": 3, "Gravity": "0, 0, -10", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2, 2, 2", "Soil/Region": "x < 1 && y < 1 && z < 1"}
    elastic = {"Soil/Material": "linear elastic", "Soil/Linear elastic/Young's modulus": 1e6, "Soil/Linear elastic/Poisson's ratio": 0.2}
    sand = {"Soil/Initial state/Type": "isotropic", "Soil/Initial state/Pressure": 1e4}
    water = {"Transfer/Method": "TPIC", "Water/Region": "x < 1 && y < 1 && z < 1.5", "Water/Points per cell": 2}
    for entries, wanted in (({**elastic, "Soil/Initial velocity": "0.03*x; 0"}, "1 m; 1500 kg/m^3; 1.11e+06 Pa; 27.2 and 27.2 m/s; 0.0135; 0.036; 0.116; 400; 100; 400; 0; 0; 0; 0"),
                            ({**elastic, "Transfer/Method": "TPIC", "Water/Point sets": "single"}, "1 m; 1900 kg/m^3; 1.11e+06 Pa; 27.2 and 27.2 m/s; 0.0171; 0.0456; 0.116; 400; 100; 400 (they carry the water); double: water leaves its soil; single-point water would not be conserved; 0.113 m^2/s; 27.9; 0.000201 s"),
                            ({**space, **sand, **water}, "1 m; 1900 kg/m^3; 1.03e+07 Pa; 83 and 83 m/s; 0.00184; 0.00475; 0.0381; 8000; 1500; 8000; 12000; 1.05 m^2/s; 3; 0.000201 s")):
        found = dict(re.findall(r"^  (\S.*?) {2,}(\S.*)$", advice(set_entries("", {**soil, **entries})), re.MULTILINE)[::-1])
        names = ("height H", "density rho", "modulus M = K + 4/3 G at the start, mean", "wave speed, mean and largest", "strain by own weight rho g H/M",
                 "weight over shear modulus rho g H/G", "Mach number of the motion sqrt(g H)/c", "cells of the box; with points", "soil points", "water points",
                 "consolidation coefficient c_v = k M/(rho_w g)", "drainage time over time of motion", "drag relaxation time")
        text = "; ".join(found.get(name, "0") for name in names)
        check(text == wanted, f"{entries}: {text}, not {wanted}")


globals()[sys.argv[3]]()
