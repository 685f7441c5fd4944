# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laboratory tests: tables in CSV with named columns and units, and the same quantities of a path of scree-element. Compression is positive."""

import csv
from typing import NamedTuple

import numpy as np

STRESS, STRAIN, RATIO = {"Pa": 1., "kPa": 1e3, "MPa": 1e6}, {"%": 1e-2, "-": 1.}, {"-": 1.}
UNITS = {"axial_strain": STRAIN, "shear_strain": STRAIN, "volume_strain": STRAIN, "void_ratio": RATIO, "deviator_stress": STRESS, "mean_pressure": STRESS,
         "vertical_stress": STRESS, "lateral_stress": STRESS, "shear_stress": STRESS, "pore_pressure": STRESS}

# By path: which column can be the strain that the path prescribes, and which ones are compared with the law.
COORDINATES = {"drained triaxial": ("axial_strain",), "undrained triaxial": ("axial_strain",), "oedometer": ("axial_strain", "volume_strain", "void_ratio"),
               "isotropic compression": ("volume_strain", "void_ratio"), "simple shear": ("shear_strain",)}
MEASURED = {"drained triaxial": ("deviator_stress", "volume_strain", "void_ratio", "mean_pressure", "vertical_stress"),
            "undrained triaxial": ("deviator_stress", "pore_pressure", "mean_pressure"),
            "oedometer": ("vertical_stress", "lateral_stress", "mean_pressure", "deviator_stress"),
            "isotropic compression": ("mean_pressure",), "simple shear": ("shear_stress", "volume_strain", "void_ratio")}


class Column(NamedTuple):
    """One quantity of a test in SI units at the rows that have it; `strain` is the coordinate at these rows, `row_weights` have the sum 1."""
    name: str
    strain: np.ndarray
    values: np.ndarray
    row_weights: np.ndarray
    weight: float
    is_logarithmic: bool

    @property
    def is_strain(self):
        return UNITS[self.name] is not STRESS

    @property
    def largest(self):
        """What differences are divided by: the largest value, of strains their range; of logarithms 1."""
        size = 1. if self.is_logarithmic else np.ptp(self.values) if self.is_strain else np.max(np.abs(self.values))
        return float(size) or 1.

    def differences(self, law):
        """The law's values less those of the test, by `largest`; of logarithms the relative difference."""
        if self.is_logarithmic:
            return np.log(np.maximum(law, 1e-9 * np.max(self.values)) / self.values)
        return (law - self.values) / self.largest

    def rms(self, law):
        """Number and unit: stresses in % of the largest one or of each, strains in % of strain."""
        rms = 100 * float(np.sqrt(np.sum(self.row_weights * self.differences(law)**2)))
        if self.is_strain:
            return rms * self.largest, "% of strain"
        return rms, "% of each" if self.is_logarithmic else "% of the largest"


def read_csv(file):
    """{name: texts} and the line numbers. Lines that begin with # are comments; the first other one has the names. Separator: comma, semicolon or tab;
    with the latter two a comma may be the decimal sign. Throws a ValueError."""
    content = file.read_bytes()
    try:
        content = content.decode("utf-8-sig")
    except UnicodeDecodeError:  # as spreadsheets of Windows write
        content = content.decode("latin-1")
    lines = [(number, line) for number, line in enumerate(content.splitlines(), 1) if line.strip(" ,;\t") and line.strip()[0] != "#"]
    if len(lines) < 2:
        raise ValueError(f"{file} has no rows. The first line that is no comment has the names of the columns, the others have numbers")
    separator = max(";\t,", key=lines[0][1].count)
    names, *rows = csv.reader([line for _, line in lines], delimiter=separator)
    names = [name.strip() for name in names]
    for (number, _), row in zip(lines[1:], rows):
        if len(row) != len(names):
            raise ValueError(f"{file}, line {number}: {len(row)} values under {len(names)} names of columns")
    texts = {name: [row[place].strip().replace(",", ".") for row in rows] for place, name in enumerate(names)}
    return texts, [number for number, _ in lines[1:]]


def numbers(file, name, texts, lines):
    """A column as numbers; NaN where a cell is empty."""
    values = np.full(len(texts), np.nan)
    for place, (cell, line) in enumerate(zip(texts, lines)):
        try:
            values[place] = float(cell) if cell else np.nan
        except ValueError as error:
            raise ValueError(f'{file}, line {line}: "{cell}" in column "{name}" is not a number') from error
    return values


def void_ratio_to_strain(values, strain):
    """Engineering or logarithmic volume strain since the first row."""
    ratio = (1 + values) / (1 + values[np.isfinite(values)][0])
    return 1 - ratio if strain == "engineering" else -np.log(ratio)


def row_weights(strain, kind):
    """By the strain between the middles to both neighbours ("strain"), or all the same ("rows")."""
    weights = np.abs(np.gradient(strain)) if kind == "strain" and len(strain) > 1 else np.ones(len(strain))
    return weights / weights.sum() if weights.sum() > 0 else np.full(len(strain), 1 / len(strain))


def final_strain(path, coordinate, largest, strain):
    """The entry "Final strain" of a path that reaches the largest value of the coordinate."""
    if coordinate == "shear_strain":
        return largest
    logarithmic = largest if strain == "logarithmic" else -np.log1p(-largest)
    return logarithmic / 3 if path == "isotropic compression" else logarithmic


def law_values(name, table, strain):
    """A quantity of UNITS, SI units, along a table of scree-element ({column: values})."""
    def measure(stretch):
        return 1 - stretch if strain == "engineering" else -np.log(stretch)
    return {"axial_strain": lambda: measure(np.exp(-table["strain"])),
            "shear_strain": lambda: table["strain"],
            "volume_strain": lambda: measure(table["volume_ratio"]),
            "deviator_stress": lambda: table["stress_xx"] - table["stress_yy"],
            "mean_pressure": lambda: table["mean_pressure"],
            "vertical_stress": lambda: -table["stress_yy"],
            "lateral_stress": lambda: -table["stress_xx"],
            "shear_stress": lambda: table["stress_xy"],
            # The total lateral stress is constant.
            "pore_pressure": lambda: table["stress_xx"] - table["stress_xx"][0]}[name]()


def at_rows(column, coordinate, table, strain):
    """The law's values at the rows of a column."""
    return np.interp(column.strain, law_values(coordinate, table, strain), law_values(column.name, table, strain))
