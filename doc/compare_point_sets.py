#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the saturated slopes with water on points of its own (double-point) and on the soil's points (single-point), and draws both.

/usr/bin/python3 doc/compare_point_sets.py --times 0,1,2,4,12

Writes a picture a case, doc/figures/point_sets_<case>.png (soil points grey, water points over them coloured by p), and the
numbers of all runs in doc/figures/point_sets.csv. The longest time is the end of the runs. A run that is there already for the
same parameters is not repeated (--again repeats it); one that stopped with an error is shown at its last picture.
"""

import argparse
import csv
import math
import pathlib
import sys
from typing import NamedTuple, Optional

import numpy as np

import render
import runs
from render import plt
from runs import ROOT

TITLES = {"double": "double-point", "single": "single-point"}
FIELD = "pressure"


class Variant(NamedTuple):
    """A run of a case: its folder, and when it stopped with an error, s (None: it came to its end)."""
    case: str
    point_sets: str
    folder: pathlib.Path
    stopped_at: Optional[float]


def run_variant(base, point_sets, arguments):
    """Runs one variant unless it is there."""
    entries = {"Water/Point sets": point_sets, "End time": f"{max(arguments.times):g}"}
    if arguments.cell_size:
        entries["Mesh/Cell size"] = f"{arguments.cell_size:g}"
    folder, exit_code = runs.run_variant(base, f"{base.stem}_{point_sets}", entries, arguments)
    return Variant(base.stem, point_sets, folder, runs.stopped_at(folder, exit_code))


def pictures(variant, time):
    """(soil points, water points) of the picture next to a time; None if the run wrote none."""
    try:
        return render.read_points(variant.folder, time), render.read_points(variant.folder, time, "water")
    except (OSError, ValueError):
        return None


# Numbers --------------------------------------------------------------------------------------------------------------


def deposit_angle(soil, cell_size):
    """Slope of the deposit, degrees: a line through its surface from 20 to 80 % of its height; nan without one.

    The surface is the highest point in each strip of a cell's width; a strip counts down the slope from the crest on.
    """
    strips = np.floor(soil.positions[:, 0] / cell_size).astype(int)
    tops = {strip: np.max(soil.positions[strips == strip, 1]) for strip in np.unique(strips)}
    x = (np.array(sorted(tops)) + 0.5) * cell_size
    y = np.array([tops[strip] for strip in sorted(tops)])
    crest = np.max(np.flatnonzero(y >= 0.8 * np.max(y)))
    on_slope = (np.arange(len(x)) >= crest) & (y > 0.2 * np.max(y))
    if np.sum(on_slope) < 3:
        return np.nan
    return math.degrees(math.atan(-np.polyfit(x[on_slope], y[on_slope], 1)[0]))


def numbers(variant):
    """One line of the table, at the last row of the statistics and in the last picture."""
    line = {"case": variant.case, "point sets": variant.point_sets,
            "stopped": "no" if variant.stopped_at is None else "yes"}
    empty = ["time (s)", "steps", "front 90 % (m)", "front 99.5 % (m)", "water front 99.5 % (m)", "angle of deposit (degrees)",
             "p oscillation (time mean)", "largest p (kPa)", "smallest p (kPa)", "water mass change", "water outside soil (part)",
             "volume error"]
    line.update({name: "" for name in empty})
    if not (variant.folder / "statistics").exists():
        return line
    statistics = render.read_statistics(variant.folder)
    time = statistics["Time (s)"]
    if len(time) == 0:
        return line
    water = statistics["Water mass (kg)"] + statistics["Water lost (kg)"]
    oscillation = statistics["p oscillation (-)"]
    values = {
        "time (s)": time[-1], "steps": statistics["Step"][-1], "front 90 % (m)": statistics["Front 90 % (m)"][-1],
        "front 99.5 % (m)": statistics["Front 99.5 % (m)"][-1], "water front 99.5 % (m)": statistics["Water front 99.5 % (m)"][-1],
        "p oscillation (time mean)": np.trapz(oscillation, time) / np.ptp(time) if np.ptp(time) > 0 else oscillation[-1],
        "largest p (kPa)": 1e-3 * np.nanmax(statistics["Largest p (Pa)"]),
        "smallest p (kPa)": 1e-3 * np.nanmin(statistics["Smallest p (Pa)"]),
        "water mass change": water[-1] / water[0] - 1,
        "water outside soil (part)": statistics["Water outside soil (kg)"][-1] / statistics["Water mass (kg)"][-1],
        "volume error": statistics["Volume error (-)"][-1],
    }
    picture = pictures(variant, time[-1])
    if picture and len(picture[0].positions):
        values["angle of deposit (degrees)"] = deposit_angle(picture[0], render.read_box(variant.folder).cell_size)
    line.update({name: f"{value:.4g}" for name, value in values.items() if np.isfinite(value)})
    return line


# Drawing --------------------------------------------------------------------------------------------------------------


def draw(variants, times, output):
    """A row a time, a column a variant of one case."""
    shown = {(time, variant.point_sets): pictures(variant, time) for time in times for variant in variants}
    # The double-point run gives frame and colours: one that breaks must not choose them.
    reference = [shown[time, variants[0].point_sets] for time in times if shown[time, variants[0].point_sets]]
    reference = reference or [picture for picture in shown.values() if picture]
    if not reference:
        sys.exit(f"compare_point_sets.py: no run of {variants[0].case} wrote a picture; see their .log")
    pressures = np.concatenate([render.field_values(water, FIELD) for _, water in reference])
    limits = (0., max(np.percentile(pressures, 99), 1e-3))
    box = render.read_box(variants[0].folder if shown[times[0], variants[0].point_sets] else variants[-1].folder)
    reach = np.max([np.percentile(water.positions[:, :box.dim], 99.9, axis=0) for _, water in reference], axis=0)
    box = box._replace(upper=np.minimum(box.upper, box.lower + 1.1 * (reach - box.lower)))

    figure, axes = render.panels(len(times), len(variants), box, width=12.)
    for time, panels in zip(times, axes):
        for variant, panel in zip(variants, panels):
            picture = shown[time, variant.point_sets]
            if picture:
                soil, water = picture
                grey = render.draw_points(panel, soil, box, "mass", (0, 1))
                grey.set_array(None)
                grey.set_facecolor("0.72")
                drawn = render.draw_points(panel, water, box, FIELD, limits)
            if box.dim == 2:
                panel.label_outer()
                label = f"t = {picture[0].time if picture else time:.3g} s"
                if variant.stopped_at is not None and time > variant.stopped_at:
                    label += f", stopped at {variant.stopped_at:.3g} s"
                panel.text(0.97, 0.93, label, transform=panel.transAxes, ha="right", va="top",
                           color="firebrick" if "stopped" in label else "black")
    for variant, panel in zip(variants, axes[0]):
        panel.set_title(TITLES[variant.point_sets])
    figure.suptitle(variants[0].case.replace("_", " "))
    figure.colorbar(drawn, ax=axes, label=render.field_label(FIELD), extend="both", aspect=40)
    output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=150)
    plt.close(figure)
    print(f"Wrote {output}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--times", type=lambda text: [float(word) for word in text.split(",")], default=[0., 1., 2., 4., 12.],
                        help="times of the pictures, s, separated by commas; default 0,1,2,4,12")
    parser.add_argument("--cases", type=pathlib.Path, nargs="+", help="a picture each",
                        default=[ROOT / "prm" / "slope_saturated_dense.prm", ROOT / "prm" / "slope_saturated_loose.prm"])
    parser.add_argument("--cell-size", type=float, help="m; default: that of the case")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "doc" / "figures", help="folder; default doc/figures")
    runs.add_arguments(parser, "point_sets", 14400.)
    arguments = parser.parse_args()
    try:
        runs.resolve(arguments)
    except FileNotFoundError as error:
        sys.exit(f"compare_point_sets.py: {error}")
    for case in arguments.cases:
        if not case.exists():
            sys.exit(f"compare_point_sets.py: {case} is not there.")

    lines = []
    for case in arguments.cases:
        compared = [run_variant(case.resolve(), point_sets, arguments) for point_sets in TITLES]
        draw(compared, arguments.times, arguments.output / f"point_sets_{case.stem}.png")
        lines += [numbers(variant) for variant in compared]
    table = arguments.output / "point_sets.csv"
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=lines[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
    print(f"Wrote {table}")


if __name__ == "__main__":
    main()
