# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of agreement for doc/validation.md, from doc/verification/benchmarks.csv and the tables of the studies.

PYTHONPATH=source/python python3 -m scree.agreement

Writes doc/verification/agreement_seepage.svg, agreement_forces.svg and agreement_submerged_slope.svg.
"""

from scree import benchmarks
from scree.studies import charts
from scree.studies import run as studies

FRICTION = 30  # degrees, of the slopes under water
STAND = 1  # mm; a slope that moves less stands
SEEPAGE = ("two layers", "rigid porous dam", "porous dam", "porous block", "packed bed", "net over", "fall, k")
FORCES = ("upright wall", "layer at rest: force", "cylinder: buoyancy", "sphere", "cylinder, oblique", "bore")
CONDUCTIVITIES = {0.1: "o", 1e-4: "s", 1e-8: "^"}  # m/s and their marks


def draw_ratios(beginnings, target):
    """Computed over reference values of the benchmarks whose quantities begin so, one line each, 5 % shaded."""
    rows = [row for row in benchmarks.read() if row["quantity"].startswith(beginnings) and float(row["reference"]) > 0]
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


def main():
    draw_ratios(SEEPAGE, benchmarks.FOLDER / "agreement_seepage")
    draw_ratios(FORCES, benchmarks.FOLDER / "agreement_forces")
    draw_slopes_under_water(benchmarks.FOLDER / "agreement_submerged_slope")


if __name__ == "__main__":
    main()
