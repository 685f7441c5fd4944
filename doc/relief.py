#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws maps of a run over the shaded relief of its ground.

/usr/bin/python3 doc/relief.py results/mountain_dry --maps thickness_0s,largest_thickness,largest_speed

Reads the run's `maps` and, for the relief, the raster of its bed. Writes relief.png into the run folder. Needs Debian's python3-matplotlib.
"""

import argparse
import pathlib
import sys
from typing import NamedTuple

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.colors
    import matplotlib.pyplot as plt
    import numpy as np
except ModuleNotFoundError as missing:
    sys.exit(f"relief.py: {sys.executable} has no module {missing.name}: start this with /usr/bin/python3, and install python3-matplotlib.")

import variants

UNITS = {"thickness": "m", "deposit": "m", "mass": "kg/m^2", "speed": "m/s", "time": "s"}  # by the end of a map's name


class Raster(NamedTuple):
    """An ESRI ASCII grid: values, the northern row first, nan where there are none; lower corner and width of a cell, m."""
    values: np.ndarray
    x: float
    y: float
    width: float

    @property
    def extent(self):
        rows, columns = self.values.shape
        return self.x, self.x + columns * self.width, self.y, self.y + rows * self.width


def read_raster(path):
    head, rows = {}, []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words and words[0][0].isalpha():
                head[words[0].lower()] = float(words[1])
            elif words:
                rows += words
    try:
        columns, lines, width = int(head["ncols"]), int(head["nrows"]), head["cellsize"]
        corner = [head[f"{axis}llcorner"] if f"{axis}llcorner" in head else head[f"{axis}llcenter"] - width / 2 for axis in "xy"]
        values = np.array(rows, dtype=float).reshape(lines, columns)
    except (KeyError, ValueError) as error:
        raise ValueError(f"{path} is no ESRI ASCII grid ({error})") from error
    return Raster(np.where(values == head.get("nodata_value", -9999), np.nan, values), *corner, width)


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
        values = read_raster(run / "maps" / f"{name}.asc")
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
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("run", type=pathlib.Path, help="run folder with a folder maps, for instance results/mountain_dry")
    parser.add_argument("--maps", default="largest_thickness", help="names of maps without .asc, separated by commas; default: largest_thickness")
    parser.add_argument("--output", type=pathlib.Path, help="picture; default: relief.png in the run folder")
    arguments = parser.parse_args()
    try:
        draw(arguments.run, arguments.maps.split(","), arguments.output or arguments.run / "relief.png")
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"relief.py: {error.args[0] if isinstance(error, KeyError) else error}")


if __name__ == "__main__":
    main()
