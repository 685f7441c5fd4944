# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid ground of a run: level sets of its bed and obstacles, from their expressions, profiles, rasters and surface meshes."""

import functools
import pathlib
import re
import sys
from typing import NamedTuple

import numpy as np
from scipy import ndimage

from scree import expressions, results, variants


class Surface(NamedTuple):
    """A rigid surface at one time: name of its subsection, level set at the places asked for (positive in the open), displacement in m."""
    name: str
    level_set: np.ndarray
    displacement: np.ndarray

    @property
    def is_bed(self):
        return self.name == "Bed"


def _expression(text, places):
    """The value of a case's expression at the places."""
    value = expressions.evaluate(text, **dict(zip("xyz", places)))
    return np.broadcast_to(np.asarray(value, dtype=float), np.broadcast_shapes(*(np.shape(place) for place in places)))


def _profile(file, places):
    points = np.array([[float(word) for word in re.split(r"[,\s]+", line.strip())[:2]]
                       for line in file.read_text(encoding="utf-8").splitlines() if re.match(r"\s*[-+.0-9]", line)])
    return places[1] - np.interp(places[0], *points.T)


def _raster(file, places, origin):
    """Vertical distance from a raster's bilinear surface; open where it has no heights."""
    ground = results.read_raster(file)
    heights = ground.values[::-1]  # the southern row first
    column = (places[0] + origin[0] - ground.x) / ground.width - 0.5
    row = (places[1] + origin[1] - ground.y) / ground.width - 0.5
    z = ndimage.map_coordinates(heights, np.broadcast_arrays(row, column), order=1, mode="nearest")
    distance = places[2] + origin[2] - z
    return np.where(np.isnan(distance), np.nanmax(places[2]) - np.nanmin(places[2]) + 1., distance)


def _surface_mesh(file, places, origin):
    """Distance from a closed surface of polygons."""
    import vtk  # plane runs need none
    from vtk.util import numpy_support
    reader = {".stl": vtk.vtkSTLReader, ".obj": vtk.vtkOBJReader, ".ply": vtk.vtkPLYReader}[file.suffix.lower()]()
    reader.SetFileName(str(file))
    triangles, joined, oriented = vtk.vtkTriangleFilter(), vtk.vtkCleanPolyData(), vtk.vtkPolyDataNormals()
    oriented.AutoOrientNormalsOn()
    for before, after in ((reader, triangles), (triangles, joined), (joined, oriented)):
        after.SetInputConnection(before.GetOutputPort())
    oriented.Update()
    shape = np.broadcast_shapes(*(np.shape(place) for place in places))
    points = np.stack([np.broadcast_to(place, shape).ravel() + shift for place, shift in zip(places, origin)], axis=1)
    lower, upper = np.reshape(oriented.GetOutput().GetBounds(), (3, 2)).T
    values = np.linalg.norm(np.maximum(np.maximum(lower - points, points - upper), 0.), axis=1)  # from the box around it
    near = np.flatnonzero(values < 0.1 * np.max(upper - lower))
    distance, exact = vtk.vtkImplicitPolyDataDistance(), vtk.vtkDoubleArray()
    distance.SetInput(oriented.GetOutput())
    distance.FunctionValue(numpy_support.numpy_to_vtk(np.ascontiguousarray(points[near])), exact)
    values[near] = numpy_support.vtk_to_numpy(exact)
    return values.reshape(shape)


def displacement(run, subsection, time, dim):
    """How far an obstacle has moved, m, from the statistics of the run."""
    file = pathlib.Path(run) / "statistics.csv"
    statistics = results.read_statistics(run) if subsection != "Bed" and file.exists() else {}
    ways = [f"{subsection} displacement {axis} (m)" for axis in "xyz"[:dim]]
    return np.array([np.interp(time, statistics["Time (s)"], statistics[way]) if way in statistics else 0. for way in ways])


@functools.lru_cache
def _report(subsection, message):
    """Once, however many pictures there are."""
    print(f"scree-render: subsection {subsection} is not drawn: {message}.", file=sys.stderr)


def _level_set(prm, entries, subsection, here, origin):
    """The level set that an expression or a file gives."""
    for ending, read in (("Profile", lambda file: _profile(file, here)), ("Raster", lambda file: _raster(file, here, origin)),
                         ("Surface mesh", lambda file: _surface_mesh(file, here, origin))):
        name = entries.get(f"{subsection}/{ending}", "")
        if name:
            return read(pathlib.Path(prm).parent / name)
    return _expression(entries[subsection + "/Level set expression"], here)


def rigid_surfaces(run, places, time):
    """The bed and the obstacles of a run at `places` (arrays x, y, or x, y, z) and a time. Those that cannot be read are left out."""
    prm = pathlib.Path(run) / "parameters.prm"
    entries = variants.read_entries(prm)
    origin = results.local_origin(entries)
    surfaces = []
    for key, kind in entries.items():
        subsection, _, name = key.rpartition("/")
        if name != "Type" or not re.match(r"(Bed|Obstacle [^/]*)$", subsection) or kind == "none":
            continue
        moved = displacement(run, subsection, time, len(places))
        here = [place - way for place, way in zip(places, moved)]
        try:
            level_set = _level_set(prm, entries, subsection, here, origin)
        except (OSError, SyntaxError, NameError, TypeError, ValueError, KeyError) as error:
            _report(subsection, str(error) or type(error).__name__)
            continue
        surfaces.append(Surface(subsection, level_set, moved))
    return surfaces


def rigid_bodies(run):
    """Numbers of the bodies that are structures of points, such as nets: their material is rigid."""
    entries = variants.read_entries(pathlib.Path(run) / "parameters.prm")
    names = [name.strip() for name in entries.get("Bodies", "Soil").split(",")]
    return [number for number, name in enumerate(names) if entries.get(f"{name}/Material") == "rigid"]
