# SPDX-License-Identifier: LGPL-2.1-or-later
"""The file of a fit, in TOML: free entries of a law with bounds, tests with their cases and tables."""

import pathlib
import re
from typing import NamedTuple

import numpy as np

from scree import settings, variants
from scree.fit import laboratory

TABLES = ("set", "parameters", "tests")
KEYS = ("case", "results", "weights", "strain_step", "starts", "evaluations", *TABLES)
OF_A_PARAMETER = ("start", "low", "high", "scale")
OF_A_TEST = ("case", "data", "set", "strain", "largest_strain", "weight", "columns")
OF_A_COLUMN = ("column", "unit", "zero", "weight", "scale")
LEAST_STEPS = 200  # of a path, however short
SCALES, STRAINS, WEIGHTS = ("linear", "logarithmic"), ("engineering", "logarithmic"), ("strain", "rows")
OWN = {"Final strain": "the fit takes it from the table", "Number of steps": 'it follows from the entry "strain_step"',
       "Output directory": 'name that of the fit by the entry "results"'}


class Parameter(NamedTuple):
    """A free entry. Its place in [0, 1] between the bounds is what least squares varies."""
    entry: str
    start: float
    low: float
    high: float
    is_logarithmic: bool

    def place(self, value):
        low, high, value = (np.log(one) if self.is_logarithmic else one for one in (self.low, self.high, value))
        return (value - low) / (high - low)

    def value(self, place):
        if self.is_logarithmic:
            return float(np.clip(self.low * (self.high / self.low)**place, self.low, self.high))
        return float(np.clip(self.low + (self.high - self.low) * place, self.low, self.high))

    def slope(self, place):
        """The derivative of the value by the place."""
        return self.value(place) * np.log(self.high / self.low) if self.is_logarithmic else self.high - self.low


class Test(NamedTuple):
    """A laboratory test and the case of its path."""
    name: str
    case: pathlib.Path
    path: str
    entries: dict
    strain: str
    coordinate: str
    columns: list
    weight: float


class Problem(NamedTuple):
    """A fit whose entries have been checked."""
    file: pathlib.Path
    folder: pathlib.Path
    parameters: list
    tests: list
    n_starts: int
    n_evaluations: int

    @property
    def n_values(self):
        return sum(len(column.values) for test in self.tests for column in test.columns)


def read(file):
    """Reads and checks a fit. Throws a ValueError with file, entry, value and remedy."""
    file = pathlib.Path(file)
    given = settings.read(file, KEYS, TABLES)
    parameters = [_parameter(file, entry, value) for entry, value in given.get("parameters", {}).items()]
    if not parameters:
        raise ValueError(f'{file}: no entry is free. Write one into [parameters], such as "Mohr-Coulomb/Friction angle" = '
                         "{ start = 32, low = 25, high = 45 }")
    weights, step = settings.choice(file, given, "weights", WEIGHTS), settings.number(file, given, "strain_step", 2e-4)
    tests = [_test(file, given, name, value, weights, step) for name, value in given.get("tests", {}).items()]
    if not tests:
        raise ValueError(f"{file}: there is no test. Write [tests.NAME] with its table (data) and [tests.NAME.columns]")
    for test in tests:
        _check_entries(file, test, given.get("set", {}), parameters)
    problem = Problem(file, pathlib.Path(given.get("results", f"results/{file.stem}")), parameters, tests, settings.count(file, given, "starts", 1),
                      settings.count(file, given, "evaluations", 100))
    if problem.n_values <= len(parameters):
        raise ValueError(f"{file}: too few data: {problem.n_values} values for {len(parameters)} free entries. Add tests or columns, or hold entries in [set]")
    return problem


def _parameter(file, entry, given):
    keys = ("start", "low", "high")
    if not isinstance(given, dict) or not set(keys) <= set(given) <= set(OF_A_PARAMETER) or not all(settings.is_number(given[key]) for key in keys):
        raise settings.fault(file, entry, given, "write { start = 1.2, low = 0.9, high = 1.6 }, and scale = \"logarithmic\" for a value of unknown order",
                             "parameters")
    start, low, high = (float(given[key]) for key in keys)
    is_logarithmic = settings.choice(file, given, "scale", SCALES, f"parameters], [{entry}") == "logarithmic"
    if low >= high:
        raise settings.fault(file, entry, given, f"low = {low:g} is not below high = {high:g}", "parameters")
    if not low <= start <= high:
        raise settings.fault(file, entry, given, f"start = {start:g} is outside of the bounds {low:g} and {high:g}. Change start or the bound", "parameters")
    if is_logarithmic and low <= 0:
        raise settings.fault(file, entry, given, f"a logarithmic scale needs low above 0, and it is {low:g}", "parameters")
    return Parameter(entry, start, low, high, is_logarithmic)


def _test(file, given, name, own, weights, step):
    table = f"tests.{name}"
    settings.check_keys(file, own, OF_A_TEST, table)
    if not re.fullmatch(r"[\w.-]+", name):
        raise ValueError(f'{file}: [tests."{name}"]: write a name of letters, digits, "-" and "_": files get it')
    case = _file(file, "case", own.get("case", given.get("case")), table)
    data = _file(file, "data", own.get("data"), table)
    if not isinstance(own.get("set", {}), dict):
        raise settings.fault(file, "set", own["set"], 'write { "Nor-Sand/Initial specific volume" = 1.7 }', table)
    entries = {entry: settings.text(value) for entry, value in {**given.get("set", {}), **own.get("set", {})}.items()}
    for entry in set(entries) & set(OWN):
        raise settings.fault(file, entry, entries[entry], f"not here: {OWN[entry]}", "set" if entry in given.get("set", {}) else f"{table}.set")
    base = {"Path": "drained triaxial", **variants.read_entries(case), **entries}
    if base["Path"] not in laboratory.COORDINATES:
        raise settings.fault(case, "Path", base["Path"], f"there is no such path{settings.nearest(base['Path'], list(laboratory.COORDINATES))}")
    strain = settings.choice(file, own, "strain", STRAINS, table)
    coordinate, columns = _columns(file, table, data, base["Path"], own, strain, weights)
    largest = max(float(np.max(column.strain)) for column in columns)
    if not 0 < largest < (1 if strain == "engineering" and coordinate != "shear_strain" else 5):
        raise ValueError(f"{data}: the largest {coordinate} is {largest:g} (without unit); compression is positive. Is the unit right?")
    # A little beyond the last row, so that the law's values enclose it.
    final = (1 + 1e-9) * laboratory.final_strain(base["Path"], coordinate, largest, strain)
    entries.update({"Path": base["Path"], "Final strain": f"{final:.12g}", "Number of steps": str(max(LEAST_STEPS, int(np.ceil(final / step))))})
    return Test(name, case, base["Path"], entries, strain, coordinate, columns, settings.number(file, own, "weight", 1., table=table))


def _file(file, key, value, table):
    if value is None:
        raise ValueError(f'{file}: [{table}]: entry "{key}" is missing. Its path counts from {file.name}')
    return settings.path(file, key, value, table)


def _columns(file, table, data, path, own, strain, weights):
    """The name of the coordinate, and the columns that are compared with the law."""
    texts, lines = laboratory.read_csv(data)
    given = own.get("columns", {})
    measured, coordinates = laboratory.MEASURED[path], laboratory.COORDINATES[path]
    settings.check_keys(file, given, tuple(dict.fromkeys(coordinates + measured)), f"{table}.columns")
    values = {name: _values(file, f"{table}.columns.{name}", data, texts, lines, name, one, strain) for name, one in given.items()}
    coordinate = next((name for name in coordinates if name in given), None)
    chosen = [name for name in measured if name in given and name != coordinate]
    if coordinate is None or not chosen:
        missing = coordinates if coordinate is None else measured
        raise ValueError(f"{file}: [{table}.columns]: the path {path} needs {' or '.join(missing)}. "
                         'Write for instance axial_strain = { column = "NAME IN THE TABLE", unit = "%" }')
    x = values[coordinate]
    if "largest_strain" in own:
        largest = settings.number(file, own, "largest_strain", 1., table=table) * laboratory.UNITS[coordinate][given[coordinate].get("unit", "-")]
        x = np.where(x <= largest, x, np.nan)
    _check_coordinate(data, coordinate, x, lines)
    found = []
    for name in chosen:
        there = np.isfinite(x) & np.isfinite(values[name])
        column = f"{table}.columns.{name}"
        is_logarithmic = settings.choice(file, given[name], "scale", SCALES, column) == "logarithmic"
        if not there.any():
            raise ValueError(f"{data}: there is no row with both {coordinate} and {name}")
        if is_logarithmic and np.min(values[name][there]) <= 0:
            raise settings.fault(file, "scale", "logarithmic", "the column has values that are not above 0", column)
        canonical = "volume_strain" if name == "void_ratio" else name
        found.append(laboratory.Column(canonical, x[there], values[name][there], laboratory.row_weights(x[there], weights),
                                       settings.number(file, given[name], "weight", 1., table=column), is_logarithmic))
    return "volume_strain" if coordinate == "void_ratio" else coordinate, found


def _values(file, table, data, texts, lines, name, given, strain):
    """A column of the table in SI units."""
    settings.check_keys(file, given, OF_A_COLUMN, table)
    for key in ("column", "unit"):
        if key not in given:
            raise ValueError(f'{file}: [{table}]: entry "{key}" is missing. Write {name} = {{ column = "NAME IN THE TABLE", unit = "'
                             f'{next(iter(laboratory.UNITS[name]))}" }}')
    if given["column"] not in texts:
        raise settings.fault(file, "column", given["column"], f"there is no such column in {data}{settings.nearest(str(given['column']), list(texts))}", table)
    units = laboratory.UNITS[name]
    if given["unit"] not in units:
        raise settings.fault(file, "unit", given["unit"], f"write one of: {', '.join(units)}", table)
    zero = given.get("zero", 0.)
    if not settings.is_number(zero):
        raise settings.fault(file, "zero", zero, "write the number that is subtracted from the column, in its unit", table)
    values = (laboratory.numbers(data, given["column"], texts[given["column"]], lines) - zero) * units[given["unit"]]
    if name != "void_ratio":
        return values
    if not np.isfinite(values).any():
        raise ValueError(f'{data}: column "{given["column"]}" is empty')
    return laboratory.void_ratio_to_strain(values, strain)


def _check_coordinate(data, coordinate, x, lines):
    """The paths only load: throws a ValueError where the strain falls by more than the scatter of readings."""
    there = np.isfinite(x)
    if not there.any():
        raise ValueError(f"{data}: there is no row with {coordinate}")
    fall = np.maximum.accumulate(np.where(there, x, -np.inf)) - np.where(there, x, np.inf)
    worst = int(np.argmax(fall))
    if fall[worst] > 0.02 * np.nanmax(np.abs(x)):
        raise ValueError(f"{data}, line {lines[worst]}: {coordinate} falls, and the path only loads. Remove what follows, or write largest_strain")


def _check_entries(file, test, common, parameters):
    """That the case may have these entries, and that the law reads them."""
    base = {"Path": test.path, **variants.read_entries(test.case)}
    given = {entry: value for entry, value in test.entries.items() if entry not in ("Path", "Final strain", "Number of steps")}
    law = {**base, **given}.get("Material", "Nor-Sand")
    tables = {"set" if set(given) <= set(common) else f"tests.{test.name}.set": given, "parameters": [one.entry for one in parameters]}
    settings.check_entries(file, base, tables, given, {entry: f" cannot be free: {reason}" for entry, reason in OWN.items()})
    for entry in tables["parameters"]:
        if "/" in entry and entry.split("/")[0] != law:
            raise ValueError(f'{file}: [parameters], entry "{entry}": the law of {test.case} is {law}. Free one of its entries, or change "Material"')
