# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws maps of a run over the shaded relief of its ground.

scree-relief results/mountain_dry --maps thickness_00s,largest_thickness,largest_speed

Reads the run's `maps` and, for the relief, the raster of its bed. Writes relief.png into the run folder.
"""

import pathlib

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np

from scree import variants
from scree.command import Command
from scree.results import Raster, map_file, read_raster

UNITS = {"thickness": "m", "deposit": "m", "mass": "kg/m^2", "speed": "m/s", "time": "s"}  # by the end of a map's name


def unit_of(name):
    words = name.split("_")
    return next((UNITS[word] for word in reversed(words) if word in UNITS), "")


def cut(ground, lower, upper):
    """The cells of a raster that a window touches."""
    rows, columns = ground.values.shape
    left, right = (int(np.clip(round((corner[0] - ground.x) / ground.width) + more, 0, columns)) for corner, more in ((lower, -1), (upper, 1)))
    bottom, top = (int(np.clip(round((corner[1] - ground.y) / ground.width) + more, 0, rows)) for corner, more in ((lower, -1), (upper, 1)))
    return Raster(ground.values[rows - top:rows - bottom, left:right], ground.x + left * ground.width, ground.y + bottom * ground.width, ground.width)


def draw_relief(axes, ground):
    """Light from the north-west; contours of the height."""
    light = matplotlib.colors.LightSource(azdeg=315, altdeg=35)
    filled = np.where(np.isnan(ground.values), np.nanmin(ground.values), ground.values)
    axes.imshow(light.hillshade(filled, dx=ground.width, dy=ground.width), cmap="gray", vmin=-0.7, vmax=1.3, extent=ground.extent, interpolation="bilinear")
    x = ground.x + (np.arange(ground.values.shape[1]) + 0.5) * ground.width
    y = ground.y + (ground.values.shape[0] - np.arange(ground.values.shape[0]) - 0.5) * ground.width
    lines = axes.contour(x, y, ground.values, levels=12, colors="0.25", linewidths=0.4)
    axes.clabel(lines, fontsize=5, fmt="%.0f")


def draw(run, names, output):
    entries = variants.read_entries(run / "parameters.prm")
    raster = variants.file_named(run / "parameters.prm", entries.get("Bed/Raster", ""))
    origin = [float(word) for word in entries.get("Local origin", "0, 0").split(",")] + [0.]
    lower, upper = ([float(word) + start for word, start in zip(entries[f"Mesh/{side} corner"].split(","), origin)] for side in ("Lower", "Upper"))
    figure, all_axes = plt.subplots(1, len(names), squeeze=False, layout="constrained", figsize=(4.6 * len(names), 4.6))
    for axes, name in zip(all_axes[0], names):
        values = read_raster(map_file(run, name))
        if raster:
            draw_relief(axes, cut(read_raster(raster), lower, upper))
        shown = np.ma.masked_where(~(values.values > 0.) | np.isnan(values.values), values.values)
        image = axes.imshow(shown, cmap="plasma", alpha=0.75, extent=values.extent, interpolation="nearest")
        figure.colorbar(image, ax=axes, shrink=0.75, label=f"{name.replace('_', ' ')} ({unit_of(name)})", pad=0.02)
        axes.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), xlabel="x (m)", ylabel="y (m)", aspect="equal")
        axes.ticklabel_format(useOffset=False, style="plain")
        axes.tick_params(labelsize=6)
        axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(4))
    figure.savefig(output, dpi=130)
    print(f"Wrote {output}")


def main():
    parser = Command("scree-relief", __doc__)
    parser.add_argument("run", type=pathlib.Path, help="run folder with a folder maps, for instance results/mountain_dry")
    parser.add_argument("--maps", default="largest_thickness", help="names of maps without ending, separated by commas; default: largest_thickness")
    parser.add_argument("--output", type=pathlib.Path, help="picture; default: relief.png in the run folder")
    parser.run(lambda arguments: draw(arguments.run, arguments.maps.split(","), arguments.output or arguments.run / "relief.png"))
