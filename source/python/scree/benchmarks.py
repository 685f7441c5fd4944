# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the page of benchmarks and the chart of their deviations, from doc/verification/benchmarks.csv: measured or exact beside computed.

PYTHONPATH=source/python python3 -m scree.benchmarks

Writes the tables into doc/verification/benchmarks.md, between the lines `<!-- rows of PAGE -->` and `<!-- end -->`, the chart
doc/verification/benchmarks.svg, and the pictures of doc/validation.md and of the page of wet experiments, doc/verification/agreement_*.svg.
"""

import re

from scree.command import ROOT
from scree.results import read_rows
from scree.studies import charts
from scree.studies import run as studies
from scree.studies.cases import strength_reduction
from scree.studies.study import reference_rows

FOLDER = ROOT / "doc" / "verification"
COLUMNS = ("quantity", "reference", "computed", "deviation (%)", "run")
BLOCK = re.compile(r"(<!-- rows of (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def read():
    """The rows, each a dictionary by the names of the columns."""
    return read_rows(FOLDER / "benchmarks.csv")


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
             "blocks and bars": ("dry-soil-on-an-oblique-bed", "contact-between-bodies"), "earthquakes": ("absorbing-walls",),
             "consolidation": ("terzaghis-consolidation", "scaled-inertia", "large-strain"),
             "seepage, infiltration": ("darcy-and-ergun-flow", "infiltration-into-dry-soil"),
             "dam break, waves": ("dam-break-on-a-dry-bed", "dam-break-on-a-wet-bed", "sloshing-and-rest", "viscous-films", "inflow"),
             "forces on structures": ("obstacles-in-water", "obstacles-in-dry-soil")}
EXPERIMENTS = ("aluminium-bars", "granular-columns-against-experiments", "dam-break-on-a-dry-bed")


def deviations(rows):
    """{question: [(deviation in percent, whether the reference is measured)]}, with the factors of safety of the study of strength reduction."""
    found = {question: [(float(row["deviation_percent"]), anchor in EXPERIMENTS) for row in rows for anchor in [row["page"].partition("#")[2]]
                        if anchor in anchors and not row["quantity"].startswith("plug")] for question, anchors in QUESTIONS.items()}
    slopes = strength_reduction.scenes_of(studies.read_table(studies.PAGES / "strength_reduction.csv"))
    found["factor of safety"] += [(100 * strength_reduction.deviation(row), False) for row in slopes]
    return found


def draw(found, target):
    """One line a question, the deviations as points, 5 % shaded."""
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


# Pictures of agreement --------------------------------------------------------------------------------------------------

FRICTION = 30  # degrees, of the slopes under water
STAND = 1  # mm; a slope that moves less stands
SEEPAGE = ("two layers", "rigid porous dam", "porous dam", "porous block", "packed bed", "net over", "fall, k")
FORCES = ("upright wall", "layer at rest: force", "cylinder: buoyancy", "sphere", "cylinder, oblique", "bore")
CONDUCTIVITIES = {0.1: "o", 1e-4: "s", 1e-8: "^"}  # m/s and their marks


def draw_ratios(beginnings, target):
    """Computed over reference values of the benchmarks whose quantities begin so, one line each, 5 % shaded."""
    rows = [row for row in read() if row["quantity"].startswith(beginnings) and float(row["reference"]) > 0]
    ratios = [float(row["computed"]) / float(row["reference"]) for row in rows]
    figure, axes = charts.plt.subplots(figsize=(charts.WIDTH, 0.8 + 0.28 * len(rows)))
    axes.axvspan(0.95, 1.05, color="#5aa55a", alpha=0.15, linewidth=0)
    axes.axvline(1, color="0.5", linewidth=1)
    axes.scatter(ratios, range(len(rows)), s=28, zorder=3)
    axes.set(yticks=range(len(rows)), yticklabels=[row["quantity"].replace("fall,", "infiltration:") for row in rows], xlim=(0.9, 1.1), xlabel="computed over exact value (-)")
    axes.invert_yaxis()
    charts.save(figure, target)


def draw_slopes_under_water(target):
    """Displacement of the front of slopes under still water within 1 s over their angle, for three conductivities and water levels."""
    rows = studies.read_table(studies.PAGES / "submerged_slope.csv")
    figure, axes = charts.plt.subplots(figsize=(charts.WIDTH, 3.2))
    axes.axvline(FRICTION, color="0.5", linewidth=1)
    axes.axhline(STAND, color="0.5", linewidth=1, linestyle=":")
    axes.annotate("friction angle", (FRICTION, 0.006), xytext=(4, 0), textcoords="offset points", color="0.4")
    axes.annotate("stands", (45, STAND), xytext=(0, -11), textcoords="offset points", color="0.4", ha="right")
    for conductivity, mark in CONDUCTIVITIES.items():
        found = [row for row in rows if row["k"] == conductivity]
        axes.scatter([row["angle"] for row in found], [row["front moved, mm"] for row in found], marker=mark, s=28, zorder=3, alpha=0.8,
                     label=f"k = {conductivity:g} m/s")
    axes.set(yscale="log", xlabel="angle of the slope (degrees)", ylabel="front moved in 1 s (mm)")
    axes.legend(loc="lower right")
    charts.save(figure, target)


def draw_submerged_columns(target):
    """Fronts of loose and dense submerged columns over time: measured ones as points, computed ones as lines."""
    rows = read_rows(FOLDER / "submerged_columns.csv")
    figure, both = charts.plt.subplots(1, 2, figsize=(charts.WIDTH, 3.2), sharey=True)
    for axes, packing in zip(both, ("loose", "dense")):
        measured = reference_rows(f"rondon_{packing}_front")
        axes.scatter([float(row["time_s"]) for row in measured], [float(row["front_cm"]) for row in measured], color="0.3", s=20, zorder=3, label="experiment")
        of_packing = [row for row in rows if row["column"] == packing]
        for run_name in dict.fromkeys(row["run"] for row in of_packing):
            line = [(float(row["time_s"]), float(row["front_cm"])) for row in of_packing if row["run"] == run_name]
            axes.plot(*zip(*line), color={"law, 6 mm": "C0", "law, 4 mm": "C1"}.get(run_name, "C2"), label=run_name)
        axes.set(xlabel="time (s)", title=packing)
        axes.legend(loc="lower right" if packing == "loose" else "upper right")
    both[0].set_ylabel("front (cm)")
    charts.save(figure, target)


def main():
    page = FOLDER / "benchmarks.md"
    page.write_text(filled(page.read_text(encoding="utf-8"), read()), encoding="utf-8")
    draw(deviations(read()), FOLDER / "benchmarks")
    draw_ratios(SEEPAGE, FOLDER / "agreement_seepage")
    draw_ratios(FORCES, FOLDER / "agreement_forces")
    draw_slopes_under_water(FOLDER / "agreement_submerged_slope")
    draw_submerged_columns(FOLDER / "agreement_submerged_columns")


if __name__ == "__main__":
    main()
