# SPDX-License-Identifier: LGPL-2.1-or-later
"""The memory that a run announces is within 30 % of the largest that it takes: dry and wet, plane and in space, with fine cells that follow
a slide, with and without pictures; further cases by hand."""

import pathlib
import re
import subprocess
import sys

from case_tools import HERE, SCREE, check, log_of
from scree.variants import write_variant

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


globals()[sys.argv[3]]()
