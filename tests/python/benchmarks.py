# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of benchmarks has the tables of its CSV, whose deviations follow from its numbers; scenes and cases that it names exist."""

import re
import sys

from scree import benchmarks
from scree.command import ROOT


def faults(rows, page):
    if benchmarks.filled(page, rows) != page:
        yield "doc/verification/benchmarks.md is not current. Run PYTHONPATH=source/python python3 -m scree.benchmarks."
    scenes = (ROOT / "tests" / "scenes" / "CMakeLists.txt").read_text(encoding="utf-8")
    for row in rows:
        reference, computed, deviation = (float(row[name]) for name in ("reference", "computed", "deviation_percent"))
        expected = 100 * (computed / reference - 1) if reference else 100 * computed
        if abs(abs(deviation) - abs(expected)) > 0.02:
            yield f"{row['quantity']}: the deviation is {expected:.2f} %, not {deviation} %."
        words = row["command"].split()
        name = words[1] if "&&" in words else words[-1]  # a variant of a case has two commands, the first with the case
        if name.startswith("scenes/"):
            if not re.search(rf"\b{name[7:]}\b", scenes):
                yield f"{row['quantity']}: there is no test {name}."
        elif name.endswith(".prm"):
            if not (ROOT / name).is_file():
                yield f"{row['quantity']}: there is no case {name}."
        elif not (ROOT / "doc" / "studies" / "pages" / f"{name}.csv").is_file():
            yield f"{row['quantity']}: study {name} has no numbers."
        file, _, anchor = row["page"].partition("#")
        titles = re.findall(r"^#+ (.*)$", (benchmarks.FOLDER / file).read_text(encoding="utf-8"), re.MULTILINE)
        if anchor not in (re.sub(r"[^\w -]", "", title).lower().replace(" ", "-") for title in titles):
            yield f"{row['quantity']}: {file} has no section {anchor}."


def main():
    rows = benchmarks.read()
    page = (benchmarks.FOLDER / "benchmarks.md").read_text(encoding="utf-8")
    found = list(faults(rows, page))
    stale = page.replace(rows[0]["computed"], "0", 1)
    if not list(faults(rows, stale)):
        found.append("A page with another number passes.")
    print(f"{len(rows)} rows")
    sys.exit("\n".join(found) or len(rows) < 50)


if __name__ == "__main__":
    main()
