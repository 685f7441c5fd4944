# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/scaling.md."""

import math
import re

from scree.pictures.tables import name_lines
from scree.studies import Curves, Study, Variant, compiled, tick_axis, transfer

QUIET = {"Output/Interval": 100, "Output/Graphics": "none", "Output/Statistics interval": 100}
SCENES = {"dry slope": ("prm/slopes/slope_dense.prm", (0.004, 0.012), {}),
          "saturated slope": ("prm/slopes/slope_saturated_dense.prm", (0.005, 0.015), {}),
          "3D column": ("prm/columns/column_3d.prm", (0.01, 0.03), {}),
          "dam break": ("prm/water/dam_break.prm", (0.04, 0.12), {})}
RANKS = (1, 2, 4, 8, 16, 32, 64)
LARGE = "dam break, 205000 points"
TIMED = {**SCENES, LARGE: ("prm/water/dam_break.prm", (), {"Mesh/Cell size": 0.0125})}
LONG = dict(zip(TIMED, (0.1, 0.1, 0.15, 0.6, 0.35)))  # s of motion for times
CELLS = (0.02, 0.01, 0.005, 0.002)  # m, of the dam break's 2 m^2: up to 5e5 unknowns
COUNTS = ("messages", "messages of busiest", "bytes", "bytes of busiest", "collectives")
LATENCY, BANDWIDTH = 1.5e-6, 10e9  # s, bytes/s


def environment():
    return {"LD_PRELOAD": str(compiled("count_mpi.c", "mpicc", "-shared", "-fPIC", "-O2")),
            "OMPI_MCA_hwloc_base_binding_policy": "none"}


def variant(question, scene, ranks, end, entries, base):
    labels = {"question": question, "scene": scene, "ranks": ranks, "end": end}
    return Variant(labels, {**QUIET, **entries, "End time": end}, base, ranks)


def unknowns(cell):
    return {**transfer("TPIC"), "Mesh/Cell size": cell, "Water/Points per cell": 2,
            "Time step/Maximum time step": cell * 0.02,
            "Water/Volume correction rate": 0}


def variants():
    found = [variant("counts", scene, ranks, end, entries, base)
             for scene, (base, ends, entries) in SCENES.items() for ranks in RANKS for end in ends]
    found += [variant("two ranks", scene, ranks, end, TIMED[scene][2], TIMED[scene][0])
              for scene, end in LONG.items() for ranks in (1, 2)]
    return found + [variant("unknowns", f"h = {cell:g} m", ranks, 20 * cell * 0.02, unknowns(cell),
                            "prm/water/dam_break.prm")
                    for cell in CELLS for ranks in (1, 2, 8)]


def measure(run):
    counts = re.search(r"^mpi: ranks \d+ messages (\d+) (\d+) bytes (\d+) (\d+) collectives (\d+)$", run.log,
                       re.MULTILINE)

    def number(pattern, default=None):
        found = re.search(pattern, run.log, re.MULTILINE)
        return float(found.group(1)) if found or default is None else default
    return {**dict(zip(COUNTS, map(int, counts.groups()))), "wall s": number(r"^total +([\d.e+-]+) "),
            "imbalance": number(r"^imbalance: ([\d.]+)", 1.),
            "points": number(r"/ ([\d.e+-]+) point updates") / run.statistics("Step")[-1],
            "ghost nodes": number(r"; ghost nodes (\d+)", 0.),
            "CG iterations": run.columns.get("CG iterations per step", [math.nan])[-1]}


def per_step(rows, scene):
    """{ranks: {what: a step's}} of the counted runs of a scene."""
    result = {}
    for ranks in sorted(set(rows.values["ranks"])):
        pair = sorted(rows.where(question="counts", scene=scene, ranks=ranks), key=lambda row: row["end"])
        if len(pair) == 2:
            short, long = pair
            steps = long["steps"] - short["steps"]
            result[ranks] = {**{name: (long[name] - short[name]) / steps for name in COUNTS},
                             **{name: long[name] for name in ("points", "imbalance", "ghost nodes")}}
    return result


def modelled(step, ranks, ns, times=1., dimensions=2):
    """Seconds of a step by the model, with `times` as many points as were counted."""
    surface = times ** ((dimensions - 1) / dimensions)
    work = 1e-9 * ns * times * step["points"] / ranks * (step["imbalance"] if ranks <= 2 else 1.1)
    if ranks == 1:
        return work
    return (work + step["messages of busiest"] * LATENCY + surface * step["bytes of busiest"] / BANDWIDTH
            + step["collectives"] * LATENCY * math.log2(ranks))


def ns_of_one_core(rows, scene):
    row = rows.first(question="two ranks", scene=scene, ranks=1)
    return 1e9 * row["wall s"] / row["steps"] / row["points"]


def speed_up(rows, scene):
    one, two = (rows.first(question="two ranks", scene=scene, ranks=ranks) for ranks in (1, 2))
    return one["wall s"] / two["wall s"]


def speed_ups_by_model(rows, scene, steps):
    """{ranks: speed-up} with a hundred times the points."""
    ns, dimensions = ns_of_one_core(rows, scene), 3 if "3D" in scene else 2
    one = modelled(steps[1], 1, ns, 100)
    return {ranks: one / modelled(step, ranks, ns, 100, dimensions) for ranks, step in steps.items()}


def verdict(rows, claim):
    counted = {scene: steps for scene in SCENES if len(steps := per_step(rows, scene)) > 1}
    most = max(ranks for steps in counted.values() for ranks in steps)
    collectives = {scene: max(step["collectives"] for step in counted[scene].values())
                   for scene in counted if scene in ("dry slope", "3D column")}
    claims, claim = [], claim.shared(most=most)
    if rows.where(question="two ranks"):
        times = {scene: speed_up(rows, scene) for scene in LONG}
        claims.append(claim("two ranks", min(times.values()) >= 1.8, quick=False, times=times))
    claims += [claim("messages", all(steps[1]["messages"] == 0 for steps in counted.values()), tabled=True),
               claim("collectives", max(collectives.values(), default=0) < 5, collectives=list(collectives.values()))]
    if most == max(RANKS):
        strong = {f"{scene}, {100 * steps[1]['points']:.1e} points": speed_ups_by_model(rows, scene, steps)[most] / most
                  for scene, steps in counted.items()}
        claims.append(claim("model", True, quick=False, efficiency=strong))
        coarse, fine = (rows.where(question="unknowns", scene=f"h = {cell:g} m").span["CG iterations"]
                        for cell in (CELLS[0], CELLS[-1]))
        claims.append(claim("pressure", fine.high < 3 * coarse.low, quick=False, coarse=coarse, fine=fine,
                            coarsest=CELLS[0], finest=CELLS[-1],
                            n_coarse=2 / CELLS[0] ** 2, n_fine=2 / CELLS[-1] ** 2))
    return claims


def table(rows):
    most = max(RANKS)
    lines = [("scene", "points", "two ranks over one (bound 1.8)", "messages on 64 ranks", "collectives",
              "kB of the busiest rank")]
    for scene in SCENES:
        steps = per_step(rows, scene)
        lines.append((scene, f"{steps[1]['points']:.0f}", f"{speed_up(rows, scene):.2f}",
                      f"{steps[most]['messages of busiest']:.0f}",
                      f"{steps[most]['collectives']:.0f}", f"{1e-3 * steps[most]['bytes of busiest']:.0f}"))
    return [*lines, (LARGE, "205000", f"{speed_up(rows, LARGE):.2f}", "-", "-", "-")]


def draw(figure, rows):
    if not rows.where(question="two ranks"):
        return
    messages, speeds = figure.subplots(1, 2)
    for index, scene in enumerate(SCENES):
        steps, style = per_step(rows, scene), {"marker": "o", "markersize": 4, "color": f"C{index}"}
        ranks, speed_ups = list(steps), speed_ups_by_model(rows, scene, steps)
        messages.plot(ranks[1:], [steps[number]["messages of busiest"] for number in ranks[1:]], **style)
        speeds.plot(ranks, list(speed_ups.values()), label=scene, **style)
    speeds.plot(RANKS, RANKS, color="0.6", linewidth=1, label="ideal")
    for plot, label in ((messages, "messages of the busiest rank per time step"),
                        (speeds, "speed-up by the model,\n100 times the points")):
        plot.set(xscale="log", yscale="log", xlabel="ranks", ylabel=label)
        tick_axis(plot.yaxis)
        plot.set_xticks(RANKS, RANKS, minor=False)
        plot.minorticks_off()
    name_lines(speeds)


STUDY = Study(
    "prm/slopes/slope_dense.prm", variants=variants(), environment=environment,
    quick=lambda labels: labels["question"] == "counts" and labels["ranks"] <= 2
    and labels["scene"] in ("dry slope", "dam break"), chart=Curves(draw, 3.6, timed=True))
