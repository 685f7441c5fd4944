# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a slide has taken from a layer: a body's thickness at the start less that at the end, from the points of the pictures, and the balance."""

import pathlib
from typing import NamedTuple

import numpy as np

from scree import maps, results, terrain, variants


class Scour(NamedTuple):
    """Rows of columns of cells from the north (2D: one row), m, nan where the body never was; volumes, m^3 (2D: m^2), at its density of the start."""
    raster: results.Raster
    start: float
    taken: float
    laid_down: float
    left: float


def scour(run, body):
    """The scour of a body, by its name, between the first and the last picture of a run. Throws a ValueError if there is no such body."""
    box, times = results.read_box(run), results.read_times(run)
    names = [name.strip() for name in variants.read_entries(pathlib.Path(run) / "parameters.prm").get("Bodies", "Soil").split(",")]
    if body not in names:
        raise ValueError(f"{run} has no body {body}; there are: {', '.join(names)}")
    if len(times) < 2:
        raise ValueError(f"{run} has no picture of the start and the end. Write them: entries Graphics and Interval of subsection Output")
    first, last = (_points(run, time, names.index(body)) for time in (min(times), max(times)))
    density = first[1].sum() / first[2].sum()
    start, end = (_columns(box, places, mass / density) for places, mass, _ in (first, last))
    area = box.cell_size**(box.dim - 1)
    change = np.where((start > 0) | (end > 0), start - end, np.nan) / area
    origin = terrain.origin_of_maps(variants.read_entries(pathlib.Path(run) / "parameters.prm"), 3) if box.dim == 3 else (0., 0.)
    raster = results.Raster(change, box.lower[0] + origin[0], box.lower[1] + origin[1] if box.dim == 3 else 0., box.cell_size)
    taken, laid_down = area * np.nansum(np.maximum(change, 0)), area * np.nansum(np.maximum(-change, 0))
    return Scour(raster, start.sum(), taken, laid_down, start.sum() - end.sum())


def _points(run, time, body):
    """Positions, masses and volumes of the points of a body."""
    points = results.read_points(run, time)
    mine = points.arrays["body"] == body
    return points.positions[mine], points.arrays["mass"][mine], points.arrays["volume"][mine]


def _columns(box, places, volumes):
    """Volume in each column of cells, shared between the nearest ones as in the maps of a run."""
    counts = [round((box.upper[axis] - box.lower[axis]) / box.cell_size) for axis in range(box.dim - 1)]
    found = np.zeros(counts[::-1])
    shares = [((places[:, axis] - box.lower[axis]) / box.cell_size - 0.5) for axis in range(box.dim - 1)]
    for corner in np.ndindex(*(2,) * (box.dim - 1)):
        weight, index = volumes.copy(), []
        for axis, side in enumerate(corner):
            below = np.floor(shares[axis])
            weight = weight * (shares[axis] - below if side else 1 - (shares[axis] - below))
            index.append(np.clip(below + side, 0, counts[axis] - 1).astype(int))
        np.add.at(found, tuple(index[::-1]), weight)
    return found[None, :] if box.dim == 2 else found[::-1]


def write(run, body):
    """Writes maps/scour_BODY of a run, in 3D a raster and in 2D a table; returns the file and the scour."""
    found, folder = scour(run, body), pathlib.Path(run) / "maps"
    like = next((path for name, path in maps.map_files(run).items() if name == "largest_thickness"), folder / "scour.asc")
    folder.mkdir(exist_ok=True)
    name = f"scour_{body.replace(' ', '_')}"
    if results.read_box(run).dim == 3:
        path = folder / f"{name}{like.suffix}"
        results.write_map(path, found.raster, like)
    else:
        path = folder / f"{name}.csv"
        x, _ = terrain.places(found.raster)
        np.savetxt(path, np.column_stack([x, np.nan_to_num(found.raster.values[0])]), fmt="%.6g", delimiter=",", header=f"x_m,{name}_m", comments="")
    return path, found
