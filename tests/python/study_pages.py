# SPDX-License-Identifier: LGPL-2.1-or-later
"""study_pages.py: the pages of the studies and their list are what the committed tables say, pages and sections begin with their worst result, and have no long lines."""

import re
import sys

from scree.studies import pages, run
from scree.studies.study import Claim

LONGEST_SENTENCE = 40  # words

faults = []


def check(what, holds):
    if not holds:
        faults.append(what)


def check_lines(file, text):
    for number, line in enumerate(text.splitlines(), 1):
        check(f"{file}, line {number}: {len(line)} characters", len(line) <= pages.LINE or line.startswith("|"))


for name in run.names_of_studies():
    module, topic = run.module_of(name), pages.topic_of(name)
    rows = run.read_table(run.PAGES / f"{name}.csv")
    failed = [claim for claim in module.STUDY.verdict(rows) if not claim.holds]
    page = (run.PAGES / f"{topic}.md").read_text(encoding="utf-8")
    section = page.partition(f"\n## {module.STUDY.title}\n\n")[2].partition("\n## ")[0]
    check(f"{name}: claims that do not hold at the head of its section", section.partition("\n![")[0].count("**Does not hold.**") == len(failed))
    check(f"{name}: no result in the first line of its section", section.startswith(("- **Does not hold.**", "- **Not stable.**", "- **Worst result.**")))
    check(f"{name}: no result in the first line of {topic}.md", page.splitlines()[2].startswith(("**Does not hold.**", "**Not stable.**", "**Worst result.**")))
    check(f"{topic}.md begins with a claim that does not hold", not failed or page.splitlines()[2].startswith("**Does not hold.**"))
    parts = re.split(r"\n\s*\n|\n(?=- |\d+\. )", module.__doc__)
    for sentence in (sentence for part in parts for sentence in pages.SENTENCES.split(" ".join(part.split()))):
        words = len([word for word in sentence.split() if word[0].isalnum() or len(word) > 1])
        check(f"{name}: a sentence of {words} words: {sentence[:60]}...", words <= LONGEST_SENTENCE)

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
check("order of the worst results", [text for _, text in pages.worst_results(Study, [], claims)] == ["Worse.", "Bad.", "Limited."])
check("the first claim, if nothing is worse", pages.worst_results(Study, [], claims[:1]) == [("Worst result.", "Good.")])
check("a sentence a line", pages.sentences("One. Two et al. 2005 are there. 3 are not.", "- ", "  ") == ["- One.", "  Two et al. 2005 are there.", "  3 are not."])
check("no line begins a list", all(not pages.MARKUP.match(line.split()[0]) for line in pages.filled("word - " * 60)))

print(f"{len(run.names_of_studies())} pages")
sys.exit("\n".join(faults) or 0)
