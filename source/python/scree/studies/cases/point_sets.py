# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/point_sets.md."""
import math
import re

import numpy as np

from scree import results
from scree.pictures import fields, plane
from scree.studies.charts import Pictures
from scree.studies.study import Claim, Study, Variant, axis, product

SOILS = {"dense": "slopes/slope_saturated_dense", "loose": "slopes/slope_saturated_loose", "Mohr-Coulomb": "slopes/slope_saturated_mohr_coulomb"}
SHOWN = (1., 4., 12.)  # s
CELL = 0.05  # m, of the cases


def soil(name):
    return Variant({"soil": name}, {}, f"prm/{SOILS[name]}.prm")


def deposit_angle(soil):
    """Slope of the deposit, degrees: a line through its surface from 20 to 80 % of its height; nan without one.

    The surface is the highest point in each strip of a cell's width; a strip counts down the slope from the crest on.
    """
    strips = np.floor(soil.positions[:, 0] / CELL).astype(int)
    tops = {strip: np.max(soil.positions[strips == strip, 1]) for strip in np.unique(strips)}
    x = (np.array(sorted(tops)) + 0.5) * CELL
    y = np.array([tops[strip] for strip in sorted(tops)])
    crest = np.max(np.flatnonzero(y >= 0.8 * np.max(y)))
    on_slope = (np.arange(len(x)) >= crest) & (y > 0.2 * np.max(y))
    return math.degrees(math.atan(-np.polyfit(x[on_slope], y[on_slope], 1)[0])) if np.sum(on_slope) >= 3 else math.nan


def pressure_share(run):
    """Part of the steps' time that the pressure takes, %; nan for a run that broke."""
    log = run.folder / "log.txt"
    shares = re.findall(r"^pressure: .* ([\d.]+) %", log.read_text(encoding="utf-8") if log.exists() else "", re.MULTILINE)
    return sum(map(float, shares)) if shares else math.nan


def measure(run):
    time, whole = run.time, run.labels["end"] > 1
    water, oscillation = run.statistics("Water mass (kg)") + run.statistics("Water lost (kg)"), run.statistics("p oscillation (-)")
    return {"reached (s)": time[-1], "pressure share (%)": pressure_share(run), "front 90 % (m)": run.statistics("Front 90 % (m)")[-1],
            "front 99.5 % (m)": run.statistics("Front 99.5 % (m)")[-1], "water front 99.5 % (m)": run.statistics("Water front 99.5 % (m)")[-1],
            "angle (degrees)": deposit_angle(run.points()) if whole else math.nan,
            "p oscillation": np.trapz(oscillation, time) / np.ptp(time), "largest suction (kPa)": -1e-3 * np.nanmin(run.statistics("Smallest p (Pa)")),
            "change of water mass": water[-1] / water[0] - 1, "numerical dissipation (J)": run.statistics("Numerical dissipation (J)")[-1],
            "J released": run.statistics("Potential energy (J)")[0] - run.statistics("Potential energy (J)")[-1]}


def verdict(rows):
    def pair(soil, whole):
        chosen = [row for row in rows if row["soil"] == soil and (row["end"] > 1) == whole]
        return [next((row for row in chosen if row["points"] == points), None) for points in ("double", "single")]

    costs = {name: double["core-seconds"] / single["core-seconds"] for name in ("dense", "loose")
             for double, single in [pair(name, False)] if double}
    claims = [Claim("Double-point takes " + ", ".join(f"{cost:.2f} ({name})" for name, cost in costs.items()) + " times the processor time of "
                    "single-point for a step, not the published 1.14 to 1.16.", holds=all(cost < 1.14 for cost in costs.values()), quick=False)]
    if not any(row["end"] > 1 for row in rows):
        return claims + [Claim("Double-point conserves the mass of the water.",
                               holds=all(abs(row["change of water mass"]) < 1e-12 for row in rows if row["points"] == "double"))]

    sand = {name: pair(name, True) for name in ("dense", "loose")}
    shares = [row["pressure share (%)"] for row in rows if row["end"] > 1 and math.isfinite(row["pressure share (%)"])]
    stopped, fluid = pair("Mohr-Coulomb", True)[1], pair("Mohr-Coulomb", True)[0]

    def each(form, value):
        return " and ".join(f"{form.format(value(double, single))} ({name})" for name, (double, single) in sand.items())

    def taken(row):
        return 100 * row["numerical dissipation (J)"] / row["J released"]

    return claims + [
        Claim(f"The pressure takes {min(shares):.0f} to {max(shares):.0f} % of the time of the time steps.", holds=max(shares) < 30),
        Claim("Single-point Nor-Sand is not unstable here: both slopes run to their end, with "
              + each("{:.1f}", lambda double, single: single["p oscillation"] / double["p oscillation"]) + " times the oscillation of p.",
              holds=all(row["ended"] for both in sand.values() for row in both)),
        Claim("Single-point Nor-Sand is not too stiff: its front ends "
              + each("{:.1f} %", lambda double, single: 100 * (single["front 99.5 % (m)"] / double["front 99.5 % (m)"] - 1))
              + " farther, as the pores that open fill with water that did not exist. The mass of the water changes by "
              + each("{:+.1f} %", lambda double, single: 100 * single["change of water mass"])
              + ". Double-point conserves the mass of the water.",
              holds=all(single["front 99.5 % (m)"] > double["front 99.5 % (m)"] and single["change of water mass"] > 0.01
                        and abs(double["change of water mass"]) < 1e-9 for double, single in sand.values())),
        Claim("The numerical dissipation over the released energy is " + each("{:.0f} %", lambda double, single: taken(double)) + " double-point, "
              + each("{:.0f} %", lambda double, single: taken(single)) + " single-point. A negative value is an artificial energy gain.",
              holds=all(double["numerical dissipation (J)"] > 0 for double, _ in sand.values())),
        Claim(f"Single-point fails where soil is thrown about: the Mohr-Coulomb slope stops at {stopped['reached (s)']:.1f} s with "
              f"{stopped['p oscillation'] / fluid['p oscillation']:.1f} times the oscillation of p; double-point runs to the end.",
              holds=fluid["ended"] and not stopped["ended"], worst=True),
    ]


def table(rows):
    return [("soil, water", "front of 99.5 % (m)", "p oscillation (-)", "change of water mass", "dissipation over released energy", "ended at (s)"),
            *((f"{row['soil']}, {row['points']}-point", f"{row['front 99.5 % (m)']:.2f}", f"{row['p oscillation']:.3f}",
               *((f"{100 * row['change of water mass']:+.1f} %", f"{100 * row['numerical dissipation (J)'] / row['J released']:.0f} %") if row["ended"]
                 else ("diverges", "diverges")), f"{row['reached (s)']:.1f}") for row in rows if row["end"] > 1)]


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
            plot.text(0.97, 0.9, f"{soil_name}, t = {time:g} s", transform=plot.transAxes, ha="right", va="top", fontsize=9)
    plots[0, 0].set_title("double-point", fontsize="medium")
    plots[0, 1].set_title("single-point", fontsize="medium")
    figure.colorbar(drawn, ax=plots, label=fields.field_label("pressure"), extend="both", aspect=50)


POINTS = axis("points", "Water/Point sets", ["double", "single"])
STUDY = Study(title="Double-point and single-point formulation",
              question="May water share the points of the soil, and what does the double-point formulation cost?",
              advice="Use double-point water, the default. Single-point creates water where pores open.",
              base="prm/slopes/slope_saturated_dense.prm", needs_end=False,
              entries={"Output/Checkpoint interval": 1},
              variants=product([soil(name) for name in SOILS], POINTS, axis("end", "End time", [12]))
              + product([soil(name) for name in ("dense", "loose")], POINTS,
                        axis("end", lambda end: {"End time": end, "Output/Graphics": "none"}, [0.06])),
              quick=lambda labels: labels["end"] < 1 and labels["soil"] == "dense", measure=measure, verdict=verdict, table=table,
              chart=Pictures(draw, 7.5, timed=True))
