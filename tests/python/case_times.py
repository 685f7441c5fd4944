# SPDX-License-Identifier: LGPL-2.1-or-later
"""The times of prm/README.md are those of the study of the advice, and every case has a row."""

import re
import sys

from scree import case_times
from scree.command import ROOT


def faults(text):
    if case_times.filled(text) != text:
        yield "prm/README.md is not current. Run PYTHONPATH=source/python python3 -m scree.case_times."
    listed = re.findall(r"^\| `([\w-]+)` \|", text, re.MULTILINE)
    for path in sorted((ROOT / "prm").rglob("*.prm")):
        if listed.count(path.stem) != 1:
            yield f"{path.stem}: {listed.count(path.stem)} rows"


def main():
    text = case_times.PAGE.read_text(encoding="utf-8")
    found = list(faults(text))
    if not list(faults(text.replace("| ~", "| ~1", 1))):
        found.append("A page with another time passes.")
    print(f"{len(case_times.ROW.findall(text))} rows")
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
