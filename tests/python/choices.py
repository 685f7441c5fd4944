# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tables of doc/choosing.md and doc/studies/defaults.md are what the tables of the studies and of the benchmarks give; every table of the first
with numbers is one of them."""

import re
import sys

from scree import choices


def faults(page, text):
    if choices.filled(page, text) != text:
        yield f"{page.name} is not current. Run PYTHONPATH=source/python python3 -m scree.choices."
    missing = set(choices.MAKERS[page]) - {match.group(2) for match in choices.BLOCK.finditer(text)}
    if missing:
        yield f"{page.name} has no block for {', '.join(sorted(missing))}."
    for line in choices.BLOCK.sub("", text).splitlines():
        if page == choices.CHOICES and line.startswith("|") and re.search(r"\d %|\d \(\d+\)", line):
            yield f"A number of a table that no table of a study gives: {line}"


def main():
    found = []
    for page in choices.MAKERS:
        text = page.read_text(encoding="utf-8")
        found += faults(page, text)
        block = next(match for match in choices.BLOCK.finditer(text) if re.search(r"\d+ % at \d+", match.group()))
        place = block.start() + re.search(r"\d+ % at \d+", block.group()).start()
        if not list(faults(page, text[:place] + "1" + text[place:])):
            found.append(f"{page.name} with another number passes.")
    text = choices.CHOICES.read_text(encoding="utf-8")
    if not list(faults(choices.CHOICES, text + "\n| scene | 5 % |\n")):
        found.append("A table by hand passes.")
    try:
        choices.quoted("limits.md", "3 parts of 4", "3")
        found.append("A number that its page does not have passes.")
    except ValueError:
        pass
    if [choices.reached({5: 0.2, 10: 0.04, 20: 0.06, 40: 0.01}, bound) for bound in (0.05, 0.1, 0.001)] != ["40", "10", "none"]:
        found.append("The smallest H/h from which on all runs are within the bound is wrong.")
    print(f"{sum(map(len, choices.MAKERS.values()))} blocks")
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
