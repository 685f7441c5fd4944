# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points of a plane run as an area without gaps: each pixel inside the material has the colour of its nearest point."""

from typing import NamedTuple

import matplotlib.colors
import matplotlib.lines
import matplotlib.patches
import numpy as np
from scipy import ndimage, spatial

from scree.pictures import rigid
from scree.pictures.fields import Scale, field_values

GROUND, STRUCTURE, WATER, WATER_LINE, SOIL_LINE, OUTLINE = "0.78", "0.45", "#cfe4f4", "#1763a6", "#7a3b10", "0.15"
WIDTH_OF_FILL = 0.3  # cells; a gap of one cell in stretched material is closed, a layer of half a cell is kept


def fitted(box, pictures):
    """The box, cut to the points of all pictures (a list of Points) and a margin of 8 % of their extent or three cells."""
    bounds = [(points.positions.min(axis=0), points.positions.max(axis=0)) for points in pictures if len(points.positions)]
    if not bounds:
        return box
    lower = np.min([low for low, _ in bounds], axis=0)[:box.dim]
    upper = np.max([high for _, high in bounds], axis=0)[:box.dim]
    margin = np.maximum(0.08 * np.max(upper - lower), 3 * box.cell_size)
    lower, upper = np.maximum(box.lower, lower - margin), np.minimum(box.upper, upper + margin)
    # A little more than the material is no reason to cut: walls of the box that are close are shown.
    size = box.upper - box.lower
    lower = np.where(lower - box.lower < 0.12 * size, box.lower, lower)
    upper = np.where(box.upper - upper < 0.12 * size, box.upper, upper)
    return box._replace(lower=lower, upper=upper)


class Pixels(NamedTuple):
    """The pixels of a panel: lower corner and width in m, numbers along x and y."""
    lower: np.ndarray
    width: float
    nx: int
    ny: int

    @property
    def centres(self):
        return [self.lower[axis] + (np.arange(n) + 0.5) * self.width for axis, n in enumerate((self.nx, self.ny))]

    @property
    def extent(self):
        return (self.lower[0], self.lower[0] + self.nx * self.width, self.lower[1], self.lower[1] + self.ny * self.width)


def pixels_of(box, longest=1300):
    size = box.upper - box.lower
    # Large cells need no more pixels.
    width = max(max(size) / longest, box.cell_size / 60)
    return Pixels(box.lower, width, *(max(1, int(np.ceil(side / width - 1e-9))) for side in size))


def point_sides(points, box):
    """Side of the square (or cube) that each point fills, m; water between grains fills the room of both."""
    if "volume" not in points.arrays:
        return np.full(len(points.positions), box.cell_size / 4)
    volumes = np.maximum(points.arrays["volume"], 0)
    if "inside_soil" in points.arrays:
        volumes = np.where(points.arrays["inside_soil"] > 0.5, volumes / np.maximum(points.arrays["porosity"], 0.1), volumes)
    sides = volumes ** (1 / box.dim)
    # A point that flies alone keeps opening; its volume is no longer the room it fills.
    return np.minimum(sides, 1.3 * np.median(sides))


def blurred(image, width):
    """Convolution with a Gaussian of `width` pixels; nothing is outside of the image."""
    return ndimage.gaussian_filter(image, width, mode="constant", radius=int(np.ceil(3 * width)))


def _pixel_of(points, pixels):
    """Row and column of each point, and which of them are in the panel."""
    column, row = ((points.positions[:, axis] - pixels.lower[axis]) / pixels.width for axis in range(2))
    row, column = np.floor(row).astype(int), np.floor(column).astype(int)
    return row, column, (row >= 0) & (row < pixels.ny) & (column >= 0) & (column < pixels.nx)


def fill(points, box, pixels, is_open, chosen=True):
    """The part of each pixel's open surroundings that the points fill: 1 inside, 1/2 on the surface of the material."""
    row, column, inside = _pixel_of(points, pixels)
    inside = inside & chosen
    areas = np.zeros((pixels.ny, pixels.nx))
    np.add.at(areas, (row[inside], column[inside]), (point_sides(points, box)[inside] / pixels.width) ** 2)
    is_open = is_open.astype(float)

    def part(cells):
        width = max(cells * box.cell_size / pixels.width, 0.5)
        return blurred(areas, width) / np.maximum(blurred(is_open, width), 0.25)

    # Small holes deep inside close: with the larger width only they are filled by 0.8.
    filled = part(WIDTH_OF_FILL)
    return np.where(part(2.5 * WIDTH_OF_FILL) > 0.8, np.maximum(filled, 0.75), filled)


def _covered(points, box, pixels, filled):
    """Which pixels the material covers, and the nearest point of each: what is filled, and the squares of points that fly outside of it."""
    places = (points.positions[:, :2] - pixels.lower[:2]) / pixels.width - 0.5
    centres = np.stack(np.meshgrid(np.arange(pixels.nx), np.arange(pixels.ny)), axis=-1)
    nearest, near = np.zeros((pixels.ny, pixels.nx), dtype=int), filled > 1e-9
    nearest[near] = spatial.cKDTree(places).query(centres[near])[1]
    half = np.maximum(0.5 * point_sides(points, box) / pixels.width, 1.)
    in_square = np.max(np.abs(places[nearest] - centres), axis=-1) <= half[nearest]
    row, column, inside = _pixel_of(points, pixels)
    is_alone = np.zeros(len(inside), dtype=bool)
    is_alone[inside] = filled[row[inside], column[inside]] < 0.5
    return near & ((filled >= 0.5) | (in_square & is_alone[nearest])), nearest


class Panel(NamedTuple):
    """One picture of a plane run in matplotlib's axes: the part of the box that is shown, and what is open in it."""
    axes: object
    box: object
    pixels: Pixels
    is_open: np.ndarray
    surfaces: list


def panel_of(axes, box, run=None, time=0., longest=1300):
    """Prepares axes; with a run folder its rigid ground is known."""
    pixels = pixels_of(box, longest)
    places = np.meshgrid(*pixels.centres)
    surfaces = rigid.rigid_surfaces(run, places, time) if run else []
    is_open = np.all([surface.level_set > 0 for surface in surfaces], axis=0) if surfaces else np.ones((pixels.ny, pixels.nx), dtype=bool)
    axes.set(xlim=(box.lower[0], box.upper[0]), ylim=(box.lower[1], box.upper[1]), aspect="equal", xlabel="x (m)", ylabel="y (m)")
    axes.locator_params(steps=[1, 2, 5, 10])  # steps of 2.5 have wide labels, for which the layout has no room
    return Panel(axes, box, pixels, is_open, surfaces)


def _show(panel, covered, colours, order):
    image = np.zeros(covered.shape + (4,))
    image[covered] = colours
    panel.axes.imshow(image, extent=panel.pixels.extent, origin="lower", interpolation="nearest", zorder=order)
    panel.axes.set(xlim=(panel.box.lower[0], panel.box.upper[0]), ylim=(panel.box.lower[1], panel.box.upper[1]))


def _line(panel, filled, colour, width, order, edge=0.):
    """The surface of a material; it has none where it touches what is rigid. `edge`: width of white on both sides, for lines over colours."""
    level = np.ma.masked_where(~panel.is_open, filled)
    if level.count() and level.min() < 0.5 < level.max():
        for one, line_width in [("white", width + 2 * edge)] * (edge > 0) + [(colour, width)]:
            panel.axes.contour(*panel.pixels.centres, level, levels=[0.5], colors=[one], linewidths=line_width, zorder=order)


def draw_material(panel, points, scale, colour=None, structures=()):
    """The points by their field, or all in one `colour`; bodies whose number is among `structures` are dark grey."""
    if len(points.positions) == 0:
        return
    body = np.round(points.arrays["body"]).astype(int) if "body" in points.arrays else np.zeros(len(points.positions), dtype=int)
    fills = [fill(points, panel.box, panel.pixels, panel.is_open, body == one) for one in np.unique(body)]
    covered, nearest = _covered(points, panel.box, panel.pixels, sum(fills))
    colours = np.tile(matplotlib.colors.to_rgba(colour or STRUCTURE), (len(body), 1))
    if colour is None:
        colours = scale.mappable.to_rgba(field_values(points, scale.name))
    colours[np.isin(body, structures)] = matplotlib.colors.to_rgba(STRUCTURE)
    _show(panel, covered, colours[nearest[covered]], 2)
    if colour is None:
        whole = sum(fills)
        _line(panel, whole, OUTLINE, 0.6, 5)
        for number, one in enumerate(fills[:-1]):
            # Where two bodies meet: both fill equal parts.
            others = np.max([other for other_number, other in enumerate(fills) if other_number != number], axis=0)
            _line(panel, np.ma.masked_where(whole < 0.5, 0.5 + one - others), OUTLINE, 0.6, 5)


def draw_water_around(panel, water):
    """Behind the soil: the water in pale blue, and its free surface, which is the water table inside the soil."""
    filled = fill(water, panel.box, panel.pixels, panel.is_open)
    covered, _ = _covered(water, panel.box, panel.pixels, filled)
    _show(panel, covered, matplotlib.colors.to_rgba(WATER), 1)
    _line(panel, filled, WATER_LINE, 1.3, 4, 0.5)


def draw_outline(panel, soil):
    """The outline of the soil, over a picture of the water."""
    if len(soil.positions):
        _line(panel, fill(soil, panel.box, panel.pixels, panel.is_open), SOIL_LINE, 1., 4, 0.6)


def draw_ground(panel):
    """Fills what is rigid: the bed light, obstacles dark."""
    for surface in sorted(panel.surfaces, key=lambda one: not one.is_bed):
        centres = panel.pixels.centres
        colour = GROUND if surface.is_bed else STRUCTURE
        panel.axes.contourf(*centres, surface.level_set, levels=[-np.inf, 0], colors=[colour], zorder=3)
        if np.min(surface.level_set) < 0 < np.max(surface.level_set):
            panel.axes.contour(*centres, surface.level_set, levels=[0], colors=["0.3"], linewidths=0.8, zorder=3.5)


def draw_points(axes, points, box, name, limits, colour=None):
    """The points of one picture in axes of their own, coloured by a field, or in one colour; returns what a colour bar needs."""
    scale = Scale(name, *limits, "neither")
    draw_material(panel_of(axes, box, longest=700), points, scale, colour)
    return scale.mappable


def legend(axes, has_soil, has_water, collection, surfaces, structures):
    """Names what has no colour of the field."""
    entries = []
    if collection == "points" and has_water:
        entries.append(matplotlib.patches.Patch(color=WATER, label="water"))
        entries.append(matplotlib.lines.Line2D([], [], color=WATER_LINE, lw=1.3, label="water surface"))
    if collection == "water" and has_soil:
        entries.append(matplotlib.lines.Line2D([], [], color=SOIL_LINE, lw=1., label="outline of the soil"))
    if any(surface.is_bed for surface in surfaces):
        entries.append(matplotlib.patches.Patch(facecolor=GROUND, edgecolor="0.3", label="bed"))
    if any(not surface.is_bed for surface in surfaces) or structures:
        entries.append(matplotlib.patches.Patch(facecolor=STRUCTURE, edgecolor="0.3", label="structure"))
    if entries:
        axes.legend(handles=entries, loc="upper right", fontsize="x-small", ncols=len(entries) if len(entries) < 3 else 2, framealpha=0.8)
