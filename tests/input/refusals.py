#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""refusals.py SCREE: faults that show in a step or depend on the machine, and questions in the log.

Each case must end at once with exit code 1 and one error that reads as wanted, or write what is wanted into its log.
"""

import pathlib
import re
import resource
import subprocess
import sys

SOIL = "subsection Soil\n  set Region = y < 0.5\nend\n"
SHORT = "set End time = 2e-3\nset Output directory = run\nsubsection Output\n  set Graphics = none\nend\n"
INSTANT = SHORT.replace("2e-3", "1e-9")
LOAD = "subsection Surface load\n  set Lower corner = 0, 0.5\n  set Upper corner = 1, 0.5\n  set Traction = {}\nend\n"

# case, what the error must be
REFUSED = {
    "body force, not a number at the first step": (
        SHORT + SOIL + "set Body force = 0; sqrt(-1 - x)\n",
        r'^scree: stopped: case.prm, line 9: entry "Body force" = 0; sqrt\(-1 - x\): it is not a number at .* m, t = 0 s\. Write'),
    "traction, infinite later": (
        SHORT + SOIL + LOAD.format("0; -1/(t < 1e-3)"),
        r'^scree: stopped: case.prm, line 12: subsection Surface load, entry "Traction" = .*: it is infinite at .* m, t = 0\.001\d* s\. Write'),
    "more cells than any memory holds": (
        SHORT + SOIL.replace("y < 0.5", "x < 0.1 && y < 0.1") + "subsection Mesh\n  set Upper corner = 3, 3\n  set Cell size = 1e-4\n  set Fine cells = everywhere\nend\n",
        r'^scree: case.prm, line 11: subsection Mesh, entry "Cell size" = 0.0001: the run would need about \S+ GB of memory, '
        r"for 9e\+08 cells and about \S+ points, but only \S+ GB are available"),
    "more points than any memory holds": (
        SHORT + "subsection Soil\n  set Region = y < 0.5\n  set Points per cell = 32\nend\n"
        "subsection Mesh\n  set Upper corner = 10, 10\n  set Cell size = 1e-3\nend\n",
        r'^scree: case.prm, line 8: subsection Soil, entry "Points per cell" = 32: the run would need about \S+ GB'),
}

# what a case that needs .6 GB ends with under a limit of so many bytes (ulimit -v); none: it runs
MEMORY = (INSTANT + SOIL + "subsection Mesh\n  set Cell size = 4e-3\nend\n",
          {int(0.9e9): r'^scree: case.prm: subsection Soil, entry "Points per cell" = 4: the run would need about \S+ GB', None: ""})

# case, the questions in the log
QUESTIONED = {
    "usual values": (INSTANT + SOIL, []),
    "an angle in radians, a modulus in MPa, a density in g/cm^3": (
        INSTANT + "subsection Soil\n  set Region = y < 0.5\n  set Material = Mohr-Coulomb\n  set Grain density = 2.65\n"
        "  subsection Mohr-Coulomb\n    set Young's modulus = 20\n    set Friction angle = 0.52\n  end\nend\n",
        ['entry "Grain density" = 2.65: the unit is kg/m^3', 'entry "Young\'s modulus" = 20: the unit is Pa',
         'entry "Friction angle" = 0.52: the unit is degrees']),
    "an angle for M": (
        INSTANT + "subsection Soil\n  set Region = y < 0.5\n  subsection Nor-Sand\n    set Critical stress ratio M = 24\n  end\nend\n",
        ['entry "Critical stress ratio M" = 24: the unit is none']),
    "a conductivity in m/d, and mPa s": (
        INSTANT + SOIL + "subsection Transfer\n  set Method = TPIC\nend\n"
        "subsection Water\n  set Hydraulic conductivity = 86\n  set Density = 1\nend\n",
        ['entry "Density" = 1: the unit is kg/m^3', 'entry "Hydraulic conductivity" = 86: the unit is m/s']),
}


def run(scree, case, limit=None):
    """Exit code and error of a case."""
    pathlib.Path("case.prm").write_text(case, encoding="utf-8")

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
        questions = [line for line in pathlib.Path("run/log.txt").read_text(encoding="utf-8").split("\n") if "Is this meant?" in line]
        if len(questions) != len(wanted) or not all(any(text in question for question in questions) for text in wanted):
            faults.append(f"{name}: the log asks {questions}")
    print("\n".join(faults) or "all as they should be")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
