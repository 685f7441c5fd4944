# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of the studies as text: a sentence a line, lines of at most 120 characters, the worst result first."""

import math
import re

from scree.studies.charts import StabilityMap
from scree.studies.measures import BOUNDS_IN_WORDS, share_of_defaults

LINE = 120
ITEM = re.compile(r"(- |\d+\. )")
SENTENCES = re.compile(r"(?<=[.!?])(?<!al\.)\s+(?=[A-Z0-9`*(\[\"]|p )")
MARKUP = re.compile(r"([-+*>#|]|#+|\d+[.)])$")  # a word that would begin a list, a heading or a table at the start of a line

# Headings of the list of studies; a study that is missing here stands under the last one.
TOPICS = {
    "Run-out of dry soil": ("dry_slope", "run_out", "run_out_causes", "granular_collapse", "granular_dam_break", "transfer_rate"),
    "Saturated slopes": ("saturated_slope", "submerged_slope", "pressure_options_slope"),
    "Drained, coupled or undrained": ("regimes", "point_sets", "single_point"),
    "Consolidation": ("terzaghi", "large_strain", "pressure_options"),
    "Free water": ("dam_break", "surface_position", "points_jitter"),
    "Impact and gaps": ("impact", "air_gap"),
    "Infiltration": ("wetting_front",),
    "Waves and convergence": ("bar", "manufactured", "pic_courant"),
    "Soil models and quality of the stress": ("contours", "triaxial", "nor_sand_density", "low_stress", "bulk_to_shear"),
    "Experiments": ("aluminium_bars", "martin_moyce"),
    "Cost": ("advice", "scaling", "nothing_costs", "peers"),
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


def claim_lines(claim):
    """A claim of the verdict, with its table."""
    lines = sentences(claim.text + ("" if claim.holds else " **(Does not hold.)**"), "- ", "  ")
    return [*lines, "", *table(claim.table, "  "), ""] if claim.table else lines


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


def page_text(name, study, introduction, rows, claims):
    seconds = sum(row["core-seconds"] for row in rows if math.isfinite(row.get("core-seconds", math.nan)))
    share = headline(study, rows)
    lines = [f"# {study.title}", ""]
    for label, text in worst_results(study, rows, claims):
        lines += sentences(f"**{label}** {text}", "- ", "  ")
    lines += ["", *paragraphs(introduction), "", f"![{study.title}]({name}.svg)", "", "## Verdict", ""]
    lines += sentences(share, "- ", "  ") if share else []
    for claim in claims:
        lines += claim_lines(claim)
    lines += [""] if lines[-1] else []
    lines += [f"`build/scree-study {name}` repeats it: {len(rows)} runs, {_cost(seconds)}.", f"Numbers: [{name}.csv]({name}.csv); case: `{study.base}`."]
    return "\n".join(lines) + "\n"


def index_text(studies):
    """The list of all studies, {name: (study, rows, claims)}: first all claims that do not hold and the maps that are not stable, then a heading a topic."""
    n_claims = sum(len(claims) for _, _, claims in studies.values())
    found = {name: worst_results(*of) for name, of in studies.items()}
    failed = {label: [(name, text) for name, results in found.items() for kind, text in results if kind == label]
              for label in ("Does not hold.", "Not stable.")}

    def link(name):
        return f"[{studies[name][0].title}]({name}.md)"

    lines = ["# Studies", "", "Each page is written by `build/scree-study NAME` from the runs of one study, and its first line is its worst result.",
             "`build/scree-study all --page` writes all pages again from their tables, without a run.",
             "What follows for the choice of cells, points and transfer: [choosing.md](../../choosing.md).", "",
             "## Claims that do not hold", "", f"{len(failed['Does not hold.'])} of {n_claims} claims do not hold.", ""]
    for name, text in failed["Does not hold."]:
        lines += sentences(f"{link(name)}: {text}", "- ", "  ")
    lines += ["", "## Maps with default cells that are not stable", ""]
    for name, text in failed["Not stable."]:
        lines += sentences(f"{link(name)}: {text}", "- ", "  ")
    listed = [name for names in TOPICS.values() for name in names]
    for topic, names in TOPICS.items():
        names = [name for name in names if name in studies] + ([name for name in studies if name not in listed] if topic == list(TOPICS)[-1] else [])
        lines += ["", f"## {topic}", ""]
        for name in names:
            n_failed = sum(not claim.holds for claim in studies[name][2])
            texts = [f"{n_failed} of {len(studies[name][2])} claims do not hold, see above."] if n_failed else []
            texts += ["not stable in all default cells, see above."] if not n_failed and found[name][0][0] == "Not stable." else []
            texts += [text for label, text in found[name] if label == "Worst result."]
            lines += sentences(f"{link(name)}: " + " ".join(texts), "- ", "  ")
    return "\n".join([*lines, "", "## Bounds of the stability maps", "", *paragraphs(BOUNDS_IN_WORDS)]) + "\n"


def defaults_text(charts):
    """Where the defaults lie on the work-precision charts, {name: (study, meshes, {method: (error, time, fails)})}."""
    lines = ["# Position of the defaults on the work-precision charts", "",
             "One table per chart: error and core-seconds of each other method over those of the case.",
             "They are geometric means over the same meshes.",
             "Errors of the slopes and the dam break are distances to a finer run of one of the methods.",
             "Their ratios are farther from 1 than against the limit.", "Times have a noise of 10 to 20 %.",
             "What follows for the defaults: [defaults.md](../defaults.md)."]
    for name, (study, meshes, others) in charts.items():
        lines += ["", f"## {study.title}", "", f"The defaults are Pareto-optimal on {meshes} meshes ([chart]({name}.md)).", "",
                  *table([("method", "error (-)", "time (-)", "fails on a mesh"),
                          *((method, f"{error:.2g}", f"{time:.2g}", "yes" if fails else "no") for method, (error, time, fails) in others.items())])]
    return "\n".join(lines) + "\n"
