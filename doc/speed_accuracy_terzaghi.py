#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Chart of speed against accuracy: Terzaghi's consolidation with several meshes, steps, point sets and bases.

/usr/bin/python3 doc/speed_accuracy_terzaghi.py

Variants of prm/terzaghi.prm, one at a time on one core. Writes doc/figures/speed_accuracy_terzaghi.csv and .svg: error of p over
the core-seconds of the steps, a curve a method over its meshes; runs that no other beats in both are ringed. The error is the root mean
square of the L2 errors of p/q at T_v = 0.1, 0.5 and 1; the table has each of them, that of U, and the error against the solution with
inertia (doc/closed_forms.py), which Terzaghi's leaves out, so that orders of convergence are not hidden by it. A run that is
there already for the same parameters is not repeated (--again repeats it): do so on an idle machine.

It shows: second order in the cell size for both bases and both point sets, from 10 to 40 cells; the step hardly matters, as the
error is that of the mesh even at C = 0.9, so that the largest step wins; double- and single-point agree within 1 % with splines;
linear functions are as accurate as splines, on regular points that hardly move. (The .png is the same chart.)
"""

import argparse
import csv
import itertools
import math
import pathlib
import sys

import numpy as np

import closed_forms
import render
import runs
import variants
from render import plt
from runs import ROOT

FACTORS = (0.1, 0.5, 1.)
LOAD = 100.  # Pa, a tenth of the case's: Terzaghi's strain is small, and a settlement of 9e-4 H alone changes p/q by 5e-4
BASE = ROOT / "prm" / "terzaghi.prm"
COLOURS = {("spline", "double"): "C0", ("spline", "single"): "C1", ("linear", "double"): "C2", ("linear", "single"): "C3"}
MARKERS = ["o", "s", "^", "D", "v"]


def column_of(entries):
    """The consolidating column of a case, with grain density and porosity."""
    modulus = closed_forms.oedometric_modulus(float(entries["Soil/Linear elastic/Young's modulus"]),
                                              float(entries["Soil/Linear elastic/Poisson's ratio"]))
    column = closed_forms.Terzaghi(1., -float(entries["Surface load/Traction"].split(";")[1]), modulus,
                                   float(entries["Water/Hydraulic conductivity"]))
    return column, float(entries["Soil/Grain density"]), float(entries["Soil/Initial porosity"])


def run_variant(basis, point_sets, courant, cells, arguments):
    """Runs one variant unless it is there; returns its line of the table."""
    column, grain_density, porosity = column_of(variants.read_entries(BASE))
    column = column._replace(load=LOAD)
    size = 1 / cells
    folder, exit_code = runs.run_variant(
        BASE, f"{basis}_{point_sets}_C{courant:g}_{cells}",
        {"Mesh/Basis": basis, "Surface load/Traction": f"0; {-LOAD:g}", "Mesh/Cell size": f"{size:.12g}", "Mesh/Upper corner": f"{2 * size:.12g}, 1.2",
         "Surface load/Upper corner": f"{2 * size:.12g}, 1", "Water/Point sets": point_sets,
         "Time step/Courant number": f"{courant:g}", "End time": repr(column.time(1)), "Output/Interval": repr(column.time(0.1)),
         "Output/Graphics": "points"},
        arguments, ranks=1)
    line = {"basis": basis, "point sets": point_sets, "Courant number": courant, "cells": cells, "ended": exit_code == 0}
    line.update({name: math.nan for name in ("steps", "core-seconds", "error", "error with inertia",
                                             *(f"L2 error, T_v = {factor:g}" for factor in FACTORS), "largest error of U")})
    if exit_code != 0:
        return line
    line["steps"] = int(render.read_statistics(folder)["Step"][-1])
    line["core-seconds"] = runs.core_seconds(folder, 1)
    errors, with_inertia, degrees = [], [], []
    for factor in FACTORS:
        water, soil = (render.read_points(folder, column.time(factor), collection) for collection in ("water", "points"))
        depth = 1 - water.positions[:, 1]
        pressure = water.arrays["pressure"] / column.load
        exact, _ = closed_forms.consolidation_with_inertia(column, grain_density, porosity, depth, column.time(factor))
        errors.append(math.sqrt(np.mean((pressure - closed_forms.terzaghi_pressure(depth, factor))**2)))
        with_inertia.append(math.sqrt(np.mean((pressure - exact)**2)))
        degrees.append(abs(-np.mean(soil.arrays["stress"][:, 4]) / column.load - closed_forms.terzaghi_degree(factor)))
        line[f"L2 error, T_v = {factor:g}"] = errors[-1]
    line["error"] = math.sqrt(np.mean(np.square(errors)))
    line["error with inertia"] = math.sqrt(np.mean(np.square(with_inertia)))
    line["largest error of U"] = max(degrees)
    return line


def mark_pareto(lines):
    """A run is on the front if none is both faster and more accurate."""
    for line in lines:
        line["Pareto"] = bool(math.isfinite(line["error"]) and math.isfinite(line["core-seconds"]) and not any(
            other["error"] <= line["error"] and other["core-seconds"] <= line["core-seconds"]
            and (other["error"], other["core-seconds"]) != (line["error"], line["core-seconds"]) for other in lines))


def print_orders(lines):
    """Order of convergence in the cell size (and the step with it) between neighbouring meshes, against the solution with inertia."""
    for method, group in itertools.groupby(lines, key=lambda line: (line["basis"], line["point sets"], line["Courant number"])):
        group = list(group)
        orders = [math.log(a["error with inertia"] / b["error with inertia"]) / math.log(b["cells"] / a["cells"])
                  for a, b in zip(group, group[1:]) if a["ended"] and b["ended"]]
        print(f"{method[0]}, {method[1]}, C = {method[2]:g}: errors " + ", ".join(f"{line['error with inertia']:.2e}" for line in group)
              + "; orders " + ", ".join(f"{order:.2f}" for order in orders))


def draw(lines, output):
    figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
    courants = sorted({line["Courant number"] for line in lines})
    for method, group in itertools.groupby(lines, key=lambda line: (line["basis"], line["point sets"], line["Courant number"])):
        group = [line for line in group if math.isfinite(line["error"])]
        if not group:
            continue
        index = courants.index(method[2])
        axes.plot([line["core-seconds"] for line in group], [line["error"] for line in group], color=COLOURS.get(method[:2], "k"),
                  marker=MARKERS[index % len(MARKERS)], markersize=5, linestyle=["-", "--", ":", "-."][index % 4], linewidth=1,
                  label=f"{method[0]}, {method[1]}-point, C = {method[2]:g}")
        for line in group:
            axes.annotate(str(line["cells"]), (line["core-seconds"], line["error"]), textcoords="offset points", xytext=(4, 3),
                          fontsize="x-small", color="0.4")
    front = sorted((line["core-seconds"], line["error"]) for line in lines if line["Pareto"])
    if front:
        axes.plot(*zip(*front), linestyle="none", marker="o", markersize=12, markerfacecolor="none", markeredgecolor="k",
                  label="not beaten in both (Pareto)")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("core-seconds of the steps")
    axes.set_ylabel("error of p/q, rms of T_v = 0.1, 0.5, 1")
    axes.set_title("Terzaghi's consolidation; the numbers are cells over the height", fontsize="medium")
    axes.grid(alpha=0.3, which="both")
    axes.legend(fontsize="small")
    for suffix in (".svg", ".png"):
        figure.savefig(output.with_suffix(suffix), dpi=120)
    plt.close(figure)


def main():
    def list_of(kind):
        return lambda text: [kind(word) for word in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=list_of(int), default=[10, 20, 40], help="over the height, separated by commas; multiples of 5")
    parser.add_argument("--courant", type=list_of(float), default=[0.1, 0.3, 0.9], help="Courant numbers")
    parser.add_argument("--bases", type=list_of(str), default=["spline", "linear"])
    parser.add_argument("--point-sets", type=list_of(str), default=["double", "single"])
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "doc" / "figures" / "speed_accuracy_terzaghi.svg",
                        help="the chart as .svg and .png; the table goes beside them")
    runs.add_arguments(parser, "speed_accuracy_terzaghi", 1800.)
    arguments = parser.parse_args()
    try:
        runs.resolve(arguments)
    except FileNotFoundError as error:
        sys.exit(f"speed_accuracy_terzaghi.py: {error}")

    lines = [run_variant(basis, point_sets, courant, cells, arguments) for basis in arguments.bases
             for point_sets in arguments.point_sets for courant in arguments.courant for cells in arguments.cells]
    mark_pareto(lines)
    print_orders(lines)
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    draw(lines, arguments.output)
    table = arguments.output.with_suffix(".csv")
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=lines[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in line.items()} for line in lines)
    print(f"Wrote {arguments.output} and {table}")


if __name__ == "__main__":
    main()
