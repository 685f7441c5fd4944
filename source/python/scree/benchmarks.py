# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the page of benchmarks, from doc/verification/benchmarks.csv: measured or exact beside computed.

PYTHONPATH=source/python python3 -m scree.benchmarks

Writes the tables into doc/verification/benchmarks.md, between the lines `<!-- rows of PAGE -->` and `<!-- end -->`.
"""

import csv
import re

from scree.command import ROOT

FOLDER = ROOT / "doc" / "verification"
COLUMNS = ("quantity", "reference", "computed", "unit", "deviation (%)", "run", "commit", "date")
BLOCK = re.compile(r"(<!-- rows of (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def read(path=FOLDER / "benchmarks.csv"):
    """The rows, each a dictionary by the names of the columns."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def run(command):
    """A command in the table: its last word without prm/, or all of it if it has several parts."""
    parts = command.split(" && ")
    return ", then ".join(f"`{part}`" for part in parts) if len(parts) > 1 else f"`{command.split()[-1].replace('prm/', '')}`"


def table(rows):
    """The rows as a table; `run` is the last word of a single command, without prm/."""
    lines = [COLUMNS, ("---",) * len(COLUMNS)]
    lines += [(row["quantity"], row["reference"], row["computed"], row["unit"], row["deviation_percent"],
               run(row["command"]), row["commit"], row["date"]) for row in rows]
    return "".join(f"| {' | '.join(cells)} |\n".replace("| --- ", "|---").replace("--- |", "---|") for cells in lines)


def filled(text, rows):
    """The page with the tables of these rows. Throws ValueError if a row has no place in it."""
    missing = {row["page"] for row in rows} - {match.group(2) for match in BLOCK.finditer(text)}
    if missing:
        raise ValueError(f"The page of benchmarks has no block for {', '.join(sorted(missing))}")
    return BLOCK.sub(lambda match: f"{match.group(1)}\n{table([row for row in rows if row['page'] == match.group(2)])}\n{match.group(3)}", text)


def main():
    page = FOLDER / "benchmarks.md"
    page.write_text(filled(page.read_text(encoding="utf-8"), read()), encoding="utf-8")


if __name__ == "__main__":
    main()
