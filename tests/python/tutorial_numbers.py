# SPDX-License-Identifier: LGPL-2.1-or-later
"""tutorial_numbers.py [RESULTS [COMMIT]]: key numbers of the tutorials are those of doc/tutorials/numbers.csv, and those of the runs in RESULTS.

A row has the page; the run folder in RESULTS; the file there, a table such as statistics.csv or a log; the column and the time in s (empty: the last line)
in a table, or a regular expression with one group in a log; a factor from SI to the unit on the page; the value as the page writes it; commit and date
of the run (before 2026-11-29: of the page that has the value). A value holds within one unit of its last digit; zeros at the end of whole
numbers do not count.

With RESULTS it compares every row whose run is there; with COMMIT it stores this commit and today's date for those that hold.
"""

import csv
import datetime
import pathlib
import re
import sys

import numpy

from scree.command import ROOT
from scree.results import column, read_table

FOLDER = ROOT / "doc" / "tutorials"
TABLE = FOLDER / "numbers.csv"


def is_on(page, value):
    return re.search(rf"(?<![\d.]){re.escape(value)}(?!\d|\.\d)", page.replace(" 000", "000")) is not None


def last_digit(value):
    """The value of the last digit: 0.01 of 4.10, 10 of 1970, 1e-5 of 4.2e-4."""
    mantissa, _, exponent = value.partition("e")
    whole, _, decimals = mantissa.partition(".")
    places = -len(decimals) if decimals else len(whole) - len(whole.rstrip("0"))
    return 10.**(places + int(exponent or 0))


def computed(row, run):
    """The value of a row from its run."""
    path = run / row["file"]
    if path.suffix == ".txt":
        return float(row["factor"]) * float(re.search(row["quantity"], path.read_text(encoding="utf-8")).group(1))
    table = read_table(path)
    values = column(table, row["quantity"])
    return float(row["factor"]) * (numpy.interp(float(row["time"]), table["Time (s)"], values) if row["time"] else values[-1])


def faults(rows, pages):
    for row in rows:
        if not is_on(pages[row["page"]], row["value"]):
            yield f"{row['page']} does not have {row['value']}: {row['run']}, {row['quantity']} at {row['time']}"


def compare(rows, results, commit):
    """Faults of the rows against the runs."""
    for row in rows:
        if not (results / row["run"] / row["file"]).exists():
            continue
        value = computed(row, results / row["run"])
        if abs(value - float(row["value"])) > last_digit(row["value"]) * 1.0001:
            yield f"{row['page']}: {row['run']}, {row['quantity']} at {row['time']} is {value:.5g}, not {row['value']}"
        elif commit:
            row.update(commit=commit, date=datetime.date.today().isoformat())


def main():
    with open(TABLE, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    pages = {row["page"]: (FOLDER / row["page"]).read_text(encoding="utf-8") for row in rows}
    found = list(faults(rows, pages))
    if not list(faults(rows[:1], {rows[0]["page"]: pages[rows[0]["page"]].replace(rows[0]["value"], "0")})):
        found.append("A page with another number passes.")
    if len(sys.argv) > 1:
        found += compare(rows, pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "")
        with open(TABLE, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    print(f"{len(rows)} numbers of {len(pages)} pages")
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
