# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `scree --advise` says a case will cost, against what it costs: every case of `prm/` and `prm/benchmarks`, as it stands or, where it runs for
many minutes, its first part (column "simulated", s). Cost is processor time of the steps and the output, without the start-up. The advice is asked for
the same shortened case, right after its run, on the same machine, which other programs kept busy: a core-second of it then does now more, now less, by a
factor of two within minutes. What it says comes from half a core-second of the case's first steps, a row and a picture; the factors by
which later steps are longer or shorter, and dearer where soil yields, were set on these cases and on whole runs of the saturated slopes, so that this
page shows how well a few factors serve all of them, not what a case of another kind will do. Whole runs of the saturated slopes to 12 s (not in the
table) took 41389, 40948, 41669 and 41128 steps (dense, loose, dense and loose single-point) where 43200 are predicted.

Eleven cases on which nothing was set, those of `prm/bed` and `prm/terrain` and `aluminium_bars` as it stands, each run whole once: predicted over measured cost .89 to 1.09, 1.23 (`flow_against_wall`), 1.47 (`piston`, .1 s), .70 (`kot_dry`),
and .49 for `kot_saturated`, whose contact with the bed took half of the time once it had spread (today .31: the contact takes a fifth, the pressure's solve more than half, three and a half times
as much a step as in the first 4 s); steps within 1.1. Eight written since, run whole on a quiet machine (`bed/gate`, `bed/film`, `bed/settled_layer`, `bed/bore`, `contact`, `net`, `dam`): .76 to 1.30, but .47 for `bore`, whose solves take three times as many iterations in the end."""

import math
import re
import subprocess

from charts import Curves
from study import ROOT, Claim, Study, Variant

FACTOR = 1.5

# End times, s, of the cases that are not run to their end.
PARTS = {"column_loose": 1.5, "column_saturated_3d": 0.75, "porous_dam": 1, "submerged_column": 0.8, "quickstart": 0.6, "slope_dense": 0.3,
         "slope_loose": 0.6, "slope_dense_fine": 0.03, "slope_loose_fine": 0.03, "slope_saturated_dense": 0.3, "slope_saturated_dense_single": 0.15,
         "slope_saturated_dense_porosity": 0.1, "slope_saturated_loose": 0.5, "slope_saturated_loose_single": 0.15,
         "slope_saturated_loose_porosity": 0.1, "slope_saturated_mohr_coulomb": 0.3, "nor_sand_slope_2d": 0.1, "slope_dense_friction": 0.3,
         "slope_loose_friction": 0.3, "gully_dry": 0.02, "gully_saturated": 0.02, "slope_saturated_dense_friction": 0.1, "slope_saturated_loose_friction": 0.1}
TINY = {"terzaghi", "saturated_rest", "dam_break"}


def cases():
    files = sorted((ROOT / "prm").glob("*.prm")) + sorted((ROOT / "prm" / "benchmarks").glob("*.prm"))
    return [Variant({"case": file.stem}, {"End time": PARTS[file.stem]} if file.stem in PARTS else {}, str(file.relative_to(ROOT))) for file in files]


def ask(run, program):
    with open(run.folder / "advice.txt", "w", encoding="utf-8") as answer:
        subprocess.run([program, "--advise", run.folder / "case.prm"], cwd=ROOT, stdout=answer, check=True)


def measure(run):
    text = (run.folder / "advice.txt").read_text(encoding="utf-8")
    cost = text[text.index("Cost of the case"):text.index("Recommendation")]

    predicted = float(re.search(r"^  run +([\d.e+-]+)", cost, re.MULTILINE).group(1))
    steps = float(re.search(r"^  steps to .* ([\d.e+-]+)$", cost, re.MULTILINE).group(1))
    return {"simulated": run.time[-1], "whole": run.labels["case"] not in PARTS, "predicted core-seconds": predicted, "predicted steps": steps,
            "cost ratio": predicted / run.cost["core-seconds"], "steps ratio": steps / run.cost["steps"]}


def off(ratio):
    """By which factor a prediction is off, whichever way."""
    return max(ratio, 1 / ratio) if ratio > 0 else math.inf


def verdict(rows):
    costs, steps = [off(row["cost ratio"]) for row in rows], [off(row["steps ratio"]) for row in rows]
    worst, worst_steps = rows[costs.index(max(costs))], rows[steps.index(max(steps))]
    geometric = math.exp(sum(math.log(factor) for factor in costs) / len(costs))
    return [Claim(f"The predicted core-seconds of all cases are within a factor {FACTOR:g} of the measured ones: {sum(cost <= FACTOR for cost in costs)} of "
                  f"{len(rows)} are, at worst it is {max(costs):.2f} ({worst['case']}), in the geometric mean {geometric:.2f}.", holds=max(costs) <= FACTOR, quick=False),
            Claim(f"The predicted steps are within a factor 1.3: at worst {max(steps):.2f} ({worst_steps['case']}).", holds=max(steps) <= 1.3)]


def draw(figure, rows):
    axes = figure.add_subplot()
    ends = [min(row["core-seconds"] for row in rows) / 2, 2 * max(row["core-seconds"] for row in rows)]
    axes.fill_between(ends, [x / FACTOR for x in ends], [x * FACTOR for x in ends], color="#dddddd", label=f"within a factor {FACTOR:g}")
    axes.plot(ends, ends, color="0.5", linewidth=0.8)
    for whole, face, label in ((True, "C0", "whole case"), (False, "white", "first part")):
        chosen = [row for row in rows if row["whole"] == whole]
        axes.scatter([row["core-seconds"] for row in chosen], [row["predicted core-seconds"] for row in chosen], s=28, zorder=3, facecolor=face,
                     edgecolor="C0", label=label)
    for row in (min(rows, key=lambda row: row["cost ratio"]), max(rows, key=lambda row: row["cost ratio"])):
        axes.annotate(f"{row['case']} {row['cost ratio']:.2f}", (row["core-seconds"], row["predicted core-seconds"]), fontsize=8, xytext=(6, -3),
                      textcoords="offset points")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, xlabel="measured, core-seconds", ylabel="predicted by scree --advise, core-seconds")
    axes.legend(loc="upper left")


STUDY = Study(title="What a case will cost: predicted and measured", base="prm", variants=cases(), measure=measure, verdict=verdict, after=ask,
              quick=lambda labels: labels["case"] in TINY, chart=Curves(draw, size=(7.5, 7), timed=True))
