# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/advice.md."""

import math
import re
import statistics
import subprocess
import tomllib

from scree import variants as prm_files
from scree.studies.charts import Curves, tick_axis
from scree.studies.study import ROOT, Claim, Run, Study, Variant

FACTOR = 1.5
TURNS = 3

OWN = tomllib.loads((ROOT / "doc" / "studies" / "reference" / "advice.toml").read_text(encoding="utf-8"))
FOLDERS = ("", "bed", "benchmarks", "columns", "consolidation", "contact", "dynamics", "seepage", "slopes", "terrain", "water")
WITHOUT_RASTERS = {"acheron"}  # they are not in the repository
TINY = {"terzaghi", "saturated_rest"}


def cases():
    files = [file for folder in FOLDERS for file in sorted((ROOT / "prm" / folder).glob("*.prm")) if file.stem not in WITHOUT_RASTERS]
    old = [Variant({"case": file.stem, "kind": "old"}, {**OWN["former"].get(file.stem, {}), **({"End time": end} if (end := OWN["parts"].get(file.stem)) else {})},
                   str(file.relative_to(ROOT))) for file in files]
    return old + [Variant({"case": case, "kind": "new"}, {key: value for key, value in given.items() if key != "base"}, given["base"])
                  for case, given in OWN["new"].items()]


def again(run, turn):
    """The folder of a further run of the case."""
    return run.folder / f"again_{turn}"


def advice(run, turn):
    return run.folder / f"advice_{turn}.txt"


def ask(run, program):
    case = (run.folder / "case.prm").read_text(encoding="utf-8")
    for turn in range(TURNS):
        if turn > 0:
            prm = run.folder / f"again_{turn}.prm"
            prm.write_text(prm_files.set_entry(case, "Output directory", again(run, turn)), encoding="utf-8")
            subprocess.run([program, prm], cwd=ROOT, stdout=subprocess.DEVNULL, check=True)
        with open(advice(run, turn), "w", encoding="utf-8") as answer:
            subprocess.run([program, "--advise", run.folder / "case.prm"], cwd=ROOT, stdout=answer, check=True)


def predicted(run, turn):
    """Core-seconds of the run and its steps, as the advice says."""
    text = advice(run, turn).read_text(encoding="utf-8")
    cost = text[text.index("Estimated cost of this case"):text.index("Recommendation")]
    return [float(re.search(pattern, cost, re.MULTILINE).group(1)) for pattern in (r"^  run +([\d.e+-]+)", r"^  steps to .* ([\d.e+-]+)$")]


def measure(run):
    runs = [run, *(Run(again(run, turn), run.labels, run.exit_code, math.nan) for turn in range(1, TURNS))]
    cost = sorted((one.cost for one in runs), key=lambda one: one["core-seconds"])[TURNS // 2]
    seconds, steps = map(statistics.median, zip(*(predicted(run, turn) for turn in range(TURNS))))
    return {**cost, "simulated": run.time[-1], "whole": run.labels["case"] not in OWN["parts"], "predicted core-seconds": seconds, "predicted steps": steps,
            "cost ratio": seconds / cost["core-seconds"], "steps ratio": steps / cost["steps"]}


def off(ratio):
    """By which factor a prediction is off, whichever way."""
    return max(ratio, 1 / ratio) if ratio > 0 else math.inf


def verdict(rows):
    costs, steps = [off(row["cost ratio"]) for row in rows], [off(row["steps ratio"]) for row in rows]
    worst, worst_steps = rows[costs.index(max(costs))], rows[steps.index(max(steps))]
    new = [cost for row, cost in zip(rows, costs) if row["kind"] == "new"]
    geometric = math.exp(sum(math.log(factor) for factor in costs) / len(costs))
    n_parts = sum(not row["whole"] for row in rows)
    return [Claim(f"The predicted core-seconds are within a factor {FACTOR:g} of the measured ones in {sum(cost <= FACTOR for cost in costs)} of {len(rows)} cases. "
                  f"The worst factor is {max(costs):.2f} ({worst['case']}), the geometric mean {geometric:.2f}. For {n_parts} of the cases only a first part was "
                  "run; their cost to the end is not verified.", holds=max(costs) <= FACTOR, quick=False),
            Claim(f"Of the new cases {sum(cost <= FACTOR for cost in new)} of {len(new)} are within that factor.", holds=max(new, default=1) <= FACTOR, quick=False),
            Claim(f"The predicted steps are within a factor 1.3: at worst {max(steps):.2f} ({worst_steps['case']}).", holds=max(steps) <= 1.3)]


def table(rows):
    groups = {"whole case": [row for row in rows if row["kind"] == "old" and row["whole"]], "first part of a case": [row for row in rows if not row["whole"]],
              "new case": [row for row in rows if row["kind"] == "new"]}
    return [("compared", "cases", "predicted over measured", "geometric mean of the factor", "predicted steps over measured"),
            *((name, str(len(group)), f"{min(row['cost ratio'] for row in group):.2f} to {max(row['cost ratio'] for row in group):.2f}",
               f"{math.exp(sum(math.log(off(row['cost ratio'])) for row in group) / len(group)):.2f}",
               f"{min(row['steps ratio'] for row in group):.2f} to {max(row['steps ratio'] for row in group):.2f}") for name, group in groups.items() if group)]


def draw(figure, rows):
    axes = figure.add_subplot()
    ends = [min(row["core-seconds"] for row in rows) / 2, 2 * max(row["core-seconds"] for row in rows)]
    axes.fill_between(ends, [x / FACTOR for x in ends], [x * FACTOR for x in ends], color="#dddddd", label=f"within a factor {FACTOR:g}")
    axes.plot(ends, ends, color="0.5", linewidth=0.8)
    for kind, whole, face, edge, label in (("old", True, "C0", "C0", "whole case"), ("old", False, "white", "C0", "first part"),
                                           ("new", True, "C1", "C1", "new case, whole")):
        chosen = [row for row in rows if row["kind"] == kind and row["whole"] == whole]
        axes.scatter([row["core-seconds"] for row in chosen], [row["predicted core-seconds"] for row in chosen], s=28, zorder=3, facecolor=face,
                     edgecolor=edge, label=label)
    for row in (min(rows, key=lambda row: row["cost ratio"]), max(rows, key=lambda row: row["cost ratio"])):
        axes.annotate(f"{row['case']}: {row['cost ratio']:.2f}", (row["core-seconds"], row["predicted core-seconds"]), fontsize=9, xytext=(24, -24), arrowprops={"arrowstyle": "-", "linewidth": 0.5},
                      textcoords="offset points")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, xlabel="measured, core-seconds", ylabel="predicted by scree --advise, core-seconds")
    tick_axis(axes.xaxis)
    tick_axis(axes.yaxis)
    axes.legend(loc="upper left", fontsize=9)


STUDY = Study(title="Cost of a case: predicted and measured",
              question="How reliable is the cost that `--advise` predicts?",
              advice="Plan with the predicted core-seconds times 1.5.",
              base="prm", variants=cases(), measure=measure, verdict=verdict, after=ask,
              quick=lambda labels: labels["case"] in TINY, table=table,
              chart=Curves(draw, 5., timed=True))
