# SPDX-License-Identifier: LGPL-2.1-or-later
"""refusals.py SCREE: faults that show in a step or depend on the machine, and questions in the log.

Each case must end at once with exit code 1 and one error that reads as wanted, or write what is wanted into its log.
"""

import pathlib
import re
import resource
import subprocess
import sys

from scree.variants import set_entries

SOIL = {"Soil/Region": "y < 0.5"}
COULOMB = {**SOIL, "Soil/Material": "Mohr-Coulomb"}
SHORT = {"End time": 2e-3, "Output directory": "run", "Output/Graphics": "none"}
INSTANT = {**SHORT, "End time": 1e-9}
LOAD = {"Surface load/Lower corner": "0, 0.5", "Surface load/Upper corner": "1, 0.5"}

# case, what the error must be
REFUSED = {
    "body force, not a number at the first step": (
        {**SHORT, **SOIL, "Body force": "0; sqrt(-1 - x)"},
        r'^scree: stopped: case.prm, line 10: entry "Body force" = 0; sqrt\(-1 - x\): it is not a number at .* m, t = 0 s\. Write'),
    "traction, infinite later": (
        {**SHORT, **SOIL, **LOAD, "Surface load/Traction": "0; -1/(t < 1e-3)"},
        r'^scree: stopped: case.prm, line 13: subsection Surface load, entry "Traction" = .*: it is infinite at .* m, t = 0\.001\d* s\. Write'),
    "more points than any memory holds": (
        {**SHORT, **SOIL, "Soil/Points per cell": 32, "Mesh/Upper corner": "10, 10", "Mesh/Cell size": 1e-3},
        r'^scree: case.prm, line 9: subsection Soil, entry "Points per cell" = 32: the run would need about \S+ GB'),
}

# what a case that needs .6 GB ends with under a limit of so many bytes (ulimit -v); none: it runs
MEMORY = ({**INSTANT, **SOIL, "Mesh/Cell size": 4e-3},
          {int(0.9e9): r'^scree: case.prm: subsection Soil, entry "Points per cell" = 3: the run would need about \S+ GB', None: ""})

# case, the questions in the log
QUESTIONED = {
    "usual values": ({**INSTANT, **SOIL}, []),
    "cells wider than half of the length": (
        {**INSTANT, **COULOMB, "Soil/Mohr-Coulomb/Softening strain": 0.1, "Soil/Mohr-Coulomb/Residual friction angle": 20, "Soil/Mohr-Coulomb/Nonlocal length": 0.15},
        ['entry "Nonlocal length" = 0.15: shear bands depend on cells wider than half of it, here 0.1 m. Use cells of at most 0.075 m.']),
    "cohesion without tension in water": (
        {**INSTANT, **COULOMB, "Soil/Initial porosity": 0.4, "Soil/Mohr-Coulomb/Cohesion": 2e3, "Soil/Mohr-Coulomb/Tension cut-off": 0, "Water/Phreatic surface": 0.5},
        ['entry "Tension cut-off" = 0: with cohesion, here 2000 Pa, soil in water opens as soon as it shears']),
    "entries of a law that is not chosen": (
        {**INSTANT, **COULOMB, "Soil/Tresca/Undrained strength": "2e4"},
        ['subsection Soil/Tresca, entry "Undrained strength" = 2e4: this entry has no effect, as "Material" is Mohr-Coulomb. Write "Material = Tresca", or']),
    "a base with the angle of its soil": (
        {**INSTANT, **COULOMB, "Boundaries/Bottom": "friction 30"},
        ['Base stronger than the soil: subsection Boundaries, entry "Bottom" = 30 degrees: Soil shears on a plane at 26.565']),
    "a base below cohesive soil": ({**INSTANT, **COULOMB, "Boundaries/Bottom": "friction 40", "Soil/Mohr-Coulomb/Cohesion": 1e3}, []),
    "a base with the angle of repose of its soil": (
        {**INSTANT, **COULOMB, "Boundaries/Bottom": "friction 30", "Soil/Mohr-Coulomb/Friction angle kind": "direct shear or repose"}, []),
    "rain in mm/h, a water table above all soil": (
        {**INSTANT, **SOIL, "Rain/Rate": 50, "Water/Phreatic surface": 0.95},
        ['subsection Rain, entry "Rate" = 50: usual are 1e-10 to 0.1 m/s (1 m/d = 1.16e-5 m/s, 1 mm/h = 2.78e-7 m/s). Look at the unit.',
         'subsection Water, entry "Phreatic surface" = 0.95: all soil lies more than a cell below it']),
    "a water table at the ground": ({**INSTANT, **SOIL, "Water/Phreatic surface": 0.55}, []),
    "water above the ground": ({**INSTANT, **SOIL, "Water/Phreatic surface": 0.8, "Water/Reservoir level": 0.8}, []),
    "a conductivity in m/d, and mPa s": (
        {**INSTANT, **SOIL, "Transfer/Method": "TPIC", "Water/Hydraulic conductivity": 86, "Water/Density": 1},
        ['entry "Density" = 1: usual are 500 to 2000 kg/m^3', 'entry "Hydraulic conductivity" = 86: usual are 1e-13 to 1 m/s']),
    "radians, kPa, g/cm^3": (
        {**INSTANT, **COULOMB, "Soil/Grain density": 2.65, "Soil/Mohr-Coulomb/Friction angle": 0.55, "Soil/Mohr-Coulomb/Cohesion": 0.005,
         "Boundaries/Bottom": "friction 0.35"},
        ['subsection Soil, entry "Grain density" = 2.65: usual are 900 to 8000 kg/m^3 (1 g/cm^3 = 1e3 kg/m^3',
         'subsection Soil/Mohr-Coulomb, entry "Friction angle" = 0.55: usual are 1.6 to 70 degrees (1 rad = 57.3 degrees)',
         'subsection Soil/Mohr-Coulomb, entry "Cohesion" = 0.005: usual are',
         'subsection Boundaries, entry "Bottom" = friction 0.35: usual are 1.6 to 70 degrees']),
    "kPa of clay that grows with depth, and of a load": (
        {**INSTANT, **SOIL, "Soil/Material": "Tresca", "Soil/Tresca/Undrained strength": "20 + 4*(0.5 - y)", "Surface load/Lower corner": "0, 0.5",
         "Surface load/Upper corner": "1, 0.5", "Surface load/Traction": "0; -min(1, t)*2"},
        ['subsection Soil/Tresca, entry "Undrained strength" = 20 + 4*(0.5 - y): usual are', 'subsection Surface load, entry "Traction" = 0; -min(1, t)*2: usual']),
    "a law that is not chosen is not asked": ({**INSTANT, **COULOMB, "Soil/Linear elastic/Young's modulus": 20}, ["this entry has no effect"]),
    "soil and water that the top cuts off": (
        {**INSTANT, **SOIL, "Soil/Region": "x < 0.5 && y < 1.3", "Water/Region": "x > 0.5 && y < 1.5"},
        ['entry "Region" = x < 0.5 && y < 1.3: the box cuts it off. 0.150391 m^3/m lie beyond the face Top of the box, and 0.5 m^3/m in it are filled.',
         'subsection Water, entry "Region" = x > 0.5 && y < 1.5: the box cuts it off. 0.25 m^3/m lie beyond the face Top']),
    "a layer that ends beyond a closed wall": (
        {**INSTANT, **SOIL, "Soil/Region": "y < 0.5 && x < 1.5"}, ['0.25 m^3/m lie beyond the face Right of the box, and 0.5 m^3/m in it are filled.']),
    "half spaces, and soil up to the top": ({**INSTANT, **SOIL, "Soil/Region": "x < 0.5 || y < 0.3 + 0.1*sin(20*x)"}, []),
    "a reservoir above the box": ({**INSTANT, **SOIL, "Water/Phreatic surface": 0.5, "Water/Reservoir level": 1.4},
                                  ['subsection Water, entry "Reservoir level" = 1.4: the box cuts it off. 0.398438 m^3/m lie beyond the face Top']),
    "a reservoir beside dry soil": ({**INSTANT, **SOIL, "Soil/Region": "x < 0.5 && y < 0.7", "Water/Phreatic surface": 0.2, "Water/Reservoir level": 0.6},
                                    ['entry "Reservoir level" = 0.6: it stands above "Phreatic surface" = 0.2, beside soil with dry pores, for instance at 0.']),
    "a reservoir at the level of the water table": ({**INSTANT, **SOIL, "Soil/Region": "x < 0.5 && y < 0.7", "Water/Phreatic surface": 0.6,
                                                     "Water/Reservoir level": 0.6}, []),
}

TERRAIN = {**INSTANT, "Dimension": 3, "Gravity": "0, 0, -9.81", "Bed/Type": "fixed", "Bed/Raster": "heights.asc",
           "Soil/Region": "x < 10 && y < 10 && z < 1510", "Soil/Points per cell": 2}
BOX = {**TERRAIN, "Mesh/Lower corner": "0, 0, 1490", "Mesh/Upper corner": "40, 40, 1530", "Mesh/Cell size": 5}


def heights(middle="1500"):
    """A plain raster of 5 x 5 heights, 10 m apart, with another one in its middle."""
    rows = [["1500"] * 5 for _ in range(5)]
    rows[2][2] = middle
    return "ncols 5\nnrows 5\nxllcenter 0\nyllcenter 0\ncellsize 10\nNODATA_value -9999\n" + "\n".join(map(" ".join, rows)) + "\n"


RANGE = r"^Bed: heights of the raster from %s m in row \d, column \d \(x = \d+, y = \d+\) to %s m in row \d, column \d \(x = \d+, y = \d+\)$"
STEPS = (r"^Unusual value: Bed: 4 steps between neighbouring heights of the raster are steeper than 80 degrees; the largest is from 1500 m in row \d, "
         r"column \d \(x = \d+, y = \d+\) to %s m in row 3, column 3 \(x = 20, y = 20\)\.$")
STRANGE = (r"^Unusual value: Bed: 1 heights of the raster lie outside -500 to 9000 m, the first is %s m in row 3, column 3 \(x = 20, y = 20\)\. "
           r"If they stand for missing ones, write that value as NODATA_value\.$")
# case, file heights.asc, lines that the log must have, how many questions
LOGGED = {
    "heights as they should be": (BOX, heights(), [RANGE % (1500, 1500)], 0),
    "a missing height": (BOX, heights("-9999"), [r"^Bed: 1 of 25 heights of the raster are missing \(NODATA\)\. There is no ground around them: .*gdal_fillnodata\.$"], 0),
    "0 in the middle": (BOX, heights("0"), [RANGE % (0, 1500), STEPS % 0], 1),
    "another mark of missing heights": (BOX, heights("-32768"), [RANGE % (-32768, 1500), STRANGE % -32768, STEPS % -32768], 2),
    "99999": (BOX, heights("99999"), [RANGE % (1500, 99999), STRANGE % 99999, STEPS % 99999], 2),
    "the raster's box": (
        {**TERRAIN, "Mesh/Cell size": 6}, heights("1507"),
        [r"^Box from the raster, in whole cells: from 0, 0, 1488 to 36, 36, 1596 m; the raster reaches from 0, 0 to 40, 40 m, its heights from 1500 to 1507 m$"], 0),
    "no porosity and no stress": (
        {**INSTANT, **COULOMB}, "",
        [r'^Soil at the start: 0\.5 m\^3/m, 1\d+ kg/m; 2\d+ kg/m\^3 dry: grains of 2\d+ kg/m\^3, porosity 0 \(no "Initial porosity" is set, and "Material = '
         r'Mohr-Coulomb" has none of its own\); no stress \("Type = none" in subsection Initial state\)$',
         r"^Soil at the end, at its density of the start: in the box 0\.5 m\^3/m, 1\d+ kg/m; lost through open walls 0 m\^3/m, 0 kg/m \(0 points\)$"], 0),
    "soil that leaves the box": (
        {**SHORT, **SOIL, "Soil/Initial porosity": 0.5, "Soil/Grain density": 2000, "Soil/Initial velocity": "20; 0", "Soil/Initial state/Type": "K0",
         "Boundaries/Right": "open"}, "",
        [r"^Soil at the start: 0\.5 m\^3/m, 500 kg/m; 1000 kg/m\^3 dry: grains of 2000 kg/m\^3, porosity 0\.5; stress by weight, K0 = 0\.68",
         r"^Soil at the end, .*: in the box 0\.4\d* m\^3/m, 4\d\d\S* kg/m; lost through open walls 0\.0\d+ m\^3/m, [1-9]\S* kg/m \([1-9]\d* points\)$"], 0),
    "settling": ({**SHORT, **SOIL, "Settling/Maximum time": 0.01, "Settling/Unbalanced force": 0.01}, "",
                 [r"^Settled for \d\.\d{1,7} s in \d+ steps; unbalanced force over weight \S{1,12}"], 0),
}


def run(scree, case, limit=None):
    """Exit code and error of a case."""
    pathlib.Path("case.prm").write_text(set_entries("", case), encoding="utf-8")

    def set_limit():
        if limit:
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

    done = subprocess.run([scree, "case.prm"], capture_output=True, text=True, timeout=120, check=False, preexec_fn=set_limit)
    return done.returncode, done.stderr.strip()


def main():
    scree = sys.argv[1]
    faults = []

    def require(name, wanted, code, error):
        if code != (1 if wanted else 0) or not re.search(wanted or "^$", error) or "\n" in error:
            faults.append(f"{name}: exit code {code}, {error}")

    for name, (case, wanted) in REFUSED.items():
        require(name, wanted, *run(scree, case))
    for limit, wanted in MEMORY[1].items():
        require(f"memory limit {limit}", wanted, *run(scree, MEMORY[0], limit))
    for name, (case, wanted) in QUESTIONED.items():
        code, error = run(scree, case)
        require(name, "", code, error)
        questions = [line for line in pathlib.Path("run/log.txt").read_text(encoding="utf-8").split("\n") if re.search("Unusual value:|Base stronger", line)]
        if len(questions) != len(wanted) or not all(any(text in question for question in questions) for text in wanted):
            faults.append(f"{name}: the log asks {questions}")
    for name, (case, raster, wanted, n_questions) in LOGGED.items():
        pathlib.Path("heights.asc").write_text(raster, encoding="utf-8")
        require(name, "", *run(scree, case))
        log = pathlib.Path("run/log.txt").read_text(encoding="utf-8")
        for line in wanted:
            if not re.search(line, log, re.MULTILINE):
                faults.append(f"{name}: no line {line} in {log}")
        if log.count("Unusual value:") != n_questions:
            faults.append(f"{name}: {log.count('Unusual value:')} questions in {log}")
    print("\n".join(faults) or "all as they should be")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
