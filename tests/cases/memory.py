# SPDX-License-Identifier: LGPL-2.1-or-later
"""The memory that a run announces is within 30 % of the largest that it takes: dry and wet, plane and in space, with fine cells that follow
a slide, with and without pictures; further cases by hand."""

import pathlib
import re
import resource
import subprocess
import sys

from case_tools import HERE, SCREE, check, log_of
from scree.variants import set_entries, write_variant

CASES = (("slopes/first_slope", 0.1), ("columns/column_saturated_3d", 0.03), ("slopes/slope_saturated_dense", 0.03))
FURTHER_CASES = (("columns/column_3d", 0.3), ("water/dam_break", 0.3), ("benchmarks/elastic_2d", 0.05), ("columns/column_dense", 0.2), ("consolidation/terzaghi", 0.5), ("terrain/mountain_dry", 15), ("terrain/mountain_saturated", 10),
                 ("clay/mud", 0.2))


def estimate(cases=CASES):
    outside = []
    for case, end in cases:
        name = case.split("/")[1]
        pictures = {} if "benchmarks" in case else {"Output/Interval": str(end / 4)}
        write_variant(HERE.parents[1] / "prm" / (case + ".prm"), name + ".prm", {"Output directory": name, "End time": str(end), **pictures})
        subprocess.run([SCREE, name + ".prm"], check=True, stdout=subprocess.DEVNULL)
        log = log_of(pathlib.Path(name))
        announced, taken = (float(re.search(pattern, log)[1]) for pattern in (r"Memory +(\d+) MB", r"Largest memory: (\d+) MB"))
        print(f"{name}: {announced:.0f} MB announced, {taken:.0f} MB taken, ratio {announced / taken:.2f}")
        if not 1 / 1.3 <= announced / taken <= 1.3:
            outside.append(name)
    check(not outside, "beyond 30 %: " + ", ".join(outside))


def further_estimates():
    estimate(FURTHER_CASES)


def refused():
    """A run that needs more than the machine or a limit (ulimit -v) has ends at once, and so does an expression that has no value later."""
    load = {"Surface load/Lower corner": "0, 0.5", "Surface load/Upper corner": "1, 0.5", "Surface load/Traction": "0; -1/(t < 1e-3)"}
    points = 'case.prm, line \\d+: subsection Soil, entry "Points per cell" = %d: the run would need about \\S+ GB'
    for limit, entries, wanted in (
            (None, {"Soil/Points per cell": 32, "Mesh/Upper corner": "10, 10", "Mesh/Cell size": 1e-3}, points % 32),
            (int(0.9e9), {"Soil/Points per cell": 3, "Mesh/Upper corner": "1, 1", "Mesh/Cell size": 4e-3, "End time": 1e-9}, points % 3),
            (None, {"Mesh/Cell size": 4e-3, "End time": 1e-9}, ""),
            (None, {"Body force": "0; sqrt(-1 - x)"}, r'stopped: case.prm, line \d+: entry "Body force" = 0; sqrt\(-1 - x\): it is not a number at .* m, t = 0 s\. Write'),
            (None, load, r'stopped: case.prm, line \d+: subsection Surface load, entry "Traction" = .*: it is infinite at .* m, t = 0\.001\d* s\. Write')):
        pathlib.Path("case.prm").write_text(set_entries("", {"End time": 2e-3, "Output directory": "run", "Output/Graphics": "none", "Soil/Region": "y < 0.5", **entries}),
                                            encoding="utf-8")
        limits = {"preexec_fn": lambda most=limit: resource.setrlimit(resource.RLIMIT_AS, (most, most))} if limit else {}
        done = subprocess.run([SCREE, "case.prm"], capture_output=True, text=True, check=False, **limits)
        check(done.returncode == (1 if wanted else 0) and re.search(f"^scree: {wanted}" if wanted else "^$", done.stderr.strip()) and done.stderr.count("\n") <= 1,
              f"{entries}, limit {limit}: {done.stderr}")


globals()[sys.argv[3]]()
