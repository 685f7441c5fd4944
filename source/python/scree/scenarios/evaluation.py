# SPDX-License-Identifier: LGPL-2.1-or-later
"""What follows from the runs of a study: numbers of each run, probabilities of exceedance, quantiles, influence of parameters."""

import math
import pathlib
from typing import NamedTuple

import numpy as np
from scipy import stats

from scree import maps, results, terrain
from scree.results import Raster

# Maps of the largest values, by the names of thresholds.
MAPS = {"thickness": "largest_thickness", "speed": "largest_speed", "pressure": "largest_impact_pressure"}
FACTOR = "factor of safety"  # as run_out: the runs are strength reductions
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


class Result(NamedTuple):
    """A number of each run: its key in the tables, its name, its unit."""
    key: str
    name: str
    unit: str

    @property
    def label(self):
        return self.name + (f" ({self.unit})" if self.unit != "-" else "")


def numbers_of(study, run):
    """{Result: value} of a run that has ended well."""
    run = pathlib.Path(run)
    if study.run_out == FACTOR:
        trials = results.read_table(run / "safety" / "safety.csv")
        factor, rests = trials["Factor (-)"], trials["Rests (-)"] > 0
        return {Result("factor", "Factor of safety", "-"): (np.max(factor[rests]) + np.min(factor[~rests])) / 2}
    box, table = results.read_box(run), results.read_statistics(run)
    name = "Run-out length (m)" if study.run_out == "distance" else study.run_out
    quantity, unit = results.split_unit(name)
    found = {Result("run_out", quantity, unit or "-"): results.column(table, name)[-1]}
    if study.run_out == "distance":
        found[Result("drop", "Drop, H", "m")] = results.column(table, "Fall height (m)")[-1]
        found[Result("h_over_l", "H/L", "-")] = results.column(table, "Run-out H/L (-)")[-1]
    peaks = peak_maps(run)
    for quantity, one in peaks.items():
        kind = maps.KINDS[MAPS[quantity]]
        found[Result(MAPS[quantity], kind.title, kind.unit)] = kind.factor * np.nanmax(np.append(one.values, 0.))
    if "thickness" in peaks:
        one = peaks["thickness"]
        size = one.width**(box.dim - 1)
        place = Result("area", "Area", "m^2") if box.dim == 3 else Result("length", "Length", "m")
        found[place] = size * np.count_nonzero(one.values >= max(study.run_out_thickness, 1e-9))
    if "Mass lost (kg)" in table:
        found[Result("mass_lost", "Mass lost", "kg")] = table["Mass lost (kg)"][-1]
    return {one: float(value) for one, value in found.items()}


def peak_maps(run):
    """{quantity: Raster} of the largest values at each place, SI units; in 2D with one row."""
    files = maps.map_files(run)
    if "profile" in files:
        profile = maps.read_profile(files["profile"])
        x = profile["x"]
        width = x[1] - x[0]
        return {quantity: Raster(profile[name][None, :], x[0] - width / 2, 0., width) for quantity, name in MAPS.items() if name in profile}
    return {quantity: results.read_raster(files[name]) for quantity, name in MAPS.items() if name in files}


def on_one_grid(rasters):
    """Rasters on the cells of the finest one, over the area of all; nan where a raster has no value."""
    first = rasters[0]
    if all(one[1:] == first[1:] and one.values.shape == first.values.shape for one in rasters):
        return rasters
    width = min(one.width for one in rasters)
    finest = next(one for one in rasters if one.width == width)
    extents = np.array([one.extent for one in rasters])
    left, bottom = (start - width * math.ceil((start - extents[:, 2 * axis].min()) / width - 1e-9) for axis, start in enumerate((finest.x, finest.y)))
    columns, rows = (max(1, math.ceil((extents[:, 2 * axis + 1].max() - start) / width - 1e-9)) for axis, start in enumerate((left, bottom)))
    empty = Raster(np.full((rows, columns), np.nan), left, bottom, width)
    x, y = terrain.places(empty)
    return [empty._replace(values=terrain.value_at(one, *np.meshgrid(x, y))) for one in rasters]


def probability(rasters, threshold):
    """The part of the runs whose value is above the threshold at each place; no value counts as below."""
    placed = on_one_grid(rasters)
    above = sum((np.nan_to_num(one.values, nan=-np.inf) > threshold).astype(int) for one in placed)
    return placed[0]._replace(values=above / len(placed))


def quantiles(values):
    """Those of QUANTILES, by linear interpolation between the sorted values."""
    return np.quantile(values, QUANTILES)


def exceedance(values):
    """Sorted values, and the part of the runs that reach or exceed each of them."""
    values = np.sort(values)
    return values, 1 - np.arange(len(values)) / len(values)


class Influence(NamedTuple):
    """Rank correlation (Spearman) of a parameter with a result; `bound`: what independent numbers stay below in 95 % of all cases."""
    label: str
    correlation: float
    bound: float


def influences(parameters, rows, values):
    """Of each parameter whose values are numbers, the strongest first."""
    found = []
    for place, one in enumerate(parameters):
        column = [row[place] for row in rows]
        if all(isinstance(value, (int, float)) for value in column) and len(set(column)) > 1 and len(set(values)) > 1:
            found.append(Influence(one.label, float(stats.spearmanr(column, values).statistic), 1.96 / math.sqrt(len(values) - 1)))
    return sorted(found, key=lambda one: -abs(one.correlation))


class Bar(NamedTuple):
    """What one parameter alone changes: its values and the results with them, the lowest value first."""
    label: str
    values: list
    results: list

    @property
    def width(self):
        return max(self.results) - min(self.results)


def tornado(parameters, rows, values):
    """(result of the base run, bars, the widest first) of a study one at a time; runs without a result are nan. None without the base run."""
    base, bars = values[0], []
    if not np.isfinite(base):
        return None
    for place, one in enumerate(parameters):
        varied = [(row[place], value) for row, value in zip(rows[1:], values[1:]) if row[place] != rows[0][place] and np.isfinite(value)]
        if varied:
            varied.append((rows[0][place], base))
            varied.sort(key=lambda pair: (isinstance(pair[0], str), pair[0]))
            bars.append(Bar(one.label, *map(list, zip(*varied))))
    return base, sorted(bars, key=lambda bar: -bar.width)
