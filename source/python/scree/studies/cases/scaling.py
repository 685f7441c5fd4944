# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/scaling.md."""

import math
import re

from scree.pictures.tables import name_lines
from scree.studies.charts import Curves, tick_axis
from scree.studies.study import Claim, Study, Variant, compiled, transfer

QUIET = {"Output/Interval": 100, "Output/Graphics": "none", "Output/Statistics interval": 100}
SCENES = {"dry slope": ("prm/slopes/slope_dense.prm", (0.004, 0.012), {}),
          "saturated slope": ("prm/slopes/slope_saturated_dense.prm", (0.005, 0.015), {}),
          "3D column": ("prm/columns/column_3d.prm", (0.01, 0.03), {}),
          "dam break": ("prm/water/dam_break.prm", (0.04, 0.12), {})}
RANKS = (1, 2, 4, 8, 16, 32, 64)
TIMED = {**SCENES, "dam break, 205000 points": ("prm/water/dam_break.prm", (), {"Mesh/Cell size": 0.0125})}
LONG = dict(zip(TIMED, (0.1, 0.1, 0.15, 0.6, 0.35)))  # s of motion for times
CELLS = (0.02, 0.01, 0.005, 0.002)  # m, of the dam break's 2 m^2: up to 5e5 unknowns
COUNTS = ("messages", "messages of busiest", "bytes", "bytes of busiest", "collectives")
LATENCY, BANDWIDTH = 1.5e-6, 10e9  # s, bytes/s


def environment():
    return {"LD_PRELOAD": str(compiled("count_mpi.c", "mpicc", "-shared", "-fPIC", "-O2")), "OMPI_MCA_hwloc_base_binding_policy": "none"}


def variants():
    found = []
    for scene, (base, ends, entries) in SCENES.items():
        for ranks in RANKS:
            for end in ends:
                found.append(Variant({"question": "counts", "scene": scene, "ranks": ranks, "end": end}, {**QUIET, **entries, "End time": end}, base, ranks))
    for scene, end in LONG.items():
        base, _, entries = TIMED[scene]
        for ranks in (1, 2):
            found.append(Variant({"question": "two ranks", "scene": scene, "ranks": ranks, "end": end}, {**QUIET, **entries, "End time": end}, base, ranks))
    for cell in CELLS:
        for ranks in (1, 2, 8):
            found.append(Variant({"question": "unknowns", "scene": f"h = {cell:g} m", "ranks": ranks, "end": 20 * cell * 0.02},
                                 {**QUIET, **transfer("TPIC"), "Mesh/Cell size": cell, "Water/Points per cell": 2, "Time step/Maximum time step": cell * 0.02,
                                  "Water/Volume correction rate": 0, "End time": 20 * cell * 0.02}, "prm/water/dam_break.prm", ranks))
    return found


def measure(run):
    counts = re.search(r"^mpi: ranks \d+ messages (\d+) (\d+) bytes (\d+) (\d+) collectives (\d+)$", run.log, re.MULTILINE)
    total = re.search(r"^total +([\d.e+-]+) ", run.log, re.MULTILINE)
    imbalance = re.search(r"^imbalance: ([\d.]+)", run.log, re.MULTILINE)
    ghosts = re.search(r"; ghost nodes (\d+)", run.log)
    updates = re.search(r"/ ([\d.e+-]+) point updates", run.log)
    columns = run.columns
    return {**dict(zip(COUNTS, map(int, counts.groups()))), "wall s": float(total.group(1)), "imbalance": float(imbalance.group(1)) if imbalance else 1.,
            "points": float(updates.group(1)) / run.statistics("Step")[-1], "ghost nodes": float(ghosts.group(1)) if ghosts else 0.,
            "CG iterations": columns["CG iterations per step"][-1] if "CG iterations per step" in columns else math.nan}


def per_step(rows, scene):
    """{ranks: {what: a step's}} of the counted runs of a scene."""
    result = {}
    for ranks in sorted({row["ranks"] for row in rows}):
        pair = sorted((row for row in rows if (row["question"], row["scene"], row["ranks"]) == ("counts", scene, ranks)), key=lambda row: row["end"])
        if len(pair) == 2:
            steps = pair[1]["steps"] - pair[0]["steps"]
            result[ranks] = {**{name: (pair[1][name] - pair[0][name]) / steps for name in COUNTS}, "points": pair[1]["points"],
                             "imbalance": pair[1]["imbalance"], "ghost nodes": pair[1]["ghost nodes"]}
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
    row = next(row for row in rows if (row["question"], row["scene"], row["ranks"]) == ("two ranks", scene, 1))
    return 1e9 * row["wall s"] / row["steps"] / row["points"]


def speed_up(rows, scene):
    one, two = (next(row for row in rows if (row["question"], row["scene"], row["ranks"]) == ("two ranks", scene, ranks)) for ranks in (1, 2))
    return one["wall s"] / two["wall s"]


def verdict(rows):
    counted = {scene: per_step(rows, scene) for scene in SCENES}
    counted = {scene: steps for scene, steps in counted.items() if len(steps) > 1}
    claims = []
    if any(row["question"] == "two ranks" for row in rows):
        times = {scene: speed_up(rows, scene) for scene in LONG}
        claims.append(Claim("Two ranks are " + ", ".join(f"{value:.2f} ({scene})" for scene, value in times.items()) + " times as fast as one. Bound: 1.8.",
                            min(times.values()) >= 1.8, quick=False))
    most = max(ranks for steps in counted.values() for ranks in steps)
    claims.append(Claim(f"Messages of the busiest rank and collectives per time step on {most:g} ranks. One rank sends nothing.",
                        holds=all(steps[1]["messages"] == 0 for steps in counted.values()), tabled=True))
    dry = [scene for scene in counted if scene in ("dry slope", "3D column")]
    claims.append(Claim("Dry scenes need " + ", ".join(f"{max(steps['collectives'] for steps in counted[scene].values()):.1f}" for scene in dry)
                        + " collectives per time step on any number of ranks.", all(max(steps["collectives"] for steps in counted[scene].values()) < 5 for scene in dry)))
    if most == max(RANKS):
        strong = {scene: modelled(steps[1], 1, ns_of_one_core(rows, scene), 100) / most
                  / modelled(steps[most], most, ns_of_one_core(rows, scene), 100, 3 if "3D" in scene else 2) for scene, steps in counted.items()}
        claims.append(Claim(f"By the model, a hundred times the points of these scenes on {most:g} ranks run with an efficiency of "
                            + ", ".join(f"{value:.0%} ({scene}, {100 * counted[scene][1]['points']:.1e} points)" for scene, value in strong.items()) + ".",
                            True, quick=False))
        solves = [row for row in rows if row["question"] == "unknowns"]
        coarse, fine = ([row["CG iterations"] for row in solves if row["scene"] == f"h = {cell:g} m"] for cell in (CELLS[0], CELLS[-1]))
        claims.append(Claim(f"The pressure takes {min(coarse):.1f} to {max(coarse):.1f} CG iterations per time step with cells of {CELLS[0]:g} m and {min(fine):.1f} to {max(fine):.1f} with "
                            f"{CELLS[-1]:g} m, on 1 to 8 ranks: {2 / CELLS[0] ** 2:.0f} and {2 / CELLS[-1] ** 2:.0f} unknowns.", max(fine) < 3 * min(coarse), quick=False))
    return claims


def table(rows):
    lines, most = [("scene", "points", "two ranks over one (bound 1.8)", "messages on 64 ranks", "collectives", "kB of the busiest rank")], max(RANKS)
    for scene in SCENES:
        steps = per_step(rows, scene)
        lines.append((scene, f"{steps[1]['points']:.0f}", f"{speed_up(rows, scene):.2f}", f"{steps[most]['messages of busiest']:.0f}",
                      f"{steps[most]['collectives']:.0f}", f"{1e-3 * steps[most]['bytes of busiest']:.0f}"))
    return [*lines, ("dam break, 205000 points", "205000", f"{speed_up(rows, 'dam break, 205000 points'):.2f}", "-", "-", "-")]


def draw(figure, rows):
    if not any(row["question"] == "two ranks" for row in rows):
        return
    messages, speeds = figure.subplots(1, 2)
    for index, scene in enumerate(SCENES):
        steps = per_step(rows, scene)
        ranks = list(steps)
        ns, dimensions = ns_of_one_core(rows, scene), 3 if "3D" in scene else 2
        messages.plot(ranks[1:], [steps[number]["messages of busiest"] for number in ranks[1:]], marker="o", markersize=4, color=f"C{index}")
        one = modelled(steps[1], 1, ns, 100)
        speeds.plot(ranks, [one / modelled(steps[number], number, ns, 100, dimensions) for number in ranks], color=f"C{index}", marker="o", markersize=4, label=scene)
    speeds.plot(RANKS, RANKS, color="0.6", linewidth=1, label="ideal")
    for plot, label in ((messages, "messages of the busiest rank per time step"), (speeds, "speed-up by the model,\n100 times the points")):
        plot.set(xscale="log", yscale="log", xlabel="ranks", ylabel=label)
        tick_axis(plot.yaxis)
        plot.set_xticks(RANKS, RANKS, minor=False)
        plot.minorticks_off()
    name_lines(speeds)


STUDY = Study(title="Parallel runs: messages and load balance",
              question="How do runs scale with the number of ranks?",
              advice="Use as many ranks as keep some ten thousand points each; free water scales worst.",
              base="prm/slopes/slope_dense.prm", variants=variants(), measure=measure, verdict=verdict, environment=environment,
              quick=lambda labels: labels["question"] == "counts" and labels["ranks"] <= 2 and labels["scene"] in ("dry slope", "dam break"),
              table=table, chart=Curves(draw, 3.6, timed=True))
