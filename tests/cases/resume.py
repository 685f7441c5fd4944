# SPDX-License-Identifier: LGPL-2.1-or-later
"""resume.py SCREE LAUNCHER changes: what --resume says of a short case that is no longer that of the checkpoint (case_tools.py)."""

import os
import pathlib
import shutil
import subprocess

from scree.variants import set_entries

from case_tools import SCREE, check, log_of

OF_RUN = "the run that wrote results/checkpoint/step-"
# Entries behind a case, which win over what stands above; what the error must have.
REFUSED = {"column_short": (
    ({"Mesh/Upper corner": "4, 1.5"}, f'subsection Mesh, entry "Upper corner" = 4, 1.5: {OF_RUN}'),
    ({"Mesh/Cell size": 0.05}, " had 0.1, and --resume cannot change that."),
    ({"Mesh/Basis": "linear"}, 'entry "Basis" = linear'),
    ({"Gravity": "0, -1.62"}, 'entry "Gravity" = 0, -1.62'),
    ({"Dimension": 3, "Gravity": "0, 0, -9.81", "Mesh/Upper corner": "3, 1, 1.5", "Mesh/Lower corner": "0, 0, 0"}, 'entry "Dimension" = 3'),
    ({"Bodies": "Soil, Clay", "Clay/Region": "x > 2 && y < 1"}, 'entry "Bodies" = Soil, Clay'),
    ({"Soil/Region": "x < 2 && y < 1"}, 'subsection Soil, entry "Region" = x < 2 && y < 1'),
    ({"Soil/Material": "linear elastic"}, 'subsection Soil, entry "Material" = linear elastic'),
    ({"Boundaries/Bottom": "free slip"}, 'subsection Boundaries, entry "Bottom" = free slip'),
    ({"Water/Region": "same"}, f"subsection Water: {OF_RUN}"),
    ({"Stabilisation/F-bar": "none"}, 'subsection Stabilisation, entry "F-bar" = none'),
    # TPIC reads no PIC rate.
    ({"Transfer/PIC rate": "auto", "Transfer/Method": "TPIC"}, 'subsection Transfer, entry "Method" = TPIC'),
    ({"Time step/Mass scaling": 2}, 'subsection Time step, entry "Mass scaling" = 2'),
    ({"Transfer/Method": "AFLIP"}, 'subsection Transfer, entry "Method" = AFLIP'),
    ({"End time": 0.004}, 'entry "End time" = 0.004: the checkpoint results/checkpoint/step-')),
    "water_short": (({"Water/Density": 1020}, 'subsection Water, entry "Density" = 1020'),)}
# Entries of runs that go on; what the log tells of them.
GOES_ON = {"column_short": (
    ({}, ""),
    ({"End time": "1.5e-2", "Mesh/Upper corner": "3.0, 15e-1", "Output/Statistics interval": 0.002}, ""),
    ({"Time step/Courant number": 0.3}, 'subsection Time step, entry "Courant number" = 0.3, before auto.'),
    ({"Transfer/PIC rate": 2}, 'subsection Transfer, entry "PIC rate" = 2, before 5.')),
    "water_short": (
        ({"Transfer/Method": "TPIC"}, 'subsection Transfer, entry "Method" = TPIC, before AFLIP.'),
        ({"Water/Pressure/Relative tolerance": "1e-9"}, 'subsection Water/Pressure, entry "Relative tolerance" = 1e-9, before 1e-12.'))}


def run(case, entries, *options):
    """Exit code and error of a short case with these entries behind it."""
    parts = [f"include {os.environ['SHORT_CASES']}/{case}.prm", *(set_entries("", one) for one in ({"End time": 0.01, "Output/Checkpoint interval": 0.005}, entries))]
    pathlib.Path("case.prm").write_text("\n".join(parts) + "\n", encoding="utf-8")
    done = subprocess.run([SCREE, "case.prm", *options], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def changes():
    results, whole = pathlib.Path("results"), pathlib.Path("whole")
    for case in REFUSED:
        shutil.rmtree(results, ignore_errors=True)
        check(run(case, {}) == (0, ""), f"{case} stops")
        shutil.rmtree(whole, ignore_errors=True)
        results.rename(whole)
        for entries, wanted in REFUSED[case] + GOES_ON[case]:
            shutil.rmtree(results, ignore_errors=True)
            shutil.copytree(whole, results)
            code, error = run(case, entries, "--resume")
            print(f"{entries}: {error}")
            if (entries, wanted) in REFUSED[case]:
                check(code == 1 and wanted in error and error.count("\n") == 1, f"{entries}: exit code {code}, {error}, without {wanted}")
                check((results / "statistics.csv").read_bytes() == (whole / "statistics.csv").read_bytes(), f"{entries}: the statistics have changed")
            else:
                noted = "".join(line for line in log_of(results).splitlines() if "Changed from here on" in line)
                check(code == 0 and noted == (f"Changed from here on: {wanted}" if wanted else ""), f"{entries}: exit code {code}, {error}, noted: {noted}")


changes()
