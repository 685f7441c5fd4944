# SPDX-License-Identifier: LGPL-2.1-or-later
"""study_pages.py: the pages of the studies and their list are what the committed tables say, sections begin with what holds and end with all that does not, and have no long lines."""

import pathlib
import re
import sys

from scree.studies import pages, run
from scree.studies.rows import Rows, Span
from scree.studies.words import Claim, Claims, filled, tabled

faults = []


def check(what, holds):
    if not holds:
        faults.append(what)


def check_lines(file, text):
    for number, line in enumerate(text.splitlines(), 1):
        check(f"{file}, line {number}: {len(line)} characters", len(line) <= pages.LINE or line.startswith("|"))


for name in run.names_of_studies():
    study, topic = run.study_of(name), pages.topic_of(name)
    module = pathlib.Path(run.__file__).with_name("cases") / f"{name}.py"
    for sentence in study.text.sentences:
        check(f"{study.text.file.name}: no claim of {module.name} has the sentence {sentence}", f'"{sentence}"' in module.read_text(encoding="utf-8"))
    rows = run.read_table(run.PAGES / f"{name}.csv")
    failed = [claim for claim in study.verdict(rows) if not claim.holds]
    page = (run.PAGES / f"{topic}.md").read_text(encoding="utf-8")
    section = page.partition(f"\n## {study.text.title}\n\n")[2].partition("\n## ")[0]
    tail = section.partition(study.text.introduction)[2]
    check(f"{name}: claims that do not hold behind the text of its section", tail.count("**Does not hold.**") == section.count("**Does not hold.**") == len(failed))
    check(f"{name}: its map is not stable, and its section does not say so",
          pages.headline(study, rows) is None or pages.all_stable(rows) or "**Not stable.**" in tail)
    check(f"{topic}.md does not say how many claims of {name} hold", re.search(rf"^\| \[{re.escape(study.text.title)}\].* {pages.n_held(study.verdict(rows))} \|$",
                                                                        page, re.MULTILINE))

texts = run.page_texts()
for file, text in texts.items():
    check(f"{file.name} is not what the tables say: scree-study all --page", file.read_text(encoding="utf-8") == text)
    check_lines(file.name, text)
for file in (run.PAGES.parent / "defaults.md", run.PAGES.parent.parent / "choosing.md"):
    check_lines(file.name, file.read_text(encoding="utf-8"))

# No file that no page uses.
used = {path.name for path in texts} | {name for text in texts.values() for name in re.findall(r"\]\(([\w.]+)\)", text)}
for path in run.PAGES.iterdir():
    check(f"no page uses {path.name}", path.name.replace("_curves.csv", ".csv") in used)


class Chart:
    pass


class Study:
    chart = Chart()


claims = [Claim("Good.", True), Claim("Bad.", False), Claim("Worse.", False, worst=True), Claim("Limited.", True, worst=True)]
check("order of the misses", [text for _, text in pages.misses(Study, [], [*claims, Claim("Worst.", False, worst=True)])] == ["Worse.", "Worst.", "Bad."])
check("order of the results", pages.results(Study, [], claims) == ["Limited.", "Good."])
check("claims that hold", pages.n_held(claims) == "2 of 4")
check("a sentence a line", pages.sentences("One. Two et al. 2005 are there. 3 are not.", "- ", "  ") == ["- One.", "  Two et al. 2005 are there.", "  3 are not."])
check("no line begins a list", all(not pages.MARKUP.match(" " + line) for line in pages.filled("word - " * 60)))

rows = Rows([{"kind": "a", "cells": 4, "gain": 0.02}, {"kind": "b", "cells": 2, "gain": 0.1}, {"kind": "a", "cells": 2, "gain": 0.01}])
check("rows", rows.where(kind="a").values["gain"] == [0.02, 0.01] and rows.where(lambda row: row["gain"] > 0.05).n == 1 and rows.first(kind="c") is None
      and rows.with_largest("gain")["kind"] == "b" and rows.span["gain"] == Span(0.01, 0.1))
check("rows from coarse to fine", {key: [row["h"] for row in of] for key, of in rows.grouped("kind").items()} == {("a",): [0.5, 0.25], ("b",): [0.5]})
for form, value, text in (("{:.1f %}", 0.123, "12.3 %"), ("{:g mm}", 0.0025, "2.5"), ("{:.0f %}", Span(0.1, 0.2), "10 to 20 %"), ("{:.1f}", [1, 2], "1.0, 2.0"),
                          ("{:.2f}", {"x": 1, "y": 2}, "1.00 (x), 2.00 (y)"), ("{[a b, %]:.1f}", {"a b, %": 1}, "1.0"), ("{0.largest[gain]}", rows, "0.1")):
    check(f"{form} gives {filled(form, value)}, not {text}", filled(form, value) == text)
claim = Claims({"gain": "At most {rows.largest[gain]:g} of {n}."}).shared(rows=rows)
check("a claim with its sentence", claim("gain", 1, quick=False, n=3) == Claim("At most 0.1 of 3.", True, False))
check("a table", tabled({"kind": "{[kind]}", "gain": "{[gain]:.0f %}"}, by="gain")(rows[:2]) == [("kind", "gain"), ("a", "2 %"), ("b", "10 %")])

print(f"{len(run.names_of_studies())} pages")
sys.exit("\n".join(faults) or 0)
