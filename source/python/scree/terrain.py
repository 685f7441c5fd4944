# SPDX-License-Identifier: LGPL-2.1-or-later
"""The ground below the maps of a run: heights, light and shade, contours."""

import pathlib

import matplotlib.colors
import matplotlib.ticker
import numpy as np
from scipy import ndimage

from scree import expressions, results, variants
from scree.results import Raster


def ground(run, window):
    """Heights of the bed of a run in 3D within `window`, (x, x, y, y) in map coordinates; None without a bed. Throws OSError or ValueError."""
    prm = pathlib.Path(run) / "parameters.prm"
    entries = variants.read_entries(prm)
    if entries.get("Bed/Type", "none") == "none":
        return None
    if entries.get("Bed/Raster"):
        raster = variants.file_named(prm, entries["Bed/Raster"])
        if raster is None:
            raise ValueError(f"the raster of the bed, {entries['Bed/Raster']}, is not there: the run folder or the raster has moved")
        return cut(results.read_raster(raster), window)
    if entries.get("Bed/Level set expression"):
        return _of_expression(results.read_box(run), entries["Bed/Level set expression"], results.local_origin(entries), window)
    raise ValueError("the heights of the bed are drawn only if it is given by a raster or an expression")


def _of_expression(box, text, origin, window):
    """The highest zero of a level set in each column, by linear interpolation between half cells."""
    width = box.cell_size / 2
    columns, rows = (max(2, round((window[i + 1] - window[i]) / width)) for i in (0, 2))
    x = window[0] + (np.arange(columns) + 0.5) * width - origin[0]
    y = window[3] - (np.arange(rows) + 0.5) * width - origin[1]
    heights = np.full((rows, columns), np.nan)
    z = np.linspace(box.upper[2], box.lower[2], 1 + max(2, round((box.upper[2] - box.lower[2]) / width)))  # from the top
    above = None
    for height in z:
        value = np.broadcast_to(expressions.evaluate(text, x=x[None, :], y=y[:, None], z=height), heights.shape)
        if above is not None:
            found = np.isnan(heights) & (above > 0) & (value <= 0)
            heights[found] = height + (z[0] - z[1]) * (value / (value - above))[found]
        above = value
    return Raster(heights, window[0], window[3] - rows * width, width)


def cut(raster, window):
    """The cells of a raster that a window touches, and one more on each side."""
    rows, columns = raster.values.shape
    left, right = (int(np.clip(round((x - raster.x) / raster.width) + more, 0, columns)) for x, more in ((window[0], -2), (window[1], 2)))
    bottom, top = (int(np.clip(round((y - raster.y) / raster.width) + more, 0, rows)) for y, more in ((window[2], -2), (window[3], 2)))
    return Raster(raster.values[rows - top:rows - bottom, left:right], raster.x + left * raster.width, raster.y + bottom * raster.width, raster.width)


def places(raster):
    """x and y of the centres of a raster's cells, y in the order of its rows."""
    rows, columns = raster.values.shape
    return raster.x + (np.arange(columns) + 0.5) * raster.width, raster.y + (rows - np.arange(rows) - 0.5) * raster.width


def value_at(raster, x, y):
    """Values of the cells in which places are; nan outside."""
    rows, columns = raster.values.shape
    column = np.floor((np.asarray(x) - raster.x) / raster.width).astype(int)
    row = rows - 1 - np.floor((np.asarray(y) - raster.y) / raster.width).astype(int)
    is_inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    return np.where(is_inside, raster.values[np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)], np.nan)


def nice_length(length):
    """The largest of 1, 2 and 5 times a power of ten up to a length."""
    power = 10. ** np.floor(np.log10(length))
    return max(factor * power for factor in (1, 2, 5) if factor * power <= length * (1 + 1e-9))


def contour_step(raster, count=12):
    """Height between contours, m, of which there are about `count`."""
    height = np.nanmax(raster.values) - np.nanmin(raster.values)
    return 1 / nice_length(count / height) if height > 0 else 1.


def draw_shade(axes, ground, strength, zorder, soil=None):
    """Light from the north-west, as a shadow over what lies below: it leaves its hue, and darkens it by up to `strength`; only where `soil` has values."""
    filled = np.where(np.isnan(ground.values), np.nanmin(ground.values), ground.values)
    slope = max(1e-9, np.percentile(np.hypot(*np.gradient(filled, ground.width)), 90))
    light = matplotlib.colors.LightSource(azdeg=315, altdeg=45)
    # Steep and gentle terrain get the same contrast.
    shade = light.hillshade(filled, vert_exag=0.7 / slope, dx=ground.width, dy=ground.width)
    dark = np.where(np.isnan(ground.values), 0., 0.1 + 0.9 * (1 - shade))
    # Small cells with values between the centres of large ones.
    dark = strength * ndimage.zoom(dark, max(1, round(700 / max(dark.shape))), order=1, mode="nearest", grid_mode=True)
    image = np.zeros((*dark.shape, 4))
    image[..., 3] = np.round(60 * dark) / 60  # Steps that nobody sees make a small file.
    if soil is not None:
        x, y = places(Raster(dark, ground.x, ground.y, ground.width * ground.values.shape[1] / dark.shape[1]))
        image[np.isnan(value_at(soil, *np.meshgrid(x, y))), 3] = 0.
    axes.imshow(image, extent=ground.extent, interpolation="nearest", zorder=zorder)


def draw_contours(axes, raster, zorder):
    """Contours of the height, with their heights."""
    step = contour_step(raster)
    levels = step * np.arange(np.ceil(np.nanmin(raster.values) / step), np.floor(np.nanmax(raster.values) / step) + 1)
    if len(levels) == 0:
        return
    lines = axes.contour(*places(raster), raster.values, levels=levels, colors="0.2", linewidths=0.4, alpha=0.8, zorder=zorder)
    axes.clabel(lines, levels[::2], fontsize=5.5, fmt=matplotlib.ticker.FormatStrFormatter("%g"))
