# SPDX-License-Identifier: LGPL-2.1-or-later
"""Times of prm/README.md, the last column of its tables, from the table of the study `advice`.

PYTHONPATH=source/python python3 -m scree.case_times

A case of which the study ran the first part only has "~" and its time in proportion. Runs by hand have "*":
whole ones are in BY_HAND, first parts in PARTS_BY_HAND.
"""

import re

from scree.command import ROOT
from scree.studies import run as studies
from scree.variants import read_entries

PAGE = ROOT / "prm" / "README.md"
ROW = re.compile(r"^(\| `([\w-]+)` \|.*\| )([^|]*)( \|)$", re.MULTILINE)
# Processor time of whole runs, s; with other programs on the machine.
BY_HAND = {"quickstart": 30, "first_slope": 3, "griffiths_lane": 20, "griffiths_lane_water": 38, "phreatic": 6, "vertical_cut": 9, "biaxial": 2,
           "gully_dry": 5400, "mountain_dry": 7, "mountain_saturated": 22, "mountain_outline": 5, "acheron": 31, "entrainment": 3, "debris_flow": 9,
           "slope_jefferies_been": 6, "cut": 40, "graded_slope": 45, "quick_clay": 35, "mud": 32, "steady_dam": 4, "earth_dam": 1,
           "capillary_fringe": 1, "green_ampt": 1, "rain": 17, "wet_cut": 8}
# The same of a first part: processor time, s, and its length, s.
PARTS_BY_HAND = {"slope_loose": (27.8, 3.19), "slope_loose_fine": (53.9, 0.8)}


def rounded(seconds):
    """Two digits above 10 s, whole seconds below, at least 1 s."""
    if seconds < 10:
        return f"{max(1, round(seconds))}"
    return f"{float(f'{seconds:.2g}'):,.0f}".replace(",", " ") if seconds >= 1e4 else f"{float(f'{seconds:.2g}'):.0f}"


def time_of(name, rows):
    """The last cell of a case; None for a case of scree-element."""
    path, = (ROOT / "prm").rglob(f"{name}.prm")
    entries = read_entries(path)
    if "Path" in entries:
        return None
    if name in PARTS_BY_HAND:
        seconds, simulated = PARTS_BY_HAND[name]
        return f"~{rounded(seconds * float(entries['End time']) / simulated)} *"
    if name in BY_HAND or name not in rows:
        return f"{BY_HAND[name]} *" if name in BY_HAND else "-"
    row = rows[name]
    if row["whole"]:
        return rounded(row["core-seconds"])
    return f"~{rounded(row['core-seconds'] * float(entries['End time']) / row['simulated'])}"


def filled(text):
    """The page with its times made again."""
    rows = {row["case"]: row for row in studies.read_table(studies.PAGES / "advice.csv")}

    def cell(match):
        time = time_of(match.group(2), rows)
        return match.group() if time is None else match.group(1) + time + match.group(4)
    return ROW.sub(cell, text)


def main():
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
