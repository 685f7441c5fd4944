# SPDX-License-Identifier: LGPL-2.1-or-later
"""A dry column of Mohr-Coulomb soil of width L0 and height H0 = a L0 collapses on a rough base.
Lube et al. 2005 and Lajeunesse et al. 2005 give the final run-out (L - L0)/L0 and height H/L0 for grains in a channel as functions of a alone.
Between a = 1.8 and 2.8 Lube et al. give none (`doc/studies/reference/lube_lajeunesse_2005.csv`).
Their grains had friction angles of 22 to 31 degrees; both ends of that range are run.
The number of cells is that over the smaller side of the column, 1 m; Young's modulus grows with H0.
L is the front that holds 99.5 % of the mass after 8 sqrt(H0/g), H the largest height of a point at that time.
The friction of the channel walls, rolling, and a friction that depends on the speed are not modelled.
"""
import math
import re

import numpy as np

from scree.studies.charts import Curves, tick_axis
from scree.studies.study import Claim, Study, axis, product, reference_rows

GRAVITY = 9.81


def law(source, quantity, aspect):
    """The law's value, - ; nan where the source gives none. At the bound between two ranges it is the lower one's."""
    for row in reference_rows("lube_lajeunesse_2005"):
        sign, bound = row["range_of_a"].split()[1:]
        inside = aspect <= float(bound) if sign == "<" else aspect > float(bound)
        if row["source"].startswith(source) and row["quantity"] == quantity.replace("-", "") and inside:
            factor, power, over = re.fullmatch(r"(?:([\d.]+)\*)?a(?:\^\((\d)/(\d)\))?", row["formula"]).groups()
            return float(factor or 1) * aspect ** (float(power) / float(over) if power else 1)
    return math.nan


def in_cells(cells):
    return {"Mesh/Cell size": f"{1 / cells:.10g}"}


def column(aspect):
    """Entries of a column whose smaller side is 1 m."""
    width, height = max(1., 1 / aspect), max(1., aspect)
    reach = width * (1 + 1.7 * law("Lajeunesse", "run-out", aspect))  # the far wall must not be touched
    return {"Mesh/Upper corner": f"{math.ceil(reach):g}, {math.ceil(height + 0.1):g}",
            "Soil/Region": f"x < {width:g} && y < {height:g}",
            "Soil/Mohr-Coulomb/Young's modulus": f"{1e6 * height:g}",
            "End time": f"{8 * math.sqrt(height / GRAVITY):.3f}",
            "Output/Interval": f"{math.sqrt(height / GRAVITY):.3f}"}


def measure(run):
    aspect = run.labels["a"]
    width = max(1., 1 / aspect)
    front, height = run.statistics("Front 99.5 % (m)"), run.statistics("Height (m)")
    return {"run-out": front[-1] / width - 1, "height": height[-1] / width,
            "run-out in the last sixth": (front[-1] - np.interp(5 / 6 * run.time[-1], run.time, front)) / width}


def chosen(rows, friction, cells):
    return [row for row in rows if row["friction"] == friction and row["cells"] == cells]


def ratios(rows, source, quantity):
    """Computed over the law's value, of the columns for which there is one."""
    found = [row[quantity] / law(source, quantity, row["a"]) for row in rows]
    return [ratio for ratio in found if not math.isnan(ratio)]


def span(values):
    return f"{min(values):.2f} to {max(values):.2f}" if max(values) - min(values) > 0.005 else f"{values[0]:.2f}"


def verdict(rows):
    all_sizes = sorted({row["cells"] for row in rows if row["a"] == 3})
    fine = all_sizes[-1]
    rough, smooth = chosen(rows, 31, fine), chosen(rows, 22, fine)
    low, tall = ([[row for row in group if (row["a"] <= 3) == is_low] for group in (rough, smooth)] for is_low in (True, False))
    flat = [row for row in rough + smooth if row["a"] <= 0.5]
    high = [row for row in rough + smooth if row["a"] >= 1]
    flat_height, high_height = ratios(flat, "Lube", "height"), ratios(high, "Lube", "height")
    rest = max(row["run-out in the last sixth"] for row in rows)
    lowest = min(high, key=lambda row: row["height"] / law("Lube", "height", row["a"]))
    lube, lajeunesse = ratios(low[0], "Lube", "run-out"), ratios(low[1], "Lajeunesse", "run-out")
    claims = [
        Claim(f"Up to a = 3 the two friction angles span the band of the two laboratories: with {fine:g} cells the run-out is {span(lube)} times "
              f"Lube's for 31 degrees and {span(lajeunesse)} times Lajeunesse's for 22 degrees.",
              holds=all(0.9 < ratio < 1.2 for ratio in lube + lajeunesse), quick=False),
        Claim(f"A flat column (a = 0.5) keeps its height ({span(flat_height)} times Lube's), as in the experiments.",
              holds=all(abs(ratio - 1) < 0.03 for ratio in flat_height)),
        Claim(f"From a = 1 on the deposit is too low: {span(high_height)} times Lube's height, least for "
              f"a = {lowest['a']:g} and {lowest['friction']:g} degrees.",
              holds=all(ratio < 0.9 for ratio in high_height)),
        Claim(f"All columns are at rest at the end: in the last sixth of the time the front advances by {rest:.4f} L0 at most.", holds=rest < 0.01),
    ]
    if tall[0]:
        farther = ratios(tall[0] + tall[1], "Lajeunesse", "run-out")
        claims.append(Claim(f"The tall column (a = {tall[0][0]['a']:g}) reaches {farther[0]:.2f} times Lajeunesse's run-out, the farther law, with 31 degrees and "
                            f"{farther[1]:.2f} times with 22 degrees.", holds=min(farther) > 1, quick=False))
    if len(all_sizes) > 1:
        coarse = {(row["friction"], row["a"]): row["run-out"] for row in rows if row["cells"] == all_sizes[0]}
        growth = [row["run-out"] / coarse[row["friction"], row["a"]] for row in rough + smooth]
        square = ", ".join(f"{row['run-out']:.2f} with {row['cells']:g}" for row in rows if row["a"] == 1 and row["friction"] == 31)
        claims.insert(0, Claim(f"The run-out has not converged with the mesh: {fine:g} instead of {all_sizes[0]:g} cells lengthen it by a factor "
                               f"{span(growth)}. For a = 1 and 31 degrees it is {square} cells (Lube: 1.2, Lajeunesse: 1.8). Agreement with the laws is that of "
                               "one mesh.", holds=all(factor > 1.01 for factor in growth), quick=False, worst=True))
    return claims


LAWS = {31: "Lube", 22: "Lajeunesse"}  # friction angle -> the law of the run-out that it is compared with


def compared(rows):
    fine = [row for row in rows if row["cells"] == 16]
    found = [(f"{quantity} of columns over L0, a = {row['a']:g}, {row['friction']:g} degrees ({source})", "-", law(source, quantity, row["a"]), row[quantity])
             for row in fine for quantity, source in (("run-out", LAWS[row["friction"]]), ("height", "Lube"))]
    return [line for line in found if not math.isnan(line[2])]


def draw(figure, rows):
    plots = dict(zip(("run-out", "height"), figure.subplots(1, 2)))
    aspects = np.geomspace(0.4, 8, 400)
    for quantity, plot in plots.items():
        for source, style in (("Lube", "k-"), ("Lajeunesse", "k--")):
            values = np.array([law(source, quantity, aspect) for aspect in aspects])
            if np.any(np.isfinite(values)):
                plot.plot(aspects, values, style, linewidth=1)
        for friction, colour in ((22, "C1"), (31, "C0")):
            for cells, face in ((8, "none"), (16, colour)):
                group = chosen(rows, friction, cells)
                plot.plot([row["a"] for row in group], [row[quantity] for row in group], "o", color=colour, markersize=6, markerfacecolor=face)
        plot.set(xscale="log", yscale="log", xlabel="aspect ratio a = H0/L0; open: 8 cells, full: 16")
        tick_axis(plot.xaxis)
        tick_axis(plot.yaxis)
    plots["run-out"].set_ylabel("run-out (L - L0)/L0")
    plots["height"].set_ylabel("height H/L0")
    for place, text, colour in (((1.2, 5.2), "22 degrees", "C1"), ((3.5, 3.0), "31 degrees", "C0"), ((0.42, 3.4), "Lajeunesse (dashed)", "k"), ((0.75, 0.62), "Lube (line)", "k")):
        plots["run-out"].text(*place, text, color=colour, fontsize=9)
    plots["height"].text(0.55, 1.3, "Lube (line)", fontsize=9)


CELLS = axis("cells", in_cells, [8, 16])
ANGLES = axis("friction", "Soil/Mohr-Coulomb/Friction angle", [22, 31])
STUDY = Study(title="Granular columns",
              question="Do run-out and height of dry columns follow the laws of two laboratories?",
              advice="Take the run-out as a band over friction angles and cell sizes; do not use the height of tall columns.",
              base="prm/columns/mohr_coulomb_collapse.prm", entries={"Output/Graphics": "none"},
              variants=product(CELLS, ANGLES, axis("a", column, [0.5, 1, 3, 6]))
              + product(axis("cells", in_cells, [32]), ANGLES, axis("a", column, [1])),
              quick=lambda labels: labels["cells"] == 8 and labels["a"] <= 3,
              measure=measure, verdict=verdict, compared=compared, chart=Curves(draw, 3.8))
