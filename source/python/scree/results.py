# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what runs wrote: tables (statistics, probes), points, the box, maps. SI units."""

import csv
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
    """Arrays by the bare names of their fields, such as "pore_pressure" of "pore_pressure [Pa]". `units` has the units by these names, "" without one."""

    def __init__(self, arrays=()):
        super().__init__({bare_name(label): values for label, values in dict(arrays).items()})
        self.units = {bare_name(label): label[len(bare_name(label)) + 2:-1] for label in dict(arrays)}


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
    """A raster: values, the northern row first, nan where there are none; lower corner and width of a cell, m."""
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


def times_of_stages(run):
    """The times of the first and the last picture of each stage of a run folder, s: the first is that of its release."""
    times = read_times(run)
    starts = np.flatnonzero(np.diff(times) <= 1e-12 * times[1:]) + 1
    return [(times[start], times[end - 1]) for start, end in zip(starts, [*starts[1:], len(times)])]


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
    """The columns of statistics.csv, see `read_table`."""
    return read_table(pathlib.Path(run) / "statistics.csv")


class Log(NamedTuple):
    """What the log tells of a run: parts of its last start by their labels, such as "Checks", and warnings of all starts."""
    parts: dict
    warnings: list
    text: str


def read_log(run):
    """The log of a run folder; empty if there is none. A label is a word in the first 12 columns; its further lines are indented."""
    file = pathlib.Path(run) / "log.txt"
    text = file.read_text(encoding="utf-8", errors="replace") if file.exists() else ""
    parts, warnings, label = {}, [], None
    for line in text.splitlines():
        labelled = re.match(r"([A-Z][A-Za-z -]{1,9}[A-Za-z])  +(\S.*)$", line)
        if line.startswith("Scree "):
            parts, label = {"Program": line}, None
        elif labelled and len(line) - len(labelled.group(2)) == 12:
            label = labelled.group(1)
            parts[label] = labelled.group(2)
            if label == "Warning":
                warnings.append(labelled.group(2))
        elif re.match(r" {2,}\S", line) and label and not re.match(r" +[-0-9.e+]+ +[0-9]+ %", line):
            parts[label] += "\n" + line.strip()
            if label == "Warning":
                warnings[-1] += " " + line.strip()
        else:
            label = None
            if re.match(r"Check:|Unusual value|'Maximum time step' bounds|Stopped|The run before this one|.*NODATA", line):
                warnings.append(line)
    return Log(parts, warnings, text)


class Check(NamedTuple):
    """What a run has found in a check of itself; `kind`: "fault", "resolution" or "information" (doc/output.md)."""
    name: str
    value: str
    bound: str
    kind: str
    is_exceeded: bool
    place: str
    remedy: str


def read_checks(run):
    """The checks of a run, from its checks.csv; empty before its end."""
    file = pathlib.Path(run) / "checks.csv"
    if not file.exists():
        return []
    return [Check(row["check"], row["value"], row["bound"], row["class"], row["is_exceeded"] == "1", row["place"], row["remedy"]) for row in read_rows(file)]


def read_rows(path):
    """The rows of a table in CSV, {column: text}; lines that begin with # are comments."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader((line for line in file if not line.startswith("#")), skipinitialspace=True))


def write_rows(path, head, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


def read_table(path):
    """The columns of a table of a run, such as statistics.csv: {"Time (s)": values, ...}. A line that is not complete yet is left out."""
    with open(path, encoding="utf-8", newline="") as file:
        names, *rows = [*csv.reader(line for line in file if line.endswith("\n"))] or [[]]
    return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))


def read_element_table(path):
    """{column without unit: values} of a table of scree-element. Throws an OSError, or a ValueError if it is none."""
    head, _, rows = pathlib.Path(path).read_text(encoding="utf-8").partition("\n")
    names, values = [name.split("[")[0] for name in head.split()], np.array(rows.split(), float)
    if not names or not len(values) or len(values) % len(names):
        raise ValueError(f"{path} is no table of scree-element, or one without rows")
    return dict(zip(names, values.reshape(-1, len(names)).T))


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


def local_origin(entries):
    """Map coordinates of the place 0, 0, 0 of a case, m."""
    given = [float(word) for word in entries.get("Local origin", "").split(",") if word.strip()]
    return np.array((given + 3 * [0.])[:3])


def split_unit(column_name):
    """("Front 90 %", "m") of the column "Front 90 % (m)"; no unit: ""."""
    match = re.fullmatch(r"(.*?)\s*\(([^()]*)\)\s*", column_name)
    return match.groups() if match else (column_name, "")


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
    pictures = {}
    for data_set in reversed(list(sets)):
        time = float(data_set.get("timestep"))
        while time in pictures:  # A stage begins at the time at which the one before ends, which is that of its picture by a digit less.
            time = np.nextafter(time, -np.inf)
        pictures[time] = pvd.parent / data_set.get("file")
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


def _gdal():
    """Only maps and drawings need it."""
    from osgeo import gdal  # pylint: disable=import-outside-toplevel
    gdal.UseExceptions()
    return gdal


def read_raster(path):
    """The first band of a raster in any format of GDAL, with square cells along the axes. Throws a ValueError at what is none."""
    try:
        data = _gdal().Open(str(path))
        band, system = data.GetRasterBand(1), data.GetSpatialRef()
        if data.GetDriver().ShortName == "AAIGrid":  # of which GDAL reads words and what is missing at the end as 0
            words = pathlib.Path(path).read_text(encoding="utf-8").split()
            first = 2 * sum(word[0].isalpha() and word.lower() != "nan" for word in words)
            values = np.array(words[first:], dtype=float).reshape(data.RasterYSize, data.RasterXSize)
            is_valid = np.full(values.shape, True)
        else:
            values, is_valid = band.ReadAsArray().astype(float), band.GetMaskBand().ReadAsArray() > 0
    except (AttributeError, RuntimeError, ValueError) as error:
        raise ValueError(f"{path}: GDAL reads no complete raster ({error})") from error
    x, width, row_x, y, column_y, height = data.GetGeoTransform()
    if row_x or column_y or abs(abs(height) - width) > 1e-6 * width:
        raise ValueError(f"{path}: its cells are {width:g} x {height:g} m. Write squares along the axes")
    unit = band.GetUnitType() or (system and system.GetAttrValue("VERT_CS|UNIT")) or "m"
    if re.search("f(oo|ee)?t", unit, re.IGNORECASE):
        raise ValueError(f"{path}: its values are in {unit}. gdal_translate -scale 0 1 0 0.3048 -a_srs EPSG:number IN OUT makes one in m")
    missing = -9999. if band.GetNoDataValue() is None else band.GetNoDataValue()
    # As the program: the value for missing ones may be rounded otherwise than theirs.
    is_valid &= (np.abs(values) < 1e30) & ~(np.abs(values - missing) <= 1e-7 * abs(missing))
    values = np.where(is_valid, (band.GetScale() or 1.) * values + (band.GetOffset() or 0.), np.nan)
    return Raster(values, x, y + height * len(values), width) if height < 0 else Raster(values[::-1], x, y, width)


def _rings(shape):
    """The corners of all rings and lines of a geometry of GDAL."""
    parts = [shape.GetGeometryRef(i) for i in range(shape.GetGeometryCount())]
    return [ring for part in parts for ring in _rings(part)] if parts else [tuple(corner[:2] for corner in shape.GetPoints())]


def read_layer(drawing, layer):
    """The areas of a layer of a drawing as lists of rings, by the rules of source/geometry/drawing.cc: a place is in an area if it is in an odd number of them."""
    areas, lines, row = [], set(), []  # lines are holes in each other; of a table a row of corners
    data = _gdal().OpenEx(str(drawing))
    for source in (data.GetLayer(i) for i in range(data.GetLayerCount())):
        for feature in source:
            texts = {key.lower(): value for key, value in feature.items().items()}
            if (texts.get("name") or texts.get("layer") or source.GetName()) != layer:
                continue
            shape = feature.GetGeometryRef()
            if shape is None:
                row.append((float(texts["x"]), float(texts["y"])))
                if len(row) > 2 and row[0] == row[-1]:
                    lines, row = lines | {tuple(row)}, []
            elif "LINE" in shape.GetLinearGeometry().GetGeometryName():
                lines |= set(_rings(shape.GetLinearGeometry()))
            else:
                areas.append(_rings(shape.GetLinearGeometry()))
    lines |= {tuple(row)} if row else set()
    return areas + ([list(lines)] if lines else [])


def write_map(path, raster, like):
    """Writes a GeoTIFF (.tif, .tiff), else an ESRI ASCII grid, in the system of coordinates of the file `like`; -9999 where there is no value."""
    path, like = pathlib.Path(path), pathlib.Path(like)
    values = np.where(np.isfinite(raster.values), raster.values, -9999.)
    rows, columns = values.shape
    if path.suffix.lower() in (".tif", ".tiff"):
        gdal = _gdal()
        data = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, gdal.GDT_Float32, ["COMPRESS=DEFLATE"])
        data.SetGeoTransform((raster.x, raster.width, 0., raster.y + rows * raster.width, 0., -raster.width))
        if (system := gdal.Open(str(like)).GetSpatialRef()) is not None:
            system.StripVertical()
            data.SetSpatialRef(system)
        data.GetRasterBand(1).SetNoDataValue(-9999.)
        data.GetRasterBand(1).WriteArray(values)
    else:
        _write_grid(path, values, f"xllcorner {raster.x:.12g}\nyllcorner {raster.y:.12g}", raster.width, "%.6g")
    if like.with_suffix(".prj").exists():
        path.with_suffix(".prj").write_bytes(like.with_suffix(".prj").read_bytes())


def write_raster(path, values, spacing):
    """Writes an ESRI ASCII grid; the first row of `values` is the southern one, the middle of its first cell is at 0, 0."""
    _write_grid(path, values[::-1], "xllcenter 0\nyllcenter 0", spacing, "%.2f")


def _write_grid(path, values, corner, width, digits):
    rows, columns = values.shape
    head = f"ncols {columns}\nnrows {rows}\n{corner}\ncellsize {width:.12g}\nNODATA_value -9999"
    np.savetxt(path, values, digits, header=head, comments="")
