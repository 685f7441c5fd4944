# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plots what scree-element wrote: element.png of table.txt in each folder."""

import pathlib

import matplotlib.pyplot as plt
from scree import results
from scree.command import Command
from scree.pictures.panels import save_picture


def plot(directory):
    """Throws OSError or ValueError if there is no table of scree-element."""
    columns = results.read_element_table(directory / "table.txt")
    missing = [name for name in ("strain", "stress_ratio", "mean_pressure", "deviator_stress") if name not in columns]
    if missing:
        raise ValueError(f"{directory / 'table.txt'} has no column {missing[0]}: is {directory} a folder of scree-element?")
    pressure = columns["mean_pressure"] / 1000
    # Laws without pores: the volume ratio stands in for the specific volume.
    volume = next(name for name in ("specific_volume", "void_ratio", "volume_ratio") if name in columns)
    curves = [
        (100 * columns["strain"], columns["stress_ratio"], "strain, %", "q/p', -"),
        (pressure, columns[volume], "p', kPa", volume.replace("_", " ") + ", -"),
        (pressure, columns["deviator_stress"] / 1000, "p', kPa", "q, kPa"),
    ]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
    for axis, (x, y, x_label, y_label) in zip(axes, curves):
        axis.plot(x, y)
        axis.set(xlabel=x_label, ylabel=y_label)
        axis.grid(alpha=0.3)
    if pressure.min() > 0 and pressure.max() > 3 * pressure.min():
        axes[1].set_xscale("log")
    figure.suptitle(directory.name)
    save_picture(figure, directory / "element.png", 120)


def plot_all(arguments):
    for folder in arguments.folders:
        plot(folder)
        print(f"Wrote {folder / 'element.png'}")


def main():
    parser = Command("scree-plot-element", __doc__)
    parser.add_argument("folders", metavar="FOLDER", nargs="+", type=pathlib.Path, help="output directory of scree-element, for instance results/element/oedometer")
    parser.run(plot_all)
