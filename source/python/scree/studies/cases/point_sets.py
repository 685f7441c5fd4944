# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/point_sets.md."""
import math
import re

import numpy as np

from scree import results
from scree.pictures import fields, plane
from scree.studies import Pictures, Span, Study, Variant, axis, product, tabled

SOILS = {"dense": "slopes/slope_saturated_dense", "loose": "slopes/slope_saturated_loose",
         "Mohr-Coulomb": "slopes/slope_saturated_mohr_coulomb"}
FRONT, OSCILLATION, WATER = "front 99.5 % (m)", "p oscillation", "change of water mass"
SHOWN = (1., 4., 12.)  # s


def soil(name):
    return Variant({"soil": name}, {}, f"prm/{SOILS[name]}.prm")


def pressure_share(run):
    """Part of the steps' time that the pressure takes, %; nan for a run that broke."""
    log = run.folder / "log.txt"
    shares = re.findall(r"^pressure: .* ([\d.]+) %", log.read_text(encoding="utf-8") if log.exists() else "",
                        re.MULTILINE)
    return sum(map(float, shares)) if shares else math.nan


def measure(run):
    time, potential = run.time, run.statistics("Potential energy (J)")
    water = run.statistics("Water mass (kg)") + run.statistics("Water lost (kg)")
    oscillation = run.statistics("p oscillation (-)")
    return {"reached (s)": time[-1], "pressure share (%)": pressure_share(run),
            FRONT: run.statistics("Front 99.5 % (m)")[-1],
            OSCILLATION: np.trapz(oscillation, time) / np.ptp(time),
            WATER: water[-1] / water[0] - 1,
            "numerical dissipation (J)": run.statistics("Numerical dissipation (J)")[-1],
            "J released": potential[0] - potential[-1]}


def pair(rows, soil, whole):
    """(double-point, single-point) of a soil, None where it is missing; the whole run or its first steps."""
    chosen = rows.where(lambda row: row["soil"] == soil and (row["end"] > 1) == whole)
    return [chosen.first(points=points) for points in ("double", "single")]


def taken(row):
    return row["numerical dissipation (J)"] / row["J released"]


def verdict(rows, claim):
    costs = {name: double["core-seconds"] / single["core-seconds"] for name in ("dense", "loose")
             for double, single in [pair(rows, name, False)] if double}
    claim = claim.shared(costs=costs)
    claims = [claim("cost", all(cost < 1.14 for cost in costs.values()), quick=False)]
    whole = rows.where(lambda row: row["end"] > 1)
    if not whole:
        changes = rows.where(points="double").values[WATER]
        return claims + [claim("mass", all(abs(change) < 1e-12 for change in changes))]
    sand = {name: pair(rows, name, True) for name in ("dense", "loose")}
    shares = list(filter(math.isfinite, whole.values["pressure share (%)"]))
    fluid, stopped = pair(rows, "Mohr-Coulomb", True)

    def each(value):
        return {name: value(*both) for name, both in sand.items()}

    return claims + [
        claim("pressure", max(shares) < 30, shares=Span.of(shares)),
        claim("stability", all(row["ended"] for both in sand.values() for row in both),
              oscillation=each(lambda double, single: single[OSCILLATION] / double[OSCILLATION])),
        claim("front", all(single[FRONT] > double[FRONT] and single[WATER] > 0.01 and abs(double[WATER]) < 1e-9
                           for double, single in sand.values()),
              farther=each(lambda double, single: single[FRONT] / double[FRONT] - 1),
              water=each(lambda double, single: single[WATER])),
        claim("dissipation", all(double["numerical dissipation (J)"] > 0 for double, _ in sand.values()),
              double=each(lambda double, single: taken(double)), single=each(lambda double, single: taken(single))),
        claim("failure", fluid["ended"] and not stopped["ended"], worst=True, stopped=stopped,
              oscillation=stopped[OSCILLATION] / fluid[OSCILLATION])]


def table(rows):
    whole = rows.where(lambda row: row["end"] > 1)
    return tabled({"soil, water": "{0[soil]}, {0[points]}-point", "front of 99.5 % (m)": "{[front 99.5 % (m)]:.2f}",
                   "p oscillation (-)": "{[p oscillation]:.3f}", WATER: "{[of water]}",
                   "dissipation over released energy": "{[taken]}", "ended at (s)": "{[reached (s)]:.1f}"})(
        {**row, "of water": f"{100 * row[WATER]:+.1f} %" if row["ended"] else "diverges",
         "taken": f"{100 * taken(row):.0f} %" if row["ended"] else "diverges"} for row in whole)


def draw(figure, runs):
    runs = [run for run in runs if run.labels["soil"] != "Mohr-Coulomb" and run.labels["end"] > 1]
    if not runs:  # the short version
        return
    box = results.read_box(runs[0].folder)
    box = box._replace(upper=np.array([7.5, 2.1]))
    lines = [(soil, time) for soil in ("dense", "loose") for time in SHOWN]
    plots = figure.subplots(len(lines), 2, sharex=True, sharey=True)
    for run in runs:
        for (soil_name, time), pair in zip(lines, plots):
            if soil_name != run.labels["soil"]:
                continue
            plot = pair[["double", "single"].index(run.labels["points"])]
            plane.draw_points(plot, run.points(time), box, "mass", (0, 1), colour="0.72")
            drawn = plane.draw_points(plot, run.points(time, "water"), box, "pressure", (-5, 15))
            plot.label_outer()
            plot.text(0.97, 0.9, f"{soil_name}, t = {time:g} s", transform=plot.transAxes, ha="right", va="top",
                      fontsize=9)
    plots[0, 0].set_title("double-point", fontsize="medium")
    plots[0, 1].set_title("single-point", fontsize="medium")
    figure.colorbar(drawn, ax=plots, label=fields.field_label("pressure"), extend="both", aspect=50)


POINTS = axis("points", "Water/Point sets", ["double", "single"])
STUDY = Study(
    "prm/slopes/slope_saturated_dense.prm", needs_end=False, entries={"Output/Checkpoint interval": 1},
    variants=product([soil(name) for name in SOILS], POINTS, axis("end", "End time", [12]))
    + product([soil(name) for name in ("dense", "loose")], POINTS,
              axis("end", lambda end: {"End time": end, "Output/Graphics": "none"}, [0.06])),
    quick=lambda labels: labels["end"] < 1 and labels["soil"] == "dense", chart=Pictures(draw, 7.5, timed=True))
