# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of the studies as text: a page a topic, a section a study, first what holds, at its end what does not; lines of at most 120 characters.

doc/studies/intro has the text of each section, NAME.md, and that of the bounds."""

import math
import re
import textwrap
from typing import NamedTuple

from scree.studies import words
from scree.studies.charts import Curves, StabilityMap
from scree.studies.measures import BOUNDS, map_table, share_of_defaults

LINE = 120
BOUNDS_TEXT = words.FOLDER / "bounds.md"
SENTENCES = re.compile(r"(?<=[.!?])(?<!al\.)\s+(?=[A-Z0-9`*(\[\"]|p )")
MARKUP = re.compile(r" ([-+*>#|]|#+|\d+[.)])(?=\s|$)")  # a word that would begin a list, a heading or a table at the start of a line


class Topic(NamedTuple):
    """A page: its heading and its studies."""
    title: str
    studies: tuple


# Pages in the order of the list.
TOPICS = {
    "run_out": Topic("Run-out of dry soil", ("run_out_limits", "cylinders", "run_out", "resolution", "dry_slope", "transfer_rate", "granular_dam_break")),
    "safety": Topic("Factor of safety", ("strength_reduction",)),
    "saturated_slopes": Topic("Saturated slopes", ("saturated_run_out_limits", "saturated_slope", "submerged_slope")),
    "drained_or_coupled": Topic("Drained, coupled or undrained", ("regimes", "point_sets", "single_point")),
    "consolidation": Topic("Consolidation", ("terzaghi", "large_strain")),
    "free_water": Topic("Free water", ("dam_break",)),
    "impact_and_gaps": Topic("Impact and gaps", ("impact", "air_gap")),
    "infiltration": Topic("Infiltration", ("wetting_front",)),
    "waves_and_convergence": Topic("Waves and convergence", ("bar", "manufactured")),
    "soil_models": Topic("Soil models and quality of the stress", ("contours", "low_stress", "shear_bands")),
    "experiments": Topic("Experiments", ("aluminium_bars", "martin_moyce", "porous_dam_break")),
    "cost": Topic("Cost", ("advice", "scaling", "peers")),
}


def filled(sentence, first="", indent=""):
    """The sentence on lines of at most LINE characters: `first` before the first of them, `indent` before the others."""
    kept = MARKUP.sub("\0\\1", sentence)
    lines = textwrap.wrap(kept, LINE, initial_indent=first, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in lines]


def sentences(text, first="", indent=""):
    """A paragraph or an item of a list, a sentence a line."""
    lines = []
    for sentence in SENTENCES.split(" ".join(text.split())):
        lines += filled(sentence, indent if lines else first, indent)
    return lines


def table(rows, indent=""):
    """A table whose first row is its head."""
    head, *others = [[str(cell) for cell in row] for row in rows]
    return [indent + "| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *others)]


def headline(study, rows):
    """What a stability map says in the first place; none for other charts."""
    return share_of_defaults(rows) if isinstance(study.chart, StabilityMap) else None


def results(study, rows, claims):
    """What holds, the claims with the largest deviations first; without those that the table of the section has."""
    share = headline(study, rows)
    held = [claim.text for claim in sorted(claims, key=lambda claim: not claim.worst) if claim.holds and not (claim.tabled and not claim.worst)]
    return ([share] if share and all_stable(rows) else []) + held


def all_stable(rows):
    return all(row["state"] == "stable" for row in rows if row["default"])


def misses(study, rows, claims):
    """[(label, text)]: the claims that do not hold, the worst first; a map with default cells that are not stable."""
    found = [(FAILED, claim.text) for claim in sorted(claims, key=lambda claim: not claim.worst) if not claim.holds]
    share = headline(study, rows)
    return found + ([(UNSTABLE, share)] if share and not all_stable(rows) else [])


def n_held(claims):
    return f"{sum(claim.holds for claim in claims)} of {len(claims)}"


def slug(title):
    """The anchor of a heading, as GitHub and MyST name it."""
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", title.lower()))


def topic_of(name):
    """The page of a study; a ValueError if TOPICS lacks it."""
    for topic, (_, names) in TOPICS.items():
        if name in names:
            return topic
    raise ValueError(f"pages.TOPICS has no page for the study {name}")


def section_text(name, study, rows, claims):
    """What holds, chart, text, one table and what does not hold of a study."""
    seconds = sum(row["core-seconds"] for row in rows if math.isfinite(row.get("core-seconds", math.nan)))
    cost = f"{seconds:.0f} core-seconds" if seconds < 90 else f"{seconds / 60:.0f} core-minutes"
    lines = [f"## {study.text.title}", ""]
    for text in results(study, rows, claims):
        lines += sentences(text, "- ", "  ")
    lines += ["", *([f"![{study.text.title}]({name}.svg)", ""] if isinstance(study.chart, Curves) else []), study.text.introduction]
    found = study.table(rows) if study.table else map_table(rows) if isinstance(study.chart, StabilityMap) else None
    lines += ["", *table(found)] if found else []
    missed = misses(study, rows, claims)
    for label, text in missed:
        lines += ([""] if (label, text) == missed[0] else []) + sentences(f"**{label}** {text}", "- ", "  ")
    lines += ["", *filled(f"Repeat: `build/scree-study {name}` ({len(rows)} runs, {cost}, `{study.base}`); numbers: [{name}.csv]({name}.csv).")]
    return "\n".join(lines) + "\n"


FAILED, UNSTABLE = "Does not hold.", "Not stable."


def page_text(topic, studies):
    """A page; studies: {name: (study, rows, claims)} of all studies."""
    title, names = TOPICS[topic]
    names = [name for name in names if name in studies]
    lines = [f"# {title}", "",
             *table([("study", "question", "what to do", "claims that hold"),
                     *((f"[{study.text.title}](#{slug(study.text.title)})", study.text.question, study.text.advice, n_held(claims))
                       for study, _, claims in (studies[name] for name in names))])]
    return "\n".join([*lines, "", *("\n".join(section_text(name, *studies[name]) for name in names).splitlines())]) + "\n"


def index_text(studies):
    """The list of all studies, {name: (study, rows, claims)}: what follows from each, then all claims that do not hold and the maps that are not stable."""
    claims = [claim for _, _, of in studies.values() for claim in of]
    names = [name for topic in TOPICS.values() for name in topic.studies if name in studies]
    missed = [(name, label, text) for name in names for label, text in misses(*studies[name])]

    def link(name):
        title = studies[name][0].text.title
        return f"[{title}]({topic_of(name)}.md#{slug(title)})"

    def section(title, label):
        lines = ["", f"## {title}", ""]
        for name, of, text in missed:
            lines += sentences(f"{link(name)}: {text}", "- ", "  ") if of == label else []
        return lines

    lines = ["# Studies", "", f"{n_held(claims)} claims of {len(studies)} studies hold.",
             "The pages have charts, tables and conditions.",
             "`build/scree-study NAME` repeats one; `build/scree-study all --page` writes all pages again from their tables.",
             "What follows for a case: [choices](../../choosing.md), with the number of points; [defaults](../defaults.md).", "",
             *table([("study", "what to do", "claims that hold"), *((link(name), studies[name][0].text.advice, n_held(studies[name][2])) for name in names)]),
             *section("Claims that do not hold", FAILED), *section("Maps with default cells that are not stable", UNSTABLE)]
    return "\n".join([*lines, "", "## Bounds of the stability maps", "", BOUNDS_TEXT.read_text(encoding="utf-8").rstrip().format_map(BOUNDS)]) + "\n"
