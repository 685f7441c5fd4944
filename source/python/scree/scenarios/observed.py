# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is known of an event, table [observed] of a study, and how near a run comes to it."""

import pathlib
from typing import NamedTuple

import numpy as np

from scree import maps, results, settings, terrain
from scree.scenarios.evaluation import Result

FILES = {"impact": "raster", "deposit": "raster", "path": "table"}
KEYS = (*FILES, "thickness", "source")


class Observed(NamedTuple):
    """Rasters, above 0 where soil was and where it lay at the end; corners of a path, m; least thickness of a run that counts, m. None: not given."""
    impact: results.Raster | None
    deposit: results.Raster | None
    path: np.ndarray | None
    thickness: float


def read(folder, given):
    """The files of a table [observed], which count from `folder`. Throws a ValueError with the remedy."""
    for key in given:
        if key not in KEYS:
            raise ValueError(f'entry "{key}": there is no such entry. Write one of: {", ".join(KEYS)}')
    found = {}
    for key, kind in FILES.items():
        if key not in given:
            continue
        path = pathlib.Path(folder, str(given[key]))
        if not path.is_file():
            raise ValueError(f'entry "{key}" = {given[key]}: there is no file {path}.' + (f" {given['source']}" if "source" in given else ""))
        found[key] = results.read_raster(path) if kind == "raster" else _path(path)
    if not found:
        raise ValueError(f'nothing is observed. Write one of: {", ".join(FILES)}')
    thickness = given.get("thickness", 0.1)
    if not settings.is_number(thickness) or thickness <= 0:
        raise ValueError(f'entry "thickness" = {thickness}: write a number above 0, in m')
    return Observed(found.get("impact"), found.get("deposit"), found.get("path"), thickness)


def _path(file):
    try:
        corners = np.array([(float(row["x"]), float(row["y"])) for row in results.read_rows(file)])
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f'entry "path" = {file}: write a table with columns x and y, in m') from error
    if len(corners) < 2:
        raise ValueError(f'entry "path" = {file}: write two places or more')
    return corners


def numbers(observed, run):
    """{Result: value} of a run."""
    found = {}
    reached, left = (results.read_raster(maps.find_map(run, name)) for name in ("largest_thickness", "thickness"))
    for key, area, soil in (("impact", observed.impact, reached), ("deposit", observed.deposit, left)):
        if area is not None:
            index, missed, beyond = overlap(area, soil, observed.thickness)
            found[Result(f"{key}_index", f"Critical success index of the {key}", "-")] = index
            found[Result(f"{key}_missed", f"Missed {key} over the observed one", "-")] = missed
            found[Result(f"{key}_beyond", f"Additional {key} over the observed one", "-")] = beyond
    if observed.path is not None:
        found[Result("toe", "Toe along the path", "m")] = toe(observed.path, reached, observed.thickness)
    return found


def overlap(area, soil, least):
    """Critical success index, TP/(TP + FP + FN), and the missed and the additional part over the observed area; at the middles of the area's cells."""
    x, y = np.meshgrid(*terrain.places(area))
    is_observed = np.nan_to_num(area.values) > 0
    is_computed = np.nan_to_num(terrain.value_at(soil, x, y)) >= least
    n_both, n_observed = np.count_nonzero(is_observed & is_computed), np.count_nonzero(is_observed)
    if n_observed == 0:
        return np.nan, np.nan, np.nan
    n_beyond = np.count_nonzero(is_computed & ~is_observed)
    return n_both / (n_observed + n_beyond), 1 - n_both / n_observed, n_beyond / n_observed


def toe(path, soil, least):
    """How far along a path, m from its first corner, soil of at least `least` m has come; its places are half a cell apart, or less."""
    lengths = np.concatenate([[0.], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    along = np.unique(np.concatenate([lengths, np.arange(0., lengths[-1], soil.width / 2)]))
    has_soil = np.nan_to_num(terrain.value_at(soil, *(np.interp(along, lengths, column) for column in path.T))) >= least
    return along[has_soil].max() if np.any(has_soil) else 0.
