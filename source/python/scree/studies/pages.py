# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of the studies as text: a page a topic, a section a study, the worst result first; lines of at most 120 characters, a sentence a line."""

import math
import re
from typing import NamedTuple

from scree.studies.charts import StabilityMap
from scree.studies.measures import BOUNDS_IN_WORDS, map_table, share_of_defaults

LINE = 120
ITEM = re.compile(r"(- |\d+\. )")
SENTENCES = re.compile(r"(?<=[.!?])(?<!al\.)\s+(?=[A-Z0-9`*(\[\"]|p )")
MARKUP = re.compile(r"([-+*>#|]|#+|\d+[.)])$")  # a word that would begin a list, a heading or a table at the start of a line



class Topic(NamedTuple):
    """A page: its heading and its studies."""
    title: str
    studies: tuple


# Pages in the order of the list.
TOPICS = {
    "run_out": Topic("Run-out of dry soil", ("run_out_limits", "cylinders", "run_out", "run_out_causes", "dry_slope", "transfer_rate", "granular_dam_break")),
    "safety": Topic("Factor of safety", ("strength_reduction",)),
    "saturated_slopes": Topic("Saturated slopes", ("saturated_run_out_limits", "saturated_slope", "submerged_slope")),
    "drained_or_coupled": Topic("Drained, coupled or undrained", ("regimes", "point_sets", "single_point")),
    "consolidation": Topic("Consolidation", ("terzaghi", "large_strain")),
    "free_water": Topic("Free water", ("dam_break", "surface_position")),
    "impact_and_gaps": Topic("Impact and gaps", ("impact", "air_gap")),
    "infiltration": Topic("Infiltration", ("wetting_front",)),
    "waves_and_convergence": Topic("Waves and convergence", ("bar", "manufactured", "pic_courant")),
    "soil_models": Topic("Soil models and quality of the stress", ("contours", "triaxial", "nor_sand_density", "low_stress", "bulk_to_shear", "shear_bands")),
    "experiments": Topic("Experiments", ("aluminium_bars", "martin_moyce")),
    "cost": Topic("Cost", ("advice", "scaling", "nothing_costs", "peers")),
}


def filled(sentence, first="", indent=""):
    """The sentence on lines of at most LINE characters: `first` before the first of them, `indent` before the others."""
    lines, line = [], []
    for word in sentence.split():
        if line and len(indent if lines else first) + len(" ".join([*line, word])) > LINE:
            carried = [line.pop()] if MARKUP.match(word) else []
            lines.append((indent if lines else first) + " ".join(line))
            line = carried
        line.append(word)
    return [*lines, (indent if lines else first) + " ".join(line)]


def sentences(text, first="", indent=""):
    """A paragraph or an item of a list, a sentence a line."""
    lines = []
    for sentence in SENTENCES.split(" ".join(text.split())):
        lines += filled(sentence, indent if lines else first, indent)
    return lines


def paragraphs(text):
    """Text with lists and tables, a sentence a line."""
    lines = []
    for paragraph in re.split(r"\n\s*\n", text.strip()):
        if paragraph.startswith("|"):
            lines += paragraph.splitlines()
        else:
            for part in re.split(r"\n(?=- |\d+\. )", paragraph):
                mark = ITEM.match(part)
                mark = mark.group(1) if mark else ""
                lines += sentences(part[len(mark):], mark, " " * len(mark))
        lines.append("")
    return lines[:-1]


def table(rows, indent=""):
    """A table whose first row is its head."""
    head, *others = [[str(cell) for cell in row] for row in rows]
    return [indent + "| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *others)]


def headline(study, rows):
    """What a stability map says in the first place; none for other charts."""
    return share_of_defaults(rows) if isinstance(study.chart, StabilityMap) else None


def worst_results(study, rows, claims):
    """[(label, text)]: the claims that do not hold; a map with default cells that are not stable; the claims that are marked as the worst. Where there
    is none of these, the headline of a map, or the first claim."""
    found = [("Does not hold.", claim.text) for claim in sorted(claims, key=lambda claim: not claim.worst) if not claim.holds]
    share = headline(study, rows)
    if share and not all(row["state"] == "stable" for row in rows if row["default"]):
        found.append(("Not stable.", share))
    found += [("Worst result.", claim.text) for claim in claims if claim.worst and claim.holds]
    return found or [("Worst result.", share or claims[0].text)]


def _cost(core_seconds):
    return f"{core_seconds:.0f} core-seconds" if core_seconds < 90 else f"{core_seconds / 60:.0f} core-minutes"


def slug(title):
    """The anchor of a heading, as GitHub and MyST name it."""
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", title.lower()))


def topic_of(name):
    """The page of a study; a ValueError if TOPICS lacks it."""
    for topic, (_, names) in TOPICS.items():
        if name in names:
            return topic
    raise ValueError(f"pages.TOPICS has no page for the study {name}")


def section_text(name, study, introduction, rows, claims):
    """Worst results, chart, text, other claims and one table of a study."""
    seconds = sum(row["core-seconds"] for row in rows if math.isfinite(row.get("core-seconds", math.nan)))
    worst = worst_results(study, rows, claims)
    shown, share = [text for _, text in worst], headline(study, rows)
    lines = [f"## {study.title}", ""]
    for label, text in worst:
        lines += sentences(f"**{label}** {text}", "- ", "  ")
    lines += ["", f"![{study.title}]({name}.svg)", "", *paragraphs(introduction)]
    others = [text for text in [share, *(claim.text for claim in claims if not claim.tabled)] if text and text not in shown]
    if others:
        lines += ["", "Further results:", ""]
    for text in others:
        lines += sentences(text, "- ", "  ")
    found = study.table(rows) if study.table else map_table(rows) if isinstance(study.chart, StabilityMap) else None
    lines += ["", *table(found)] if found else []
    lines += ["", *filled(f"Repeat: `build/scree-study {name}` ({len(rows)} runs, {_cost(seconds)}, `{study.base}`); numbers: [{name}.csv]({name}.csv).")]
    return "\n".join(lines) + "\n"


RANKS = ("Does not hold.", "Not stable.", "Worst result.")


def page_text(topic, studies, introductions):
    """A page; studies: {name: (study, rows, claims)} of all studies, introductions: {name: text}."""
    title, names = TOPICS[topic]
    names = [name for name in names if name in studies]
    results = [(RANKS.index(label), name, text) for name in names for label, text in worst_results(*studies[name])[:1]]
    rank, name, text = min(results, key=lambda result: result[0])
    n_failed, n_claims = (sum(count(claim) for name in names for claim in studies[name][2]) for count in (lambda claim: not claim.holds, lambda claim: 1))
    lines = [f"# {title}", "", *sentences(f"**{RANKS[rank]}** [{studies[name][0].title}](#{slug(studies[name][0].title)}): {text}"), "",
             f"{n_failed} of the {n_claims} claims on this page do not hold.", "",
             *table([("study", "question", "what to do"), *((f"[{studies[name][0].title}](#{slug(studies[name][0].title)})", studies[name][0].question,
                                                            studies[name][0].advice) for name in names)])]
    compared = [line for name in names for line in (studies[name][0].compared(studies[name][1]) if studies[name][0].compared else ())]
    if compared:
        lines += ["", *table([("quantity", "unit", "measured", "computed", "deviation"),
                              *((quantity, unit, f"{measured:.3g}", f"{computed:.3g}", f"{100 * (computed / measured - 1):+.0f} %")
                                for quantity, unit, measured, computed in compared)])]
    return "\n".join([*lines, "", *("\n".join(section_text(name, studies[name][0], introductions[name], *studies[name][1:]) for name in names).splitlines())]) + "\n"


def index_text(studies):
    """The list of all pages, {name: (study, rows, claims)}: first all claims that do not hold and the maps that are not stable, then the studies."""
    n_claims = sum(len(claims) for _, _, claims in studies.values())
    found = {name: worst_results(*of) for name, of in studies.items()}
    names = [name for topic in TOPICS.values() for name in topic.studies if name in studies]
    failed = {label: [(name, text) for name in names for kind, text in found[name] if kind == label] for label in RANKS}

    def link(name):
        title = studies[name][0].title
        return f"[{title}]({topic_of(name)}.md#{slug(title)})"

    lines = ["# Studies", "", "Each page answers the questions of a topic from its studies, and its first line is the worst result.",
             "`build/scree-study NAME` repeats a study.", "`build/scree-study all --page` writes all pages again from their tables, without a run.",
             "What follows for the choice of cells, points and transfer: [choosing.md](../../choosing.md), [defaults](../defaults.md).", "",
             *table([("page", "studies", "claims that do not hold"),
                     *((f"[{title}]({topic}.md)", ", ".join(f"`{name}`" for name in of),
                        f"{sum(not claim.holds for name in of for claim in studies[name][2])} of {sum(len(studies[name][2]) for name in of)}")
                       for topic, (title, of) in TOPICS.items())]), "",
             "## Claims that do not hold", "", f"{len(failed[RANKS[0]])} of {n_claims} claims do not hold.", ""]
    for name, text in failed[RANKS[0]]:
        lines += sentences(f"{link(name)}: {text}", "- ", "  ")
    lines += ["", "## Maps with default cells that are not stable", ""]
    for name, text in failed[RANKS[1]]:
        lines += sentences(f"{link(name)}: {text}", "- ", "  ")
    lines += ["", "## Limits of the claims that hold", ""]
    for name, text in failed[RANKS[2]]:
        lines += sentences(f"{link(name)}: {text}", "- ", "  ")
    return "\n".join([*lines, "", "## Bounds of the stability maps", "", *paragraphs(BOUNDS_IN_WORDS)]) + "\n"
