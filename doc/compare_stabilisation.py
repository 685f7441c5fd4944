#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the dry slope, dense and loose, without stabilisation, with F-bar and with modified F-bar, and draws all six.

/usr/bin/python3 doc/compare_stabilisation.py --time 1

Writes doc/figures/stabilisation.png and, next to it, the numbers in stabilisation.csv. A run that is there already for
the same parameters is not repeated (--again repeats it); one that stopped with an error is shown at its last picture.
"""

import argparse
import csv
import pathlib
import re
import sys
from typing import NamedTuple, Optional

import numpy as np

import render
import runs
from render import plt
from runs import ROOT

TITLES = {"none": "no stabilisation", "standard": "F-bar", "modified": "modified F-bar"}
FIELD = "mean_effective_stress"


class Variant(NamedTuple):
    """A run and what is left of it: its last picture up to the time of comparison, None if it wrote none."""
    case: str
    f_bar: str
    folder: pathlib.Path
    stopped_at: Optional[float]
    points: Optional[render.Points]


def run_variant(base, f_bar, arguments):
    """Runs one variant unless it is there; returns it with its points."""
    folder, exit_code = runs.run_variant(base, f"{base.stem}_{f_bar}",
                                         {"Stabilisation/F-bar": f_bar, "End time": f"{arguments.time:g}"}, arguments)
    try:
        points = render.read_points(folder, arguments.time)
    except (OSError, ValueError):
        points = None
    return Variant(base.stem, f_bar, folder, runs.stopped_at(folder, exit_code), points)


def numbers(variant, time):
    """One line of the table."""
    line = {"case": variant.case, "F-bar": variant.f_bar, "time (s)": "",
            "stopped": "no" if variant.stopped_at is None else "yes", "front 99.5 % (m)": "",
            "stress oscillation (time mean)": "", "largest mean effective stress (kPa)": ""}
    if not (variant.folder / "statistics").exists():
        return line
    statistics = render.read_statistics(variant.folder)
    times = render.column(statistics, "^time")
    if times is None or len(times) == 0:
        return line
    rows = times <= time * (1 + 1e-9)
    line["time (s)"] = f"{times[rows][-1]:.4g}"

    front = render.column(statistics, r"front.*99\.5")
    if front is not None:
        line["front 99.5 % (m)"] = f"{front[rows][-1]:.4g}"

    oscillation = render.column(statistics, "oscillation")
    if oscillation is not None:
        known = rows & np.isfinite(oscillation)
        duration = np.ptp(times[known]) if np.any(known) else 0
        if duration > 0:
            line["stress oscillation (time mean)"] = f"{np.trapz(oscillation[known], times[known]) / duration:.4g}"

    for name, values in statistics.items():
        if re.search(r"(largest|maximum|max).*(stress|\bP\b)", name, re.IGNORECASE):
            to_kilopascal = 1 if "(kPa)" in name else 1e-3
            line["largest mean effective stress (kPa)"] = f"{to_kilopascal * np.nanmax(values[rows]):.4g}"
            break
    else:
        if variant.points:
            line["largest mean effective stress (kPa)"] = f"{np.nanmax(render.field_values(variant.points, FIELD)):.4g}"
    return line


def draw(rows, time, output):
    """`rows`: for each case its variants in the order of TITLES."""
    modified = [variant for row in rows for variant in row if variant.f_bar == "modified" and variant.points]
    if not modified:
        sys.exit("compare_stabilisation.py: the runs with modified F-bar wrote no picture; see their .log")
    # The runs that oscillate must not choose the colours, nor their flying points the frame.
    limits = (0., np.percentile(np.concatenate([render.field_values(variant.points, FIELD) for variant in modified]), 95))
    box = render.read_box(modified[0].folder)
    shown = [variant.points for variant in modified] + [render.read_points(variant.folder, 0) for variant in modified]
    reach = np.max([points.positions[:, :2].max(axis=0) for points in shown if len(points.positions)], axis=0)
    box = box._replace(upper=np.minimum(box.upper, box.lower + 1.1 * (reach - box.lower)))

    figure, axes = render.panels(len(rows), len(TITLES), box, width=14.)
    for row, panels in zip(rows, axes):
        for variant, panel in zip(row, panels):
            if variant.points:
                drawn = render.draw_points(panel, variant.points, box, FIELD, limits)
            panel.label_outer()
            if variant.stopped_at is not None:
                panel.text(0.97, 0.93, f"stopped at t = {variant.stopped_at:.3g} s", transform=panel.transAxes, ha="right",
                           va="top", color="firebrick")
        panels[0].set_ylabel(f"{row[0].case.replace('_', ' ')}\n\ny (m)")
    for panel, title in zip(axes[0], TITLES.values()):
        panel.set_title(title)
    figure.colorbar(drawn, ax=axes, label=f"{render.field_label(FIELD)}, t = {time:g} s", extend="max", aspect=30)
    output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=150)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--time", type=float, default=1., help="time of the comparison and end of the runs, s")
    parser.add_argument("--cases", type=pathlib.Path, nargs="+", help="one row each",
                        default=[ROOT / "prm" / "slope_dense.prm", ROOT / "prm" / "slope_loose.prm"])
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "doc" / "figures" / "stabilisation.png")
    runs.add_arguments(parser, "stabilisation")
    arguments = parser.parse_args()
    try:
        runs.resolve(arguments)
    except FileNotFoundError as error:
        sys.exit(f"compare_stabilisation.py: {error}")
    for case in arguments.cases:
        if not case.exists():
            sys.exit(f"compare_stabilisation.py: {case} is not there.")

    rows = [[run_variant(case.resolve(), f_bar, arguments) for f_bar in TITLES] for case in arguments.cases]
    draw(rows, arguments.time, arguments.output)
    table = arguments.output.with_suffix(".csv")
    with open(table, "w", newline="", encoding="utf-8") as file:
        lines = [numbers(variant, arguments.time) for row in rows for variant in row]
        writer = csv.DictWriter(file, fieldnames=lines[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
    print(f"Wrote {arguments.output} and {table}")


if __name__ == "__main__":
    main()
