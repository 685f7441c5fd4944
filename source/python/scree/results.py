# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what runs wrote: tables (statistics, probes), points, the box, maps. SI units."""

import pathlib
import re
import xml.etree.ElementTree
from typing import NamedTuple

import numpy as np

from scree import variants


def bare_name(field):
    """The name of a field without its unit: "pore_pressure" of "pore_pressure [Pa]"; a name without unit as it is."""
    return re.sub(r" \[[^\]]*\]$", "", field)


class Fields(dict):
    """Arrays by the bare names of their fields, such as "pore_pressure"; "pore_pressure [Pa]", as in the file, finds the same array.

    `units` has the units by bare names, "" where there is none.
    """

    def __init__(self, arrays=()):
        """`arrays`: by names with or without units."""
        by_label = dict(arrays)
        super().__init__({bare_name(label): values for label, values in by_label.items()})
        self.units = {bare_name(label): label[len(bare_name(label)) + 2:-1] for label in by_label}

    def __missing__(self, name):
        bare = bare_name(name)
        if bare == name:
            raise KeyError(name)
        return self[bare]

    def __contains__(self, name):
        return super().__contains__(bare_name(name))

    def get(self, name, default=None):
        return super().get(bare_name(name), default)


class Points(NamedTuple):
    """The material points of one picture: time in s, positions (n, 3) in m, arrays by the names of fields in SI units."""
    time: float
    positions: np.ndarray
    arrays: Fields


class Box(NamedTuple):
    """The box of the mesh: corners in m, cell size in m, axis of gravity (0, 1, 2)."""
    lower: np.ndarray
    upper: np.ndarray
    cell_size: float
    vertical: int

    @property
    def dim(self):
        return len(self.lower)


class Raster(NamedTuple):
    """An ESRI ASCII grid or a GeoTIFF: values, the northern row first, nan where there are none; lower corner and width of a cell, m."""
    values: np.ndarray
    x: float
    y: float
    width: float

    @property
    def extent(self):
        rows, columns = self.values.shape
        return self.x, self.x + columns * self.width, self.y, self.y + rows * self.width


def read_times(run, collection="points"):
    """The times of the pictures of a run folder, s, in ascending order."""
    return np.array(sorted(_pictures(run, collection)))


def pictures_at(run, times, collection="points"):
    """The times of the pictures at `times`, s, to a millionth of the run. Throws a ValueError that lists those there are if one is missing."""
    available = read_times(run, collection)
    tolerance = 1e-6 * max(abs(available[-1]), abs(available[0]))
    nearest = [min(available, key=lambda one, wanted=wanted: abs(one - wanted)) for wanted in times]
    for wanted, found in zip(times, nearest):
        if not abs(found - wanted) <= tolerance:
            shown = [f"{time:.6g}" for time in available]
            shown = shown if len(shown) <= 20 else shown[:10] + ["..."] + shown[-10:]
            raise ValueError(f"{run} has no picture at t = {wanted:g} s; there are {len(available)}, at {', '.join(shown)} s. "
                             f"The next is at {found:.6g} s; entry \"Interval\" in subsection Output sets them.")
    return np.unique(nearest)


def read_points(run, time=None, collection="points"):
    """The points of the picture next to `time`, s; of the last one without `time`.

    `collection`: "points" for the soil's points, "water" for those of the water.
    """
    pictures = _pictures(run, collection)
    chosen = max(pictures) if time is None else min(pictures, key=lambda candidate: abs(candidate - time))
    pieces = [piece for piece in map(_read_piece, _pieces(pictures[chosen])) if piece]
    if not pieces:
        return Points(chosen, np.zeros((0, 3)), Fields())
    arrays = {label: np.concatenate([piece.arrays[label] for piece in pieces]) for label in pieces[0].arrays}
    return Points(chosen, np.concatenate([piece.positions for piece in pieces]), Fields(arrays))


def read_statistics(run):
    """The columns of the statistics file, see `read_table`."""
    return read_table(pathlib.Path(run) / "statistics")


def read_table(path):
    """The columns of a table of a run: {"Time (s)": values, ...}. A line that is not complete yet is left out."""
    names, rows = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            header = re.match(r"#\s*\d+:\s*(.*\S)", line)
            if header:
                names.append(header.group(1))
            elif line.strip() and not line.startswith("#"):
                values = [_number(word) for word in line.split()]
                if len(values) >= len(names):
                    rows.append(values[:len(names)])
    return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))


def read_box(run):
    """The box of the mesh from parameters.prm."""
    entries = variants.read_entries(pathlib.Path(run) / "parameters.prm")

    for key in ("Mesh/Lower corner", "Mesh/Upper corner", "Mesh/Cell size"):
        if key not in entries:
            raise ValueError(f"{run}/parameters.prm has no entry {key}.")

    def vector(key):
        return np.array([float(word) for word in entries[key].split(",")])

    dim = int(entries.get("Dimension", 2))
    gravity = vector("Gravity") if "Gravity" in entries else np.zeros(dim)
    vertical = int(np.argmax(np.abs(gravity[:dim]))) if np.any(gravity) else dim - 1
    return Box(vector("Mesh/Lower corner")[:dim], vector("Mesh/Upper corner")[:dim],
               float(entries["Mesh/Cell size"].split(",")[0]), vertical)


def column(statistics, name):
    """A column of `read_statistics` by its whole name, such as "Front 90 % (m)"; a KeyError lists the names if there is none."""
    if name not in statistics:
        raise KeyError(f"No column {name}; there are: {', '.join(statistics) or 'none'}.")
    return statistics[name]


def _pictures(run, collection):
    """{time: file} of a .pvd in the folder solution."""
    pvd = pathlib.Path(run) / "solution" / f"{collection}.pvd"
    if not pvd.exists():
        raise FileNotFoundError(f"{pvd} is not there: is {run} a run folder, and has the run written a picture?")
    sets = _xml(pvd).iter("DataSet")
    pictures = {float(data_set.get("timestep")): pvd.parent / data_set.get("file") for data_set in sets}
    if not pictures:
        raise ValueError(f"{pvd} lists no picture.")
    return pictures


def _pieces(path):
    """The .vtu files of a .pvtu, one a rank. VTK's own reader of .pvtu trusts its types, and crashes if they are wrong."""
    if path.suffix == ".vtu":
        return [path]
    return [path.parent / piece.get("Source") for piece in _xml(path).iter("Piece")]


def _xml(path):
    try:
        return xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        raise ValueError(f"{path} is damaged: {error}.") from error


def _read_piece(path):
    """The points of one .vtu without their time, arrays by the names in the file; None if it has none."""
    # Only pictures need VTK.
    from vtkmodules.util.numpy_support import vtk_to_numpy  # pylint: disable=import-outside-toplevel
    from vtkmodules.vtkCommonCore import vtkObject  # pylint: disable=import-outside-toplevel
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader  # pylint: disable=import-outside-toplevel

    if not path.exists():
        raise FileNotFoundError(f"{path} is not there, but the run folder lists it.")
    with open(path, "rb") as file:
        file.seek(-min(path.stat().st_size, 64), 2)
        is_whole = file.read().rstrip().endswith(b"</VTKFile>")
    vtkObject.GlobalWarningDisplayOff()  # It would print a page on a damaged file.
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    if not is_whole or reader.GetErrorCode() != 0:
        raise ValueError(f"{path} is damaged.")
    grid = reader.GetOutput()
    if grid.GetNumberOfPoints() == 0:
        return None
    data = grid.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    return Points(np.nan, vtk_to_numpy(grid.GetPoints().GetData()), arrays)


def _number(word):
    try:
        return float(word)
    except ValueError:
        return np.nan


def read_raster(path):
    """An ESRI ASCII grid, or a GeoTIFF if the name ends in .tif. Throws a ValueError at what is neither."""
    if pathlib.Path(path).suffix == ".tif":
        return _read_geo_tiff(path)
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


PIXEL_SCALE, TIE_POINT, NO_DATA, GEO_KEYS = 33550, 33922, 42113, (34735, 34736, 34737)  # numbers of a GeoTIFF's tags


def _read_geo_tiff(path):
    """The first band of a GeoTIFF with square cells along the axes."""
    # Only maps need Pillow.
    from PIL import Image, UnidentifiedImageError  # pylint: disable=import-outside-toplevel
    try:
        with Image.open(path) as image:
            tags = dict(image.tag_v2)
            values = np.array(image, dtype=float)
        width = tags[PIXEL_SCALE][0]
        column, row, _, x, y, _ = tags[TIE_POINT]
    except (AttributeError, KeyError, UnidentifiedImageError) as error:
        raise ValueError(f"{path} is no GeoTIFF ({error})") from error
    missing = float(str(tags.get(NO_DATA, "nan")).strip("\0 "))
    return Raster(np.where(values == missing, np.nan, values), x - column * width, y + (row - values.shape[0]) * width, width)


def write_map(path, raster, like):
    """Writes a raster in the format and the system of coordinates of the file `like`, and with its .prj file; -9999 where there is no value."""
    path, like = pathlib.Path(path), pathlib.Path(like)
    values = np.where(np.isfinite(raster.values), raster.values, -9999.)
    if like.suffix == ".tif":
        _write_geo_tiff(path, raster, values, like)
    else:
        rows, columns = values.shape
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"ncols {columns}\nnrows {rows}\nxllcorner {raster.x:.12g}\nyllcorner {raster.y:.12g}\ncellsize {raster.width:.12g}\nNODATA_value -9999\n")
            np.savetxt(file, values, fmt="%.6g")
    if like.with_suffix(".prj").exists():
        path.with_suffix(".prj").write_bytes(like.with_suffix(".prj").read_bytes())


def _write_geo_tiff(path, raster, values, like):
    """`values`: those of the raster, -9999 where there is none."""
    from PIL import Image, TiffImagePlugin  # pylint: disable=import-outside-toplevel
    with Image.open(like) as image:
        tags, kinds = dict(image.tag_v2), dict(image.tag_v2.tagtype)
    directory = TiffImagePlugin.ImageFileDirectory_v2()
    for tag, value in {**{tag: tags[tag] for tag in GEO_KEYS if tag in tags}, PIXEL_SCALE: (raster.width, raster.width, 0.), NO_DATA: "-9999",
                       TIE_POINT: (0., 0., 0., raster.x, raster.y + values.shape[0] * raster.width, 0.)}.items():
        directory.tagtype[tag] = kinds.get(tag, TiffImagePlugin.TiffTags.ASCII)
        directory[tag] = value
    Image.fromarray(values.astype(np.float32)).save(path, tiffinfo=directory)


def write_raster(path, values, spacing):
    """Writes an ESRI ASCII grid; the first row of `values` is the southern one, the middle of its first cell is at 0, 0."""
    rows, columns = values.shape
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"ncols {columns}\nnrows {rows}\nxllcenter 0\nyllcenter 0\ncellsize {spacing:g}\nNODATA_value -9999\n")
        np.savetxt(file, values[::-1], fmt="%.2f")
