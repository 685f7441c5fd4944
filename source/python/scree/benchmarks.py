# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the page of benchmarks and the chart of their deviations, from doc/verification/benchmarks.csv: measured or exact beside computed.

PYTHONPATH=source/python python3 -m scree.benchmarks

Writes the tables into doc/verification/benchmarks.md, between the lines `<!-- rows of PAGE -->` and `<!-- end -->`, and the chart
doc/verification/benchmarks.svg.
"""

import csv
import re

from scree.command import ROOT

FOLDER = ROOT / "doc" / "verification"
COLUMNS = ("quantity", "reference", "computed", "deviation (%)", "run")
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
    """The rows as a table; the run is part of the head if it is that of all rows."""
    runs = [run(row["command"]) for row in rows]
    common = len(set(runs)) == 1
    lines = [(*COLUMNS[:2], f"{COLUMNS[2]}, {runs[0]}", COLUMNS[3]) if common else COLUMNS]
    lines += [("---",) * len(lines[0])]
    for row, of in zip(rows, runs):
        unit = "" if row["unit"] == "-" else f" ({row['unit']})"
        lines.append((row["quantity"] + unit, row["reference"], row["computed"], row["deviation_percent"], *([] if common else [of])))
    return "".join(f"| {' | '.join(cells)} |\n".replace("| --- ", "|---").replace("--- |", "---|") for cells in lines)


def filled(text, rows):
    """The page with the tables of these rows. Throws ValueError if a row has no place in it."""
    missing = {row["page"] for row in rows} - {match.group(2) for match in BLOCK.finditer(text)}
    if missing:
        raise ValueError(f"The page of benchmarks has no block for {', '.join(sorted(missing))}")
    return BLOCK.sub(lambda match: f"{match.group(1)}\n{table([row for row in rows if row['page'] == match.group(2)])}\n{match.group(3)}", text)


# Lines of the chart: sections of the pages with the rows of each; rows of these sections with a measured reference are open circles.
QUESTIONS = {"factor of safety": ("clay-and-mud",), "dry columns and slopes": ("aluminium-bars", "granular-columns-against-experiments", "breaking-layer-of-grains"),
             "blocks and bars": ("dry-soil-on-an-oblique-bed", "contact-between-bodies"),
             "consolidation": ("terzaghis-consolidation", "scaled-inertia", "large-strain"),
             "seepage, infiltration": ("darcy-and-ergun-flow", "infiltration-into-dry-soil"),
             "dam break, waves": ("dam-break-on-a-dry-bed", "dam-break-on-a-wet-bed", "sloshing-and-rest", "viscous-films", "inflow"),
             "forces on structures": ("obstacles-in-water", "obstacles-in-dry-soil")}
EXPERIMENTS = ("aluminium-bars", "granular-columns-against-experiments", "dam-break-on-a-dry-bed")


def deviations(rows):
    """{question: [(deviation in percent, whether the reference is measured)]}, with the factors of safety of the study of strength reduction."""
    from scree.studies import run as studies
    from scree.studies.cases import strength_reduction
    found = {question: [(float(row["deviation_percent"]), anchor in EXPERIMENTS) for row in rows for anchor in [row["page"].partition("#")[2]]
                        if anchor in anchors and not row["quantity"].startswith("plug")] for question, anchors in QUESTIONS.items()}
    slopes = strength_reduction.scenes_of(studies.read_table(studies.PAGES / "strength_reduction.csv"))
    found["factor of safety"] += [(100 * strength_reduction.deviation(row), False) for row in slopes]
    return found


def draw(found, target):
    """One line a question, the deviations as points, 5 % shaded."""
    from scree.studies import charts
    figure, axes = charts.plt.subplots(figsize=(charts.WIDTH, 3.2))
    axes.axvspan(-5, 5, color="#5aa55a", alpha=0.15, linewidth=0)
    axes.axvline(0, color="0.5", linewidth=1)
    for measured, style, label in ((False, {"color": "C0"}, "exact or published"), (True, {"edgecolors": "C1", "facecolors": "none"}, "experiment")):
        points = [(value, y) for y, values in enumerate(found.values()) for value, of in values if of == measured]
        axes.scatter(*zip(*points), s=28, label=label, zorder=3, **style)
    axes.set(yticks=range(len(found)), yticklabels=found, xlim=(-25, 25), xlabel="deviation of the computed from the reference value (%)")
    axes.invert_yaxis()
    axes.legend(loc="lower left")
    charts.save(figure, target)


def main():
    page = FOLDER / "benchmarks.md"
    page.write_text(filled(page.read_text(encoding="utf-8"), read()), encoding="utf-8")
    draw(deviations(read()), FOLDER / "benchmarks")


if __name__ == "__main__":
    main()
