# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/advice.md."""

import math
import re
import statistics
import subprocess
import tomllib

from scree import variants as prm_files
from scree.studies import ROOT, Curves, Run, Study, Variant, tick_axis

FACTOR = 1.5
TURNS = 3
COST, STEPS = "cost ratio", "steps ratio"

OWN = tomllib.loads((ROOT / "doc" / "studies" / "reference" / "advice.toml").read_text(encoding="utf-8"))
FOLDERS = ("", "bed", "benchmarks", "columns", "consolidation", "contact", "dynamics", "seepage", "slopes", "terrain",
           "water")
WITHOUT_RASTERS = {"acheron"}  # they are not in the repository
TINY = {"terzaghi", "saturated_rest"}


def cases():
    files = [file for folder in FOLDERS for file in sorted((ROOT / "prm" / folder).glob("*.prm"))
             if file.stem not in WITHOUT_RASTERS]
    ends = {case: {"End time": end} for case, end in OWN["parts"].items()}
    old = [Variant({"case": file.stem, "kind": "old"}, {**OWN["former"].get(file.stem, {}), **ends.get(file.stem, {})},
                   str(file.relative_to(ROOT))) for file in files]
    return old + [Variant({"case": case, "kind": "new"}, {key: value for key, value in given.items() if key != "base"},
                          given["base"])
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
    return [float(re.search(pattern, cost, re.MULTILINE).group(1))
            for pattern in (r"^  run +([\d.e+-]+)", r"^  steps to .* ([\d.e+-]+)$")]


def measure(run):
    runs = [run, *(Run(again(run, turn), run.labels, run.exit_code, math.nan) for turn in range(1, TURNS))]
    cost = sorted((one.cost for one in runs), key=lambda one: one["core-seconds"])[TURNS // 2]
    seconds, steps = map(statistics.median, zip(*(predicted(run, turn) for turn in range(TURNS))))
    return {**cost, "simulated": run.time[-1], "whole": run.labels["case"] not in OWN["parts"],
            "predicted core-seconds": seconds,
            "predicted steps": steps, COST: seconds / cost["core-seconds"], STEPS: steps / cost["steps"]}


def off(ratio):
    """By which factor a prediction is off, whichever way."""
    return max(ratio, 1 / ratio) if ratio > 0 else math.inf


def mean_off(rows):
    return math.exp(sum(math.log(off(ratio)) for ratio in rows.values[COST]) / rows.n)


def verdict(rows, claim):
    costs = [off(ratio) for ratio in rows.values[COST]]
    worst, worst_steps = (max(rows, key=lambda row: off(row[name])) for name in (COST, STEPS))
    new = rows.where(kind="new")
    within = {name: sum(off(ratio) <= FACTOR for ratio in of.values[COST])
              for name, of in (("all", rows), ("new", new))}
    most_steps = off(worst_steps[STEPS])
    claim = claim.shared(rows=rows, new=new, factor=FACTOR, within=within, worst=worst, worst_steps=worst_steps)
    return [claim("cost", max(costs) <= FACTOR, quick=False, most=max(costs), mean=mean_off(rows),
                  parts=rows.where(whole=False)),
            claim("new cases", within["new"] == new.n, quick=False), claim("steps", most_steps <= 1.3, most=most_steps)]


def table(rows):
    groups = {"whole case": rows.where(kind="old", whole=True), "first part of a case": rows.where(whole=False),
              "new case": rows.where(kind="new")}
    return [("compared", "cases", "predicted over measured", "geometric mean of the factor",
             "predicted steps over measured"),
            *((name, str(of.n), f"{of.span[COST]:.2f}", f"{mean_off(of):.2f}", f"{of.span[STEPS]:.2f}")
              for name, of in groups.items() if of)]


def draw(figure, rows):
    axes = figure.add_subplot()
    ends = [rows.smallest["core-seconds"] / 2, 2 * rows.largest["core-seconds"]]
    axes.fill_between(ends, [x / FACTOR for x in ends], [x * FACTOR for x in ends], color="#dddddd",
                      label=f"within a factor {FACTOR:g}")
    axes.plot(ends, ends, color="0.5", linewidth=0.8)
    for kind, whole, face, edge, label in (("old", True, "C0", "C0", "whole case"),
                                           ("old", False, "white", "C0", "first part"),
                                           ("new", True, "C1", "C1", "new case, whole")):
        chosen = rows.where(kind=kind, whole=whole)
        axes.scatter(chosen.values["core-seconds"], chosen.values["predicted core-seconds"], s=28, zorder=3,
                     facecolor=face, edgecolor=edge, label=label)
    for row in (rows.with_smallest(COST), rows.with_largest(COST)):
        axes.annotate(f"{row['case']}: {row[COST]:.2f}", (row["core-seconds"], row["predicted core-seconds"]),
                      fontsize=9, xytext=(24, -24),
                      arrowprops={"arrowstyle": "-", "linewidth": 0.5}, textcoords="offset points")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, xlabel="measured, core-seconds",
             ylabel="predicted by scree --advise, core-seconds")
    tick_axis(axes.xaxis)
    tick_axis(axes.yaxis)
    axes.legend(loc="upper left", fontsize=9)


STUDY = Study("prm", variants=cases(), after=ask,
              quick=lambda labels: labels["case"] in TINY, chart=Curves(draw, 5., timed=True))
