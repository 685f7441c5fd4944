# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables in pages that are made from other tables are current, and one with another number is not taken for current.

- doc/verification/benchmarks.md: the deviations of its CSV follow from its numbers; scenes and cases that it names exist.
- doc/choosing.md and doc/studies/defaults.md: of studies and benchmarks; every table of the first with numbers is one of them.
- prm/README.md: the times are those of the study of the advice, and every case has a row.
"""

import re
import sys

from scree import benchmarks, choices
from scree.command import ROOT


def faults_of_benchmarks(rows, page):
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


def check_benchmarks():
    rows = benchmarks.read()
    page = (benchmarks.FOLDER / "benchmarks.md").read_text(encoding="utf-8")
    found = list(faults_of_benchmarks(rows, page))
    stale = page.replace(rows[0]["computed"], "0", 1)
    if not list(faults_of_benchmarks(rows, stale)):
        found.append("A page with another number passes.")
    print(f"{len(rows)} rows")
    return found + ([] if len(rows) >= 50 else ["Rows are missing."])


def faults_of_choices(page, text):
    if choices.filled(page, text) != text:
        yield f"{page.name} is not current. Run PYTHONPATH=source/python python3 -m scree.choices."
    missing = set(choices.BLOCKS[page]) - {match.group(2) for match in choices.BLOCK.finditer(text)}
    if missing:
        yield f"{page.name} has no block for {', '.join(sorted(missing))}."
    for line in choices.BLOCK.sub("", text).splitlines():
        if page == choices.CHOICES and line.startswith("|") and re.search(r"\d %|\d \(\d+\)", line):
            yield f"A number of a table that no table of a study gives: {line}"


def check_choices():
    found = []
    for page in choices.BLOCKS:
        text = page.read_text(encoding="utf-8")
        found += faults_of_choices(page, text)
        block = next(match for match in choices.BLOCK.finditer(text) if re.search(r"\d+ % at \d+", match.group()))
        place = block.start() + re.search(r"\d+ % at \d+", block.group()).start()
        if not list(faults_of_choices(page, text[:place] + "1" + text[place:])):
            found.append(f"{page.name} with another number passes.")
    text = choices.CHOICES.read_text(encoding="utf-8")
    if not list(faults_of_choices(choices.CHOICES, text + "\n| scene | 5 % |\n")):
        found.append("A table by hand passes.")
    try:
        choices.quoted("limits.md", "3 parts of 4", "3")
        found.append("A number that its page does not have passes.")
    except ValueError:
        pass
    if [choices.reached({5: 0.2, 10: 0.04, 20: 0.06, 40: 0.01}, bound) for bound in (0.05, 0.1, 0.001)] != ["40", "10", "none"]:
        found.append("The smallest H/h from which on all runs are within the bound is wrong.")
    print(f"{sum(map(len, choices.BLOCKS.values()))} blocks")
    return found


def faults_of_times(text):
    if choices.with_times(text) != text:
        yield "prm/README.md is not current. Run PYTHONPATH=source/python python3 -m scree.choices."
    listed = re.findall(r"^\| `([\w-]+)` \|", text, re.MULTILINE)
    for path in sorted((ROOT / "prm").rglob("*.prm")):
        if listed.count(path.stem) != 1:
            yield f"{path.stem}: {listed.count(path.stem)} rows"


def check_times():
    text = choices.TIMES.read_text(encoding="utf-8")
    found = list(faults_of_times(text))
    if not list(faults_of_times(text.replace("| ~", "| ~1", 1))):
        found.append("A page with another time passes.")
    print(f"{len(choices.ROW.findall(text))} rows")
    return found


sys.exit("\n".join([*check_benchmarks(), *check_choices(), *check_times()]) or 0)
