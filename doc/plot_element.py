#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plot what scree-element wrote: plot_element.py DIRECTORY... makes DIRECTORY/element.png of DIRECTORY/table.txt."""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")  # No display is needed.
import matplotlib.pyplot as plt
import numpy as np


def read(file):
    """Columns of the table by name, without units."""
    names = file.open().readline().split()
    values = np.loadtxt(file, skiprows=1, ndmin=2)
    return {name.split("[")[0]: values[:, i] for i, name in enumerate(names)}


def plot(directory):
    columns = read(directory / "table.txt")
    pressure = columns["mean_pressure"] / 1000
    # Laws without pores: the volume ratio stands in for the specific volume.
    volume = "specific_volume" if "specific_volume" in columns else "volume_ratio"
    curves = [
        (100 * columns["strain"], columns["stress_ratio"], "strain, %", "q/p', -"),
        (pressure, columns[volume], "p', kPa", volume.replace("_", " ") + ", -"),
        (pressure, columns["deviator_stress"] / 1000, "p', kPa", "q, kPa"),
    ]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
    for axis, (x, y, x_label, y_label) in zip(axes, curves):
        axis.plot(x, y)
        axis.set_xlabel(x_label)
        axis.set_ylabel(y_label)
        axis.grid(alpha=0.3)
    if pressure.min() > 0 and pressure.max() > 3 * pressure.min():
        axes[1].set_xscale("log")
    figure.suptitle(directory.name)
    figure.savefig(directory / "element.png", dpi=120)
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for name in sys.argv[1:]:
        plot(pathlib.Path(name))
